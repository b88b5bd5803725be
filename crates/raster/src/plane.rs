//! Depth and piece numbers of one sample of every pixel of a tile.
//!
//! Pixels are kept in blocks of 8 × 8, so that a row of a block is one vector and a block lies in four cache lines. For each block
//! two bounds are kept: a depth that none of its samples is farther than, and one that none is nearer than (hierarchical z).
//! What is farther than the first is hidden in the whole block; what is nearer than the second hides it. For the first there is one of the
//! whole tile, too. The bounds may lag behind, but they always hold.

use crate::grid::{TILE, TileRect};

/// Pixels of a tile.
pub(crate) const AREA: usize = (TILE * TILE) as usize;
/// Pixels of a row of blocks, and of a block's side: one vector.
pub(crate) const LANES: usize = 8;
/// Blocks of a tile's row.
pub(crate) const BLOCKS: usize = TILE as usize / LANES;
/// No piece: the background.
pub(crate) const NOTHING: u32 = u32::MAX;

/// The tile's bound is found anew after so many blocks have come nearer.
const STALE: u32 = 16;

/// The place of a pixel of the tile in the arrays.
pub(crate) const fn index_of(x: usize, y: usize) -> usize {
    ((y / LANES * BLOCKS + x / LANES) * LANES + y % LANES) * LANES + x % LANES
}

/// One sample of every pixel.
#[derive(Debug)]
pub(crate) struct Plane {
    pub(crate) depth: Box<[f32; AREA]>,
    pub(crate) piece: Box<[u32; AREA]>,
    /// For each block, a depth that no sample of it is farther than.
    pub(crate) farthest: [f32; BLOCKS * BLOCKS],
    /// For each block, a depth that no sample of it is nearer than.
    pub(crate) nearest: [f32; BLOCKS * BLOCKS],
    /// A depth that no sample of the tile is farther than.
    farthest_of_all: f32,
    /// How many blocks have come nearer since that was found.
    stale: u32,
}

impl Plane {
    pub(crate) fn new() -> Self {
        Self {
            depth: Box::new([f32::NEG_INFINITY; AREA]),
            piece: Box::new([NOTHING; AREA]),
            farthest: [f32::NEG_INFINITY; BLOCKS * BLOCKS],
            nearest: [f32::NEG_INFINITY; BLOCKS * BLOCKS],
            farthest_of_all: f32::NEG_INFINITY,
            stale: 0,
        }
    }

    /// Makes it empty again. Blocks outside of the shown part of the tile count as covered: nobody looks at them.
    pub(crate) fn clear(&mut self, shown: TileRect) {
        self.depth.fill(f32::NEG_INFINITY);
        self.piece.fill(NOTHING);
        self.nearest.fill(f32::NEG_INFINITY);
        self.farthest.fill(f32::INFINITY);
        let (columns, rows) =
            (shown.left / 8..shown.right.div_ceil(8), shown.top / 8..shown.bottom.div_ceil(8));
        for row in rows {
            let (first, end) = (columns.start as usize, columns.end as usize);
            self.farthest[row as usize * BLOCKS..][first..end].fill(f32::NEG_INFINITY);
        }
        (self.farthest_of_all, self.stale) = (f32::NEG_INFINITY, 0);
    }

    /// A depth that no sample of the tile is farther than.
    pub(crate) fn farthest_of_all(&self) -> f32 {
        self.farthest_of_all
    }

    /// Takes note that so many blocks have come nearer.
    #[inline(always)]
    pub(crate) fn came_nearer(&mut self, blocks: u32) {
        self.stale += blocks;
        if self.stale >= STALE {
            self.stale = 0;
            let mut least = [f32::INFINITY; LANES];
            for row in self.farthest.as_chunks::<LANES>().0 {
                for (least, &farthest) in least.iter_mut().zip(row) {
                    *least = if farthest < *least { farthest } else { *least };
                }
            }
            self.farthest_of_all = least.into_iter().fold(f32::INFINITY, f32::min);
        }
    }
}
