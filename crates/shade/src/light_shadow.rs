//! The shadows of one light: a single shadow map, or a cube of six.

use super::shadow_cube::ShadowCube;
use super::shadow_map::ShadowMap;

/// The depths of a scene from a light, by which shading finds what is in its shadow.
#[derive(Clone, Debug)]
pub enum LightShadow {
    /// The map of a directional or spot light.
    Map(ShadowMap),
    /// The maps of a point light.
    Cube(Box<ShadowCube>),
}

impl LightShadow {
    /// The visibility of the light, 0 to 1, from a position in the world with this unit normal.
    ///
    /// Where there is no map, beside the light's cone for instance, nothing is in shadow.
    #[inline(always)]
    pub(super) fn visibility(&self, position: [f32; 3], normal: [f32; 3]) -> f32 {
        match self {
            Self::Map(map) => map.visibility(position, normal),
            Self::Cube(cube) => cube.visibility(position, normal),
        }
    }

    /// Its maps, for their memory.
    pub fn into_maps(self) -> impl Iterator<Item = ShadowMap> {
        let (map, faces) = match self {
            Self::Map(map) => (Some(map), Default::default()),
            Self::Cube(cube) => (None, cube.faces),
        };
        map.into_iter().chain(faces.into_iter().flatten())
    }
}
