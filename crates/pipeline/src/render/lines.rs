//! Line drawings of a scene: from the models to the page that every output writes.

use super::RenderError;
use crate::Timings;
use crate::color::SrgbEncoder;
use crate::drawing::{self, Ink, Layer, LineLook, Overlay, Page, Widths};
use crate::scene::{Scene, Style};

/// The ink of lines over surfaces: nearly black.
const INK: Ink = [20, 24, 30];

/// The line drawing of a scene on a page of the picture's size, 96 pixels to the inch. Styles that show surfaces have their
/// hidden lines removed.
///
/// The number of threads does not change it.
///
/// # Errors
/// As [`render`](crate::render()).
pub fn draw(scene: &Scene, threads: usize, timings: &Timings) -> Result<Page, RenderError> {
    let look = scene.style.line_look();
    let drawing = timings.measure("lines", || drawing::draw(scene, &look.options(), threads))?;
    let page = || {
        let mut page = drawing.to_page(&look, &scene.title(), paper(scene.image.background));
        page.layers.extend(drawing::overlays(scene));
        page
    };
    Ok(timings.measure("chains", page))
}

impl Style {
    /// How its lines look.
    #[must_use]
    pub const fn line_look(self) -> LineLook {
        match self {
            Self::Wireframe => LineLook::WIREFRAME,
            Self::Lines(look) => look,
            _ => LineLook::REMOVED,
        }
    }
}

/// The lines that a style or an overlay draws over surfaces: the outlines of toons, and feature edges.
pub(super) fn over_surfaces(scene: &Scene, threads: usize) -> Result<Vec<Layer>, RenderError> {
    let wants_edges = scene.overlays.iter().any(|overlay| matches!(overlay, Overlay::Edges));
    let look = match scene.style {
        _ if !scene.style.shows_surfaces() => return Ok(Vec::new()),
        _ if wants_edges => LineLook { ink: Some(INK), ..LineLook::REMOVED },
        Style::Toon => {
            LineLook { widths: Widths::Pixels(2.0), ink: Some(INK), ..LineLook::SILHOUETTE }
        }
        _ => return Ok(Vec::new()),
    };
    let drawing = drawing::draw(scene, &look.options(), threads)?;
    Ok(drawing.to_page(&look, "", None).layers)
}

/// The background as a colour of paper; `None` if it is transparent.
fn paper(background: [f32; 4]) -> Option<Ink> {
    let [r, g, b, alpha] = SrgbEncoder::shared().pixel(background);
    (alpha == 255).then_some([r, g, b])
}
