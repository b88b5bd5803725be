//! Pictures of scenes, whole or region by region.
//!
//! What all regions need is made once: mip chains, the page of a line drawing, the layers of overlays. Each region is then drawn
//! from the models on, so that memory is bounded by the region and not by the picture.

use super::region::Region;
use super::renderer::Renderer;
use super::{RenderError, Textures, lines};
use crate::drawing::{Layer, Page, overlays};
use crate::scene::Scene;
use crate::{Channel, Picture, Timings};
use std::ops::ControlFlow;

/// A scene ready to be drawn, region by region.
#[derive(Debug)]
pub struct Paint<'a> {
    scene: &'a Scene,
    threads: usize,
    timings: &'a Timings,
    textures: Textures<'a>,
    renderer: Renderer,
    /// A line drawing.
    page: Option<Page>,
    /// What is drawn over surfaces.
    layers: Vec<Layer>,
}

/// How many rows of a picture of this width are drawn at once when its memory is to be bounded: some 64 MiB of pixels, in whole rows of the
/// rasteriser's tiles.
#[must_use]
pub fn band_rows(width: u32) -> u32 {
    let rows = (64 << 20) / (4 * u64::from(width.max(1)));
    (rows as u32 / 64 * 64).clamp(64, 2048)
}

impl<'a> Paint<'a> {
    /// Makes what all regions need, with up to `threads` threads. Their number does not change the picture.
    ///
    /// # Errors
    /// If the picture's size is out of range.
    pub fn new(
        scene: &'a Scene,
        threads: usize,
        timings: &'a Timings,
    ) -> Result<Self, RenderError> {
        let surfaces = scene.style.shows_surfaces();
        let page = (!surfaces).then(|| lines::draw(scene, threads, timings)).transpose()?;
        let models = if surfaces { &scene.models[..] } else { &[] };
        let textures = timings.measure("mip chains", || Textures::of(models));
        let layers = if surfaces { overlays(scene) } else { Vec::new() };
        let renderer = Renderer::default();
        Ok(Self { scene, threads, timings, textures, renderer, page, layers })
    }

    /// A region of the picture.
    ///
    /// # Errors
    /// If it is empty, too large or not in the picture, or the scene holds too much.
    pub fn region<C: Channel>(&mut self, region: Region) -> Result<Picture<C>, RenderError> {
        let Self { scene, threads, timings, textures, renderer, page, layers } = self;
        region.check(scene.image)?;
        let size = [scene.image.width, scene.image.height];
        if let Some(page) = page {
            return Ok(timings.measure("pixels", || page.to_region(size, region)));
        }
        let mut picture = Picture::default();
        renderer.render_region(scene, textures, region, *threads, timings, &mut picture)?;
        picture.draw_over(size, region, layers);
        Ok(picture)
    }

    /// Whether all of a region is opaque. Where the background is, everything is; elsewhere bands of `rows` rows are drawn until a pixel is
    /// not.
    ///
    /// # Errors
    /// As [`region`](Self::region).
    pub fn is_opaque<C: Channel>(
        &mut self,
        region: Region,
        rows: u32,
    ) -> Result<bool, RenderError> {
        if self.scene.image.background[3] >= 1.0 {
            return Ok(true);
        }
        for band in region.bands(rows) {
            if !self.region::<C>(band)?.is_opaque() {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Draws a region in bands of `rows` rows and hands them over from the top, until all are or one is not wanted any more.
    ///
    /// # Errors
    /// As [`region`](Self::region).
    pub fn bands<C: Channel, B>(
        &mut self,
        region: Region,
        rows: u32,
        mut sink: impl FnMut(&Picture<C>) -> ControlFlow<B>,
    ) -> Result<ControlFlow<B>, RenderError> {
        for band in region.bands(rows) {
            let picture = self.region(band)?;
            if let ControlFlow::Break(end) = sink(&picture) {
                return Ok(ControlFlow::Break(end));
            }
        }
        Ok(ControlFlow::Continue(()))
    }
}
