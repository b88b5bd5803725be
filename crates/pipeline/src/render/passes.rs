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
mod kind;
mod npy;
mod to_png;

pub use buffer::{PassBuffer, Values};
pub use kind::{Pass, PassEncoding};

use super::RenderError;
use super::assemble::assemble_as;
use super::region::{PartOfSheet, sheets};
use super::renderer::{Renderer, shading};
use super::textures::Textures;
use crate::scene::{Scene, Style};
use geometry::{Geometry, Hit};
use homog::PixelRect;
use model::Timings;
use raster::{Cover, Fragment, Samples, Surface};

/// Draws the wanted passes of a region of a scene's picture with up to `threads` threads; their number does not change them.
///
/// They show the surfaces of the models whatever the scene's style, and never overlays or the surroundings.
///
/// # Errors
/// As [`render`](crate::render()).
pub fn passes(
    scene: &Scene,
    region: PixelRect,
    wanted: &[Pass],
    threads: usize,
    timings: &Timings,
) -> Result<Vec<PassBuffer>, RenderError> {
    super::region::check_region(scene.image, region)?;
    let textures = timings.measure("mip chains", || Textures::of(&scene.models));
    let mut buffers: Vec<_> = wanted.iter().map(|&pass| PassBuffer::empty(pass, region)).collect();
    for part in sheets(scene.image, region) {
        let drawing = Drawing { scene, textures: &textures, part, threads };
        let drawn = timings.measure("passes", || drawing.passes(wanted))?;
        for (buffer, patch) in buffers.iter_mut().zip(&drawn) {
            buffer.put(patch, part, region);
        }
    }
    Ok(buffers)
}

/// Passes of what a region has of a sheet.
struct Drawing<'a> {
    scene: &'a Scene,
    textures: &'a Textures<'a>,
    part: PartOfSheet,
    threads: usize,
}

impl Drawing<'_> {
    fn passes(&self, wanted: &[Pass]) -> Result<Vec<PassBuffer>, RenderError> {
        let needs_hits = wanted.iter().any(|pass| !matches!(pass, Pass::Overdraw | Pass::Coverage));
        let hits = if needs_hits { self.hits()? } else { Vec::new() };
        let geometry = Geometry::of(self.scene, self.part.sheet)?;
        let draw = |&pass: &Pass| {
            let mut buffer = PassBuffer::empty(pass, self.part.shown);
            match (pass, &mut buffer.values) {
                (Pass::Overdraw, Values::Numbers(counts)) => self.count(counts)?,
                (Pass::Coverage, Values::Floats(shares)) => self.cover(shares)?,
                _ => buffer.fill(&geometry, &hits, self.part, self.threads),
            }
            Ok(buffer)
        };
        wanted.iter().map(draw).collect()
    }

    /// What is nearest at the centre of each pixel.
    fn hits(&self) -> Result<Vec<Hit>, RenderError> {
        let mut hits = vec![Hit::NOTHING; self.part.area()];
        self.with_frame(Samples::One, None, |frame, surface| {
            frame.front(surface, self.threads, &mut hits, |fragment| Hit {
                id: fragment.id,
                weights: fragment.weights,
            });
        })?;
        Ok(hits)
    }

    /// How many fragments cover the centre of each pixel.
    fn count(&self, counts: &mut [u32]) -> Result<(), RenderError> {
        self.with_frame(Samples::One, Some(Cover::Translucent), |frame, surface| {
            frame.count_layers(surface, self.threads, counts);
        })
    }

    /// Which share of the samples of each pixel is covered.
    fn cover(&self, shares: &mut [f32]) -> Result<(), RenderError> {
        self.with_frame(self.scene.image.samples, None, |frame, surface| {
            let covering = Covering(surface);
            frame.draw(&covering, [0.0; 4], self.threads, shares, |color: [f32; 4]| color[0]);
        })
    }

    fn with_frame(
        &self,
        samples: Samples,
        cover: Option<Cover>,
        draw: impl FnOnce(&raster::Frame, &shade::Shading<'_>),
    ) -> Result<(), RenderError> {
        let mut scene = self.scene.clone();
        (scene.image.samples, scene.image.backdrop) = (samples, None);
        scene.painting = None;
        (scene.ground, scene.occlusion_radius) = (None, None);
        // Styles may show backs, and what is opaque as glass.
        scene.style = if scene.style == Style::Flat { Style::Flat } else { Style::Shaded };
        let memory = Renderer::default().lend(&scene, self.part, self.threads)?;
        let memory = assemble_as(&scene, self.textures, self.threads, memory, cover)?;
        draw(&memory.frame, &shading(&scene, &memory.draws, &memory.frame, &[], None));
        Ok(())
    }
}

/// A surface that is white wherever another is.
struct Covering<'a, S>(&'a S);

impl<S: Surface> Surface for Covering<'_, S> {
    fn keeps(&self, fragment: &Fragment<'_>) -> bool {
        self.0.keeps(fragment)
    }

    fn shade(&self, _: &Fragment<'_>) -> [f32; 4] {
        [1.0; 4]
    }
}
