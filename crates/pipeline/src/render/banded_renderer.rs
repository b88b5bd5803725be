//! Pictures of scenes, whole or region by region.
//!
//! What all regions need is made once: mip chains, shadow maps, the nearest surfaces that occlusion is told from, the page of a
//! line drawing, the layers of overlays. Each region is then drawn from the models on, so that memory is bounded by the region and
//! not by the picture.

use super::ambient_occlusion::build_full_ssao_buffer;
use super::renderer::Renderer;
use super::{RenderError, Textures, line_drawing};
use crate::scene::{Inset, Scene};
use crate::{Channel, Picture, Timings};
use drawing::{Layer, Page, Warning, draw_layers_over};
use homog::PixelRect;
use shade::AmbientOcclusion;
use shade::encode_png;
use std::io::{self, Write};
use std::sync::Arc;

/// A scene ready to be drawn, region by region.
#[derive(Debug)]
pub struct BandedRenderer<'a> {
    scene: &'a Scene,
    threads: usize,
    timings: &'a Timings,
    textures: Arc<Textures<'a>>,
    renderer: Renderer,
    /// A line drawing.
    page: Option<Page>,
    /// What is drawn over surfaces.
    overlay_layers: Vec<Layer>,
    /// Whether the renderer has the shadow maps of the scene.
    has_shadow_maps: bool,
    /// The nearest surfaces of the whole picture, when regions need them.
    occlusion: Option<AmbientOcclusion>,
    warnings: Vec<Warning>,
    /// The views of the scene, in their order.
    insets: Vec<Self>,
}

/// How many rows of a picture of this width are drawn at once when its memory is to be bounded: some 64 MiB of pixels, in whole rows of the
/// rasteriser's tiles.
#[must_use]
pub fn rows_per_band(width: u32) -> u32 {
    let rows = (64 << 20) / (4 * u64::from(width.max(1)));
    (rows as u32 / 64 * 64).clamp(64, 2048)
}

impl<'a> BandedRenderer<'a> {
    /// Makes what all regions need, with up to `threads` threads. Their number does not change the picture.
    ///
    /// # Errors
    /// If the picture's size is out of range.
    pub fn new(
        scene: &'a Scene,
        threads: usize,
        timings: &'a Timings,
    ) -> Result<Self, RenderError> {
        let scenes = || std::iter::once(scene).chain(scene.insets.iter().map(|view| &view.scene));
        let shows_surfaces = scenes().any(|scene| scene.style.draws_surfaces());
        let models = if shows_surfaces { &scene.models[..] } else { &[] };
        let textures = Arc::new(timings.measure("mip chains", || Textures::for_models(models)));
        Self::with_textures(scene, threads, timings, &textures)
    }

    /// The same with the mip chains of the models, which views share with the scene.
    fn with_textures(
        scene: &'a Scene,
        threads: usize,
        timings: &'a Timings,
        textures: &Arc<Textures<'a>>,
    ) -> Result<Self, RenderError> {
        let shows_surfaces = scene.style.draws_surfaces();
        let mut page = (!shows_surfaces)
            .then(|| line_drawing::draw_lines(scene, threads, timings))
            .transpose()?;
        let mut warnings =
            page.as_mut().map_or(Vec::new(), |page| std::mem::take(&mut page.warnings));
        warnings.retain(|warning| *warning != Warning::ViewportsIgnored);
        warnings.extend(
            (shows_surfaces && !scene.sections.is_empty()).then_some(Warning::SectionsIgnored),
        );
        let mut layers = line_drawing::surface_line_layers(scene, threads)?;
        layers.extend(if shows_surfaces {
            line_drawing::overlay_layers(scene)
        } else {
            Vec::new()
        });
        let inset_renderers =
            |view: &'a Inset| Self::with_textures(&view.scene, threads, timings, textures);
        let views = scene.insets.iter().map(inset_renderers).collect::<Result<Vec<_>, _>>()?;
        let (renderer, occlusion, textures) = (Renderer::default(), None, Arc::clone(textures));
        Ok(Self {
            scene,
            threads,
            timings,
            textures,
            renderer,
            page,
            overlay_layers: layers,
            has_shadow_maps: false,
            occlusion,
            warnings,
            insets: views,
        })
    }

    /// What could not be drawn as it should.
    #[must_use]
    pub fn into_warnings(self) -> Vec<Warning> {
        let inset_renderers = self.insets.into_iter().flat_map(Self::into_warnings);
        let mut all = self.warnings;
        for warning in inset_renderers {
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
    pub fn render_region<C: Channel>(
        &mut self,
        region: PixelRect,
    ) -> Result<Picture<C>, RenderError> {
        super::image_tiles::validate_region(self.scene.image, region)?;
        let views = &self.scene.insets;
        let mut picture = Picture::default();
        if Inset::covers_region(views, region) {
            picture.resize(region.width, region.height);
        } else {
            picture = self.render_models(region)?;
        }
        for (view, paint) in views.iter().zip(&mut self.insets) {
            if let Some([shown, own]) = view.visible_rects(region) {
                view.composite_into(&paint.render_region(own)?, shown, region, &mut picture);
            }
        }
        Ok(picture)
    }

    /// A region of the picture without its views.
    fn render_models<C: Channel>(&mut self, region: PixelRect) -> Result<Picture<C>, RenderError> {
        let Self {
            scene,
            threads,
            timings,
            textures,
            renderer,
            overlay_layers: layers,
            occlusion,
            ..
        } = self;
        let size = [scene.image.width, scene.image.height];
        if let Some(page) = &self.page {
            return Ok(timings.measure("pixels", || page.to_picture_region(size, region)));
        }
        let mut picture = Picture::default();
        let is_part = region != scene.image.pixel_rect();
        if is_part && occlusion.is_none() {
            *occlusion = build_full_ssao_buffer(scene, textures, *threads)?;
        }
        if !self.has_shadow_maps {
            renderer.render_shadow_maps(scene, textures, *threads, timings)?;
            self.has_shadow_maps = true;
        }
        let occlusion = occlusion.as_ref().filter(|_| is_part);
        renderer.render_tiles(
            scene,
            textures,
            region,
            *threads,
            timings,
            occlusion,
            &mut picture,
        )?;
        draw_layers_over(&mut picture, size, region, layers);
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
    ) -> Result<(), WritePngError> {
        let mut bands = region.bands(rows);
        let first: Picture<C> = self.render_region(bands.next().unwrap_or(region))?;
        let opaque = first.is_opaque() && self.bands_are_opaque::<C>(region.bands(rows).skip(1))?;
        let timings = self.timings;
        let size = [region.width, region.height];
        encode_png(out, size, opaque, C::BITS, |png| {
            let mut put = |picture: &Picture<C>| {
                witness(picture);
                timings.measure("encode", || png.write_pixels(&picture.pixels))
            };
            put(&first)?;
            drop(first);
            for band in bands {
                put(&self.render_region(band)?)?;
            }
            Ok(())
        })
    }

    /// Whether all bands are opaque. Over a background that is, all are; else they are drawn until a pixel is not.
    fn bands_are_opaque<C: Channel>(
        &mut self,
        bands: impl Iterator<Item = PixelRect>,
    ) -> Result<bool, RenderError> {
        if self.scene.has_opaque_background() {
            return Ok(true);
        }
        for band in bands {
            if !self.render_region::<C>(band)?.is_opaque() {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// A picture that could not be written.
#[derive(Debug, thiserror::Error)]
pub enum WritePngError {
    /// It cannot be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// Whoever gets its bytes does not take them.
    #[error(transparent)]
    Output(#[from] io::Error),
}
