//! The lights of a scene file.

use super::shadow::ShadowsFile;
use crate::scene::number::{Finite, NonNegative, Positive, Triple};
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
        /// Its shadows. Default: the scene's `shadows`.
        shadows: Option<ShadowsFile>,
    },
    /// Light from a point, weaker with the square of the distance. It casts no shadows; a spot does.
    Point {
        /// Where it is.
        position: Triple,
        /// The luminous intensity: the illuminance at distance 1.
        candela: NonNegative,
        /// The distance at which nothing arrives any more. Default: it goes on for ever.
        range: Option<Positive>,
        /// Red, green and blue, linear. Default: white.
        #[serde(default = "Triple::ones")]
        color: Triple,
    },
    /// Light from a point into a cone.
    Spot {
        /// Where it is.
        position: Triple,
        /// The direction of the cone's axis, in which the light travels.
        direction: Triple,
        /// The luminous intensity along the axis.
        candela: NonNegative,
        /// The angle from the axis up to which the light is full. Default: 0.
        inner_degrees: Option<Finite>,
        /// The angle from the axis at which it ends. Default: 45.
        outer_degrees: Option<Finite>,
        /// The distance at which nothing arrives any more. Default: it goes on for ever.
        range: Option<Positive>,
        /// Red, green and blue, linear. Default: white.
        #[serde(default = "Triple::ones")]
        color: Triple,
        /// Its shadows. Default: the scene's `shadows`.
        shadows: Option<ShadowsFile>,
    },
    /// The lights that the models' files have (KHR_lights_punctual).
    FromModels,
    /// The same light from everywhere. It scatters and makes no highlights; an environment does.
    Ambient {
        /// The illuminance of every surface.
        lux: NonNegative,
        /// Red, green and blue, linear. Default: white.
        #[serde(default = "Triple::ones")]
        color: Triple,
    },
}
