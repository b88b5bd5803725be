//! The shadows of one light: a single shadow map, or a cube of six.

use super::lanes::{Lanes, Mask};
use super::shadow_cube::ShadowCube;
use super::shadow_map::ShadowMap;
use super::shadow_receiver::ShadowReceiver;

/// The depths of the scene as seen from a light, from which shading finds shadows.
#[derive(Clone, Debug)]
pub enum LightShadow {
    /// The map of a directional or spot light.
    Map(Box<ShadowMap>),
    /// The maps of a point light.
    Cube(Box<ShadowCube>),
}

impl LightShadow {
    /// Computes the visibility of the light, 0 to 1, from the receivers in the `wanted` lanes.
    /// Other lanes are 0.
    ///
    /// Outside the map, for example outside the light's cone, nothing is in shadow.
    #[inline(always)]
    pub(super) fn visibility<const N: usize>(
        &self,
        receiver: &ShadowReceiver<N>,
        wanted: Mask<N>,
    ) -> Lanes<N> {
        match self {
            Self::Map(map) => map.visibility(receiver, wanted),
            Self::Cube(cube) => Lanes::from_fn(|lane| {
                if !wanted[lane] {
                    return 0.0;
                }
                cube.visibility(receiver.positions.lane(lane), receiver.normals.lane(lane))
            }),
        }
    }

    /// Returns the maps, so that their memory can be reused.
    pub fn into_maps(self) -> impl Iterator<Item = ShadowMap> {
        let (map, faces) = match self {
            Self::Map(map) => (Some(*map), Default::default()),
            Self::Cube(cube) => (None, cube.faces),
        };
        map.into_iter().chain(faces.into_iter().flatten())
    }
}
