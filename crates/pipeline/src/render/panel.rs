//! Panels: scenes drawn as parts of a page with several pictures.
//!
//! Lessons put panels side by side: the same models in several projections, or the steps of a
//! sweep. Lines stay vectors; surfaces become an image with twice the panel's resolution.

use super::{RenderContext, RenderError, Renderer, Textures, draw_lines};
use crate::{Picture, Timings};
use drawing::{Page, Panel};
use glam::DVec2;
use page::{MILLIMETERS_PER_PIXEL, PlacedImage, to_micrometers};
use scene::Scene;

/// The number of raster pixels per panel pixel along a side, for sharp prints.
const PICTURE_SCALE: u32 = 2;

/// Draws a scene as a panel of the same size as the scene's picture at 96 pixels per inch. Line
/// styles become vectors, and styles that show surfaces become a raster picture. The number of
/// threads does not change the result.
///
/// # Errors
/// Returns the same errors as [`render`](crate::render()).
pub fn render_panel(
    scene: &Scene,
    id: impl Into<String>,
    title: impl Into<String>,
    threads: usize,
) -> Result<Panel, RenderError> {
    let page = if scene.style.draws_surfaces() {
        picture_page(scene, threads)?
    } else {
        draw_lines(scene, threads, &Timings::default())?
    };
    Ok(Panel { id: id.into(), title: title.into(), notes: Vec::new(), page })
}

/// Returns a page filled with a raster picture of the scene.
fn picture_page(scene: &Scene, threads: usize) -> Result<Page, RenderError> {
    let mut enlarged = scene.clone();
    let [width, height] = [scene.image.width, scene.image.height];
    (enlarged.image.width, enlarged.image.height) = (width * PICTURE_SCALE, height * PICTURE_SCALE);
    enlarged.image.caption_height *= PICTURE_SCALE;
    let textures = Textures::for_scene(&enlarged);
    let context = RenderContext::new(&enlarged, &textures, threads);
    let mut picture = Picture::default();
    let warnings = Renderer::default().render(&context, &mut picture)?;
    let size = DVec2::new(width.into(), height.into()) * MILLIMETERS_PER_PIXEL;
    let mut page = Page::new(size, scene.model_names(), None);
    let (id, corner) = ("picture".to_owned(), [0, 0]);
    page.images.push(PlacedImage { id, corner, size: to_micrometers(size), picture });
    page.warnings = warnings;
    Ok(page)
}
