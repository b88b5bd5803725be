//! Rendering: from a resolved scene to a picture.
//!
//! The stages are those of the textbooks, one after the other (PL-1):
//!
//! ```text
//!  positions ─model_to_clip─► clip space ─clip─► pieces ─÷w, viewport, snap─► raster ─► shading ─► pixels
//! ```

mod assemble;
mod backdrop;
mod ground;
mod images;
mod lines;
mod needs;
mod occlusion;
mod paint;
mod panel;
pub mod passes;
mod pixel;
mod region;
mod renderer;
mod shadows;
mod stage;
#[cfg(test)]
mod tests;
mod textures;
mod vertices;
mod viewports;

pub use lines::draw;
pub use paint::{Paint, PaintError, band_rows};
pub use panel::render_panel;
pub use passes::{Pass, PassBuffer, passes};
pub use pixel::{Owner, PixelMakeup, SeenFragment, pixel};
pub use region::MAX_SIDE;
pub use renderer::Renderer;
pub use textures::Textures;

use crate::scene::Scene;
use crate::{Picture, Timings};
use drawing::Warning;
use region::check_region;

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
    /// Its lines cannot be drawn.
    #[error(transparent)]
    Draw(#[from] drawing::DrawError),
    /// Somebody asked for its end by a [`Cancel`](crate::Cancel).
    #[error("the picture was cancelled")]
    Cancelled,
    /// Ambient occlusion reads the whole picture, which has more pixels than can be held.
    #[error("ambient occlusion is for pictures of {} pixels a side at most", raster::MAX_SIDE)]
    OcclusionTooLarge,
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
    render_reported(scene, threads, timings).map(|(picture, _)| picture)
}

/// Renders a scene, and tells what could not be drawn as it should.
///
/// # Errors
/// As [`render`].
pub fn render_reported(
    scene: &Scene,
    threads: usize,
    timings: &Timings,
) -> Result<(Picture, Vec<Warning>), RenderError> {
    let whole = scene.image.rect();
    check_region(scene.image, whole)?;
    let mut paint = Paint::new(scene, threads, timings)?;
    Ok((paint.region(whole)?, paint.into_warnings()))
}
