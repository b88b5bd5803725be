//! Panels of scenes: a scene with its name, as a page among others.

use super::{RenderError, draw_lines, render_reported};
use crate::{Picture, Scene, Timings};
use drawing::{MILLIMETERS_PER_PIXEL, Page, Panel, PlacedImage, to_micrometers};
use glam::DVec2;

/// Pixels of a pasted picture for each pixel of its panel.
const PICTURE_SCALE: u32 = 2;

/// The panel of a scene, as large as its picture at 96 pixels to the inch: lines, or in the styles that show surfaces a
/// picture. The number of threads does not change it.
///
/// # Errors
/// As [`render`](crate::render()).
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

/// A page that a picture of the scene fills.
fn picture_page(scene: &Scene, threads: usize) -> Result<Page, RenderError> {
    let mut enlarged = scene.clone();
    let [width, height] = [scene.image.width, scene.image.height];
    (enlarged.image.width, enlarged.image.height) = (width * PICTURE_SCALE, height * PICTURE_SCALE);
    let (picture, warnings): (Picture, _) =
        render_reported(&enlarged, threads, &Timings::default())?;
    let size = DVec2::new(width.into(), height.into()) * MILLIMETERS_PER_PIXEL;
    let mut page = Page::new(size, scene.model_names(), None);
    let pasted = PlacedImage {
        id: "picture".to_owned(),
        corner: [0, 0],
        size: to_micrometers(size),
        picture,
    };
    page.images.push(pasted);
    page.warnings = warnings;
    Ok(page)
}
