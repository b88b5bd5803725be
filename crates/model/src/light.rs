//! Punctual lights from a file (KHR_lights_punctual): directional, point and spot lights.
//!
//! They have no size. The node that a light is attached to sets its position, and the node's −z is
//! its direction. Lights added by scene files have a separate type, in the `shade` crate.

use super::{MeshInstance, Model};

/// A directional, point or spot light from the file.
///
/// The extension attenuates point and spot lights by 1 / d² and, with a finite range, by a window
/// that reaches 0 at the range. Spot lights fall off smoothly between the two cone angles. The
/// formulas are in the `shade` crate.
#[derive(Clone, PartialEq, Debug)]
pub struct PunctualLight {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// Linear red, green and blue, each in [0, 1].
    pub color: [f32; 3],
    /// Brightness, at least 0: illuminance in lux for [`Directional`](LightKind::Directional),
    /// luminous intensity in candela for point and spot lights.
    pub intensity: f32,
    /// The type of the light, with its spatial distribution.
    pub kind: LightKind,
}

/// The type and spatial distribution of a punctual light.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum LightKind {
    /// Parallel light from infinity along the node's −z.
    Directional,
    /// Light from the node's position in all directions, attenuated by the square of the distance.
    Point {
        /// Distance in world units at which the light has faded to zero, > 0. Default: infinite.
        range: f32,
    },
    /// Light from the node's position into a cone around its −z.
    Spot {
        /// The same as for a point light.
        range: f32,
        /// Angle from the axis in radians up to which the light has full strength, at least 0 and
        /// less than `outer_cone_angle`.
        inner_cone_angle: f32,
        /// Angle from the axis in radians at which the light has fallen off to zero, at most π/2.
        outer_cone_angle: f32,
    },
}

impl LightKind {
    /// Returns the value of `type` in glTF: `directional`, `point` or `spot`.
    #[must_use]
    pub const fn gltf_name(self) -> &'static str {
        match self {
            Self::Directional => "directional",
            Self::Point { .. } => "point",
            Self::Spot { .. } => "spot",
        }
    }
}

impl Model {
    /// Returns the lights of the active scene, each with the instance of its node.
    pub fn scene_lights(&self) -> impl Iterator<Item = (MeshInstance, &PunctualLight)> {
        self.node_instances().into_iter().filter_map(|instance| {
            let light = self.nodes[instance.node].light?;
            Some((instance, self.lights.get(light)?))
        })
    }
}
