//! The lights of a scene file.

use crate::scene::number::{NonNegative, Triple};
use serde::Deserialize;

/// A light.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Light", deny_unknown_fields)]
pub enum LightFile {
    /// Light from very far away: parallel rays.
    Sun {
        /// The direction in which the light travels.
        direction: Triple,
        /// The illuminance of a surface that faces the light; a white one then shows `lux` / π.
        lux: NonNegative,
        /// Red, green and blue, linear. Default: white.
        #[serde(default = "Triple::ones")]
        color: Triple,
    },
    /// Light from a point, weaker with the square of the distance.
    Point {
        /// Where it is.
        position: Triple,
        /// The luminous intensity: the illuminance at distance 1.
        candela: NonNegative,
        /// Red, green and blue, linear. Default: white.
        #[serde(default = "Triple::ones")]
        color: Triple,
    },
    /// The same light from everywhere.
    Ambient {
        /// The illuminance of every surface.
        lux: NonNegative,
        /// Red, green and blue, linear. Default: white.
        #[serde(default = "Triple::ones")]
        color: Triple,
    },
}
