//! Rendering: from a resolved scene to a picture.
//!
//! The stages are those of the textbooks, one after the other (PL-1):
//!
//! ```text
//!  positions ─model_to_clip─► clip space ─clip─► pieces ─÷w, viewport, snap─► raster ─► shading ─► pixels
//! ```

mod assemble;
mod images;
mod lines;
mod needs;
mod paint;
pub mod passes;
mod pixel;
mod region;
mod renderer;
mod shot;
mod stage;
#[cfg(test)]
mod tests;
mod textures;
mod vertices;

pub use lines::draw;
pub use paint::{Paint, PaintError, band_rows};
pub use passes::{Pass, PassBuffer, passes};
pub use pixel::{Owner, PixelMakeup, SeenFragment, pixel};
pub use region::{MAX_SIDE, Region};
pub use renderer::Renderer;
pub use shot::Shot;
pub use textures::Textures;

use crate::scene::Scene;
use crate::{Picture, Timings};

/// A scene that cannot be rendered.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The picture's size is out of range.
    #[error(transparent)]
    Raster(#[from] raster::RasterError),
    /// The picture has no viewport.
    #[error(transparent)]
    Viewport(#[from] viewport::ViewportError),
    /// There are more points, lines and triangles than can be told apart.
    #[error("the scene has more than {} points, lines and triangles", u32::MAX)]
    TooManyPrimitives,
}

/// Renders a scene with up to `threads` threads. Their number does not change the picture.
///
/// # Errors
/// If the picture's size is out of range or the scene holds too much.
pub fn render(scene: &Scene, threads: usize) -> Result<Picture, RenderError> {
    render_timed(scene, threads, &Timings::default())
}

/// Renders a scene, and measures how long each stage takes.
///
/// # Errors
/// As [`render`].
pub fn render_timed(
    scene: &Scene,
    threads: usize,
    timings: &Timings,
) -> Result<Picture, RenderError> {
    let whole = Region::whole(scene.image);
    whole.check(scene.image)?;
    Paint::new(scene, threads, timings)?.region(whole)
}
