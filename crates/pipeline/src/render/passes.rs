//! Passes: what is in each pixel of a picture besides its colour, as numbers.
//!
//! ```text
//!   the picture's primitives ─► nearest at each pixel's centre ─► its triangle and weights ─► depth, position, normal, …
//! ```
//! One sample at the pixel's centre decides, by the rasteriser's own rules: what is nearest there, translucent or not, with the
//! holes of masks. The weights of the triangle's corners are then those at the exact centre, in f64, on the triangle as it
//! is before its corners are snapped to 1/256 pixel (IN-2, by homogeneous coordinates as Olano and Greer have it, 1997); where snapping puts a
//! centre outside of the triangle, those of a place on its border.

mod buffer;
mod geometry;
mod npy;
mod pass;
mod to_png;

pub use buffer::{PassBuffer, PassValues};
pub use pass::{Pass, PassEncoding};

use super::RenderError;
use super::image_tiles::{TileRegion, tile_regions};
use super::mip_chains::Textures;
use super::primitive_assembly::assemble_with_cover;
use super::renderer::{Renderer, fragment_shading};
use crate::scene::{Scene, Style};
use geometry::{Hit, SceneGeometry};
use homog::PixelRect;
use model::Timings;
use raster::{Fragment, Opacity, Samples, Surface};

/// Draws the wanted passes of a region of a scene's picture with up to `threads` threads; their number does not change them.
///
/// They show the surfaces of the models whatever the scene's style, and never overlays or the surroundings.
///
/// # Errors
/// As [`render`](crate::render()).
pub fn render_passes(
    scene: &Scene,
    region: PixelRect,
    wanted: &[Pass],
    threads: usize,
    timings: &Timings,
) -> Result<Vec<PassBuffer>, RenderError> {
    super::image_tiles::validate_region(scene.image, region)?;
    let textures = timings.measure("mip chains", || Textures::for_models(&scene.models));
    let mut buffers: Vec<_> =
        wanted.iter().map(|&pass| PassBuffer::new_empty(pass, region)).collect();
    for part in tile_regions(scene.image, region) {
        let drawing = TilePasses { scene, textures: &textures, tile_region: part, threads };
        let drawn = timings.measure("passes", || drawing.render_all(wanted))?;
        for (buffer, patch) in buffers.iter_mut().zip(&drawn) {
            buffer.copy_tile(patch, part, region);
        }
    }
    Ok(buffers)
}

/// Passes of what a region has of a sheet.
struct TilePasses<'a> {
    scene: &'a Scene,
    textures: &'a Textures<'a>,
    tile_region: TileRegion,
    threads: usize,
}

impl TilePasses<'_> {
    fn render_all(&self, wanted: &[Pass]) -> Result<Vec<PassBuffer>, RenderError> {
        let needs_hits = wanted.iter().any(|pass| !matches!(pass, Pass::Overdraw | Pass::Coverage));
        let hits = if needs_hits { self.nearest_hits()? } else { Vec::new() };
        let geometry = SceneGeometry::new(self.scene, self.tile_region.tile)?;
        let draw = |&pass: &Pass| {
            let mut buffer = PassBuffer::new_empty(pass, self.tile_region.rect);
            match (pass, &mut buffer.values) {
                (Pass::Overdraw, PassValues::Integers(counts)) => self.count_overdraw(counts)?,
                (Pass::Coverage, PassValues::Floats(shares)) => self.measure_coverage(shares)?,
                _ => buffer.fill_pixels(&geometry, &hits, self.tile_region, self.threads),
            }
            Ok(buffer)
        };
        wanted.iter().map(draw).collect()
    }

    /// What is nearest at the centre of each pixel.
    fn nearest_hits(&self) -> Result<Vec<Hit>, RenderError> {
        let mut hits = vec![Hit::MISS; self.tile_region.pixel_count()];
        self.with_frame(Samples::One, None, |frame, surface| {
            frame.map_front_fragments(surface, self.threads, &mut hits, |fragment| Hit {
                id: fragment.id,
                weights: fragment.weights,
            });
        })?;
        Ok(hits)
    }

    /// How many fragments cover the centre of each pixel.
    fn count_overdraw(&self, counts: &mut [u32]) -> Result<(), RenderError> {
        self.with_frame(Samples::One, Some(Opacity::Translucent), |frame, surface| {
            frame.count_overdraw(surface, self.threads, counts);
        })
    }

    /// Which share of the samples of each pixel is covered.
    fn measure_coverage(&self, shares: &mut [f32]) -> Result<(), RenderError> {
        self.with_frame(self.scene.image.samples, None, |frame, surface| {
            let covering = CoverageMask(surface);
            frame.draw(&covering, [0.0; 4], self.threads, shares, |color: [f32; 4]| color[0]);
        })
    }

    fn with_frame(
        &self,
        samples: Samples,
        cover: Option<Opacity>,
        draw: impl FnOnce(&raster::Frame, &shade::Shading<'_>),
    ) -> Result<(), RenderError> {
        let mut scene = self.scene.clone();
        (scene.image.samples, scene.image.environment_blur) = (samples, None);
        scene.backdrop = None;
        (scene.ground, scene.occlusion_radius) = (None, None);
        // Styles may show backs, and what is opaque as glass.
        scene.style = if scene.style == Style::Flat { Style::Flat } else { Style::Shaded };
        let memory = Renderer::default().take_buffers(&scene, self.tile_region, self.threads)?;
        let memory = assemble_with_cover(&scene, self.textures, self.threads, memory, cover)?;
        draw(&memory.frame, &fragment_shading(&scene, &memory.draws, &memory.frame, &[], None));
        Ok(())
    }
}

/// A surface that is white wherever another is.
struct CoverageMask<'a, S>(&'a S);

impl<S: Surface> Surface for CoverageMask<'_, S> {
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        self.0.passes_alpha_test(fragment)
    }

    fn shade(&self, _: &Fragment<'_>) -> [f32; 4] {
        [1.0; 4]
    }
}
