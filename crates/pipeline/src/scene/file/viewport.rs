//! Several views in one picture, and pairs for two eyes, in a scene file.

use super::background::BackgroundFile;
use super::camera::CameraFile;
use super::look::StyleFile;
use super::overlay::OverlayFile;
use crate::scene::number::{Positive, Share};
use serde::Deserialize;

/// A rectangle of the picture with a view of its own, drawn over what is there. PNG pictures and films have it; SVG and PDF, passes
/// and `explain` show the scene's own camera alone. One of `at` and `pixels` says where it is.
#[derive(Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(rename = "Viewport", deny_unknown_fields, default)]
pub struct ViewportFile {
    /// Left, top, width and height in parts of the picture, from 0 to 1, from its upper left corner. Default: as `pixels` says.
    pub at: Option<(Share, Share, Share, Share)>,
    /// The same in pixels. Default: as `at` says.
    pub pixels: Option<(u32, u32, u32, u32)>,
    /// The camera. Default: that of the scene.
    pub camera: Option<CameraFile>,
    /// How surfaces are drawn. Default: as in the scene.
    pub style: Option<StyleFile>,
    /// What is seen where no model is; all of it is in the rectangle. Default: as in the scene.
    pub background: Option<BackgroundFile>,
    /// What is drawn over it. Default: as in the scene.
    pub overlays: Option<Vec<OverlayFile>>,
    /// A border, inside of the rectangle. Default: none.
    pub border: Option<BorderFile>,
}

/// The border of a viewport.
#[derive(Clone, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename = "Border", deny_unknown_fields, default)]
pub struct BorderFile {
    /// `#rgb` or `#rrggbb`. Default: black.
    pub color: String,
    /// Its width in pixels, from 1 to 1000. Default: 1.
    pub width: u32,
}

impl Default for BorderFile {
    fn default() -> Self {
        Self { color: "#000".to_owned(), width: 1 }
    }
}

/// Two pictures, for two eyes beside the camera. They look the same way through windows off their axes, so that both see what is at
/// the distance of convergence in the same place, and nothing is shifted up or down. The projection must be a perspective.
#[derive(Clone, Copy, PartialEq, Debug, Deserialize)]
#[serde(rename = "Stereo", deny_unknown_fields)]
pub enum StereoFile {
    /// The left eye's picture in the left half, the right eye's in the right half.
    SideBySide {
        /// How far the eyes are apart, in the world's units. Default: a thirtieth of the convergence.
        eye_distance: Option<Positive>,
        /// How far ahead the plane is whose points both see in the same place: what is nearer stands out of the picture. Default: the distance of
        /// the middle of the models.
        convergence: Option<Positive>,
    },
    /// One over the other for glasses of red and cyan: red from the left eye's picture, green and blue from the right eye's.
    Anaglyph {
        /// How far the eyes are apart, in the world's units. Default: a thirtieth of the convergence.
        eye_distance: Option<Positive>,
        /// As for `SideBySide`. Default: the distance of the middle of the models.
        convergence: Option<Positive>,
    },
}
