//! Render passes (AOVs): numeric values for each pixel, such as depth, position, normal and ids.
//!
//! ```text
//!   primitives of the frame ─► nearest at each pixel's center ─► triangle id, barycentric weights
//!                                                             ─► depth, position, normal, uv, …
//! ```
//! One sample at the pixel's center determines the nearest surface, opaque or translucent, by the
//! rasterizer's rules; holes in masked materials are skipped. The weights are then recomputed at
//! the exact center, in f64, on the triangle before it is snapped to 1/256 pixel (IN-2; Olano and
//! Greer, 1997, homogeneous barycentric coordinates). If the center is inside the snapped triangle
//! but outside the exact triangle, the weights are clamped to the exact border.

mod buffer;
mod exr;
mod geometry;
mod npy;
mod to_png;

pub use buffer::{PassBuffer, PassValues};
pub use scene_file::{Pass, PassEncoding};

use super::RenderError;
use super::context::RenderContext;
use super::fragment_shading::fragment_shading;
use super::image_tiles::{TileRegion, tile_regions, validate_region};
use super::mip_chains::Textures;
use super::primitive_assembly::assemble_with_opacity;
use super::renderer::{RenderBuffers, Renderer};
use super::shadow_maps::ShadowMapRenderer;
use geometry::{SceneGeometry, Visibility};
use homog::PixelRect;
use model::Timings;
use raster::{Fragment, Opacity, Samples, Surface};
use scene::{Scene, Style};
use shade::FrameChannel;

/// Renders passes of a region of a scene's picture, in the order of `wanted`, with up to `threads`
/// threads. The number of threads does not affect the result.
///
/// Passes show the surfaces of the models even if the scene's style draws lines. They exclude
/// overlays, the environment, the backdrop and the ground.
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
/// use pipeline::PixelRect;
/// use pipeline::render::passes::{Pass, render_passes};
///
/// let whole = PixelRect::from_size(64, 48);
/// let buffers = render_passes(&scene, whole, &[Pass::Depth], 2, &Default::default())?;
/// // The triangle is 4 units in front of the eye.
/// let depth = buffers[0].float_values(32, 24).map(|values| values[0]);
/// assert!(depth.is_some_and(|depth| (depth - 4.0).abs() < 1e-5), "{depth:?}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns the same errors as [`render`](crate::render()).
pub fn render_passes(
    scene: &Scene,
    region: PixelRect,
    wanted: &[Pass],
    threads: usize,
    timings: &Timings,
) -> Result<Vec<PassBuffer>, RenderError> {
    let textures = timings.measure("mip chains", || Textures::for_models(&scene.models));
    let context = RenderContext::new(scene, &textures, threads).with_timings(timings);
    Renderer::default().render_passes(&context, region, wanted)
}

impl Renderer {
    /// Renders passes of a region of a scene's picture, in the order of `wanted`, like the function
    /// [`render_passes`] but with this renderer's memory and existing textures.
    ///
    /// # Errors
    /// Returns the same errors as [`render`](Self::render).
    pub fn render_passes(
        &mut self,
        context: &RenderContext<'_>,
        region: PixelRect,
        wanted: &[Pass],
    ) -> Result<Vec<PassBuffer>, RenderError> {
        let scene = context.scene;
        validate_region(scene.image, region)?;
        let mut buffers: Vec<_> =
            wanted.iter().map(|&pass| PassBuffer::new_empty(pass, region)).collect();
        for tile_region in tile_regions(scene.image, region) {
            let mut passes =
                TilePasses { context: *context, tile_region, memory: &mut self.buffers };
            let rendered = context.measure("passes", || passes.render_all(wanted))?;
            if tile_region.rect == region {
                return Ok(rendered);
            }
            for (buffer, tile) in buffers.iter_mut().zip(&rendered) {
                buffer.copy_tile(tile, tile_region, region);
            }
        }
        Ok(buffers)
    }
}

/// The state for rendering the passes of one image tile.
struct TilePasses<'a, 'r> {
    /// The original scene; each frame draws a variant of it.
    context: RenderContext<'a>,
    /// The part of the tile inside the requested region.
    tile_region: TileRegion,
    /// The buffers for frames.
    memory: &'r mut RenderBuffers,
}

impl TilePasses<'_, '_> {
    /// Renders passes. All except overdraw and coverage share one buffer of triangle ids.
    fn render_all(&mut self, wanted: &[Pass]) -> Result<Vec<PassBuffer>, RenderError> {
        let threads = self.context.threads;
        let geometry = SceneGeometry::new(self.context.scene, self.tile_region.tile)?;
        let mut visibility = None;
        let mut buffers = Vec::with_capacity(wanted.len());
        for &pass in wanted {
            let mut buffer = PassBuffer::new_empty(pass, self.tile_region.rect);
            match (pass, &mut buffer.values) {
                (Pass::Overdraw, PassValues::Integers(counts)) => self.count_overdraw(counts)?,
                (Pass::Coverage, PassValues::Floats(coverage)) => {
                    self.measure_coverage(coverage)?;
                }
                _ => {
                    let visible = match &mut visibility {
                        Some(visible) => visible,
                        none => none.insert(self.find_visible(geometry.needs_weights())?),
                    };
                    if !buffer.fill_pixels(&geometry, visible, self.tile_region, threads) {
                        *visible = self.find_visible(true)?;
                        buffer.fill_pixels(&geometry, visible, self.tile_region, threads);
                    }
                }
            }
            buffers.push(buffer);
        }
        Ok(buffers)
    }

    /// Finds the nearest primitive at each pixel's center, and optionally its weights there.
    fn find_visible(&mut self, needs_weights: bool) -> Result<Visibility, RenderError> {
        let count = self.tile_region.pixel_count();
        let mut ids = vec![Visibility::NOTHING; count];
        let mut weights = vec![[0.0; 3]; if needs_weights { count } else { 0 }];
        let threads = self.context.threads;
        self.with_frame(Samples::One, None, |frame, surface| {
            frame.write_front_ids(surface, threads, &mut ids);
            if needs_weights {
                let of_fragment = |fragment: &Fragment<'_>| fragment.weights;
                frame.map_front_fragments(surface, threads, &mut weights, of_fragment);
            }
        })?;
        Ok(Visibility { ids, weights })
    }

    /// Counts the fragments at each pixel's center, including hidden fragments (overdraw). All
    /// primitives are drawn as translucent, because opaque primitives would replace each other.
    fn count_overdraw(&mut self, counts: &mut [u32]) -> Result<(), RenderError> {
        let threads = self.context.threads;
        self.with_frame(Samples::One, Some(Opacity::Translucent), |frame, surface| {
            frame.count_overdraw(surface, threads, counts);
        })
    }

    /// Measures the fraction of each pixel's samples that a surface covers (coverage).
    fn measure_coverage(&mut self, coverage: &mut [f32]) -> Result<(), RenderError> {
        let RenderContext { scene, threads, .. } = self.context;
        self.with_frame(scene.image.samples, None, |frame, surface| {
            let mut pixels = vec![[0; 4]; coverage.len()];
            u16::draw_frame(frame, &CoverageMask(surface), [0.0; 4], threads, &mut pixels);
            // Alpha is the mean of the samples, and rounding it to a whole number of samples makes
            // it exact.
            let count = scene.image.samples.count() as f32;
            for (coverage, [.., alpha]) in coverage.iter_mut().zip(pixels) {
                *coverage = (f32::from(alpha) * count / f32::from(u16::MAX)).round() / count;
            }
        })
    }

    /// Assembles a frame of only the models, with a different number of samples and optionally a
    /// different opacity.
    fn with_frame(
        &mut self,
        samples: Samples,
        opacity: Option<Opacity>,
        draw: impl FnOnce(&raster::Frame, &shade::Shading<'_>),
    ) -> Result<(), RenderError> {
        let mut scene = self.context.scene.clone();
        (scene.image.samples, scene.image.environment_blur) = (samples, None);
        scene.backdrop = None;
        (scene.ground, scene.occlusion_radius) = (None, None);
        // Other styles may show back faces or draw opaque materials as translucent.
        scene.style = if scene.style == Style::Flat { Style::Flat } else { Style::Shaded };
        let context = self.context.with_scene(&scene);
        let memory = self.memory.take_frame(&context, self.tile_region)?;
        let memory = assemble_with_opacity(&context, memory, opacity)?;
        let no_shadows = ShadowMapRenderer::default();
        draw(&memory.frame, &fragment_shading(&scene, &memory, &no_shadows, None, None));
        self.memory.recycle_frame(memory);
        if context.workers().is_canceled() {
            return Err(RenderError::Canceled);
        }
        Ok(())
    }
}

/// A surface that is white wherever another surface passes its alpha test.
struct CoverageMask<'a>(&'a dyn Surface);

impl Surface for CoverageMask<'_> {
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        self.0.passes_alpha_test(fragment)
    }

    fn shade(&self, _: &Fragment<'_>) -> [f32; 4] {
        [1.0; 4]
    }
}
