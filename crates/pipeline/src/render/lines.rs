//! Line drawings of a scene: from the models to the page that every output writes.

use super::RenderError;
use crate::scene::{ImageSpec, Scene, Style};
use drawing::{
    Ink, Layer, LineLook, MILLIMETRES_PER_PIXEL, Overlay, Page, Pasted, Warning, Widths,
    micrometres,
};
use glam::DVec2;
use model::Timings;
use shade::Painting;
use shade::color::SrgbEncoder;

/// The most pixels along a side of a picture that lies under lines.
const MOST_PASTED: u32 = 4096;

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
    let drawing =
        timings.measure("lines", || drawing::draw(&scene.subject(), &look.options(), threads))?;
    let page = || {
        let mut page = drawing.to_page(&look, &scene.title(), paper(scene.image.background));
        page.pictures.extend(scene.painting.as_ref().map(|all| pasted(all, scene.image)));
        page.layers.extend(scene_overlays(scene));
        page.warnings.extend((!scene.views.is_empty()).then_some(Warning::ViewportsUnseen));
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
    let drawing = drawing::draw(&scene.subject(), &look.options(), threads)?;
    Ok(drawing.to_page(&look, "", None).layers)
}

/// The layers of all overlays of a scene, on a page of the picture's size.
pub(super) fn scene_overlays(scene: &Scene) -> Vec<Layer> {
    drawing::overlays(&scene.subject(), &scene.overlays, scene.style.line_look().hidden)
}

/// What is painted behind the models as a picture of the size of the page.
fn pasted(painting: &Painting, image: ImageSpec) -> Pasted {
    let side = |pixels: u32| f64::from(pixels) * MILLIMETRES_PER_PIXEL;
    let size = micrometres(DVec2::new(side(image.width), side(image.height)));
    let (width, height) = (image.width.min(MOST_PASTED), image.height.min(MOST_PASTED));
    Pasted {
        id: "background".to_owned(),
        corner: [0; 2],
        size,
        picture: painting.picture(width, height),
    }
}

/// The background as a colour of paper; `None` if it is transparent.
fn paper(background: [f32; 4]) -> Option<Ink> {
    let [r, g, b, alpha] = SrgbEncoder::shared().pixel(background);
    (alpha == 255).then_some([r, g, b])
}
