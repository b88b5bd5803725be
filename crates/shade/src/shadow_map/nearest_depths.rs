//! The nearest depths around blocks of texels: a bound on the depths of a receiver's casters.
//!
//! ```text
//!   ┌──┬──┬──┬──┐
//!   │  │▒▒│▒▒│▒▒│     ▒ and █ are the neighborhood of block █, which contains everything within
//!   ├──┼──┼──┼──┤     the side of a block from any texel of █
//!   │  │▒▒│██│▒▒│
//!   └──┴──┴──┴──┘
//! ```

use super::MAX_FILTER_RADIUS;
use crate::approximations::floor_to_int;
use raster::SurfaceDepth;

/// The side length of a block in texels.
const BLOCK_SIDE: usize = 16;
/// The side length of a neighborhood in texels.
const NEIGHBORHOOD_SIDE: f32 = 3.0 * BLOCK_SIDE as f32;

// Texels are compared at their centers, up to a texel beyond the radius. Lookups must not extend
// beyond three neighborhoods in a row.
const _: () = assert!(MAX_FILTER_RADIUS + 1.0 <= NEIGHBORHOOD_SIDE + BLOCK_SIDE as f32);

/// The nearest depth in the neighborhood of each block of a shadow map.
#[derive(Clone, Debug, Default)]
pub(super) struct NearestDepths {
    /// The block columns and rows.
    size: [usize; 2],
    /// The maximum depth of each block and the eight blocks around it, in rows from the top.
    depths: Vec<f32>,
    /// The depths before the last step of the computation, kept to reuse their memory.
    earlier: Vec<f32>,
}

impl NearestDepths {
    /// Computes the depths from the texels of a map, which are in rows from the top.
    pub(super) fn find(&mut self, texels: &[SurfaceDepth], size: [u32; 2]) {
        let [columns, rows] = size.map(|side| (side as usize).div_ceil(BLOCK_SIDE));
        self.size = [columns, rows];
        self.depths.clear();
        self.depths.resize(columns * rows, f32::NEG_INFINITY);
        let width = (size[0] as usize).max(1);
        for (row, texels) in texels.chunks_exact(width).enumerate() {
            let blocks = &mut self.depths[row / BLOCK_SIDE * columns..][..columns];
            for (nearest, block) in blocks.iter_mut().zip(texels.chunks(BLOCK_SIDE)) {
                *nearest = block.iter().fold(*nearest, |nearest, texel| nearest.max(texel.depth));
            }
        }
        self.dilate([1, 0]);
        self.dilate([0, 1]);
    }

    /// Replaces each depth with the maximum of itself and its two neighbors along one axis.
    fn dilate(&mut self, step: [usize; 2]) {
        let [columns, rows] = self.size;
        std::mem::swap(&mut self.depths, &mut self.earlier);
        let at = |column: usize, row: usize| self.earlier[row * columns + column];
        let greatest = |index: usize| {
            let (column, row) = (index % columns, index / columns);
            let before = at(column.saturating_sub(step[0]), row.saturating_sub(step[1]));
            let after = at((column + step[0]).min(columns - 1), (row + step[1]).min(rows - 1));
            at(column, row).max(before).max(after)
        };
        self.depths.clear();
        self.depths.extend((0..columns * rows).map(greatest));
    }

    /// Discards all depths.
    pub(super) fn clear(&mut self) {
        self.depths.clear();
    }

    /// Returns a bound on the nearest depth within `reach` texels of a position: that depth or a
    /// nearer depth. Returns 1, the nearest possible depth, if the depths are not known.
    #[inline(always)]
    pub(super) fn depth_around(&self, [x, y]: [f32; 2], reach: f32) -> f32 {
        if reach <= BLOCK_SIDE as f32 {
            return self.depth_at(x, y);
        }
        let mut nearest = f32::NEG_INFINITY;
        for dy in [-NEIGHBORHOOD_SIDE, 0.0, NEIGHBORHOOD_SIDE] {
            for dx in [-NEIGHBORHOOD_SIDE, 0.0, NEIGHBORHOOD_SIDE] {
                nearest = nearest.max(self.depth_at(x + dx, y + dy));
            }
        }
        nearest
    }

    /// Returns the nearest depth in the neighborhood of a position, which is clamped to the map.
    #[inline(always)]
    fn depth_at(&self, x: f32, y: f32) -> f32 {
        let [columns, rows] = self.size;
        let block = |at: f32, count: usize| {
            let index = floor_to_int(at * (1.0 / BLOCK_SIDE as f32)).max(0) as usize;
            index.min(count.saturating_sub(1))
        };
        let index = block(y, rows) * columns + block(x, columns);
        self.depths.get(index).copied().unwrap_or(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_within_reach_are_not_nearer_than_the_bound() {
        let size = [150_u32, 90];
        let depth = |index: usize| ((index * 7919) % 10_007) as f32 / 10_007.0;
        let texels: Vec<_> = (0..150 * 90)
            .map(|index| SurfaceDepth { depth: depth(index) * depth(index), dx: 0.0, dy: 0.0 })
            .collect();
        let mut nearest = NearestDepths::default();
        nearest.find(&texels, size);
        for step in 0..200 {
            let (x, y) = ((step * 37 % 1500) as f32 * 0.1, (step * 91 % 900) as f32 * 0.1);
            for reach in [1.0_f32, 15.9, 16.1, 40.0, MAX_FILTER_RADIUS + 1.0] {
                let bound = nearest.depth_around([x, y], reach);
                let is_within = |index: usize| {
                    let (column, row) = ((index % 150) as f32 + 0.5, (index / 150) as f32 + 0.5);
                    (column - x).abs() <= reach && (row - y).abs() <= reach
                };
                let within = (0..texels.len()).filter(|index| is_within(*index));
                assert!(within.map(|index| texels[index].depth).all(|depth| depth <= bound));
            }
        }
    }
}
