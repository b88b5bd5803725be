//! Multisample resolve of edge pixels. Several opaque triangles share the samples of such a pixel,
//! and its color is the mean of the sample colors.
//!
//! ```text
//!   A A A A B B B B     the triangle of each pixel's first sample, shaded like eight neighbors
//!         B   C         triangles of other samples, gathered along the row, shaded eight at a time
//! ```
//!
//! Each triangle is shaded once per pixel, and its color is weighted by its number of samples.
//! Colors are summed channel by channel, so the means of eight pixels are computed and encoded at
//! once.

use crate::Samples;
use crate::fragment_lanes::{F32x8, LANES};
use crate::tile_grid::TILE;
use crate::tile_resolve::Contribution;
use std::ops::Range;

/// The edge pixels in one row of a tile.
#[derive(Debug)]
pub(crate) struct EdgePixels {
    /// Red, green, blue and alpha of each pixel, summed over its samples.
    color_sums: [[f32; TILE as usize]; 4],
    /// The blocks of eight pixels that contain edge pixels, one bit per block.
    blocks: u32,
    /// The contributions of triangles that are not visible at the first sample, from left to right.
    contributions: Vec<Contribution>,
}

impl Default for EdgePixels {
    fn default() -> Self {
        Self { color_sums: [[0.0; TILE as usize]; 4], blocks: 0, contributions: Vec::new() }
    }
}

impl EdgePixels {
    /// Starts a new row.
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.blocks = 0;
        self.contributions.clear();
    }

    /// Returns the contributions that remain to be shaded and added, from left to right.
    pub(crate) fn contributions(&self) -> &[Contribution] {
        &self.contributions
    }

    /// Adds a block of eight pixels: the colors of their first samples' triangles, weighted by the
    /// number of samples that show the same triangle or a triangle that `continues` its surface.
    /// Other triangles become contributions.
    ///
    /// `planes` holds the triangles of all samples; pixels outside `lanes` are ignored.
    #[inline(always)]
    pub(crate) fn add_first_samples(
        &mut self,
        block: usize,
        lanes: Range<usize>,
        planes: &[[u32; LANES]],
        colors: &[F32x8; 4],
        continues: impl Fn(u32, u32) -> bool,
    ) {
        // Coverage of the first sample's triangle in each pixel.
        let mut masks = first_sample_masks(planes);
        self.blocks |= 1 << block;
        let all = u32::MAX >> (32 - planes.len());
        for lane in lanes {
            let first = planes[0][lane];
            // Group the remaining samples of the pixel by triangle.
            let mut remaining = all & !masks[lane];
            while remaining != 0 {
                let triangle = planes[remaining.trailing_zeros() as usize][lane];
                let mut mask = 0;
                for (sample, triangles) in planes.iter().enumerate() {
                    mask |= u16::from(triangles[lane] == triangle) << sample;
                }
                remaining &= !u32::from(mask);
                if continues(first, triangle) {
                    masks[lane] |= u32::from(mask);
                    continue;
                }
                let x = (block * LANES + lane) as u32;
                self.contributions.push(Contribution { x, triangle, mask, translucent: false });
            }
        }
        // Weight each color by its number of samples, a block of eight at once.
        for (sums, color) in self.color_sums.iter_mut().zip(colors) {
            let sums = &mut sums[block * LANES..(block + 1) * LANES];
            for lane in 0..LANES {
                sums[lane] = color[lane] * masks[lane].count_ones() as f32;
            }
        }
    }

    /// Adds the colors of at most eight contributions.
    #[inline(always)]
    pub(crate) fn add_contributions(&mut self, range: Range<usize>, colors: &[F32x8; 4]) {
        for (lane, contribution) in self.contributions[range].iter().enumerate() {
            let samples = contribution.mask.count_ones() as f32;
            for (sums, color) in self.color_sums.iter_mut().zip(colors) {
                sums[contribution.x as usize] += color[lane] * samples;
            }
        }
    }

    /// Returns the mean colors of the pixels, block by block: the index of each block and its eight
    /// colors.
    #[inline(always)]
    pub(crate) fn mean_colors(
        &self,
        samples: Samples,
    ) -> impl Iterator<Item = (usize, [F32x8; 4])> {
        let blocks = (0..TILE as usize / LANES).filter(|block| self.blocks >> block & 1 != 0);
        // The number of samples is a power of two, so its reciprocal and the product are exact.
        let inv_count = 1.0 / samples.count() as f32;
        blocks.map(move |block| {
            let mut means = [[0.0; LANES]; 4];
            for (means, sums) in means.iter_mut().zip(&self.color_sums) {
                let sums = &sums[block * LANES..(block + 1) * LANES];
                for lane in 0..LANES {
                    means[lane] = sums[lane] * inv_count;
                }
            }
            (block, means)
        })
    }
}

/// Returns, for each of eight pixels, the samples that show the first sample's triangle, one bit
/// per sample.
#[inline(always)]
fn first_sample_masks(planes: &[[u32; LANES]]) -> [u32; LANES] {
    let mut masks = [1; LANES];
    for (sample, triangles) in planes.iter().enumerate().skip(1) {
        for lane in 0..LANES {
            masks[lane] |= u32::from(triangles[lane] == planes[0][lane]) << sample;
        }
    }
    masks
}
