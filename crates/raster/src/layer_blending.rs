//! Blending of translucent layers, back to front, separately for each sample.
//!
//! ```text
//!   pixel: opaque A (samples 0–2), opaque B (sample 3), layer C (all), layer D (samples 2–3)
//!   sample 0: A ← C       sample 2: A ← C ← D        color ← c + transmittance · color
//!   sample 1: A ← C       sample 3: B ← C ← D        then the mean of the samples
//! ```
//!
//! Layers are sorted by depth in each pixel, so the result is correct for any submission order
//! (order-independent transparency with per-pixel lists).

use crate::fragment_lanes::LANES;
use crate::sample_plane::NO_TRIANGLE;
use crate::tile_grid::TILE;
use crate::tile_resolve::{Contribution, PixelRun, TileResolve, split_before};
use crate::tile_visibility::TranslucentLayer;
use crate::{Encode, Surface, TranslucentColors};

/// The contributions to the pixels with layers in one row of a tile, and their colors.
#[derive(Debug, Default)]
pub(crate) struct LayeredPixels {
    /// The contributions from left to right; within a pixel, opaque contributions first, then
    /// layers back to front.
    pub(crate) contributions: Vec<Contribution>,
    /// The indices of contributions in the order in which they are shaded.
    shading_order: Vec<u32>,
    /// The color of each contribution.
    colors: Vec<[f32; 4]>,
    /// The factor applied to everything behind each contribution; meaningless for opaque
    /// contributions.
    transmittances: Vec<[f32; 3]>,
}

impl<S: Surface> TileResolve<'_, S> {
    /// Lists the contributions to each pixel of a run with layers: each opaque triangle once, then
    /// the layers back to front.
    ///
    /// A pixel that shows the background gets a contribution without a triangle, so it is also
    /// written.
    ///
    /// Every sample of a pixel is in exactly one opaque contribution, which is a triangle or the
    /// background. There are at most as many opaque contributions as samples.
    #[inline(always)]
    pub(crate) fn gather_contributions(
        &self,
        run: &PixelRun<'_>,
        contributions: &mut Vec<Contribution>,
    ) {
        let mut planes = [[NO_TRIANGLE; LANES]; 16];
        let planes = self.sample_triangles(run, &mut planes);
        let mut layers = run.layers;
        for x in run.lanes.clone() {
            let lane = (x - run.block_start()) as usize;
            // Group the samples of the pixel by their opaque triangle.
            let mut remaining = self.full_sample_mask();
            while remaining != 0 {
                let triangle = planes[remaining.trailing_zeros() as usize][lane];
                let mut mask = 0;
                for (sample, triangles) in planes.iter().enumerate() {
                    mask |= u16::from(triangles[lane] == triangle) << sample;
                }
                remaining &= !mask;
                contributions.push(Contribution { x, triangle, mask, translucent: false });
            }
            // Take the layers of this pixel; layers are sorted by pixel.
            let over;
            (over, layers) = split_before(layers, (run.y * TILE + x + 1) as usize);
            contributions.extend(over.iter().map(|layer| {
                let TranslucentLayer { triangle, mask, .. } = *layer;
                Contribution { x, triangle, mask, translucent: true }
            }));
        }
    }

    /// Returns a mask with one bit for each sample.
    fn full_sample_mask(&self) -> u16 {
        (u32::MAX >> (32 - self.frame.samples.count())) as u16
    }

    /// Shades the gathered contributions of a row eight at a time, then blends and writes their
    /// pixels.
    ///
    /// Groups of eight extend across pixel borders, so lanes are idle only in the last group of the
    /// row. Contributions are shaded in the order of their triangles. In pixel order, a group would
    /// alternate between a layer and the surface behind it. Surfaces shade eight fragments of one
    /// draw call in half the time they need for fragments of two.
    #[inline(always)]
    pub(crate) fn write_layered_pixels<P: Copy>(
        &self,
        y: u32,
        row: &mut [P],
        encode: &impl Encode<P>,
        layered: &mut LayeredPixels,
    ) {
        self.shade_contributions(y, layered);
        let LayeredPixels { contributions, colors, transmittances, .. } = layered;
        // Blend pixel by pixel: the contributions to one pixel are adjacent.
        let mut from = 0;
        while let Some(first) = contributions.get(from) {
            let of_pixel = contributions[from..].iter().take_while(|next| next.x == first.x);
            let range = from..from + of_pixel.count();
            let (contributions, colors) = (&contributions[range.clone()], &colors[range.clone()]);
            from = range.end;
            let color = self.blend_pixel(contributions, colors, &transmittances[range]);
            row[(first.x - self.rect.left) as usize] = encode.encode_pixel(color);
        }
    }

    /// Shades the contributions of a row, eight at a time.
    #[inline(always)]
    fn shade_contributions(&self, y: u32, layered: &mut LayeredPixels) {
        let LayeredPixels { contributions, shading_order, colors, transmittances } = layered;
        shading_order.clear();
        shading_order.extend(0..contributions.len() as u32);
        shading_order
            .sort_unstable_by_key(|&index| (contributions[index as usize].triangle, index));
        colors.clear();
        colors.resize(contributions.len(), [0.0; 4]);
        transmittances.clear();
        transmittances.resize(contributions.len(), [0.0; 3]);
        for indices in shading_order.chunks(LANES) {
            let mut eight = [contributions[indices[0] as usize]; LANES];
            for (contribution, &index) in eight.iter_mut().zip(indices) {
                *contribution = contributions[index as usize];
            }
            let eight = &eight[..indices.len()];
            let mut shaded = TranslucentColors::default();
            if let Some(fragments) = self.gather_fragments(y, eight) {
                shaded = self.surface.shade_translucent_eight(&fragments);
            }
            self.fix_background_colors(eight, &mut shaded.color);
            let ([r, g, b, alpha], transmittance) = (shaded.color, shaded.transmittance);
            for (lane, &index) in indices.iter().enumerate() {
                colors[index as usize] = [r[lane], g[lane], b[lane], alpha[lane]];
                transmittances[index as usize] = [0, 1, 2].map(|k: usize| transmittance[k][lane]);
            }
        }
    }

    /// Returns the color of a pixel: the mean of its samples.
    ///
    /// Without layers, this is the plain multisample resolve, weighted by sample counts.
    #[inline(always)]
    fn blend_pixel(
        &self,
        contributions: &[Contribution],
        colors: &[[f32; 4]],
        transmittances: &[[f32; 3]],
    ) -> [f32; 4] {
        if contributions[contributions.len() - 1].translucent {
            return self.blend_layers(contributions, colors, transmittances);
        }
        let mut sum = [0.0; 4];
        for (contribution, color) in contributions.iter().zip(colors) {
            let samples = contribution.mask.count_ones() as f32;
            for (sum, channel) in sum.iter_mut().zip(color) {
                *sum += channel * samples;
            }
        }
        self.mean_color(sum)
    }

    /// Returns the color of a pixel with layers, after blending each sample back to front.
    ///
    /// Blending the means instead would be cheaper, but the background would show through where an
    /// opaque edge and the edge of a layer meet.
    ///
    /// Opaque contributions come first and set their samples. Each layer then applies `color +
    /// transmittance · behind`, with premultiplied color, channel by channel.
    fn blend_layers(
        &self,
        contributions: &[Contribution],
        colors: &[[f32; 4]],
        transmittances: &[[f32; 3]],
    ) -> [f32; 4] {
        let mut samples = [[0.0; 4]; 16];
        let layers = contributions.iter().zip(colors).zip(transmittances);
        for ((contribution, color), [r, g, b]) in layers {
            // Opaque contributions replace everything behind them: their transmittance is 0.
            let mut behind = [0.0; 4];
            if contribution.translucent {
                behind = [*r, *g, *b, 1.0 - color[3]];
            }
            for (index, sample) in samples.iter_mut().enumerate() {
                if contribution.mask & (1 << index) != 0 {
                    *sample = [0, 1, 2, 3].map(|k| color[k] + sample[k] * behind[k]);
                }
            }
        }
        // Multisample resolve of the blended samples.
        let mut sum = [0.0; 4];
        for sample in &samples[..self.frame.samples.count()] {
            sum = [0, 1, 2, 3].map(|k| sum[k] + sample[k]);
        }
        self.mean_color(sum)
    }

    /// Returns the mean of a pixel's samples, given their sum in linear light.
    #[inline(always)]
    fn mean_color(&self, sum: [f32; 4]) -> [f32; 4] {
        let count = self.frame.samples.count() as f32;
        sum.map(|channel| channel / count)
    }
}
