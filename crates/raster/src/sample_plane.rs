//! Depth and piece numbers of one sample of every pixel of a tile.
//!
//! Pixels are kept in blocks of 8 × 8, so that a row of a block is one vector and a block lies in four cache lines. For each block
//! two bounds are kept: a depth that none of its samples is farther than, and one that none is nearer than (hierarchical z).
//! What is farther than the first is hidden in the whole block; what is nearer than the second hides it. For the first there is one of the
//! whole tile, too. The bounds may lag behind, but they always hold.

use crate::tile_grid::{TILE, TileRect};

/// Pixels of a tile.
pub(crate) const TILE_PIXELS: usize = (TILE * TILE) as usize;
/// Pixels of a row of blocks, and of a block's side: one vector.
pub(crate) const BLOCK_SIDE: usize = 8;
/// Blocks of a tile's row.
pub(crate) const BLOCKS_PER_ROW: usize = TILE as usize / BLOCK_SIDE;
/// No piece: the background.
pub(crate) const NO_TRIANGLE: u32 = u32::MAX;

/// The tile's bound is found anew after so many blocks have come nearer.
const STALE_BLOCKS: u32 = 16;

/// The place of a pixel of the tile in the arrays.
pub(crate) const fn pixel_index(x: usize, y: usize) -> usize {
    ((y / BLOCK_SIDE * BLOCKS_PER_ROW + x / BLOCK_SIDE) * BLOCK_SIDE + y % BLOCK_SIDE) * BLOCK_SIDE
        + x % BLOCK_SIDE
}

/// One sample of every pixel.
#[derive(Debug)]
pub(crate) struct SamplePlane {
    pub(crate) depth: Box<[f32; TILE_PIXELS]>,
    pub(crate) triangle: Box<[u32; TILE_PIXELS]>,
    /// For each block, a depth that no sample of it is farther than.
    pub(crate) block_farthest: [f32; BLOCKS_PER_ROW * BLOCKS_PER_ROW],
    /// For each block, a depth that no sample of it is nearer than.
    pub(crate) block_nearest: [f32; BLOCKS_PER_ROW * BLOCKS_PER_ROW],
    /// A depth that no sample of the tile is farther than.
    tile_farthest: f32,
    /// How many blocks have come nearer since that was found.
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

    /// Makes it empty again. Blocks outside of the shown part of the tile count as covered: nobody looks at them.
    pub(crate) fn clear(&mut self, shown: TileRect) {
        self.depth.fill(f32::NEG_INFINITY);
        self.triangle.fill(NO_TRIANGLE);
        self.block_nearest.fill(f32::NEG_INFINITY);
        self.block_farthest.fill(f32::INFINITY);
        let (columns, rows) =
            (shown.left / 8..shown.right.div_ceil(8), shown.top / 8..shown.bottom.div_ceil(8));
        for row in rows {
            let (first, end) = (columns.start as usize, columns.end as usize);
            self.block_farthest[row as usize * BLOCKS_PER_ROW..][first..end]
                .fill(f32::NEG_INFINITY);
        }
        (self.tile_farthest, self.stale_blocks) = (f32::NEG_INFINITY, 0);
    }

    /// A depth that no sample of the tile is farther than.
    pub(crate) fn tile_farthest(&self) -> f32 {
        self.tile_farthest
    }

    /// Takes note that so many blocks have come nearer.
    #[inline(always)]
    pub(crate) fn count_nearer_blocks(&mut self, blocks: u32) {
        self.stale_blocks += blocks;
        if self.stale_blocks >= STALE_BLOCKS {
            self.stale_blocks = 0;
            let mut least = [f32::INFINITY; BLOCK_SIDE];
            for row in self.block_farthest.as_chunks::<BLOCK_SIDE>().0 {
                for (least, &farthest) in least.iter_mut().zip(row) {
                    *least = if farthest < *least { farthest } else { *least };
                }
            }
            self.tile_farthest = least.into_iter().fold(f32::INFINITY, f32::min);
        }
    }
}
