//! Pixels on edges: several solid pieces share their samples, and the pixel has the mean of their colours.
//!
//! ```text
//!   A A A A B B B B     the piece of each pixel's first sample: shaded as eight neighbours are
//!         B   C         pieces of other samples: gathered along the row of the tile and shaded eight at a time
//! ```
//!
//! Colours are summed up channel by channel, so that sums, means and codes of eight pixels are made at once.

use crate::Samples;
use crate::fragment_lanes::{F32x8, LANES};
use crate::tile_grid::TILE;
use crate::tile_resolve::Contribution;
use std::ops::Range;

/// The pixels on edges in one row of a tile.
#[derive(Debug)]
pub(crate) struct EdgePixels {
    /// For each pixel red, green, blue and alpha, summed over its samples.
    color_sums: [[f32; TILE as usize]; 4],
    /// Which blocks of eight pixels are here, bit by bit.
    blocks: u32,
    /// The pieces that are not those of their pixels' first samples, from left to right.
    contributions: Vec<Contribution>,
}

impl Default for EdgePixels {
    fn default() -> Self {
        Self { color_sums: [[0.0; TILE as usize]; 4], blocks: 0, contributions: Vec::new() }
    }
}

impl EdgePixels {
    /// Begins another row.
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.blocks = 0;
        self.contributions.clear();
    }

    /// What is still to be added: the pieces that are not those of their pixels' first samples, from left to right.
    pub(crate) fn contributions(&self) -> &[Contribution] {
        &self.contributions
    }

    /// Adds eight pixels: the colours of the pieces of their first samples, and of how many samples these are. `planes` are the
    /// pieces of all samples; those of pixels outside of `lanes` do not matter.
    #[inline(always)]
    pub(crate) fn add_first_samples(
        &mut self,
        block: usize,
        lanes: Range<usize>,
        planes: &[[u32; LANES]],
        colors: &[F32x8; 4],
    ) {
        let masks = first_sample_masks(planes);
        self.blocks |= 1 << block;
        for (sums, color) in self.color_sums.iter_mut().zip(colors) {
            let sums = &mut sums[block * LANES..(block + 1) * LANES];
            for lane in 0..LANES {
                sums[lane] = color[lane] * masks[lane].count_ones() as f32;
            }
        }
        let all = u32::MAX >> (32 - planes.len());
        for lane in lanes {
            let mut left = all & !masks[lane];
            while left != 0 {
                let piece = planes[left.trailing_zeros() as usize][lane];
                let mut mask = 0;
                for (sample, pieces) in planes.iter().enumerate() {
                    mask |= u16::from(pieces[lane] == piece) << sample;
                }
                left &= !u32::from(mask);
                let x = (block * LANES + lane) as u32;
                self.contributions.push(Contribution {
                    x,
                    triangle: piece,
                    mask,
                    translucent: false,
                });
            }
        }
    }

    /// Adds the colours of some of the others, of eight at most.
    #[inline(always)]
    pub(crate) fn add_contributions(&mut self, some: Range<usize>, colors: &[F32x8; 4]) {
        for (lane, other) in self.contributions[some].iter().enumerate() {
            let samples = other.mask.count_ones() as f32;
            for (sums, color) in self.color_sums.iter_mut().zip(colors) {
                sums[other.x as usize] += color[lane] * samples;
            }
        }
    }

    /// The means over the samples, eight pixels at a time: the number of the block, and the colours.
    #[inline(always)]
    pub(crate) fn mean_colors(
        &self,
        samples: Samples,
    ) -> impl Iterator<Item = (usize, [F32x8; 4])> {
        let blocks = (0..TILE as usize / LANES).filter(|block| self.blocks >> block & 1 != 0);
        // The number of samples is a power of two, and the product exact.
        let per = 1.0 / samples.count() as f32;
        blocks.map(move |block| {
            let mut means = [[0.0; LANES]; 4];
            for (means, sums) in means.iter_mut().zip(&self.color_sums) {
                let sums = &sums[block * LANES..(block + 1) * LANES];
                for lane in 0..LANES {
                    means[lane] = sums[lane] * per;
                }
            }
            (block, means)
        })
    }
}

/// The samples that see what the first one sees, bit by bit, for each of eight pixels.
#[inline(always)]
fn first_sample_masks(planes: &[[u32; LANES]]) -> [u32; LANES] {
    let mut masks = [1; LANES];
    for (sample, pieces) in planes.iter().enumerate().skip(1) {
        for lane in 0..LANES {
            masks[lane] |= u32::from(pieces[lane] == planes[0][lane]) << sample;
        }
    }
    masks
}
