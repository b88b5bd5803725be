//! A scene prepared to be rendered region by region, for pictures larger than memory, crops and
//! bands.
//!
//! The mip chains, shadow maps, the depth buffer of ambient occlusion, the page of a line drawing
//! and the overlay layers are computed once and shared by all regions. Everything else, beginning
//! with the geometry, is repeated for each region, so memory use depends on the size of the region,
//! not of the picture.
//!
//! ```text
//!  scene ─► prepare ─► region: surfaces of its image tiles, or lines ─► overlays ─► insets, caption
//! ```

use super::RenderError;
use super::ambient_occlusion::compute_occlusion;
use super::captions::{draw_caption_over, text_warnings, view_rect};
use super::context::RenderContext;
use super::fragment_shading::{fragment_shading, style_shading};
use super::image_tiles::{TileRegion, tile_regions, validate_region};
use super::insets::{composite_into, covers_region, visible_rects};
use super::line_drawing;
use super::primitive_assembly::assemble_scene;
use super::renderer::{RenderBuffers, Renderer};
use super::transmission_framebuffer::{
    compute_whole_occlusion, needs_framebuffer, render_framebuffer,
};
use crate::Picture;
use crate::cancel::PartMonitor;
use drawing::{Page, Warning};
use homog::PixelRect;
use page::{Layer, draw_layers_over};
use raster::Surface;
use scene::Inset;
use shade::FrameChannel;
use shade::{AmbientOcclusion, TransmissionFramebuffer};
use std::sync::Arc;

/// A scene prepared so that any region can be rendered; created by [`Renderer::prepare`].
///
/// Regions of any size, rendered in any order, match the picture bit for bit.
#[derive(Debug)]
pub struct PreparedScene<'a> {
    /// Scene, textures and threads.
    pub(super) context: RenderContext<'a>,
    /// The renderer's memory, borrowed until the picture is finished.
    buffers: &'a mut RenderBuffers,
    /// The drawing, for a style that shows only lines.
    page: Option<Page>,
    /// Outlines and overlays, drawn over surfaces.
    overlay_layers: Vec<Layer>,
    /// Whether the buffers contain this scene's shadow maps.
    has_shadow_maps: bool,
    /// The occlusion buffer of the whole picture, for partial regions and for pictures with a
    /// transmission framebuffer.
    full_occlusion: Option<AmbientOcclusion>,
    /// The picture behind refracting and rough glass, rendered on demand.
    transmission_framebuffer: Option<TransmissionFramebuffer>,
    /// Whether all pixels rendered so far have the same color.
    only_color: OnlyColor,
    /// The number of pixels rendered so far.
    pixels_seen: usize,
    /// The number of pixels in all requested regions, for progress.
    pub(super) pixels_due: u64,
    /// Warnings about this scene, excluding its insets.
    warnings: Vec<Warning>,
    /// The insets of the scene, in order.
    insets: Vec<Self>,
}

/// Whether the pixels of a picture differ.
#[derive(Clone, Copy, PartialEq, Debug)]
enum OnlyColor {
    /// No pixels yet.
    Unknown,
    /// All pixels so far have this color, with 8 bits per channel.
    One([u8; 4]),
    /// The pixels differ.
    Several,
}

impl OnlyColor {
    /// Adds the pixels of another region, up to the first pixel that differs.
    fn add_pixels<C: FrameChannel>(&mut self, picture: &Picture<C>) {
        if *self == Self::Several {
            return;
        }
        let mut colors = picture.pixels.iter().map(|pixel| pixel.map(C::to_byte));
        let first = match *self {
            Self::One(color) => Some(color),
            _ => colors.next(),
        };
        let Some(first) = first else { return };
        *self = if colors.all(|color| color == first) { Self::One(first) } else { Self::Several };
    }
}

impl<'a> PreparedScene<'a> {
    /// Prepares a scene and its insets by drawing their lines. Each inset has a separate renderer.
    pub(super) fn new(
        renderer: &'a mut Renderer,
        context: RenderContext<'a>,
    ) -> Result<Self, RenderError> {
        let scene = context.scene;
        let draws_surfaces = scene.style.draws_surfaces();
        let draw_view = || line_drawing::draw_view(scene, context.workers(), &context.timings());
        let mut page = (!draws_surfaces).then(draw_view).transpose()?;
        let mut warnings =
            page.as_mut().map_or(Vec::new(), |page| std::mem::take(&mut page.warnings));
        let ignores_sections = draws_surfaces && !scene.sections.is_empty();
        warnings.extend(ignores_sections.then_some(Warning::SectionsIgnored));
        let (mut overlay_layers, left_out) =
            line_drawing::surface_line_layers(scene, context.workers())?;
        warnings.extend(left_out);
        if draws_surfaces {
            let overlays = line_drawing::overlay_layers(scene);
            overlay_layers.extend(drawing::with_label_halos(overlays));
            warnings.extend(text_warnings(scene));
        }
        let Renderer { buffers, insets } = renderer;
        // Inset renderers are retained so that later frames can reuse their memory.
        insets.resize_with(scene.insets.len(), Renderer::default);
        let prepare = |(inset, renderer): (&'a Inset, _)| {
            Self::new(renderer, context.with_scene(&inset.scene))
        };
        let insets = scene.insets.iter().zip(insets).map(prepare).collect::<Result<_, _>>()?;
        Ok(Self {
            context,
            buffers,
            page,
            overlay_layers,
            has_shadow_maps: false,
            full_occlusion: None,
            transmission_framebuffer: None,
            only_color: OnlyColor::Unknown,
            pixels_seen: 0,
            pixels_due: scene.image.pixel_rect().area() as u64,
            warnings,
            insets,
        })
    }

    /// Returns the warnings about missing parts of the picture and its insets, without duplicates.
    #[must_use]
    pub fn into_warnings(self) -> Vec<Warning> {
        let mut all = self.warnings;
        let is_whole = self.pixels_seen >= self.context.scene.image.pixel_rect().area();
        if is_whole && matches!(self.only_color, OnlyColor::One(_)) {
            let reason = self.context.scene.empty_reason();
            all.push(Warning::PictureEmpty { reason });
        }
        for warning in self.insets.into_iter().flat_map(Self::into_warnings) {
            if !all.contains(&warning) {
                all.push(warning);
            }
        }
        all
    }

    /// Renders a region of the picture. `picture` is resized to the region.
    ///
    /// # Errors
    /// Returns an error if the region is empty, too large or outside the picture, if the scene has
    /// too many primitives, or if the context's monitor requested cancellation.
    pub fn render_region<C: FrameChannel>(
        &mut self,
        region: PixelRect,
        picture: &mut Picture<C>,
    ) -> Result<(), RenderError> {
        let scene = self.context.scene;
        validate_region(scene.image, region)?;
        // The caption covers its strip, and insets may cover the view above the strip.
        let view = region.intersection(view_rect(scene.image));
        if view.is_none_or(|view| covers_region(&scene.insets, view)) {
            picture.resize(region.width, region.height);
        } else {
            self.render_below_insets(region, picture)?;
        }
        for (inset, prepared) in scene.insets.iter().zip(&mut self.insets) {
            if let Some([in_picture, in_inset]) = visible_rects(inset, region) {
                let mut pixels = Picture::default();
                prepared.render_region(in_inset, &mut pixels)?;
                composite_into(inset, &pixels, in_picture, region, picture);
            }
        }
        self.only_color.add_pixels(picture);
        self.pixels_seen += region.area();
        draw_caption_over(scene, region, picture);
        Ok(())
    }

    /// Renders a region without the insets: lines, or surfaces with the layers drawn over them.
    fn render_below_insets<C: FrameChannel>(
        &mut self,
        region: PixelRect,
        picture: &mut Picture<C>,
    ) -> Result<(), RenderError> {
        let size = self.context.image_size();
        if let Some(page) = &self.page {
            *picture = self.context.measure("pixels", || page.to_picture_region(size, region));
            return Ok(());
        }
        self.render_surfaces(region, picture)?;
        draw_layers_over(picture, size, region, &self.overlay_layers);
        Ok(())
    }

    /// Renders the surfaces of a region, one image tile after another.
    fn render_surfaces<C: FrameChannel>(
        &mut self,
        region: PixelRect,
        picture: &mut Picture<C>,
    ) -> Result<(), RenderError> {
        let image = self.context.scene.image;
        let needs_framebuffer = needs_framebuffer(self.context.scene);
        // Occlusion at a region's border depends on surfaces outside the region.
        let is_part = region != image.pixel_rect();
        if (is_part || needs_framebuffer) && self.full_occlusion.is_none() {
            self.full_occlusion = compute_whole_occlusion(&self.context)?;
        }
        self.render_shadow_maps()?;
        if needs_framebuffer && self.transmission_framebuffer.is_none() {
            self.render_transmission_framebuffer()?;
        }
        picture.resize(region.width, region.height);
        let tiles = tile_regions(image, region);
        // Most pictures are a single tile, which needs no copy.
        if let [tile] = tiles[..] {
            self.render_tile(tile, &mut picture.pixels)?;
        } else {
            for tile in tiles {
                let mut pixels = vec![[C::default(); 4]; tile.pixel_count()];
                self.render_tile(tile, &mut pixels)?;
                tile.copy_into_region(&pixels, region, &mut picture.pixels);
            }
        }
        // The rendering of a canceled tile stops early but returns no error.
        if self.context.workers().is_canceled() {
            return Err(RenderError::Canceled);
        }
        Ok(())
    }

    /// Renders the shadow maps once. They depend on the scene and the size of the whole picture,
    /// but never on the region.
    fn render_shadow_maps(&mut self) -> Result<(), RenderError> {
        if self.has_shadow_maps {
            return Ok(());
        }
        let Self { context, buffers, .. } = self;
        if context.scene.casts_shadows() {
            context.measure("shadows", || buffers.shadow_maps.render_maps(context))?;
        } else {
            buffers.shadow_maps.recycle_maps();
        }
        self.has_shadow_maps = true;
        Ok(())
    }

    /// Renders the picture behind glass, always for the whole picture and not for a region.
    fn render_transmission_framebuffer(&mut self) -> Result<(), RenderError> {
        let Self { context, buffers, full_occlusion, .. } = self;
        self.transmission_framebuffer = context.measure("transmission", || {
            render_framebuffer(context, &buffers.shadow_maps, full_occlusion.as_ref())
        })?;
        Ok(())
    }

    /// Returns the monitor of a region's frame, which reports the progress of the whole job.
    fn frame_monitor(&self, region: TileRegion) -> Option<PartMonitor> {
        let outer = Arc::clone(self.context.monitor?);
        let pixels = region.pixel_count() as u64;
        let total = self.pixels_due.max(pixels);
        let done = (self.pixels_seen as u64).min(total - pixels);
        Some(PartMonitor { outer, done, pixels, total })
    }

    /// Renders the part of an image tile that a region needs. Vertex processing and primitive
    /// assembly fill a visibility buffer, and then the visible fragments are shaded.
    fn render_tile<C: FrameChannel>(
        &mut self,
        region: TileRegion,
        pixels: &mut [[C; 4]],
    ) -> Result<(), RenderError> {
        let monitor = self.frame_monitor(region);
        let Self { context, buffers, full_occlusion, transmission_framebuffer, .. } = self;
        let RenderContext { scene, threads, .. } = *context;
        let memory = buffers.take_frame(context, region)?.with_monitor(monitor);
        let memory = context.measure("vertices", || assemble_scene(context, memory))?;
        let own_occlusion = match full_occlusion {
            None if scene.occlusion_radius.is_some() => context.measure("occlusion", || {
                compute_occlusion(context, &memory, &mut buffers.occlusion)
            })?,
            _ => None,
        };
        let occlusion = full_occlusion.as_ref().or(own_occlusion.as_ref());
        let shadows = &buffers.shadow_maps;
        let framebuffer = transmission_framebuffer.as_ref();
        let mut shading = fragment_shading(scene, &memory, shadows, occlusion, framebuffer);
        shading.has_eight_bits = C::BITS == 8;
        let styled = style_shading(scene, &shading);
        let surface: &dyn Surface = styled.as_ref().map_or(&shading as _, |styled| styled as _);
        let (frame, background) = (&memory.frame, scene.image.background);
        context.measure("pixels", || C::draw_frame(frame, surface, background, threads, pixels));
        buffers.recycle_frame(memory);
        // The next picture reuses the memory.
        buffers.occlusion.last = own_occlusion;
        Ok(())
    }
}
