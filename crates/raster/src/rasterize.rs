//! Rasterization of one triangle into a tile: coverage, depth test and hierarchical z, eight lanes
//! wide.
//!
//! ```text
//!   row of 8 blocks          each block of 8 × 8 pixels
//!   ┌──┬──┬──┬──┬──┬──┐      outside an edge, or behind every sample:  skipped
//!   │  │ ▄│██│██│▀ │  │      inside all edges, before every sample:    overwritten, no test
//!   └──┴──┴──┴──┴──┴──┘      inside all edges:                         depth test
//!                            an edge runs through:                     coverage and depth test
//! ```
//!
//! A sample is covered if none of the three edge functions is negative, and visible if it is also
//! strictly nearer than the depth buffer. Because the comparison is strict and triangles come in
//! submission order, the triangle that was submitted first wins depth ties.
//!
//! Eight blocks of a row are classified at once by the edge functions at their corners. For
//! triangles of a few blocks that does not pay, and they are drawn block by block.
//!
//! ```text
//!   E(x, y) = A x + B y + C                 edge function, ≥ 0 inside (Pineda 1988), 32 bits
//!   z(x, y) = z₀ + dz/dx · x + dz/dy · y    depth plane, larger is nearer
//! ```
//!
//! Both are linear, so their extremes over a block lie at its corners. That makes the tests of a
//! whole block exact for edges, and safe for depth.

use crate::sample_plane::{BLOCK_SIDE, BLOCKS_PER_ROW, SamplePlane};
use crate::triangle_setup::{SampleStart, TriangleFunctions};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, i32x8, mask32x8, u32x8};

/// Triangles that touch no more blocks than this are drawn block by block, without classification.
///
/// Classification costs the same for one block of a row as for eight.
const FEW_BLOCKS: i32 = 4;

/// Rasterizes an opaque triangle into all sample planes of a tile, with depth test and depth write.
///
/// `start` gives the start values of the triangle's functions in a plane.
///
/// Every plane holds one sample of each pixel. Small triangles go block by block through all
/// planes, large ones plane by plane through the rows of blocks.
#[inline(always)]
pub(crate) fn rasterize_triangle<S: Simd>(
    simd: S,
    planes: &mut [SamplePlane],
    lanes: &TriangleLanes<S>,
    start: impl Fn(usize) -> SampleStart,
    triangle: u32,
) {
    let TriangleFunctions { x0, y0, x1, y1, max_depth, .. } = lanes.functions;
    // The blocks under the bounding box.
    let (columns, rows) = (x0 / 8..(x1 - 1) / 8 + 1, y0 / 8..(y1 - 1) / 8 + 1);
    if (columns.end - columns.start) * (rows.end - rows.start) > FEW_BLOCKS {
        for (sample, plane) in planes.iter_mut().enumerate() {
            let start = start(sample);
            for row in rows.clone() {
                plane.rasterize_block_row(simd, lanes, &start, row, triangle);
            }
        }
        return;
    }
    for block in blocks_in_bounds(&lanes.functions) {
        // Depth along the columns does not depend on the sample: once for all planes.
        let columns = lanes.block_columns(simd, block);
        for (sample, plane) in planes.iter_mut().enumerate() {
            let start = start(sample);
            // Hierarchical z, then the block's corners against the edges.
            if max_depth > plane.block_farthest[block.index] && !lanes.rejects_block(&start, block)
            {
                plane.rasterize_partial_block(simd, lanes, &start, columns, triangle);
                let nearest = &mut plane.block_nearest[block.index];
                *nearest = nearer_depth(*nearest, max_depth);
            }
        }
    }
}

impl SamplePlane {
    /// Rasterizes the part of a large triangle that lies in one row of blocks.
    ///
    /// All eight blocks are classified and bounded by vector instructions; then only touched ones
    /// are visited, in the order of the bits of a mask. Bounds of the blocks are raised before
    /// their samples are written, by depths that hold for the samples to come.
    #[inline(always)]
    fn rasterize_block_row<S: Simd>(
        &mut self,
        simd: S,
        lanes: &TriangleLanes<S>,
        start: &SampleStart,
        row: i32,
        triangle: u32,
    ) {
        let first = row as usize * BLOCKS_PER_ROW;
        let end = first + BLOCKS_PER_ROW;
        let farthest = f32x8::from_slice(simd, &self.block_farthest[first..end]);
        let nearest = f32x8::from_slice(simd, &self.block_nearest[first..end]);
        // Edge functions at the corners of the eight blocks, and the depth plane's range in each.
        let coverage = lanes.classify_blocks(simd, start, row);
        let BlockDepths { min_depth, max_depth, is_unclamped } =
            lanes.block_depth_bounds(simd, start, row);
        // Hierarchical z: touched blocks are not hidden as a whole. Of the blocks that the triangle
        // fills, those that it is in front of everywhere need no depth test.
        let touched = coverage.is_touched & max_depth.simd_gt(farthest);
        let full = touched & coverage.is_full & is_unclamped;
        let in_front = min_depth.simd_gt(nearest);
        // Update the bounds: a full block is at least as near as the triangle's farthest point in
        // it.
        let nearer = |new: f32x8<S>, old: f32x8<S>| new.simd_gt(old).select(new, old);
        let raised = full.select(nearer(min_depth, farthest), farthest);
        raised.store_slice(&mut self.block_farthest[first..end]);
        let raised = touched.select(nearer(max_depth, nearest), nearest);
        raised.store_slice(&mut self.block_nearest[first..end]);
        let (mut touched, full) = (touched.to_bitmask(), full.to_bitmask());
        let in_front = in_front.to_bitmask() & full;
        // Visit the touched blocks by the set bits of the mask.
        while touched != 0 {
            let column = touched.trailing_zeros();
            touched &= touched - 1;
            let block = Block::from_column_row(column as i32, row);
            if in_front >> column & 1 != 0 {
                self.overwrite_block(simd, lanes, start, block, triangle);
            } else if full >> column & 1 != 0 {
                self.depth_test_block(simd, lanes, start, block, triangle);
            } else {
                let columns = lanes.block_columns(simd, block);
                self.rasterize_partial_block(simd, lanes, start, columns, triangle);
                // A partly covered block can only have come nearer as a whole if the triangle may
                // reach all of it; otherwise its 64 samples need not be reduced.
                if lanes.bounds_contain(block) {
                    self.block_farthest[block.index] = self.farthest_in_block(simd, block);
                    self.count_nearer_blocks(1);
                }
            }
        }
        self.count_nearer_blocks(full.count_ones());
    }

    /// Overwrites a block that the triangle fills, and is in front of everywhere.
    ///
    /// No coverage, no depth test and no clamping: a depth and an index are stored for each sample.
    /// This is the fastest path: a large triangle that is the first in a block, or in front of all
    /// before it.
    #[inline(always)]
    fn overwrite_block<S: Simd>(
        &mut self,
        simd: S,
        lanes: &TriangleLanes<S>,
        start: &SampleStart,
        block: Block,
        triangle: u32,
    ) {
        let first = block.index * BLOCK_SIDE * BLOCK_SIDE;
        let columns = lanes.block_columns(simd, block);
        let depths = &mut self.depth[first..first + BLOCK_SIDE * BLOCK_SIDE];
        // The depth plane, a row of eight at a time.
        for (row, depths) in depths.as_chunks_mut::<BLOCK_SIDE>().0.iter_mut().enumerate() {
            (columns.depths + lanes.row_depth(simd, start, block, row)).store_slice(depths);
        }
        self.triangle[first..first + BLOCK_SIDE * BLOCK_SIDE].fill(triangle);
    }

    /// Rasterizes a block that the triangle fills: depth test only.
    ///
    /// The depth plane stays within the vertices' depths over the block, so it needs no clamping.
    #[inline(always)]
    fn depth_test_block<S: Simd>(
        &mut self,
        simd: S,
        lanes: &TriangleLanes<S>,
        start: &SampleStart,
        block: Block,
        triangle: u32,
    ) {
        let columns = lanes.block_columns(simd, block);
        for row in 0..BLOCK_SIDE {
            let depth = columns.depths + lanes.row_depth(simd, start, block, row);
            self.depth_test_row(simd, block.row_index(row), depth, None, triangle);
        }
    }

    /// Rasterizes a block that an edge may run through: coverage and depth test of each sample.
    ///
    /// Depth is clamped to the vertices' depths: on a steep sliver rounding alone may carry a
    /// sample out of their range.
    #[inline(always)]
    fn rasterize_partial_block<S: Simd>(
        &mut self,
        simd: S,
        lanes: &TriangleLanes<S>,
        start: &SampleStart,
        BlockColumns { block, depths }: BlockColumns<S>,
        triangle: u32,
    ) {
        let rows = lanes.rows_in_block(block);
        let mut edges = lanes.row_edge_values(simd, start, block, rows.start);
        for row in rows {
            // Coverage: the sign bits of the three edge functions together. All are clear inside.
            let covered = (edges[0] | edges[1] | edges[2]).simd_ge(i32x8::splat(simd, 0));
            let depth = lanes.clamp_depth(depths + lanes.row_depth(simd, start, block, row));
            self.depth_test_row(simd, block.row_index(row), depth, Some(covered), triangle);
            // Edge functions are linear: the next row is one addition away.
            for (edge, step) in edges.iter_mut().zip(lanes.functions.b) {
                *edge += i32x8::splat(simd, step);
            }
        }
    }

    /// Depth test and depth write for eight samples of a row, from array index `first` on.
    ///
    /// The test is strict: at equal depth the triangle that is there stays, which was submitted
    /// earlier.
    #[inline(always)]
    fn depth_test_row<S: Simd>(
        &mut self,
        simd: S,
        first: usize,
        depth: f32x8<S>,
        covered: Option<mask32x8<S>>,
        triangle: u32,
    ) {
        let depths: &mut [f32] = &mut self.depth[first..first + BLOCK_SIDE];
        let old = f32x8::from_slice(simd, depths);
        // Depth test. A depth tie fails the comparison: the triangle drawn first stays.
        let nearer = depth.simd_gt(old);
        let visible = covered.map_or(nearer, |covered| covered & nearer);
        // Both stores are unconditional: lanes that fail the test write back what was there.
        visible.select(depth, old).store_slice(depths);
        let triangles: &mut [u32] = &mut self.triangle[first..first + BLOCK_SIDE];
        let old = u32x8::from_slice(simd, triangles);
        visible.select(u32x8::splat(simd, triangle), old).store_slice(triangles);
    }

    /// Calls `each(array index, x, y, depth)` for every covered sample that passes the depth test.
    ///
    /// Nothing is written: for masked triangles, whose alpha test comes in between, and translucent
    /// ones. The test is strict unless `or_equal`.
    ///
    /// `each` may write to the plane: the depth test of a row is done before its samples are
    /// visited, and no sample is visited twice.
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
            let columns = lanes.block_columns(simd, block);
            for row in lanes.rows_in_block(block) {
                let edges = lanes.row_edge_values(simd, start, block, row);
                let covered = (edges[0] | edges[1] | edges[2]).simd_ge(i32x8::splat(simd, 0));
                let row_depth = lanes.row_depth(simd, start, block, row);
                let depth = lanes.clamp_depth(columns.depths + row_depth);
                let first = block.row_index(row);
                let old = f32x8::from_slice(simd, &self.depth[first..first + BLOCK_SIDE]);
                let nearer = if or_equal { depth.simd_ge(old) } else { depth.simd_gt(old) };
                let mut visible = (covered & nearer).to_bitmask();
                while visible != 0 {
                    let lane = visible.trailing_zeros() as usize;
                    visible &= visible - 1;
                    let (x, y) = (block.x as usize + lane, block.y as usize + row);
                    // The vector may reach beyond the visible region's right border.
                    if (x as i32) < functions.x1 {
                        each(self, first + lane, x, y, depth[lane]);
                    }
                }
            }
        }
    }

    /// The depth of the farthest sample of a block.
    ///
    /// 64 depths: eight vectors are reduced to one, then eight lanes to a number.
    #[inline(always)]
    fn farthest_in_block<S: Simd>(&self, simd: S, block: Block) -> f32 {
        let first = block.index * BLOCK_SIDE * BLOCK_SIDE;
        let depths = &self.depth[first..][..BLOCK_SIDE * BLOCK_SIDE];
        let mut least = f32x8::from_slice(simd, &depths[..BLOCK_SIDE]);
        for row in depths[BLOCK_SIDE..].chunks_exact(BLOCK_SIDE) {
            let row = f32x8::from_slice(simd, row);
            least = row.simd_lt(least).select(row, least);
        }
        least.as_slice().iter().fold(f32::INFINITY, |a, &b| if b < a { b } else { a })
    }

    /// Writes depth and triangle of one sample, without a test.
    ///
    /// The block's nearest bound is raised with it; its farthest bound stays, which is safe.
    pub(crate) fn write_sample(&mut self, index: usize, depth: f32, triangle: u32) {
        self.depth[index] = depth;
        self.triangle[index] = triangle;
        let nearest = &mut self.block_nearest[index / (BLOCK_SIDE * BLOCK_SIDE)];
        *nearest = nearer_depth(*nearest, depth);
    }
}

/// The nearer of two depths, neither of them NaN: one comparison, where `f32::max` takes more.
fn nearer_depth(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// A block of 8 × 8 pixels: its index in the tile, and its upper left pixel.
#[derive(Clone, Copy)]
pub(crate) struct Block {
    /// The index of the block in the tile, row by row: 0 … 63.
    index: usize,
    /// The column of the upper left pixel in the tile.
    x: i32,
    /// The row of the upper left pixel in the tile.
    y: i32,
}

impl Block {
    /// The block in a column and a row of blocks of the tile.
    #[inline(always)]
    fn from_column_row(column: i32, row: i32) -> Self {
        Self { index: row as usize * BLOCKS_PER_ROW + column as usize, x: column * 8, y: row * 8 }
    }

    /// The array index of the first pixel of one of the block's rows.
    #[inline(always)]
    fn row_index(self, row: usize) -> usize {
        (self.index * BLOCK_SIDE + row) * BLOCK_SIDE
    }
}

/// A block, and the part of the depth that depends on its columns: dx·x for each of the eight.
#[derive(Clone, Copy)]
struct BlockColumns<S: Simd> {
    block: Block,
    depths: f32x8<S>,
}

/// The blocks that a triangle's bounds touch, row by row.
#[inline(always)]
fn blocks_in_bounds(functions: &TriangleFunctions) -> impl Iterator<Item = Block> + use<> {
    let (columns, rows) = (
        functions.x0 / 8..(functions.x1 - 1) / 8 + 1,
        functions.y0 / 8..(functions.y1 - 1) / 8 + 1,
    );
    rows.flat_map(move |row| columns.clone().map(move |column| Block::from_column_row(column, row)))
}

/// The coverage of the eight blocks of a row.
struct BlockCoverage<S: Simd> {
    /// Whether the triangle may touch the block (conservative).
    is_touched: mask32x8<S>,
    /// Whether the triangle covers every sample of the block.
    is_full: mask32x8<S>,
}

/// Bounds of a triangle's depth in the eight blocks of a row.
struct BlockDepths<S: Simd> {
    /// The least depth in each block, not below the farthest vertex.
    min_depth: f32x8<S>,
    /// The greatest depth in each block, not above the nearest vertex.
    max_depth: f32x8<S>,
    /// Whether the depth plane stays within the depths of the vertices: no sample needs clamping.
    is_unclamped: mask32x8<S>,
}

/// A triangle's edge functions and depth plane for eight pixels of a row at once.
pub(crate) struct TriangleLanes<S: Simd> {
    functions: TriangleFunctions,
    /// 0 … 7.
    lane_indices: i32x8<S>,
    /// The change of each edge function from the first of eight pixels to each.
    edge_steps: [i32x8<S>; 3],
    /// 0.0 … 7.0.
    lane_offsets: f32x8<S>,
    /// The change of depth per pixel to the right, in all lanes.
    dx: f32x8<S>,
    /// The depth of the farthest vertex, in all lanes.
    min_depth: f32x8<S>,
    /// The depth of the nearest vertex, in all lanes.
    max_depth: f32x8<S>,
}

impl<S: Simd> TriangleLanes<S> {
    /// Spreads the functions of a triangle over eight lanes, for all planes alike.
    #[inline(always)]
    pub(crate) fn new(simd: S, functions: &TriangleFunctions) -> Self {
        let TriangleFunctions { a, dx, min_depth, max_depth, .. } = *functions;
        let lane_indices: i32x8<S> = [0, 1, 2, 3, 4, 5, 6, 7].simd_into(simd);
        Self {
            functions: *functions,
            lane_indices,
            edge_steps: a.map(|a| lane_indices * i32x8::splat(simd, a)),
            lane_offsets: [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0].simd_into(simd),
            dx: f32x8::splat(simd, dx),
            min_depth: f32x8::splat(simd, min_depth),
            max_depth: f32x8::splat(simd, max_depth),
        }
    }

    /// Edge function k at a pixel: E₀ + a·x + b·y.
    ///
    /// In 32 bits: E₀ is clamped to ±2³⁰ and changes by less than 2³⁰ across a tile, so nothing
    /// overflows and the sign is right.
    #[inline(always)]
    fn edge_value(&self, k: usize, start: &SampleStart, x: i32, y: i32) -> i32 {
        start.edges[k] + self.functions.a[k] * x + self.functions.b[k] * y
    }

    /// The edge functions at the eight pixels of a block's row.
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

    /// Whether an edge excludes the whole block: its function is negative even at the innermost
    /// corner.
    ///
    /// Of a linear function over a square the greatest value is at one corner, which the signs of A
    /// and B give: seven pixels to the right if A > 0, seven down if B > 0.
    #[inline(always)]
    fn rejects_block(&self, start: &SampleStart, block: Block) -> bool {
        (0..3).any(|k| {
            let to_innermost = 7 * (self.functions.a[k].max(0) + self.functions.b[k].max(0));
            self.edge_value(k, start, block.x, block.y) + to_innermost < 0
        })
    }

    /// The rows of a block that the triangle's bounds touch.
    #[inline(always)]
    fn rows_in_block(&self, block: Block) -> core::ops::Range<usize> {
        let first = (self.functions.y0 - block.y).max(0) as usize;
        let end = (self.functions.y1 - block.y).min(BLOCK_SIDE as i32) as usize;
        first..end
    }

    /// Classifies the eight blocks of a row by the edge functions at their corners.
    ///
    /// A block is touched if no edge excludes its innermost corner, and full if no edge excludes
    /// its outermost corner.
    ///
    /// The sign bits of the three edges are combined by "or": a set bit means that some edge
    /// excludes the corner.
    #[inline(always)]
    fn classify_blocks(&self, simd: S, start: &SampleStart, row: i32) -> BlockCoverage<S> {
        let TriangleFunctions { a, b, x0, x1, .. } = self.functions;
        let mut innermost = i32x8::splat(simd, 0);
        let mut outermost = i32x8::splat(simd, 0);
        for k in 0..3 {
            let first = i32x8::splat(simd, self.edge_value(k, start, 0, row * 8));
            // E at the upper left sample of each block, then at the corner with the greatest and at
            // that with the least value.
            let corner = self.lane_indices * i32x8::splat(simd, 8 * a[k]) + first;
            innermost |= corner + i32x8::splat(simd, 7 * (a[k].max(0) + b[k].max(0)));
            outermost |= corner + i32x8::splat(simd, 7 * (a[k].min(0) + b[k].min(0)));
        }
        let zero = i32x8::splat(simd, 0);
        // Blocks beside the bounding box: an edge alone does not exclude them behind a sharp
        // vertex.
        let after_first = self.lane_indices.simd_ge(i32x8::splat(simd, x0 / 8));
        let to_last = self.lane_indices.simd_le(i32x8::splat(simd, (x1 - 1) / 8));
        let is_full = outermost.simd_ge(zero);
        BlockCoverage { is_touched: innermost.simd_ge(zero) & after_first & to_last, is_full }
    }

    /// Bounds of the depth in the eight blocks of a row: the depth at two opposite corners of each.
    ///
    /// Every operation of its evaluation is monotone, rounding included, so no sample between them
    /// is beyond.
    #[inline(always)]
    fn block_depth_bounds(&self, simd: S, start: &SampleStart, row: i32) -> BlockDepths<S> {
        let TriangleFunctions { x0, y0, dx, dy, .. } = self.functions;
        let at_row = |y: i32| start.z + dy * (row * 8 + y - y0) as f32;
        // The corner in the direction in which depth falls, and the one in which it rises.
        let (lower, upper) = if dy < 0.0 { (7, 0) } else { (0, 7) };
        let (left, right) = if dx < 0.0 { (7, 0) } else { (0, 7) };
        // The first column of each block.
        let columns = self.lane_offsets * f32x8::splat(simd, 8.0);
        let at = |x: i32, y: i32| {
            let column = columns + f32x8::splat(simd, (x - x0) as f32);
            self.dx * column + f32x8::splat(simd, at_row(y))
        };
        let (least, greatest) = (at(left, lower), at(right, upper));
        let is_unclamped = least.simd_ge(self.min_depth) & greatest.simd_le(self.max_depth);
        BlockDepths {
            min_depth: self.clamp_depth(least),
            max_depth: self.clamp_depth(greatest),
            is_unclamped,
        }
    }

    /// A block with the first term of its depth, dx·x; the other is [`row_depth`](Self::row_depth).
    #[inline(always)]
    fn block_columns(&self, simd: S, block: Block) -> BlockColumns<S> {
        let x = self.lane_offsets + f32x8::splat(simd, (block.x - self.functions.x0) as f32);
        BlockColumns { block, depths: self.dx * x }
    }

    /// The second term of the depth in a block's row: z + dy·y.
    ///
    /// Added to the first in this order everywhere, so that a sample has the same bits on every
    /// path.
    #[inline(always)]
    fn row_depth(&self, simd: S, start: &SampleStart, block: Block, row: usize) -> f32x8<S> {
        let y = block.y + row as i32 - self.functions.y0;
        f32x8::splat(simd, start.z + self.functions.dy * y as f32)
    }

    /// Depth clamped to the depths of the vertices.
    #[inline(always)]
    fn clamp_depth(&self, depth: f32x8<S>) -> f32x8<S> {
        let depth = depth.simd_lt(self.min_depth).select(self.min_depth, depth);
        depth.simd_gt(self.max_depth).select(self.max_depth, depth)
    }

    /// Whether the triangle's bounds contain the whole block, so that its farthest sample may have
    /// come nearer.
    ///
    /// Conservative: the triangle itself may leave out a corner, and the bound is then computed in
    /// vain.
    #[inline(always)]
    fn bounds_contain(&self, block: Block) -> bool {
        let TriangleFunctions { x0, y0, x1, y1, .. } = self.functions;
        x0 <= block.x && y0 <= block.y && x1 >= block.x + 8 && y1 >= block.y + 8
    }
}
