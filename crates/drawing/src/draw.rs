//! Draws a subject: hidden-line removal, hatching by luma, and a fill image of the faces.
//!
//! ```text
//!   subject ─► hidden_line: segments, regions, faces ─┬─► Drawing
//!                  ▲                                  │
//!   key light ─► luma of each face              face_fill: a z-buffer color image
//! ```

use super::face_fill::{FillOptions, KeyLight, rasterize_fill};
use crate::{Drawing, FaceFill};
use camera::ViewProjection;
use glam::DVec3;
use hidden_line::{
    DrawError, DrawOptions, FaceHatching, Projector, Subject, WeldedSurface, Workers,
};
use homog::ClipRange;
use viewport::Viewport;

/// Draws the edges of a subject with hidden-line removal, and the fill of its faces. `workers` is
/// the number of threads, optionally with a monitor; the number does not change the drawing.
///
/// # Errors
/// Fails if [`hidden_line::draw`] does, or if the fill has too many faces or pixels.
pub fn draw<'a>(
    subject: &Subject<'_>,
    options: &DrawOptions,
    fill: &FillOptions,
    workers: impl Into<Workers<'a>>,
) -> Result<Drawing, DrawError> {
    let Subject { view_projection, size, .. } = subject;
    let luma = face_luma(view_projection, *size, fill.face_fill)?;
    let hatching = face_hatching(fill.face_fill, &luma);
    let (lines, faces) = hidden_line::draw_hatched(subject, options, hatching, workers)?;
    let face_fill = rasterize_fill(faces.colored(), view_projection, *size, fill)?;
    Ok(Drawing { face_fill, ..lines.into() })
}

/// Draws a welded surface and the fill of its faces as seen from one camera, in an image of `size`
/// pixels; otherwise like [`draw`].
///
/// # Errors
/// See [`draw`].
pub fn draw_surface<'a>(
    surface: &WeldedSurface,
    view_projection: &ViewProjection,
    size: [u32; 2],
    options: &DrawOptions,
    fill: &FillOptions,
    workers: impl Into<Workers<'a>>,
) -> Result<Drawing, DrawError> {
    let luma = face_luma(view_projection, size, fill.face_fill)?;
    let hatching = face_hatching(fill.face_fill, &luma);
    let lines =
        hidden_line::draw_surface(surface, view_projection, size, options, hatching, workers)?;
    let face_fill = rasterize_fill(surface.faces_with_colors(), view_projection, size, fill)?;
    Ok(Drawing { face_fill, ..lines.into() })
}

/// Returns a function that computes the luma of a face under the key light of a view. Material
/// colors count only if the fill shows them.
fn face_luma(
    view_projection: &ViewProjection,
    [width, height]: [u32; 2],
    fill: FaceFill,
) -> Result<impl Fn([DVec3; 3], [f32; 3]) -> f64, DrawError> {
    let projector =
        Projector::new(view_projection, &Viewport::image_for(width, height, ClipRange::CHAPTER)?);
    let key_light = KeyLight::new(view_projection, projector);
    let colors_count = fill == FaceFill::Hatching;
    Ok(move |vertices, color| {
        key_light.face_luma(vertices, if colors_count { color } else { [1.0; 3] })
    })
}

/// Returns the face hatching that a fill requires.
fn face_hatching(fill: FaceFill, luma: &dyn Fn([DVec3; 3], [f32; 3]) -> f64) -> FaceHatching<'_> {
    match fill {
        FaceFill::Hatching | FaceFill::ShadeHatching => FaceHatching::ByLuma(luma),
        FaceFill::PartHatching => FaceHatching::Parts,
        FaceFill::None | FaceFill::Flat | FaceFill::Gray => FaceHatching::None,
    }
}
