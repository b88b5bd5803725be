//! Rendering: from a resolved scene to a picture.
//!
//! The stages are those of the textbooks, one after the other (PL-1):
//!
//! ```text
//!  positions ─model_to_clip─► clip space ─clip─► pieces ─÷w, viewport, snap─► raster ─► shading ─► pixels
//! ```

mod assemble;
mod ground;
mod images;
mod lines;
mod occlusion;
mod pixel;
mod renderer;
mod shadows;
mod shot;
mod stage;
#[cfg(test)]
mod tests;
mod textures;
mod vertices;

pub use lines::draw;
pub use pixel::{Owner, PixelMakeup, SeenFragment, pixel};
pub use renderer::Renderer;
pub use shot::Shot;
pub use textures::Textures;

use crate::drawing::{Warning, overlays};
use crate::scene::{Scene, Style};
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
    /// Somebody asked for its end by a [`Cancel`](crate::Cancel).
    #[error("the picture was cancelled")]
    Cancelled,
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
    match scene.style {
        Style::Shaded | Style::Flat => {
            let picture = surfaces(scene, threads, timings)?;
            let is_cut = !scene.sections.is_empty();
            let warnings = is_cut.then_some(Warning::SectionsUnseen).into_iter().collect();
            Ok((picture.under(&overlays(scene)), warnings))
        }
        Style::Wireframe | Style::Lines(_) => lines::picture(scene, threads, timings),
    }
}

fn surfaces(scene: &Scene, threads: usize, timings: &Timings) -> Result<Picture, RenderError> {
    let textures = timings.measure("mip chains", || Textures::of(&scene.models));
    let mut picture = Picture::default();
    Renderer::default().render(scene, &textures, threads, timings, &mut picture)?;
    Ok(picture)
}
