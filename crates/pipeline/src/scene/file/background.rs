//! What is behind the models in a scene file.

use crate::scene::number::{Finite, NonNegative};
use serde::Deserialize;

/// What is seen where no model is.
#[derive(Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(rename = "Background", deny_unknown_fields)]
pub enum BackgroundFile {
    /// Nothing: alpha is 0.
    #[default]
    Transparent,
    /// A colour as on a web page: `#rgb` or `#rrggbb`.
    Color(String),
    /// Colours that run into each other across the whole picture, mixed as web pages mix them.
    Gradient {
        /// From 2 to 16 colours, `#rgb` or `#rrggbb`, at equal distances; the first and the last touch the picture's borders or corners.
        colors: Vec<String>,
        /// Where the colours run to, in degrees: 0 is down, 90 to the right, 180 up. Default: 0.
        #[serde(default)]
        angle_degrees: Finite,
    },
    /// A picture in a PNG, JPEG or WebP file, of 67,108,864 pixels at most. Its light is not changed by the exposure.
    Picture {
        /// The path, from the folder of the scene file.
        path: String,
        /// How it fills the picture. Default: `Cover`.
        #[serde(default)]
        fit: FitFile,
        /// What is seen beside it and through it: `#rgb` or `#rrggbb`. Default: nothing, alpha is 0.
        color: Option<String>,
    },
    /// The environment.
    Environment {
        /// How blurred, from 0 to 1. Default: 0.
        blur: Option<NonNegative>,
    },
}

/// How a picture fills another.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(rename = "Fit")]
pub enum FitFile {
    /// Stretched to its size.
    Stretch,
    /// As small as covers all of it; what is too much is cut off on both sides alike.
    #[default]
    Cover,
    /// As large as fits into it, in the middle.
    Contain,
}
