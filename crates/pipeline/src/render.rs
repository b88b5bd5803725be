//! Rendering: from a resolved scene to a picture.
//!
//! The stages are those of the textbooks, one after the other (PL-1):
//!
//! ```text
//!  positions ─model_to_clip─► clip space ─clip─► pieces ─÷w, viewport, snap─► raster ─► shading ─► pixels
//! ```

mod ambient_occlusion;
mod background;
mod banded_renderer;
mod ground;
mod image_tiles;
mod insets;
mod line_drawing;
mod mip_chains;
mod panel;
pub mod passes;
mod pixel_inspection;
mod primitive_assembly;
mod projected_mesh;
mod renderer;
mod screen_transform;
mod shadow_maps;
#[cfg(test)]
mod tests;
mod vertex_inputs;
mod vertex_processing;

pub use banded_renderer::{BandedRenderer, WritePngError, rows_per_band};
pub use image_tiles::MAX_IMAGE_SIDE;
pub use line_drawing::draw_lines;
pub use mip_chains::Textures;
pub use panel::render_panel;
pub use passes::{Pass, PassBuffer, render_passes};
pub use pixel_inspection::{FragmentSource, PixelFragments, ShadedFragment, inspect_pixel};
pub use renderer::Renderer;

use crate::scene::Scene;
use crate::{Picture, Timings};
use drawing::Warning;
use image_tiles::validate_region;

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
    let image_rect = scene.image.pixel_rect();
    validate_region(scene.image, image_rect)?;
    let mut paint = BandedRenderer::new(scene, threads, timings)?;
    Ok((paint.render_region(image_rect)?, paint.into_warnings()))
}
