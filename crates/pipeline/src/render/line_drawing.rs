//! Line drawings of a scene: from the models to the page that every output writes.

use super::RenderError;
use crate::scene::{ImageSpec, Scene, Style};
use drawing::{
    Ink, Layer, LineStyle, LineWidths, MILLIMETERS_PER_PIXEL, Overlay, Page, PlacedImage, Warning,
    to_micrometers,
};
use glam::DVec2;
use model::Timings;
use shade::Backdrop;
use shade::color::SrgbEncoder;

/// The most pixels along a side of a picture that lies under lines.
const MAX_BACKDROP_PIXELS: u32 = 4096;

/// The ink of lines over surfaces: nearly black.
const OVERLAY_INK: Ink = [20, 24, 30];

/// The line drawing of a scene on a page of the picture's size, 96 pixels to the inch. Styles that show surfaces have their
/// hidden lines removed.
///
/// The number of threads does not change it.
///
/// # Errors
/// As [`render`](crate::render()).
pub fn draw_lines(scene: &Scene, threads: usize, timings: &Timings) -> Result<Page, RenderError> {
    let look = scene.style.line_style();
    let drawing = timings.measure("lines", || {
        drawing::draw(&scene.drawing_subject(), &look.to_draw_options(), threads)
    })?;
    let page = || {
        let mut page =
            drawing.to_page(&look, &scene.model_names(), paper_color(scene.image.background));
        page.images.extend(scene.backdrop.as_ref().map(|all| backdrop_image(all, scene.image)));
        page.layers.extend(overlay_layers(scene));
        page.warnings.extend((!scene.insets.is_empty()).then_some(Warning::ViewportsIgnored));
        page
    };
    Ok(timings.measure("chains", page))
}

impl Style {
    /// How its lines look.
    #[must_use]
    pub const fn line_style(self) -> LineStyle {
        match self {
            Self::Wireframe => LineStyle::WIREFRAME,
            Self::Lines(look) => look,
            _ => LineStyle::HIDDEN_REMOVED,
        }
    }
}

/// The lines that a style or an overlay draws over surfaces: the outlines of toons, and feature edges.
pub(super) fn surface_line_layers(
    scene: &Scene,
    threads: usize,
) -> Result<Vec<Layer>, RenderError> {
    let wants_edges = scene.overlays.iter().any(|overlay| matches!(overlay, Overlay::Edges));
    let look = match scene.style {
        _ if !scene.style.draws_surfaces() => return Ok(Vec::new()),
        _ if wants_edges => LineStyle { ink: Some(OVERLAY_INK), ..LineStyle::HIDDEN_REMOVED },
        Style::Toon => LineStyle {
            line_widths: LineWidths::Pixels(2.0),
            ink: Some(OVERLAY_INK),
            ..LineStyle::SILHOUETTE
        },
        _ => return Ok(Vec::new()),
    };
    let drawing = drawing::draw(&scene.drawing_subject(), &look.to_draw_options(), threads)?;
    Ok(drawing.to_page(&look, "", None).layers)
}

/// The layers of all overlays of a scene, on a page of the picture's size.
pub(super) fn overlay_layers(scene: &Scene) -> Vec<Layer> {
    drawing::overlay_layers(
        &scene.drawing_subject(),
        &scene.overlays,
        scene.style.line_style().hidden_lines,
    )
}

/// What is painted behind the models as a picture of the size of the page.
fn backdrop_image(painting: &Backdrop, image: ImageSpec) -> PlacedImage {
    let side = |pixels: u32| f64::from(pixels) * MILLIMETERS_PER_PIXEL;
    let size = to_micrometers(DVec2::new(side(image.width), side(image.height)));
    let (width, height) =
        (image.width.min(MAX_BACKDROP_PIXELS), image.height.min(MAX_BACKDROP_PIXELS));
    PlacedImage {
        id: "background".to_owned(),
        corner: [0; 2],
        size,
        picture: painting.to_picture(width, height),
    }
}

/// The background as a colour of paper; `None` if it is transparent.
fn paper_color(background: [f32; 4]) -> Option<Ink> {
    let [r, g, b, alpha] = SrgbEncoder::shared().encode_pixel(background);
    (alpha == 255).then_some([r, g, b])
}
