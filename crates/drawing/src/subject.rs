//! The input of a line drawing: models, a camera with its projection, the size of the picture, and sections.

use camera::ViewProjection;
use homog::{Plane, World};
use model::ModelInstance;
use viewport::{Viewport, ViewportError};

/// What is drawn, from where, how large, and what cuts it open.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// The models in the world.
    pub models: &'a [ModelInstance],
    /// Camera and projection.
    pub view_projection: ViewProjection,
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// Planes that cut the models open; their unit normals point to the side that is kept.
    pub sections: &'a [Plane<World>],
}

impl Subject<'_> {
    /// The viewport of the whole picture.
    pub(crate) fn viewport(&self) -> Result<Viewport, ViewportError> {
        Viewport::image(self.size[0], self.size[1])
    }
}
