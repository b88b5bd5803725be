//! The surroundings of a scene file.

use crate::scene::number::{Finite, NonNegative, Triple};
use serde::Deserialize;

/// Light from all around: it is scattered, and mirrored in what shines.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Environment", deny_unknown_fields)]
pub enum EnvironmentFile {
    /// None at all, not even for a bare model.
    Dark,
    /// A studio with soft boxes.
    Studio {
        /// What all light is multiplied by. Default: 1.
        #[serde(default = "one")]
        strength: NonNegative,
        /// A turn about the y axis. Default: 0.
        rotate_degrees: Option<Finite>,
    },
    /// A clear sky over grey ground. The sun itself is not part of it; it is a light.
    Sky {
        /// The direction to the sun. Default: (1, 1, 1).
        #[serde(default = "Triple::ones")]
        sun: Triple,
        /// What all light is multiplied by. Default: 1.
        #[serde(default = "one")]
        strength: NonNegative,
    },
    /// The same light from everywhere, mirrored too.
    Uniform {
        /// The luminance from every side. Default: 1.
        #[serde(default = "one")]
        strength: NonNegative,
        /// Red, green and blue, linear. Default: white.
        #[serde(default = "Triple::ones")]
        color: Triple,
    },
    /// A picture of all directions in a `.hdr` file.
    File {
        /// The path, from the folder of the scene file.
        path: String,
        /// What all light is multiplied by. Default: 1.
        #[serde(default = "one")]
        strength: NonNegative,
        /// A turn about the y axis. Default: 0.
        rotate_degrees: Option<Finite>,
    },
}

impl EnvironmentFile {
    /// The studio that bare models stand in: matt white, which shows up to 1.4 in the full one, stays below 1.
    pub const STUDIO: Self =
        Self::Studio { strength: NonNegative::SIX_TENTHS, rotate_degrees: None };
    /// The sky with every default.
    pub const SKY: Self = Self::Sky { sun: Triple([1.0; 3]), strength: NonNegative::ONE };

    /// The picture in a file, as it is.
    #[must_use]
    pub const fn from_path(path: String) -> Self {
        Self::File { path, strength: NonNegative::ONE, rotate_degrees: None }
    }
}

fn one() -> NonNegative {
    NonNegative::ONE
}
