//! Line drawings of a scene: hidden-line removal to a vector page, and the lines drawn over
//! surfaces.
//!
//! ```text
//!  models ─► welded edges ─► exact visibility ─► chains ─► Page: layers of strokes, warnings
//! ```
//! The engine is the crate `drawing`; this module gives it the scene, and adds what belongs to the
//! picture: paper, backdrop, overlays. Shaded styles with outlines (toon) and the overlay of edges
//! take the layers of such a drawing and put them over the surfaces.

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

/// The longest side in pixels of a backdrop embedded in a vector page.
const MAX_BACKDROP_PIXELS: u32 = 4096;

/// The color of lines over surfaces: nearly black.
const OVERLAY_INK: Ink = [20, 24, 30];

/// Draws the lines of a scene on a page of the picture's size, at 96 pixels to the inch.
///
/// Styles that show surfaces are drawn with hidden lines removed. Insets are left out, with a
/// warning. The number of threads does not change the page.
///
/// # Errors
/// As [`render`](crate::render()).
pub fn draw_lines(scene: &Scene, threads: usize, timings: &Timings) -> Result<Page, RenderError> {
    let style = scene.style.line_style();
    let drawing = timings.measure("lines", || {
        drawing::draw(&scene.drawing_subject(), &style.to_draw_options(), threads)
    })?;
    let page = || {
        let mut page =
            drawing.to_page(&style, &scene.model_names(), paper_color(scene.image.background));
        page.images
            .extend(scene.backdrop.as_ref().map(|backdrop| backdrop_image(backdrop, scene.image)));
        page.layers.extend(overlay_layers(scene));
        page.warnings.extend((!scene.insets.is_empty()).then_some(Warning::ViewportsIgnored));
        page
    };
    Ok(timings.measure("chains", page))
}

impl Style {
    /// Widths, dashes and hidden lines of the style.
    #[must_use]
    pub const fn line_style(self) -> LineStyle {
        match self {
            Self::Wireframe => LineStyle::WIREFRAME,
            Self::Lines(style) => style,
            _ => LineStyle::HIDDEN_REMOVED,
        }
    }
}

/// The lines drawn over shaded surfaces: silhouettes of the toon style, and the overlay of feature
/// edges. None for styles that draw lines only.
pub(super) fn surface_line_layers(
    scene: &Scene,
    threads: usize,
) -> Result<Vec<Layer>, RenderError> {
    let wants_edges = scene.overlays.iter().any(|overlay| matches!(overlay, Overlay::Edges));
    let style = match scene.style {
        _ if !scene.style.draws_surfaces() => return Ok(Vec::new()),
        _ if wants_edges => LineStyle { ink: Some(OVERLAY_INK), ..LineStyle::HIDDEN_REMOVED },
        Style::Toon => LineStyle {
            line_widths: LineWidths::Pixels(2.0),
            ink: Some(OVERLAY_INK),
            ..LineStyle::SILHOUETTE
        },
        _ => return Ok(Vec::new()),
    };
    let drawing = drawing::draw(&scene.drawing_subject(), &style.to_draw_options(), threads)?;
    Ok(drawing.to_page(&style, "", None).layers)
}

/// The layers of the scene's overlays (axes, grid, view volumes …) on a page of the picture's size.
pub(super) fn overlay_layers(scene: &Scene) -> Vec<Layer> {
    drawing::overlay_layers(
        &scene.drawing_subject(),
        &scene.overlays,
        scene.style.line_style().hidden_lines,
    )
}

/// The backdrop as an image that fills the page.
fn backdrop_image(backdrop: &Backdrop, image: ImageSpec) -> PlacedImage {
    let side = |pixels: u32| f64::from(pixels) * MILLIMETERS_PER_PIXEL;
    let size = to_micrometers(DVec2::new(side(image.width), side(image.height)));
    let (width, height) =
        (image.width.min(MAX_BACKDROP_PIXELS), image.height.min(MAX_BACKDROP_PIXELS));
    PlacedImage {
        id: "background".to_owned(),
        corner: [0; 2],
        size,
        picture: backdrop.to_picture(width, height),
    }
}

/// The background as the color of the paper; `None` unless it is opaque.
fn paper_color(background: [f32; 4]) -> Option<Ink> {
    let [r, g, b, alpha] = SrgbEncoder::shared().encode_pixel(background);
    (alpha == 255).then_some([r, g, b])
}
