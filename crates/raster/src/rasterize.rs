//! Filling a plane with triangles: the innermost loops, written for vectors.
//!
//! Eight blocks of a tile's row are sorted at once: which the triangle misses or lies behind, which it fills, which it fills and
//! hides. Only where an edge runs through a block are its pixels asked for their coverage.

use crate::sample_plane::{BLOCK_SIDE, BLOCKS_PER_ROW, SamplePlane};
use crate::triangle_setup::{SampleStart, TriangleFunctions};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, i32x8, mask32x8, u32x8};

/// Triangles that touch no more blocks than this are drawn block by block without sorting these first.
const FEW_BLOCKS: i32 = 4;

/// Draws a solid triangle into all planes: where it is nearer than what is there, its depth and number take the place. `start`
/// tells where its functions start in a plane.
#[inline(always)]
pub(crate) fn rasterize_triangle<S: Simd>(
    simd: S,
    planes: &mut [SamplePlane],
    lanes: &TriangleLanes<S>,
    start: impl Fn(usize) -> SampleStart,
    piece: u32,
) {
    let TriangleFunctions { x0, y0, x1, y1, max_depth: greatest, .. } = lanes.functions;
    let (columns, rows) = (x0 / 8..(x1 - 1) / 8 + 1, y0 / 8..(y1 - 1) / 8 + 1);
    if (columns.end - columns.start) * (rows.end - rows.start) > FEW_BLOCKS {
        for (number, plane) in planes.iter_mut().enumerate() {
            let start = start(number);
            for row in rows.clone() {
                plane.rasterize_block_row(simd, lanes, &start, row, piece);
            }
        }
        return;
    }
    for block in blocks_in_bounds(&lanes.functions) {
        let along = lanes.column_depths(simd, block);
        for (number, plane) in planes.iter_mut().enumerate() {
            let start = start(number);
            if greatest > plane.block_farthest[block.index] && !lanes.rejects_block(&start, block) {
                plane.rasterize_partial_block(simd, lanes, &start, block, along, piece);
                let nearest = &mut plane.block_nearest[block.index];
                *nearest = nearer_depth(*nearest, greatest);
            }
        }
    }
}

impl SamplePlane {
    /// Draws what of a large triangle lies in a row of blocks.
    #[inline(always)]
    fn rasterize_block_row<S: Simd>(
        &mut self,
        simd: S,
        lanes: &TriangleLanes<S>,
        start: &SampleStart,
        row: i32,
        piece: u32,
    ) {
        let first = row as usize * BLOCKS_PER_ROW;
        let farthest = f32x8::from_slice(simd, &self.block_farthest[first..first + BLOCKS_PER_ROW]);
        let nearest = f32x8::from_slice(simd, &self.block_nearest[first..first + BLOCKS_PER_ROW]);
        let coverage = lanes.classify_blocks(simd, start, row);
        let BlockDepths { min_depth: least, max_depth: greatest, is_unclamped: flat } =
            lanes.block_depth_bounds(simd, start, row);
        let touched = coverage.is_touched & greatest.simd_gt(farthest);
        let full = touched & coverage.is_full & flat;
        let over = least.simd_gt(nearest);
        let higher = |new: f32x8<S>, old: f32x8<S>| new.simd_gt(old).select(new, old);
        let raised = full.select(higher(least, farthest), farthest);
        raised.store_slice(&mut self.block_farthest[first..first + BLOCKS_PER_ROW]);
        let raised = touched.select(higher(greatest, nearest), nearest);
        raised.store_slice(&mut self.block_nearest[first..first + BLOCKS_PER_ROW]);
        let (mut touched, full) = (touched.to_bitmask(), full.to_bitmask());
        let over = over.to_bitmask() & full;
        while touched != 0 {
            let column = touched.trailing_zeros();
            touched &= touched - 1;
            let block = Block::from_column_row(column as i32, row);
            if over >> column & 1 != 0 {
                self.overwrite_block(simd, lanes, start, block, piece);
            } else if full >> column & 1 != 0 {
                self.depth_test_block(simd, lanes, start, block, piece);
            } else {
                let along = lanes.column_depths(simd, block);
                self.rasterize_partial_block(simd, lanes, start, block, along, piece);
                if lanes.bounds_contain(block) {
                    self.block_farthest[block.index] = self.farthest_in_block(simd, block);
                    self.count_nearer_blocks(1);
                }
            }
        }
        self.count_nearer_blocks(full.count_ones());
    }

    /// A block that the triangle fills, and is everywhere the nearest in.
    #[inline(always)]
    fn overwrite_block<S: Simd>(
        &mut self,
        simd: S,
        lanes: &TriangleLanes<S>,
        start: &SampleStart,
        block: Block,
        piece: u32,
    ) {
        let first = block.index * BLOCK_SIDE * BLOCK_SIDE;
        let along = lanes.column_depths(simd, block);
        let depths = &mut self.depth[first..first + BLOCK_SIDE * BLOCK_SIDE];
        for (row, depths) in depths.as_chunks_mut::<BLOCK_SIDE>().0.iter_mut().enumerate() {
            (along + lanes.row_depth(simd, start, block, row)).store_slice(depths);
        }
        self.triangle[first..first + BLOCK_SIDE * BLOCK_SIDE].fill(piece);
    }

    /// A block that the triangle fills.
    #[inline(always)]
    fn depth_test_block<S: Simd>(
        &mut self,
        simd: S,
        lanes: &TriangleLanes<S>,
        start: &SampleStart,
        block: Block,
        piece: u32,
    ) {
        let along = lanes.column_depths(simd, block);
        for row in 0..BLOCK_SIDE {
            let depth = along + lanes.row_depth(simd, start, block, row);
            self.depth_test_row(simd, block, row, depth, None, piece);
        }
    }

    /// A block that an edge may run through; `along` is the depth along its columns.
    #[inline(always)]
    fn rasterize_partial_block<S: Simd>(
        &mut self,
        simd: S,
        lanes: &TriangleLanes<S>,
        start: &SampleStart,
        block: Block,
        along: f32x8<S>,
        piece: u32,
    ) {
        let rows = lanes.rows_in_block(block);
        let mut edges = lanes.row_edge_values(simd, start, block, rows.start);
        for row in rows {
            let inside = (edges[0] | edges[1] | edges[2]).simd_ge(i32x8::splat(simd, 0));
            let depth = along + lanes.row_depth(simd, start, block, row);
            self.depth_test_row(simd, block, row, lanes.clamp_depth(depth), Some(inside), piece);
            for (edge, step) in edges.iter_mut().zip(lanes.functions.b) {
                *edge += i32x8::splat(simd, step);
            }
        }
    }

    #[inline(always)]
    fn depth_test_row<S: Simd>(
        &mut self,
        simd: S,
        block: Block,
        row: usize,
        depth: f32x8<S>,
        inside: Option<mask32x8<S>>,
        piece: u32,
    ) {
        let first = (block.index * BLOCK_SIDE + row) * BLOCK_SIDE;
        let depths: &mut [f32] = &mut self.depth[first..first + BLOCK_SIDE];
        let old = f32x8::from_slice(simd, depths);
        let nearer = depth.simd_gt(old);
        let seen = inside.map_or(nearer, |inside| inside & nearer);
        seen.select(depth, old).store_slice(depths);
        let pieces: &mut [u32] = &mut self.triangle[first..first + BLOCK_SIDE];
        let old = u32x8::from_slice(simd, pieces);
        seen.select(u32x8::splat(simd, piece), old).store_slice(pieces);
    }

    /// Calls `each(array index, x, y, depth)` for every sample of the triangle that is nearer than what is there, or as near
    /// if `or_equal`.
    #[inline(always)]
    pub(crate) fn visit_visible_samples<S: Simd>(
        &mut self,
        simd: S,
        lanes: &TriangleLanes<S>,
        start: &SampleStart,
        or_equal: bool,
        mut each: impl FnMut(&mut Self, usize, usize, usize, f32),
    ) {
        let functions = &lanes.functions;
        for block in blocks_in_bounds(functions) {
            if functions.max_depth < self.block_farthest[block.index]
                || lanes.rejects_block(start, block)
            {
                continue;
            }
            let along = lanes.column_depths(simd, block);
            for row in lanes.rows_in_block(block) {
                let edges = lanes.row_edge_values(simd, start, block, row);
                let inside = (edges[0] | edges[1] | edges[2]).simd_ge(i32x8::splat(simd, 0));
                let depth = lanes.clamp_depth(along + lanes.row_depth(simd, start, block, row));
                let first = (block.index * BLOCK_SIDE + row) * BLOCK_SIDE;
                let old = f32x8::from_slice(simd, &self.depth[first..first + BLOCK_SIDE]);
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
    fn farthest_in_block<S: Simd>(&self, simd: S, block: Block) -> f32 {
        let depths =
            &self.depth[block.index * BLOCK_SIDE * BLOCK_SIDE..][..BLOCK_SIDE * BLOCK_SIDE];
        let mut least = f32x8::from_slice(simd, &depths[..BLOCK_SIDE]);
        for row in depths[BLOCK_SIDE..].chunks_exact(BLOCK_SIDE) {
            let row = f32x8::from_slice(simd, row);
            least = row.simd_lt(least).select(row, least);
        }
        least.as_slice().iter().fold(f32::INFINITY, |a, &b| if b < a { b } else { a })
    }

    /// Puts a sample of a triangle into its place, whatever was there.
    pub(crate) fn write_sample(&mut self, at: usize, depth: f32, piece: u32) {
        self.depth[at] = depth;
        self.triangle[at] = piece;
        let nearest = &mut self.block_nearest[at / (BLOCK_SIDE * BLOCK_SIDE)];
        *nearest = nearer_depth(*nearest, depth);
    }
}

fn nearer_depth(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// A block: its number in the tile, and its upper left pixel.
#[derive(Clone, Copy)]
pub(crate) struct Block {
    index: usize,
    x: i32,
    y: i32,
}

impl Block {
    #[inline(always)]
    fn from_column_row(column: i32, row: i32) -> Self {
        Self { index: row as usize * BLOCKS_PER_ROW + column as usize, x: column * 8, y: row * 8 }
    }
}

/// The blocks that a triangle's bounds touch.
#[inline(always)]
fn blocks_in_bounds(functions: &TriangleFunctions) -> impl Iterator<Item = Block> + use<> {
    let (columns, rows) = (
        functions.x0 / 8..(functions.x1 - 1) / 8 + 1,
        functions.y0 / 8..(functions.y1 - 1) / 8 + 1,
    );
    rows.flat_map(move |row| columns.clone().map(move |column| Block::from_column_row(column, row)))
}

/// For the eight blocks of a row: whether a triangle may touch them, and whether it covers them whole.
struct BlockCoverage<S: Simd> {
    is_touched: mask32x8<S>,
    is_full: mask32x8<S>,
}

/// For the eight blocks of a row: the least and the greatest depth a triangle may have in them, and whether its plane stays
/// within the depths of its corners there.
struct BlockDepths<S: Simd> {
    min_depth: f32x8<S>,
    max_depth: f32x8<S>,
    is_unclamped: mask32x8<S>,
}

/// A triangle's edges and depth for eight pixels of a row at once.
pub(crate) struct TriangleLanes<S: Simd> {
    functions: TriangleFunctions,
    /// 0 … 7.
    lane_indices: i32x8<S>,
    /// What each edge grows by from the first of eight pixels to each.
    edge_steps: [i32x8<S>; 3],
    /// 0 … 7.
    lane_offsets: f32x8<S>,
    dx: f32x8<S>,
    min_depth: f32x8<S>,
    max_depth: f32x8<S>,
}

impl<S: Simd> TriangleLanes<S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, functions: &TriangleFunctions) -> Self {
        let TriangleFunctions { a, dx, min_depth: least, max_depth: greatest, .. } = *functions;
        let lane_indices: i32x8<S> = [0, 1, 2, 3, 4, 5, 6, 7].simd_into(simd);
        Self {
            functions: *functions,
            lane_indices,
            edge_steps: a.map(|a| lane_indices * i32x8::splat(simd, a)),
            lane_offsets: [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0].simd_into(simd),
            dx: f32x8::splat(simd, dx),
            min_depth: f32x8::splat(simd, least),
            max_depth: f32x8::splat(simd, greatest),
        }
    }

    /// Edge k at a pixel.
    #[inline(always)]
    fn edge_value(&self, k: usize, start: &SampleStart, x: i32, y: i32) -> i32 {
        start.edges[k] + self.functions.a[k] * x + self.functions.b[k] * y
    }

    /// The edges at the eight pixels of a row of a block.
    #[inline(always)]
    fn row_edge_values(
        &self,
        simd: S,
        start: &SampleStart,
        block: Block,
        row: usize,
    ) -> [i32x8<S>; 3] {
        let edge = |k: usize| {
            let first = self.edge_value(k, start, block.x, block.y + row as i32);
            self.edge_steps[k] + i32x8::splat(simd, first)
        };
        [edge(0), edge(1), edge(2)]
    }

    /// Whether an edge excludes the whole block: it excludes the corner that is farthest inside.
    #[inline(always)]
    fn rejects_block(&self, start: &SampleStart, block: Block) -> bool {
        (0..3).any(|k| {
            let innermost = 7 * (self.functions.a[k].max(0) + self.functions.b[k].max(0));
            self.edge_value(k, start, block.x, block.y) + innermost < 0
        })
    }

    /// The rows of a block that the bounds touch.
    #[inline(always)]
    fn rows_in_block(&self, block: Block) -> core::ops::Range<usize> {
        let first = (self.functions.y0 - block.y).max(0) as usize;
        let end = (self.functions.y1 - block.y).min(BLOCK_SIDE as i32) as usize;
        first..end
    }

    /// Which of a row's blocks are touched: no edge excludes the corner that is farthest inside. Which are covered whole:
    /// no edge excludes the corner that is farthest outside.
    #[inline(always)]
    fn classify_blocks(&self, simd: S, start: &SampleStart, row: i32) -> BlockCoverage<S> {
        let TriangleFunctions { a, b, x0, x1, .. } = self.functions;
        let mut innermost = i32x8::splat(simd, 0);
        let mut outermost = i32x8::splat(simd, 0);
        for k in 0..3 {
            let first = i32x8::splat(simd, self.edge_value(k, start, 0, row * 8));
            let corner = self.lane_indices * i32x8::splat(simd, 8 * a[k]) + first;
            innermost |= corner + i32x8::splat(simd, 7 * (a[k].max(0) + b[k].max(0)));
            outermost |= corner + i32x8::splat(simd, 7 * (a[k].min(0) + b[k].min(0)));
        }
        let zero = i32x8::splat(simd, 0);
        let after_first = self.lane_indices.simd_ge(i32x8::splat(simd, x0 / 8));
        let to_last = self.lane_indices.simd_le(i32x8::splat(simd, (x1 - 1) / 8));
        let full = outermost.simd_ge(zero);
        BlockCoverage { is_touched: innermost.simd_ge(zero) & after_first & to_last, is_full: full }
    }

    /// Bounds of the depth in a row's blocks: the depth at two opposite corners. Every step of its evaluation is monotone, so
    /// no sample between them is beyond.
    #[inline(always)]
    fn block_depth_bounds(&self, simd: S, start: &SampleStart, row: i32) -> BlockDepths<S> {
        let TriangleFunctions { x0, y0, dx, dy, .. } = self.functions;
        let at_row = |y: i32| start.z + dy * (row * 8 + y - y0) as f32;
        let (lower, upper) = if dy < 0.0 { (7, 0) } else { (0, 7) };
        let (left, right) = if dx < 0.0 { (7, 0) } else { (0, 7) };
        let columns = self.lane_offsets * f32x8::splat(simd, 8.0);
        let at = |x: i32, y: i32| {
            let column = columns + f32x8::splat(simd, (x - x0) as f32);
            self.dx * column + f32x8::splat(simd, at_row(y))
        };
        let (least, greatest) = (at(left, lower), at(right, upper));
        let flat = least.simd_ge(self.min_depth) & greatest.simd_le(self.max_depth);
        BlockDepths {
            min_depth: self.clamp_depth(least),
            max_depth: self.clamp_depth(greatest),
            is_unclamped: flat,
        }
    }

    /// The depth's first share, that of the columns of a block; the other is that of the row.
    #[inline(always)]
    fn column_depths(&self, simd: S, block: Block) -> f32x8<S> {
        self.dx * (self.lane_offsets + f32x8::splat(simd, (block.x - self.functions.x0) as f32))
    }

    #[inline(always)]
    fn row_depth(&self, simd: S, start: &SampleStart, block: Block, row: usize) -> f32x8<S> {
        let y = block.y + row as i32 - self.functions.y0;
        f32x8::splat(simd, start.z + self.functions.dy * y as f32)
    }

    /// Depth cut off at the depths of the corners.
    #[inline(always)]
    fn clamp_depth(&self, depth: f32x8<S>) -> f32x8<S> {
        let depth = depth.simd_lt(self.min_depth).select(self.min_depth, depth);
        depth.simd_gt(self.max_depth).select(self.max_depth, depth)
    }

    /// Whether the bounds hold the whole block, so that its farthest sample may have come nearer.
    #[inline(always)]
    fn bounds_contain(&self, block: Block) -> bool {
        let TriangleFunctions { x0, y0, x1, y1, .. } = self.functions;
        x0 <= block.x && y0 <= block.y && x1 >= block.x + 8 && y1 >= block.y + 8
    }
}
