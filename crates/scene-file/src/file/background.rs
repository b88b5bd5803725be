//! The background of an image in a scene file.

use crate::color::Color;
use crate::number::{Finite, NonNegative};
use crate::schema::scene_enum;
use shade::ImageFit;

scene_enum! {
    /// The background: what the image shows where no model is.
    pub enum BackgroundFile as "Background" {
        /// Nothing: alpha is 0.
        Transparent,
        /// One color.
        Color(Color),
        /// A gradient across the whole image, interpolated in sRGB as web pages do.
        Gradient {
            /// From 2 to 16 colors at equal distances; the first and the last touch the image's
            /// borders or corners.
            colors: Vec<Color>,
            /// The direction the colors run to, in degrees: 0 is down, 90 to the right, 180 up.
            /// Default: 0.
            angle_degrees: Finite = Finite::ZERO,
        },
        /// An image in a PNG, JPEG or WebP file, of 67,108,864 pixels at most. The exposure does
        /// not change its light.
        Picture {
            /// The path, from the folder of the scene file.
            path: String,
            /// How it fills the image. Default: `Cover`.
            fit: ImageFit = ImageFit::Cover,
            /// The color beside it and behind its transparent parts. Default: nothing, alpha is 0.
            color: Option<Color>,
        },
        /// The environment.
        Environment {
            /// How blurred it is, from 0 to 1. Default: 0.
            blur: Option<NonNegative>,
        },
    }
}
