//! The lights of a scene file.

use super::shadow::ShadowsFile;
use crate::color::LightColor;
use crate::number::{Finite, NonNegative, Positive, Triple};
use crate::schema::scene_enum;

scene_enum! {
    /// A light, in the units of KHR_lights_punctual.
    pub enum LightFile as "Light" {
        /// A light at infinity, such as the sun: its rays are parallel.
        Directional {
            /// The direction in which the light travels.
            direction: Triple,
            /// The illuminance in lux of a surface that faces the light; a white surface then has
            /// the linear value `intensity` / π.
            intensity: NonNegative,
            /// The color. Default: white.
            color: LightColor = LightColor::WHITE,
            /// Its shadows. Default: the scene's `shadows`.
            shadows: Option<ShadowsFile>,
        },
        /// A point light, whose light falls off with the square of the distance.
        Point {
            /// The position.
            position: Triple,
            /// The luminous intensity in candela: the illuminance at a distance of 1.
            intensity: NonNegative,
            /// The distance beyond which the light has no effect. Default: infinite.
            range: Option<Positive>,
            /// The color. Default: white.
            color: LightColor = LightColor::WHITE,
            /// Its shadows, from six shadow maps. Default: the scene's `shadows`.
            shadows: Option<ShadowsFile>,
        },
        /// A spot light: a point light restricted to a cone.
        Spot {
            /// The position.
            position: Triple,
            /// The direction of the cone's axis, in which the light travels.
            direction: Triple,
            /// The luminous intensity in candela along the axis.
            intensity: NonNegative,
            /// The angle from the axis where the falloff begins. Default: 0.
            inner_cone_degrees: Option<Finite>,
            /// The angle from the axis where the falloff ends. Default: 45.
            outer_cone_degrees: Option<Finite>,
            /// The distance beyond which the light has no effect. Default: infinite.
            range: Option<Positive>,
            /// The color. Default: white.
            color: LightColor = LightColor::WHITE,
            /// Its shadows. Default: the scene's `shadows`.
            shadows: Option<ShadowsFile>,
        },
        /// The lights in the models' files (KHR_lights_punctual).
        FromModels,
        /// Uniform diffuse light from all directions. Unlike an environment, it does not produce
        /// highlights.
        Ambient {
            /// The illuminance in lux of every surface.
            intensity: NonNegative,
            /// The color. Default: white.
            color: LightColor = LightColor::WHITE,
        },
    }
}

impl LightFile {
    /// Returns the distance beyond which the light has no effect, in world units, or `None` if
    /// unlimited.
    #[must_use]
    pub const fn range(&self) -> Option<Positive> {
        match self {
            Self::Point { range, .. } | Self::Spot { range, .. } => *range,
            Self::Directional { .. } | Self::FromModels | Self::Ambient { .. } => None,
        }
    }
}
