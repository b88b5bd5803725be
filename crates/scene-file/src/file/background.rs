//! The background of an image in a scene file.

use crate::color::Color;
use crate::number::{Finite, NonNegative};
use crate::schema::scene_enum;
use shade::ImageFit;

scene_enum! {
    /// The background, visible behind the models.
    pub enum BackgroundFile as "Background" {
        /// No background: alpha is 0.
        Transparent,
        /// A single color.
        Color(Color),
        /// A gradient across the whole image, interpolated in sRGB as on web pages.
        Gradient {
            /// From 2 to 16 evenly spaced colors; the first and the last touch the borders or
            /// corners of the image.
            colors: Vec<Color>,
            /// The direction in which the colors run, in degrees: 0 is down, 90 is to the right and
            /// 180 is up. Default: 0.
            angle_degrees: Finite = Finite::ZERO,
        },
        /// A PNG, JPEG or WebP image file with at most 67,108,864 pixels. Exposure does not affect
        /// it.
        Picture {
            /// The path, relative to the scene file's folder.
            path: String,
            /// The way the picture is scaled to fit the image. Default: `Cover`.
            fit: ImageFit = ImageFit::Cover,
            /// The color around the picture and behind transparent parts. Default: none (alpha is
            /// 0).
            color: Option<Color>,
        },
        /// The scene's environment.
        Environment {
            /// The amount of blur, from 0 to 1. Default: 0.
            blur: Option<NonNegative>,
        },
    }
}
