//! Sample planes: the depth and visibility buffers of a tile for one sample per pixel.
//!
//! ```text
//!   tile 64 × 64 = 8 × 8 blocks          block = 8 rows of 8 pixels
//!   ┌──┬──┬──┬──┬──┬──┬──┬──┐            ┌─────────────────┐  row 0: one vector of 8 lanes
//!   │  │  │  │  │  │  │  │  │  ────────► │ · · · · · · · · │
//!   ├──┼──┼──┼ …                         │ …               │  row 7
//! ```
//!
//! Pixels are stored block by block: a row of a block is one vector, and the depths of a block fill
//! four cache lines.
//!
//! Hierarchical z (Greene, Kass and Miller 1993): each block has a farthest and a nearest bound,
//! which none of its samples exceeds. A triangle beyond the farthest bound is hidden in the whole
//! block; a triangle in front of the nearest bound hides the whole block and is written without a
//! depth test. The tile as a whole also has a farthest bound. Bounds may lag behind the samples,
//! but they always hold.

use crate::tile_grid::{TILE, TileRect};

/// The number of pixels in a tile.
pub(crate) const TILE_PIXELS: usize = (TILE * TILE) as usize;
/// The side of a block in pixels: the lanes of one vector.
pub(crate) const BLOCK_SIDE: usize = 8;
/// The number of blocks in each row of a tile.
pub(crate) const BLOCKS_PER_ROW: usize = TILE as usize / BLOCK_SIDE;
/// The triangle index of the background, which is larger than any other index.
pub(crate) const NO_TRIANGLE: u32 = u32::MAX;

/// The number of blocks that must come nearer before the tile's bound is recomputed.
const STALE_BLOCKS: u32 = 16;

/// Returns the array index of a pixel of the tile.
pub(crate) const fn pixel_index(x: usize, y: usize) -> usize {
    ((y / BLOCK_SIDE * BLOCKS_PER_ROW + x / BLOCK_SIDE) * BLOCK_SIDE + y % BLOCK_SIDE) * BLOCK_SIDE
        + x % BLOCK_SIDE
}

/// The depth and triangle index of one sample of every pixel of a tile.
///
/// The background is at depth −∞, so everything else is nearer.
#[derive(Debug)]
pub(crate) struct SamplePlane {
    /// The depth buffer.
    pub(crate) depth: Box<[f32; TILE_PIXELS]>,
    /// The visibility buffer: the index of the nearest triangle.
    pub(crate) triangle: Box<[u32; TILE_PIXELS]>,
    /// The farthest bound of each block: none of its samples is farther.
    pub(crate) block_farthest: [f32; BLOCKS_PER_ROW * BLOCKS_PER_ROW],
    /// The nearest bound of each block: none of its samples is nearer.
    pub(crate) block_nearest: [f32; BLOCKS_PER_ROW * BLOCKS_PER_ROW],
    /// The farthest bound of the tile: no sample is farther.
    tile_farthest: f32,
    /// The number of blocks that have come nearer since `tile_farthest` was computed.
    stale_blocks: u32,
}

impl SamplePlane {
    pub(crate) fn new() -> Self {
        Self {
            depth: Box::new([f32::NEG_INFINITY; TILE_PIXELS]),
            triangle: Box::new([NO_TRIANGLE; TILE_PIXELS]),
            block_farthest: [f32::NEG_INFINITY; BLOCKS_PER_ROW * BLOCKS_PER_ROW],
            block_nearest: [f32::NEG_INFINITY; BLOCKS_PER_ROW * BLOCKS_PER_ROW],
            tile_farthest: f32::NEG_INFINITY,
            stale_blocks: 0,
        }
    }

    /// Clears the plane to the background.
    ///
    /// Blocks outside the visible part of the tile get +∞ as their farthest bound. Everything in
    /// them is then hidden, so no work is done there, and they do not hold back the bound of the
    /// tile.
    pub(crate) fn clear(&mut self, visible: TileRect) {
        self.depth.fill(f32::NEG_INFINITY);
        self.triangle.fill(NO_TRIANGLE);
        self.block_nearest.fill(f32::NEG_INFINITY);
        self.block_farthest.fill(f32::INFINITY);
        let (first, end) = (visible.left as usize / 8, visible.right.div_ceil(8) as usize);
        for row in visible.top / 8..visible.bottom.div_ceil(8) {
            let row = &mut self.block_farthest[row as usize * BLOCKS_PER_ROW..];
            row[first..end].fill(f32::NEG_INFINITY);
        }
        (self.tile_farthest, self.stale_blocks) = (f32::NEG_INFINITY, 0);
    }

    /// Computes the bounds of the blocks in the visible part of the tile from its depths. Pixels of
    /// a block outside that part are at −∞ and hold back the block's farthest bound, which is safe.
    pub(crate) fn find_block_bounds(&mut self, visible: TileRect) {
        let columns = visible.left as usize / 8..visible.right.div_ceil(8) as usize;
        for row in visible.top as usize / 8..visible.bottom.div_ceil(8) as usize {
            for column in columns.clone() {
                let block = row * BLOCKS_PER_ROW + column;
                let depths = &self.depth[block * BLOCK_SIDE * BLOCK_SIDE..];
                let depths = &depths[..BLOCK_SIDE * BLOCK_SIDE];
                self.block_farthest[block] = depths.iter().copied().fold(f32::INFINITY, f32::min);
                self.block_nearest[block] =
                    depths.iter().copied().fold(f32::NEG_INFINITY, f32::max);
            }
        }
        self.tile_farthest = self.block_farthest.iter().copied().fold(f32::INFINITY, f32::min);
    }

    /// Returns the farthest bound of the tile: no sample is farther, so anything farther is hidden.
    pub(crate) fn tile_farthest(&self) -> f32 {
        self.tile_farthest
    }

    /// Counts blocks that have come nearer and updates the tile's bound after [`STALE_BLOCKS`] of
    /// them.
    ///
    /// Reducing sixty-four bounds to one after every block would cost more than it saves.
    #[inline(always)]
    pub(crate) fn count_nearer_blocks(&mut self, blocks: u32) {
        self.stale_blocks += blocks;
        if self.stale_blocks >= STALE_BLOCKS {
            self.stale_blocks = 0;
            let mut least = [f32::INFINITY; BLOCK_SIDE];
            // The minimum of 64 bounds, eight lanes at a time.
            for row in self.block_farthest.as_chunks::<BLOCK_SIDE>().0 {
                for (least, &farthest) in least.iter_mut().zip(row) {
                    *least = if farthest < *least { farthest } else { *least };
                }
            }
            self.tile_farthest = least.into_iter().fold(f32::INFINITY, f32::min);
        }
    }
}
