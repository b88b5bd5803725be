//! Overlays in a scene file: what is drawn over the picture to explain it.

use super::camera::CameraFile;
use crate::scene::number::Positive;
use serde::Deserialize;

/// Something drawn over the picture.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Overlay", deny_unknown_fields)]
pub enum OverlayFile {
    /// The axes of the world.
    Axes {
        /// How long they are. Default: as goes with the models.
        length: Option<Positive>,
    },
    /// A grid on the ground, y = 0.
    Grid {
        /// The distance of its lines. Default: a round one that goes with the models.
        step: Option<Positive>,
    },
    /// Where horizontal directions vanish.
    Horizon,
    /// Where the axes vanish, with the lines from the corners of the box around the models.
    VanishingPoints,
    /// What another camera sees: its view volume and its eye.
    Volume(CameraFile),
    /// The edges of the surfaces where they can be seen: outlines, borders, creases. Line drawings have them anyway.
    Edges,
}
