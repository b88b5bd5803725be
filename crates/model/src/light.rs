//! Lights of a file (KHR_lights_punctual): without size, each carried by nodes that place it and point it along −z.
//!
//! Scenes have lights of their own too ([`shade::Light`](shade::Light)).

use super::{MeshInstance, Model};

/// A light of the file.
#[derive(Clone, PartialEq, Debug)]
pub struct PunctualLight {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// Red, green and blue, linear, each in [0, 1].
    pub color: [f32; 3],
    /// How bright it is, at least 0: the illuminance in lux for [`Directional`](LightKind::Directional), the luminous
    /// intensity in candela for the others.
    pub intensity: f32,
    /// Where it goes.
    pub kind: LightKind,
}

/// Where the light of a punctual light goes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum LightKind {
    /// From very far away along the node's −z.
    Directional,
    /// From the node's place everywhere, weaker with the square of the distance.
    Point {
        /// The distance in the world at which nothing arrives any more, above 0; infinite unless the file gives it.
        range: f32,
    },
    /// From the node's place into a cone around its −z.
    Spot {
        /// As for a point.
        range: f32,
        /// The angle from the axis in radians up to which the light is full: at least 0, less than `outer`.
        inner_cone_angle: f32,
        /// The angle from the axis in radians at which the light ends, at most π/2.
        outer_cone_angle: f32,
    },
}

impl LightKind {
    /// The name that glTF has for it.
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
    /// The lights of the shown scene, each with the place of the node that carries it.
    pub fn scene_lights(&self) -> impl Iterator<Item = (MeshInstance, &PunctualLight)> {
        self.node_instances().into_iter().filter_map(|instance| {
            let light = self.nodes[instance.node].light?;
            Some((instance, self.lights.get(light)?))
        })
    }
}
