//! Line drawings: hidden-line removal to a vector page, and lines drawn over surfaces.
//!
//! ```text
//!  models ─► welded edges ─► exact visibility ─► chains ─► Page: layers of strokes, warnings
//! ```
//! The crates `hidden_line` and `drawing` do the work. This module passes them the scene and adds
//! the other parts of the picture: paper, backdrop, overlays, insets and caption. Shaded styles
//! with outlines (toon) and the edge overlay draw the layers of such a drawing over the surfaces.

use super::RenderError;
use super::captions::{caption_layer, paper_color, strip_rect, text_warnings};
use crate::Picture;
use drawing::{LineStyle, LineWidths, Overlay, Page, Warning};
use glam::DVec2;
use hidden_line::{DrawError, DrawOptions};
use homog::PixelRect;
use model::Timings;
use page::{
    Group, Ink, Join, Layer, MILLIMETERS_PER_PIXEL, Pen, PlacedImage, Polyline, to_micrometers,
};
use raster::Workers;
use scene::{ImageSpec, Inset, Scene, Style};
use shade::Backdrop;

/// The maximum width and height in pixels of a backdrop embedded in a vector page.
const MAX_BACKDROP_PIXELS: u32 = 4096;

/// The color of lines over surfaces: almost black.
const OVERLAY_INK: Ink = [20, 24, 30];

/// Draws the lines of a scene on a page of the picture's size, at 96 pixels per inch.
///
/// A style that shows surfaces is replaced by lines with hidden lines removed, also in viewports.
/// The second view of an anaglyph is omitted with a warning. Blank paper is omitted, so that the
/// page can cover others. `workers` sets the number of threads, which does not change the page, and
/// optionally a [monitor](raster::Monitor) that receives the edge count of each drawing.
///
/// ```
/// # use pipeline::scene::file::{CameraFile, LightFile};
/// # use pipeline::Scene;
/// # let scene = Scene::builder()
/// #     .mesh([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]], [0, 1, 2])
/// #     .camera(CameraFile::look_at([0.0, 0.0, 4.0], [0.0; 3]))
/// #     .light(LightFile::directional([0.0, 0.0, -1.0], 2.0)?)
/// #     .size(64, 48)
/// #     .build()?;
/// let page = pipeline::render::draw_lines(&scene, 2, &Default::default())?;
/// let svg = page.to_svg();
/// assert!(svg.contains("<path") && !page.layers.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns the same errors as [`render`](crate::render()).
pub fn draw_lines<'a>(
    scene: &Scene,
    workers: impl Into<Workers<'a>>,
    timings: &Timings,
) -> Result<Page, RenderError> {
    let workers = workers.into();
    let mut page = draw_view(scene, workers, timings)?;
    if scene.image.is_blank_paper {
        page.paper = None;
    }
    if scene.insets.iter().any(|inset| inset.cyan_only) {
        page.warnings.push(Warning::AnaglyphIgnored);
    } else {
        for (number, inset) in scene.insets.iter().enumerate() {
            let view = draw_lines(&inset.scene, workers, timings)?;
            paste_inset(&mut page, view, inset, number + 1);
        }
    }
    if page.layers.is_empty() && page.images.is_empty() {
        page.warnings.push(Warning::PictureEmpty { reason: scene.empty_reason() });
    }
    write_caption(&mut page, scene);
    // The view and its insets may give the same warning.
    page.warnings.sort_unstable();
    page.warnings.dedup();
    Ok(page)
}

/// Draws the lines of a scene without its insets and its caption.
pub(super) fn draw_view(
    scene: &Scene,
    workers: Workers<'_>,
    timings: &Timings,
) -> Result<Page, RenderError> {
    let style = scene.style.line_style();
    let options = DrawOptions { is_unlimited: scene.unlimited_lines, ..style.to_draw_options() };
    let fill = style.to_fill_options();
    let draw = || drawing::draw(&scene.drawing_subject(), &options, &fill, workers);
    let drawing = timings.measure("lines", draw)?;
    let page = || {
        let mut page =
            drawing.to_page(&style, &scene.model_names(), paper_color(scene.image.background));
        page.images
            .extend(scene.backdrop.as_ref().map(|backdrop| backdrop_image(backdrop, scene.image)));
        let overlays = overlay_layers(scene);
        // Lines end at labels, as in technical drawings.
        for [low, high] in drawing::label_rectangles(&overlays) {
            page.erase_rectangle(low, high);
        }
        page.layers.extend(overlays);
        page.warnings.extend(text_warnings(scene));
        page
    };
    Ok(timings.measure("chains", page))
}

/// Places the drawing of an inset, with its background and border, over the contents of its
/// rectangle.
fn paste_inset(page: &mut Page, mut view: Page, inset: &Inset, number: usize) {
    let PixelRect { x, y, width, height } = inset.rect;
    let [low, size] =
        [[x, y], [width, height]].map(|pair| DVec2::from(pair.map(to_page_millimeters)));
    page.erase_rectangle(low, low + size);
    let prefix = format!("view-{number}-");
    if let Some(paper) = view.paper {
        page.images.push(paper_image(format!("{prefix}paper"), low, low + size, paper));
    }
    view.crop_to_border();
    page.paste_page(&view, low, &prefix);
    if let Some((color, width)) = inset.border {
        page.layers.push(border_layer(format!("{prefix}border"), low, size, color, width));
    }
}

/// Clears the strip at the bottom of a page and draws the caption there.
fn write_caption(page: &mut Page, scene: &Scene) {
    let Some(layer) = caption_layer(scene) else { return };
    let PixelRect { y, width, height, .. } = strip_rect(scene.image);
    let [low, high] =
        [[0, y], [width, y + height]].map(|pair| DVec2::from(pair.map(to_page_millimeters)));
    page.erase_rectangle(low, high);
    if let Some(paper) = page.paper.filter(|_| !page.images.is_empty()) {
        page.images.push(paper_image("caption-paper".to_owned(), low, high, paper));
    }
    page.layers.push(layer);
}

/// Returns a rectangle in the paper color as a one-pixel image, above earlier images and below all
/// lines.
fn paper_image(id: String, low: DVec2, high: DVec2, [r, g, b]: Ink) -> PlacedImage {
    let [corner, end] = [low, high].map(to_micrometers);
    let mut picture = Picture::default();
    picture.resize(1, 1);
    picture.pixels.fill([r, g, b, 255]);
    PlacedImage { id, corner, size: [end[0] - corner[0], end[1] - corner[1]], picture }
}

/// Returns a border with a width in pixels, inside a rectangle in millimeters.
fn border_layer(id: String, low: DVec2, size: DVec2, color: Ink, width: u32) -> Layer {
    let width = to_page_millimeters(width);
    let half = DVec2::splat(0.5 * width);
    let (low, high) = (low + half, low + size - half);
    let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    let pen = Pen { join: Join::Miter, ..Pen::solid(width, color) };
    let mut layer = Layer::new(id, "border", pen);
    let strokes = Polyline::through_points(&corners, true).into_iter().collect();
    layer.groups.push(Group { strokes, ..Group::default() });
    layer
}

/// Converts a number of pixels to millimeters on the page.
fn to_page_millimeters(pixels: u32) -> f64 {
    f64::from(pixels) * MILLIMETERS_PER_PIXEL
}

/// Returns the lines drawn over shaded surfaces (the silhouettes of the toon style and the
/// feature-edge overlay), with a warning if they are skipped. Styles that draw only lines have
/// none.
pub(super) fn surface_line_layers(
    scene: &Scene,
    workers: Workers<'_>,
) -> Result<(Vec<Layer>, Option<Warning>), RenderError> {
    let wants_edges = scene.overlays.iter().any(|overlay| matches!(overlay, Overlay::Edges));
    let style = match scene.style {
        _ if !scene.style.draws_surfaces() => return Ok(Default::default()),
        _ if wants_edges => LineStyle { ink: Some(OVERLAY_INK), ..LineStyle::HIDDEN_REMOVED },
        Style::Toon => LineStyle {
            line_widths: LineWidths::Pixels(2.0),
            ink: Some(OVERLAY_INK),
            ..LineStyle::CONTOURS
        },
        _ => return Ok(Default::default()),
    };
    let options = DrawOptions {
        // The picture shows cut-out leaves, but lines would show the rectangles around them.
        leaves_out_cut_outs: true,
        is_unlimited: scene.unlimited_lines,
        ..style.to_draw_options()
    };
    match drawing::draw(&scene.drawing_subject(), &options, &style.to_fill_options(), workers) {
        Ok(drawing) => Ok((drawing.to_page(&style, "", None).layers, None)),
        // The surfaces are drawn without lines.
        Err(DrawError::TooManyCopies { .. }) => Ok((Vec::new(), Some(Warning::OutlinesLeftOut))),
        Err(error) => Err(error.into()),
    }
}

/// Returns the layers of the scene's overlays (axes, grid, view volumes …) on a page of the
/// picture's size.
pub(super) fn overlay_layers(scene: &Scene) -> Vec<Layer> {
    drawing::overlay_layers(
        &scene.drawing_subject(),
        &scene.overlays,
        scene.style.line_style().hidden_lines,
    )
}

/// Returns the backdrop as an image that fills the page.
fn backdrop_image(backdrop: &Backdrop, image: ImageSpec) -> PlacedImage {
    let size = [image.width, image.height].map(to_page_millimeters);
    let size = to_micrometers(DVec2::from(size));
    let (width, height) =
        (image.width.min(MAX_BACKDROP_PIXELS), image.height.min(MAX_BACKDROP_PIXELS));
    PlacedImage {
        id: "background".to_owned(),
        corner: [0; 2],
        size,
        picture: backdrop.to_picture(width, height),
    }
}
