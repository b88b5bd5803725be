//! Pictures of scenes, whole or region by region.
//!
//! What all regions need is made once: mip chains, shadow maps, the nearest surfaces that occlusion is told from, the page of a
//! line drawing, the layers of overlays. Each region is then drawn from the models on, so that memory is bounded by the region and
//! not by the picture.

use super::occlusion::whole_screen_space;
use super::renderer::Renderer;
use super::{RenderError, Textures, lines};
use crate::scene::{Scene, View};
use crate::{Channel, Picture, Timings};
use drawing::{Layer, Page, Warning, draw_over};
use homog::PixelRect;
use shade::ScreenSpace;
use shade::encode_png;
use std::io::{self, Write};
use std::sync::Arc;

/// A scene ready to be drawn, region by region.
#[derive(Debug)]
pub struct Paint<'a> {
    scene: &'a Scene,
    threads: usize,
    timings: &'a Timings,
    textures: Arc<Textures<'a>>,
    renderer: Renderer,
    /// A line drawing.
    page: Option<Page>,
    /// What is drawn over surfaces.
    layers: Vec<Layer>,
    /// Whether the renderer has the shadow maps of the scene.
    has_shadows: bool,
    /// The nearest surfaces of the whole picture, when regions need them.
    occlusion: Option<ScreenSpace>,
    warnings: Vec<Warning>,
    /// The views of the scene, in their order.
    views: Vec<Self>,
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
        let scenes = || std::iter::once(scene).chain(scene.views.iter().map(|view| &view.scene));
        let surfaces = scenes().any(|scene| scene.style.shows_surfaces());
        let models = if surfaces { &scene.models[..] } else { &[] };
        let textures = Arc::new(timings.measure("mip chains", || Textures::of(models)));
        Self::with_textures(scene, threads, timings, &textures)
    }

    /// The same with the mip chains of the models, which views share with the scene.
    fn with_textures(
        scene: &'a Scene,
        threads: usize,
        timings: &'a Timings,
        textures: &Arc<Textures<'a>>,
    ) -> Result<Self, RenderError> {
        let surfaces = scene.style.shows_surfaces();
        let mut page = (!surfaces).then(|| lines::draw(scene, threads, timings)).transpose()?;
        let mut warnings =
            page.as_mut().map_or(Vec::new(), |page| std::mem::take(&mut page.warnings));
        warnings.retain(|warning| *warning != Warning::ViewportsUnseen);
        warnings
            .extend((surfaces && !scene.sections.is_empty()).then_some(Warning::SectionsUnseen));
        let mut layers = lines::over_surfaces(scene, threads)?;
        layers.extend(if surfaces { lines::scene_overlays(scene) } else { Vec::new() });
        let inner = |view: &'a View| Self::with_textures(&view.scene, threads, timings, textures);
        let views = scene.views.iter().map(inner).collect::<Result<Vec<_>, _>>()?;
        let (renderer, occlusion, textures) = (Renderer::default(), None, Arc::clone(textures));
        Ok(Self {
            scene,
            threads,
            timings,
            textures,
            renderer,
            page,
            layers,
            has_shadows: false,
            occlusion,
            warnings,
            views,
        })
    }

    /// What could not be drawn as it should.
    #[must_use]
    pub fn into_warnings(self) -> Vec<Warning> {
        let inner = self.views.into_iter().flat_map(Self::into_warnings);
        let mut all = self.warnings;
        for warning in inner {
            if !all.contains(&warning) {
                all.push(warning);
            }
        }
        all
    }

    /// A region of the picture.
    ///
    /// # Errors
    /// If it is empty, too large or not in the picture, or the scene holds too much.
    pub fn region<C: Channel>(&mut self, region: PixelRect) -> Result<Picture<C>, RenderError> {
        super::region::check_region(self.scene.image, region)?;
        let views = &self.scene.views;
        let mut picture = Picture::default();
        if View::fill(views, region) {
            picture.resize(region.width, region.height);
        } else {
            picture = self.own_region(region)?;
        }
        for (view, paint) in views.iter().zip(&mut self.views) {
            if let Some([shown, own]) = view.shown(region) {
                view.put(&paint.region(own)?, shown, region, &mut picture);
            }
        }
        Ok(picture)
    }

    /// A region of the picture without its views.
    fn own_region<C: Channel>(&mut self, region: PixelRect) -> Result<Picture<C>, RenderError> {
        let Self { scene, threads, timings, textures, renderer, layers, occlusion, .. } = self;
        let size = [scene.image.width, scene.image.height];
        if let Some(page) = &self.page {
            return Ok(timings.measure("pixels", || page.to_region(size, region)));
        }
        let mut picture = Picture::default();
        let is_part = region != scene.image.rect();
        if is_part && occlusion.is_none() {
            *occlusion = whole_screen_space(scene, textures, *threads)?;
        }
        if !self.has_shadows {
            renderer.cast_shadows(scene, textures, *threads, timings)?;
            self.has_shadows = true;
        }
        let occlusion = occlusion.as_ref().filter(|_| is_part);
        renderer.render_part(
            scene,
            textures,
            region,
            *threads,
            timings,
            occlusion,
            &mut picture,
        )?;
        draw_over(&mut picture, size, region, layers);
        Ok(picture)
    }

    /// Writes a region as a PNG file, drawn in bands of `rows` rows; the bytes do not depend on their number. Each band is shown to `witness`
    /// on its way.
    ///
    /// # Errors
    /// If a band cannot be drawn (see [`region`](Self::region)), or the file cannot be written.
    pub fn write_png<C: Channel>(
        &mut self,
        out: impl Write,
        region: PixelRect,
        rows: u32,
        mut witness: impl FnMut(&Picture<C>),
    ) -> Result<(), PaintError> {
        let mut bands = region.bands(rows);
        let first: Picture<C> = self.region(bands.next().unwrap_or(region))?;
        let opaque = first.is_opaque() && self.are_opaque::<C>(region.bands(rows).skip(1))?;
        let timings = self.timings;
        let size = [region.width, region.height];
        encode_png(out, size, opaque, C::BITS, |png| {
            let mut put = |picture: &Picture<C>| {
                witness(picture);
                timings.measure("encode", || png.write(&picture.pixels))
            };
            put(&first)?;
            drop(first);
            for band in bands {
                put(&self.region(band)?)?;
            }
            Ok(())
        })
    }

    /// Whether all bands are opaque. Over a background that is, all are; else they are drawn until a pixel is not.
    fn are_opaque<C: Channel>(
        &mut self,
        bands: impl Iterator<Item = PixelRect>,
    ) -> Result<bool, RenderError> {
        if self.scene.has_opaque_background() {
            return Ok(true);
        }
        for band in bands {
            if !self.region::<C>(band)?.is_opaque() {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// A picture that could not be written.
#[derive(Debug, thiserror::Error)]
pub enum PaintError {
    /// It cannot be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// Whoever gets its bytes does not take them.
    #[error(transparent)]
    Output(#[from] io::Error),
}
