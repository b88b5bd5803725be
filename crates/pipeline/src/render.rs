//! Rendering: from a resolved scene to a picture.
//!
//! The stages are those of the textbooks, one after the other (PL-1):
//!
//! ```text
//!  positions ─model_to_clip─► clip space ─clip─► pieces ─÷w, viewport, snap─► raster ─► shading ─► pixels
//! ```

mod assemble;
mod shot;
mod stage;
#[cfg(test)]
mod tests;
mod textures;
mod vertices;
mod wireframe;

pub use shot::Shot;

use crate::canvas::Canvas;
use crate::color::SrgbEncoder;
use crate::scene::{Scene, Style};
use crate::shade::Shading;
use crate::{Picture, Timings};
use assemble::Assembly;
use textures::Textures;

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
    match scene.style {
        Style::Shaded | Style::Flat => surfaces(scene, threads, timings),
        Style::Wireframe => timings.measure("lines", || lines(scene)),
    }
}

fn surfaces(scene: &Scene, threads: usize, timings: &Timings) -> Result<Picture, RenderError> {
    let image = scene.image;
    let textures = timings.measure("mip chains", || Textures::of(scene));
    let assembled = timings.measure("vertices", || Assembly::of(scene, &textures))?;
    let Assembly { frame, draws } = assembled;
    let shading = Shading {
        draws: &draws,
        lights: &scene.lights,
        environment: scene.environment.as_deref(),
        develop: scene.develop,
        viewer: scene.shot.viewer(),
        instructions: frame.instructions(),
    };
    let mut pixels = vec![[0; 4]; image.width as usize * image.height as usize];
    let encoder = SrgbEncoder::shared();
    timings.measure("pixels", || {
        frame.draw(&shading, image.background, threads, &mut pixels, encoder);
    });
    Ok(Picture { width: image.width, height: image.height, pixels })
}

fn lines(scene: &Scene) -> Result<Picture, RenderError> {
    let image = scene.image;
    let segments = wireframe::segments(scene)?;
    let (width, height) = (image.width, image.height);
    let too_large = raster::RasterError::Size { x: 0, y: 0, width, height };
    let mut canvas = Canvas::new(width, height, image.background).ok_or(too_large)?;
    canvas.lines(&segments, wireframe::LINE_WIDTH, wireframe::ink(image.background));
    Ok(canvas.into_picture())
}
