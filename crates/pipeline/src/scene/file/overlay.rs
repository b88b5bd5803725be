//! Overlays in a scene file: explanations drawn over the picture.

use super::camera::CameraFile;
use crate::scene::number::Positive;
use crate::scene::schema::scene_enum;

scene_enum! {
    /// An explanation drawn over the picture.
    pub enum OverlayFile as "Overlay" {
        /// The axes of the world.
        Axes {
            /// Their length. Default: to suit the models.
            length: Option<Positive>,
        },
        /// A grid on the ground, y = 0.
        Grid {
            /// The distance of its lines. Default: a round number to suit the models.
            step: Option<Positive>,
        },
        /// The horizon: where horizontal directions vanish.
        Horizon,
        /// The vanishing points of the axes, with the lines from the corners of the box around the
        /// models.
        VanishingPoints,
        /// The view volume and the eye of another camera.
        Volume(CameraFile),
        /// The visible edges of the surfaces: silhouettes, boundaries, creases. Line drawings have
        /// them anyway.
        Edges,
    }
}
