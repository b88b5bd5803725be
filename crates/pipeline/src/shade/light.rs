//! Lights, resolved: in the world, in the units of photometry.

use super::draw::{dot, length};

/// A light of the resolved scene. Colours are linear and already multiplied by the light's strength.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Light {
    /// Parallel light from very far away.
    Sun {
        /// The unit direction towards the light.
        towards: [f32; 3],
        /// The illuminance of a surface that faces it, in lux.
        lux: [f32; 3],
    },
    /// Light from a point.
    Point {
        /// Where it is.
        position: [f32; 3],
        /// The luminous intensity in candela: lux at distance 1.
        candela: [f32; 3],
    },
    /// The same light from everywhere.
    Ambient {
        /// The illuminance of every surface, in lux.
        lux: [f32; 3],
    },
}

impl Light {
    /// The illuminance at `place` of a surface with the given unit normal.
    pub(super) fn illuminance(&self, place: [f32; 3], normal: [f32; 3]) -> [f32; 3] {
        match *self {
            Self::Sun { towards, lux } => lux.map(|c| c * dot(normal, towards).max(0.0)),
            Self::Point { position, candela } => {
                let way = [0, 1, 2].map(|k| position[k] - place[k]);
                let distance = length(way);
                // The cosine is dot / distance, and the illuminance goes with the inverse square of the distance.
                let falloff = dot(normal, way).max(0.0) / (distance * distance * distance);
                candela.map(|c| if distance > 0.0 { c * falloff } else { 0.0 })
            }
            Self::Ambient { lux } => lux,
        }
    }
}
