//! Depth and piece numbers of one sample of every pixel of a tile.
//!
//! Pixels are kept in blocks of 8 × 8, so that a row of a block is one vector and a block lies in four cache lines. For each block
//! the depth of its farthest sample is remembered: what is farther than that is hidden in the whole block (hierarchical
//! z). The memory may lag behind, for depths only grow, but it is never too near.

use crate::grid::TILE;
use crate::setup::{Setup, Start};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, i32x8, mask32x8, u32x8};

/// Pixels of a tile.
pub(crate) const AREA: usize = (TILE * TILE) as usize;
/// Pixels of a row of blocks, and of a block's side: one vector.
pub(crate) const LANES: usize = 8;
/// Blocks of a tile's row.
const BLOCKS: usize = TILE as usize / LANES;
/// No piece: the background.
pub(crate) const NOTHING: u32 = u32::MAX;

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
    farthest: [f32; BLOCKS * BLOCKS],
}

impl Plane {
    pub(crate) fn new() -> Self {
        Self {
            depth: Box::new([f32::NEG_INFINITY; AREA]),
            piece: Box::new([NOTHING; AREA]),
            farthest: [f32::NEG_INFINITY; BLOCKS * BLOCKS],
        }
    }

    /// Makes it empty again.
    pub(crate) fn clear(&mut self) {
        self.depth.fill(f32::NEG_INFINITY);
        self.piece.fill(NOTHING);
        self.farthest.fill(f32::NEG_INFINITY);
    }

    /// Draws a solid triangle: where it is nearer than what is there, its depth and number take the place.
    #[inline(always)]
    pub(crate) fn fill<S: Simd>(&mut self, simd: S, lanes: &Lanes<S>, start: &Start, piece: u32) {
        let number = u32x8::splat(simd, piece);
        let setup = &lanes.setup;
        for (block, place) in blocks(setup) {
            if setup.greatest <= self.farthest[block] || lanes.misses(start, place) {
                continue;
            }
            for row in lanes.rows(place) {
                let (inside, depth) = lanes.row(simd, start, place, row);
                let first = (block * LANES + row) * LANES;
                let depths: &mut [f32] = &mut self.depth[first..first + LANES];
                let old = f32x8::from_slice(simd, depths);
                let seen = inside & depth.simd_gt(old);
                if seen.any_true() {
                    seen.select(depth, old).store_slice(depths);
                    let pieces: &mut [u32] = &mut self.piece[first..first + LANES];
                    let old = u32x8::from_slice(simd, pieces);
                    seen.select(number, old).store_slice(pieces);
                }
            }
            if lanes.fills_most_of(place) {
                self.farthest[block] = self.least_of(simd, block);
            }
        }
    }

    /// Calls `each(array index, x, y, depth)` for every sample of the triangle that is nearer than what is there, or as near
    /// if `or_equal`.
    #[inline(always)]
    pub(crate) fn visit<S: Simd>(
        &mut self,
        simd: S,
        lanes: &Lanes<S>,
        start: &Start,
        or_equal: bool,
        mut each: impl FnMut(&mut Self, usize, usize, usize, f32),
    ) {
        let setup = &lanes.setup;
        for (block, place) in blocks(setup) {
            if setup.greatest < self.farthest[block] || lanes.misses(start, place) {
                continue;
            }
            for row in lanes.rows(place) {
                let (inside, depth) = lanes.row(simd, start, place, row);
                let first = (block * LANES + row) * LANES;
                let old = f32x8::from_slice(simd, &self.depth[first..first + LANES]);
                let nearer = if or_equal { depth.simd_ge(old) } else { depth.simd_gt(old) };
                let mut seen = (inside & nearer).to_bitmask();
                while seen != 0 {
                    let lane = seen.trailing_zeros() as usize;
                    seen &= seen - 1;
                    let (x, y) = (place.x as usize + lane, place.y as usize + row);
                    if (x as i32) < setup.x1 {
                        each(self, first + lane, x, y, depth[lane]);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn least_of<S: Simd>(&self, simd: S, block: usize) -> f32 {
        let depths = &self.depth[block * LANES * LANES..(block + 1) * LANES * LANES];
        let mut least = f32x8::from_slice(simd, &depths[..LANES]);
        for row in depths[LANES..].chunks_exact(LANES) {
            let row = f32x8::from_slice(simd, row);
            least = row.simd_lt(least).select(row, least);
        }
        least.as_slice().iter().fold(f32::INFINITY, |a, &b| if b < a { b } else { a })
    }
}

/// A block's upper left pixel.
#[derive(Clone, Copy)]
struct Place {
    x: i32,
    y: i32,
}

/// The blocks that a triangle's bounds touch, with their numbers.
#[inline(always)]
fn blocks(setup: &Setup) -> impl Iterator<Item = (usize, Place)> + use<> {
    let (columns, rows) =
        (setup.x0 / 8..(setup.x1 - 1) / 8 + 1, setup.y0 / 8..(setup.y1 - 1) / 8 + 1);
    rows.flat_map(move |row| {
        let columns = columns.clone();
        columns.map(move |column| {
            ((row * BLOCKS as i32 + column) as usize, Place { x: column * 8, y: row * 8 })
        })
    })
}

/// A triangle's edges and depth for eight pixels of a row at once.
pub(crate) struct Lanes<S: Simd> {
    setup: Setup,
    /// a·0 … a·7 for each edge.
    along: [i32x8<S>; 3],
    /// 0 … 7.
    iota: f32x8<S>,
    dx: f32x8<S>,
    least: f32x8<S>,
    greatest: f32x8<S>,
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, setup: &Setup) -> Self {
        let steps: i32x8<S> = [0, 1, 2, 3, 4, 5, 6, 7].simd_into(simd);
        let along = |a: i32| steps * i32x8::splat(simd, a);
        let Setup { dx, least, greatest, .. } = *setup;
        Self {
            setup: *setup,
            along: [along(setup.a[0]), along(setup.a[1]), along(setup.a[2])],
            iota: [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0].simd_into(simd),
            dx: f32x8::splat(simd, dx),
            least: f32x8::splat(simd, least),
            greatest: f32x8::splat(simd, greatest),
        }
    }

    /// Edge k at the upper left pixel of a block.
    #[inline(always)]
    fn edge(&self, k: usize, start: &Start, place: Place) -> i32 {
        start.e[k] + self.setup.a[k] * place.x + self.setup.b[k] * place.y
    }

    /// Whether an edge excludes the whole block: it excludes the corner that is farthest inside.
    #[inline(always)]
    fn misses(&self, start: &Start, place: Place) -> bool {
        (0..3).any(|k| {
            let innermost = 7 * (self.setup.a[k].max(0) + self.setup.b[k].max(0));
            self.edge(k, start, place) + innermost < 0
        })
    }

    /// The rows of a block that the bounds touch.
    #[inline(always)]
    fn rows(&self, place: Place) -> core::ops::Range<usize> {
        let first = (self.setup.y0 - place.y).max(0) as usize;
        let end = (self.setup.y1 - place.y).min(LANES as i32) as usize;
        first..end
    }

    /// Coverage and depth of a row of a block.
    #[inline(always)]
    fn row(&self, simd: S, start: &Start, place: Place, row: usize) -> (mask32x8<S>, f32x8<S>) {
        let down = row as i32;
        let edge = |k: usize| {
            let first = self.edge(k, start, place) + self.setup.b[k] * down;
            self.along[k] + i32x8::splat(simd, first)
        };
        // The sign bit of the union is set where any edge is negative.
        let inside = (edge(0) | edge(1) | edge(2)).simd_ge(i32x8::splat(simd, 0));
        let x = self.iota + f32x8::splat(simd, (place.x - self.setup.x0) as f32);
        let first = start.z + self.setup.dy * (place.y + down - self.setup.y0) as f32;
        let z = self.dx * x + f32x8::splat(simd, first);
        let z = z.simd_lt(self.least).select(self.least, z);
        (inside, z.simd_gt(self.greatest).select(self.greatest, z))
    }

    /// Whether the bounds hold so much of the block that its farthest sample may have come nearer.
    #[inline(always)]
    fn fills_most_of(&self, place: Place) -> bool {
        let Setup { x0, y0, x1, y1, .. } = self.setup;
        x0 <= place.x && y0 <= place.y && x1 >= place.x + 8 && y1 >= place.y + 8
    }
}
