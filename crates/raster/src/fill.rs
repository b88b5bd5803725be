//! Filling a plane with triangles: the innermost loops, written for vectors.
//!
//! Eight blocks of a tile's row are sorted at once: which the triangle misses or lies behind, which it fills, which it fills and
//! hides. Only where an edge runs through a block are its pixels asked for their coverage.

use crate::plane::{BLOCKS, LANES, Plane};
use crate::setup::{Functions, Start};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, i32x8, mask32x8, u32x8};

/// Triangles that touch no more blocks than this are drawn block by block without sorting these first.
const FEW: i32 = 4;

/// Draws a solid triangle into all planes: where it is nearer than what is there, its depth and number take the place. `start`
/// tells where its functions start in a plane.
#[inline(always)]
pub(crate) fn fill<S: Simd>(
    simd: S,
    planes: &mut [Plane],
    lanes: &Lanes<S>,
    start: impl Fn(usize) -> Start,
    piece: u32,
) {
    let Functions { x0, y0, x1, y1, greatest, .. } = lanes.functions;
    let (columns, rows) = (x0 / 8..(x1 - 1) / 8 + 1, y0 / 8..(y1 - 1) / 8 + 1);
    if (columns.end - columns.start) * (rows.end - rows.start) > FEW {
        for (number, plane) in planes.iter_mut().enumerate() {
            let start = start(number);
            for row in rows.clone() {
                plane.fill_blocks(simd, lanes, &start, row, piece);
            }
        }
        return;
    }
    for block in blocks(&lanes.functions) {
        let along = lanes.depth_along(simd, block);
        for (number, plane) in planes.iter_mut().enumerate() {
            let start = start(number);
            if greatest > plane.farthest[block.number] && !lanes.misses(&start, block) {
                plane.fill_part(simd, lanes, &start, block, along, piece);
                let nearest = &mut plane.nearest[block.number];
                *nearest = larger(*nearest, greatest);
            }
        }
    }
}

impl Plane {
    /// Draws what of a large triangle lies in a row of blocks.
    #[inline(always)]
    fn fill_blocks<S: Simd>(
        &mut self,
        simd: S,
        lanes: &Lanes<S>,
        start: &Start,
        row: i32,
        piece: u32,
    ) {
        let first = row as usize * BLOCKS;
        let farthest = f32x8::from_slice(simd, &self.farthest[first..first + BLOCKS]);
        let nearest = f32x8::from_slice(simd, &self.nearest[first..first + BLOCKS]);
        let coverage = lanes.cover_blocks(simd, start, row);
        let DepthOfBlocks { least, greatest, flat } = lanes.depth_of_blocks(simd, start, row);
        let touched = coverage.touched & greatest.simd_gt(farthest);
        let full = touched & coverage.full & flat;
        let over = least.simd_gt(nearest);
        let higher = |new: f32x8<S>, old: f32x8<S>| new.simd_gt(old).select(new, old);
        let raised = full.select(higher(least, farthest), farthest);
        raised.store_slice(&mut self.farthest[first..first + BLOCKS]);
        let raised = touched.select(higher(greatest, nearest), nearest);
        raised.store_slice(&mut self.nearest[first..first + BLOCKS]);
        let (mut touched, full) = (touched.to_bitmask(), full.to_bitmask());
        let over = over.to_bitmask() & full;
        while touched != 0 {
            let column = touched.trailing_zeros();
            touched &= touched - 1;
            let block = Block::at(column as i32, row);
            if over >> column & 1 != 0 {
                self.cover_block(simd, lanes, start, block, piece);
            } else if full >> column & 1 != 0 {
                self.fill_block(simd, lanes, start, block, piece);
            } else {
                let along = lanes.depth_along(simd, block);
                self.fill_part(simd, lanes, start, block, along, piece);
                if lanes.bounds_hold(block) {
                    self.farthest[block.number] = self.least_of(simd, block);
                    self.came_nearer(1);
                }
            }
        }
        self.came_nearer(full.count_ones());
    }

    /// A block that the triangle fills, and is everywhere the nearest in.
    #[inline(always)]
    fn cover_block<S: Simd>(
        &mut self,
        simd: S,
        lanes: &Lanes<S>,
        start: &Start,
        block: Block,
        piece: u32,
    ) {
        let first = block.number * LANES * LANES;
        let along = lanes.depth_along(simd, block);
        let depths = &mut self.depth[first..first + LANES * LANES];
        for (row, depths) in depths.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
            (along + lanes.depth_at_row(simd, start, block, row)).store_slice(depths);
        }
        self.piece[first..first + LANES * LANES].fill(piece);
    }

    /// A block that the triangle fills.
    #[inline(always)]
    fn fill_block<S: Simd>(
        &mut self,
        simd: S,
        lanes: &Lanes<S>,
        start: &Start,
        block: Block,
        piece: u32,
    ) {
        let along = lanes.depth_along(simd, block);
        for row in 0..LANES {
            let depth = along + lanes.depth_at_row(simd, start, block, row);
            self.keep_nearer(simd, block, row, depth, None, piece);
        }
    }

    /// A block that an edge may run through; `along` is the depth along its columns.
    #[inline(always)]
    fn fill_part<S: Simd>(
        &mut self,
        simd: S,
        lanes: &Lanes<S>,
        start: &Start,
        block: Block,
        along: f32x8<S>,
        piece: u32,
    ) {
        let rows = lanes.rows(block);
        let mut edges = lanes.edges(simd, start, block, rows.start);
        for row in rows {
            let inside = (edges[0] | edges[1] | edges[2]).simd_ge(i32x8::splat(simd, 0));
            let depth = along + lanes.depth_at_row(simd, start, block, row);
            self.keep_nearer(simd, block, row, lanes.clamp(depth), Some(inside), piece);
            for (edge, step) in edges.iter_mut().zip(lanes.functions.b) {
                *edge += i32x8::splat(simd, step);
            }
        }
    }

    #[inline(always)]
    fn keep_nearer<S: Simd>(
        &mut self,
        simd: S,
        block: Block,
        row: usize,
        depth: f32x8<S>,
        inside: Option<mask32x8<S>>,
        piece: u32,
    ) {
        let first = (block.number * LANES + row) * LANES;
        let depths: &mut [f32] = &mut self.depth[first..first + LANES];
        let old = f32x8::from_slice(simd, depths);
        let nearer = depth.simd_gt(old);
        let seen = inside.map_or(nearer, |inside| inside & nearer);
        seen.select(depth, old).store_slice(depths);
        let pieces: &mut [u32] = &mut self.piece[first..first + LANES];
        let old = u32x8::from_slice(simd, pieces);
        seen.select(u32x8::splat(simd, piece), old).store_slice(pieces);
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
        let functions = &lanes.functions;
        for block in blocks(functions) {
            if functions.greatest < self.farthest[block.number] || lanes.misses(start, block) {
                continue;
            }
            let along = lanes.depth_along(simd, block);
            for row in lanes.rows(block) {
                let edges = lanes.edges(simd, start, block, row);
                let inside = (edges[0] | edges[1] | edges[2]).simd_ge(i32x8::splat(simd, 0));
                let depth = lanes.clamp(along + lanes.depth_at_row(simd, start, block, row));
                let first = (block.number * LANES + row) * LANES;
                let old = f32x8::from_slice(simd, &self.depth[first..first + LANES]);
                let nearer = if or_equal { depth.simd_ge(old) } else { depth.simd_gt(old) };
                let mut seen = (inside & nearer).to_bitmask();
                while seen != 0 {
                    let lane = seen.trailing_zeros() as usize;
                    seen &= seen - 1;
                    let (x, y) = (block.x as usize + lane, block.y as usize + row);
                    if (x as i32) < functions.x1 {
                        each(self, first + lane, x, y, depth[lane]);
                    }
                }
            }
        }
    }

    /// The depth of the farthest sample of a block.
    #[inline(always)]
    fn least_of<S: Simd>(&self, simd: S, block: Block) -> f32 {
        let depths = &self.depth[block.number * LANES * LANES..][..LANES * LANES];
        let mut least = f32x8::from_slice(simd, &depths[..LANES]);
        for row in depths[LANES..].chunks_exact(LANES) {
            let row = f32x8::from_slice(simd, row);
            least = row.simd_lt(least).select(row, least);
        }
        least.as_slice().iter().fold(f32::INFINITY, |a, &b| if b < a { b } else { a })
    }

    /// Puts a sample of a triangle into its place, whatever was there.
    pub(crate) fn put(&mut self, at: usize, depth: f32, piece: u32) {
        self.depth[at] = depth;
        self.piece[at] = piece;
        let nearest = &mut self.nearest[at / (LANES * LANES)];
        *nearest = larger(*nearest, depth);
    }
}

fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// A block: its number in the tile, and its upper left pixel.
#[derive(Clone, Copy)]
pub(crate) struct Block {
    number: usize,
    x: i32,
    y: i32,
}

impl Block {
    #[inline(always)]
    fn at(column: i32, row: i32) -> Self {
        Self { number: row as usize * BLOCKS + column as usize, x: column * 8, y: row * 8 }
    }
}

/// The blocks that a triangle's bounds touch.
#[inline(always)]
fn blocks(functions: &Functions) -> impl Iterator<Item = Block> + use<> {
    let (columns, rows) = (
        functions.x0 / 8..(functions.x1 - 1) / 8 + 1,
        functions.y0 / 8..(functions.y1 - 1) / 8 + 1,
    );
    rows.flat_map(move |row| columns.clone().map(move |column| Block::at(column, row)))
}

/// For the eight blocks of a row: whether a triangle may touch them, and whether it covers them whole.
struct BlockCoverage<S: Simd> {
    touched: mask32x8<S>,
    full: mask32x8<S>,
}

/// For the eight blocks of a row: the least and the greatest depth a triangle may have in them, and whether its plane stays
/// within the depths of its corners there.
struct DepthOfBlocks<S: Simd> {
    least: f32x8<S>,
    greatest: f32x8<S>,
    flat: mask32x8<S>,
}

/// A triangle's edges and depth for eight pixels of a row at once.
pub(crate) struct Lanes<S: Simd> {
    functions: Functions,
    /// 0 … 7.
    steps: i32x8<S>,
    /// What each edge grows by from the first of eight pixels to each.
    across: [i32x8<S>; 3],
    /// 0 … 7.
    iota: f32x8<S>,
    dx: f32x8<S>,
    least: f32x8<S>,
    greatest: f32x8<S>,
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, functions: &Functions) -> Self {
        let Functions { a, dx, least, greatest, .. } = *functions;
        let steps: i32x8<S> = [0, 1, 2, 3, 4, 5, 6, 7].simd_into(simd);
        Self {
            functions: *functions,
            steps,
            across: a.map(|a| steps * i32x8::splat(simd, a)),
            iota: [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0].simd_into(simd),
            dx: f32x8::splat(simd, dx),
            least: f32x8::splat(simd, least),
            greatest: f32x8::splat(simd, greatest),
        }
    }

    /// Edge k at a pixel.
    #[inline(always)]
    fn edge(&self, k: usize, start: &Start, x: i32, y: i32) -> i32 {
        start.e[k] + self.functions.a[k] * x + self.functions.b[k] * y
    }

    /// The edges at the eight pixels of a row of a block.
    #[inline(always)]
    fn edges(&self, simd: S, start: &Start, block: Block, row: usize) -> [i32x8<S>; 3] {
        let edge = |k: usize| {
            let first = self.edge(k, start, block.x, block.y + row as i32);
            self.across[k] + i32x8::splat(simd, first)
        };
        [edge(0), edge(1), edge(2)]
    }

    /// Whether an edge excludes the whole block: it excludes the corner that is farthest inside.
    #[inline(always)]
    fn misses(&self, start: &Start, block: Block) -> bool {
        (0..3).any(|k| {
            let innermost = 7 * (self.functions.a[k].max(0) + self.functions.b[k].max(0));
            self.edge(k, start, block.x, block.y) + innermost < 0
        })
    }

    /// The rows of a block that the bounds touch.
    #[inline(always)]
    fn rows(&self, block: Block) -> core::ops::Range<usize> {
        let first = (self.functions.y0 - block.y).max(0) as usize;
        let end = (self.functions.y1 - block.y).min(LANES as i32) as usize;
        first..end
    }

    /// Which of a row's blocks are touched: no edge excludes the corner that is farthest inside. Which are covered whole:
    /// no edge excludes the corner that is farthest outside.
    #[inline(always)]
    fn cover_blocks(&self, simd: S, start: &Start, row: i32) -> BlockCoverage<S> {
        let Functions { a, b, x0, x1, .. } = self.functions;
        let mut innermost = i32x8::splat(simd, 0);
        let mut outermost = i32x8::splat(simd, 0);
        for k in 0..3 {
            let first = i32x8::splat(simd, self.edge(k, start, 0, row * 8));
            let corner = self.steps * i32x8::splat(simd, 8 * a[k]) + first;
            innermost |= corner + i32x8::splat(simd, 7 * (a[k].max(0) + b[k].max(0)));
            outermost |= corner + i32x8::splat(simd, 7 * (a[k].min(0) + b[k].min(0)));
        }
        let zero = i32x8::splat(simd, 0);
        let after_first = self.steps.simd_ge(i32x8::splat(simd, x0 / 8));
        let to_last = self.steps.simd_le(i32x8::splat(simd, (x1 - 1) / 8));
        let full = outermost.simd_ge(zero);
        BlockCoverage { touched: innermost.simd_ge(zero) & after_first & to_last, full }
    }

    /// Bounds of the depth in a row's blocks: the depth at two opposite corners. Every step of its evaluation is monotone, so
    /// no sample between them is beyond.
    #[inline(always)]
    fn depth_of_blocks(&self, simd: S, start: &Start, row: i32) -> DepthOfBlocks<S> {
        let Functions { x0, y0, dx, dy, .. } = self.functions;
        let at_row = |y: i32| start.z + dy * (row * 8 + y - y0) as f32;
        let (lower, upper) = if dy < 0.0 { (7, 0) } else { (0, 7) };
        let (left, right) = if dx < 0.0 { (7, 0) } else { (0, 7) };
        let columns = self.iota * f32x8::splat(simd, 8.0);
        let at = |x: i32, y: i32| {
            let column = columns + f32x8::splat(simd, (x - x0) as f32);
            self.dx * column + f32x8::splat(simd, at_row(y))
        };
        let (least, greatest) = (at(left, lower), at(right, upper));
        let flat = least.simd_ge(self.least) & greatest.simd_le(self.greatest);
        DepthOfBlocks { least: self.clamp(least), greatest: self.clamp(greatest), flat }
    }

    /// The depth's first share, that of the columns of a block; the other is that of the row.
    #[inline(always)]
    fn depth_along(&self, simd: S, block: Block) -> f32x8<S> {
        self.dx * (self.iota + f32x8::splat(simd, (block.x - self.functions.x0) as f32))
    }

    #[inline(always)]
    fn depth_at_row(&self, simd: S, start: &Start, block: Block, row: usize) -> f32x8<S> {
        let y = block.y + row as i32 - self.functions.y0;
        f32x8::splat(simd, start.z + self.functions.dy * y as f32)
    }

    /// Depth cut off at the depths of the corners.
    #[inline(always)]
    fn clamp(&self, depth: f32x8<S>) -> f32x8<S> {
        let depth = depth.simd_lt(self.least).select(self.least, depth);
        depth.simd_gt(self.greatest).select(self.greatest, depth)
    }

    /// Whether the bounds hold the whole block, so that its farthest sample may have come nearer.
    #[inline(always)]
    fn bounds_hold(&self, block: Block) -> bool {
        let Functions { x0, y0, x1, y1, .. } = self.functions;
        x0 <= block.x && y0 <= block.y && x1 >= block.x + 8 && y1 >= block.y + 8
    }
}
