//! Overlays in a scene file: annotations drawn over the picture.

use super::camera::CameraFile;
use crate::color::Color;
use crate::number::{Finite, LabelSize, Positive, Triple};
use crate::schema::scene_enum;

scene_enum! {
    /// An annotation drawn over the picture.
    pub enum OverlayFile as "Overlay" {
        /// The world axes.
        Axes {
            /// Their length. Default: chosen to suit the models.
            length: Option<Positive>,
        },
        /// A grid on the ground, y = 0.
        Grid {
            /// The distance between its lines. Default: a round number that suits the models.
            step: Option<Positive>,
        },
        /// The horizon: where horizontal directions vanish.
        Horizon,
        /// The vanishing points of the axes, with lines from the corners of the box around the
        /// models.
        VanishingPoints,
        /// The view volume and the eye of another camera.
        Volume(CameraFile),
        /// Text at a point in the world, drawn over the models even where they hide the point. A
        /// point outside the picture gets a warning instead of a label.
        Label {
            /// The point in the world.
            at: Triple,
            /// The text, a single line, drawn with strokes as on drawings.
            text: String,
            /// The offset from the point to the nearest corner of the text, in pixels to the right
            /// and down; if either is 0, to the middle of the nearest side. Text that would extend
            /// beyond the picture is moved inside. Default: (5, -5); (24, -24) with a leader line.
            offset: Option<(Finite, Finite)>,
            /// The color. Default: dark, or light on a dark background.
            color: Option<Color>,
            /// The height of capitals in pixels, from 1 to 1000. Default: 12.
            size: LabelSize = LabelSize::DEFAULT,
            /// Whether a leader line, ending in a dot, joins the text and the point. Default:
            /// false.
            leader: bool = false,
        },
        /// The visible edges of the surfaces: silhouettes, boundaries and creases. Line drawings
        /// show them anyway.
        Edges,
    }
}
