//! Panels of scenes: a scene with its name, as a page among others.

use super::{RenderError, draw, render_reported};
use crate::{Picture, Scene, Timings};
use drawing::{MILLIMETRES_PER_PIXEL, Page, Panel, Pasted, micrometres};
use glam::DVec2;

/// Pixels of a pasted picture for each pixel of its panel.
const SHARPNESS: u32 = 2;

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
    let page = if scene.style.shows_surfaces() {
        painted(scene, threads)?
    } else {
        draw(scene, threads, &Timings::default())?
    };
    Ok(Panel { id: id.into(), title: title.into(), notes: Vec::new(), page })
}

/// A page that a picture of the scene fills.
fn painted(scene: &Scene, threads: usize) -> Result<Page, RenderError> {
    let mut large = scene.clone();
    let [width, height] = [scene.image.width, scene.image.height];
    (large.image.width, large.image.height) = (width * SHARPNESS, height * SHARPNESS);
    let (picture, warnings): (Picture, _) = render_reported(&large, threads, &Timings::default())?;
    let size = DVec2::new(width.into(), height.into()) * MILLIMETRES_PER_PIXEL;
    let mut page = Page::new(size, scene.title(), None);
    let pasted =
        Pasted { id: "picture".to_owned(), corner: [0, 0], size: micrometres(size), picture };
    page.pictures.push(pasted);
    page.warnings = warnings;
    Ok(page)
}
