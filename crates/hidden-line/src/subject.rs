//! Subject of a line drawing: models, camera, projection, image size and section planes.

use camera::ViewProjection;
use homog::{ClipRange, Plane, World};
use model::ModelInstance;
use viewport::{Viewport, ViewportError};

/// The input of a line drawing.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// The models in world space.
    pub models: &'a [ModelInstance],
    /// The camera and the projection.
    pub view_projection: ViewProjection,
    /// The width and height of the image in pixels.
    pub size: [u32; 2],
    /// The height in pixels of the caption strip at the bottom, which does not show the view, or 0
    /// for no caption.
    pub caption_height: u32,
    /// The section planes; each retains the side to which its unit normal points.
    pub sections: &'a [Plane<World>],
    /// The objects that the sections do not cut, in ascending order. Objects are the nodes with a
    /// mesh, numbered across all models.
    pub uncut: &'a [u32],
}

impl Subject<'_> {
    /// Returns the viewport of the whole image.
    ///
    /// # Errors
    /// Fails if the image has no pixels, or too many.
    pub fn viewport(&self) -> Result<Viewport, ViewportError> {
        Viewport::image_for(self.size[0], self.size[1], ClipRange::CHAPTER)
    }

    /// Returns the fraction of the image's height, from the top, that shows the view.
    #[must_use]
    pub fn view_height(&self) -> f64 {
        1.0 - f64::from(self.caption_height) / f64::from(self.size[1].max(1))
    }
}
