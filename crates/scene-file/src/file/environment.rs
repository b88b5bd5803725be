//! The environment of a scene file: light from all directions.

use crate::color::LightColor;
use crate::number::{Finite, NonNegative, Triple};
use crate::schema::scene_enum;

scene_enum! {
    /// Image-based light from all directions: it lights diffuse surfaces and is reflected in shiny
    /// ones.
    pub enum EnvironmentFile as "Environment" {
        /// No environment, not even for a model without a scene file.
        Dark,
        /// A studio with soft boxes.
        Studio {
            /// A factor for its intensity. Default: 1.
            strength: NonNegative = NonNegative::ONE,
            /// The rotation about the y axis. Default: 0.
            rotation_degrees: Option<Finite>,
        },
        /// A clear sky over gray ground. The sun is not included; add it as a light.
        Sky {
            /// The direction to the sun. Default: (1, 1, 1).
            sun: Triple = Triple::ONES,
            /// A factor for its intensity. Default: 1.
            strength: NonNegative = NonNegative::ONE,
        },
        /// Uniform light from all directions, also visible in reflections.
        Uniform {
            /// The luminance from every direction. Default: 1.
            strength: NonNegative = NonNegative::ONE,
            /// The color. Default: white.
            color: LightColor = LightColor::WHITE,
        },
        /// An equirectangular image in a `.hdr` file.
        File {
            /// The path, relative to the scene file's folder.
            path: String,
            /// A factor for its intensity. Default: 1.
            strength: NonNegative = NonNegative::ONE,
            /// The rotation about the y axis. Default: 0.
            rotation_degrees: Option<Finite>,
        },
    }
}

impl EnvironmentFile {
    /// The studio around a model without a scene file. Together with the key light, it lights matte
    /// white to at most 0.95.
    pub const STUDIO: Self =
        Self::Studio { strength: NonNegative::BARE_STUDIO, rotation_degrees: None };
    /// The studio around a model with lights but without a scene file.
    pub const DIMMED_STUDIO: Self =
        Self::Studio { strength: NonNegative::DIMMED_STUDIO, rotation_degrees: None };
    /// The sky with all defaults.
    pub const SKY: Self = Self::Sky { sun: Triple::ONES, strength: NonNegative::ONE };

    /// Returns the image in a file, with all defaults.
    #[must_use]
    pub const fn from_path(path: String) -> Self {
        Self::File { path, strength: NonNegative::ONE, rotation_degrees: None }
    }
}
