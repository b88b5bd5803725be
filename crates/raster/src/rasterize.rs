//! Rasterization of one triangle into a tile: coverage, depth test and hierarchical z, eight lanes
//! wide.
//!
//! ```text
//!   row of 8 blocks          each block of 8 × 8 pixels
//!   ┌──┬──┬──┬──┬──┬──┐      outside an edge, or behind all samples:     skipped
//!   │  │ ▄│██│██│▀ │  │      inside all edges, in front of all samples:  overwritten, no test
//!   └──┴──┴──┴──┴──┴──┘      inside all edges otherwise:                 depth test
//!                            crossed by an edge:                         coverage and depth test
//! ```
//!
//! A sample is covered if none of the three edge functions is negative, and visible if it is also
//! strictly nearer than the depth buffer. Because the comparison is strict and triangles are drawn
//! in submission order, the triangle submitted first wins depth ties.
//!
//! Eight blocks of a row are classified at once by the edge functions at their corners. For
//! triangles that touch few blocks, this does not pay off, so they are drawn block by block.
//!
//! ```text
//!   E(x, y) = A x + B y + C                 edge function, ≥ 0 inside (Pineda 1988), 32 bits
//!   z(x, y) = z₀ + dz/dx · x + dz/dy · y    depth plane, larger is nearer
//! ```
//!
//! Both are linear, so their extremes over a block are at its corners. This makes block tests exact
//! for edges and conservative for depth.

mod triangle_lanes;

use crate::DepthCompare;
use crate::sample_plane::{BLOCK_SIDE, BLOCKS_PER_ROW, SamplePlane};
use crate::triangle_setup::{SampleStart, TriangleFunctions};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, i32x8, mask32x8, u32x8};
pub(crate) use triangle_lanes::TriangleLanes;
use triangle_lanes::{Block, BlockColumns, BlockDepths, blocks_in_bounds};

/// Triangles that touch at most this many blocks are drawn block by block, without classification.
///
/// Classification costs the same for one block of a row as for eight.
const FEW_BLOCKS: i32 = 4;

/// Rasterizes an opaque triangle into all sample planes of a tile, with depth test and depth write.
///
/// `start` returns the start values of the triangle's functions in a plane.
///
/// Every plane contains one sample of each pixel. Small triangles are drawn block by block in all
/// planes, and large ones plane by plane along the rows of blocks.
#[inline(always)]
pub(crate) fn rasterize_triangle<S: Simd>(
    simd: S,
    planes: &mut [SamplePlane],
    lanes: &TriangleLanes<S>,
    start: impl Fn(usize) -> SampleStart,
    triangle: u32,
) {
    let TriangleFunctions { x0, y0, x1, y1, max_depth, .. } = lanes.functions;
    // The blocks that the bounding box touches.
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
        // The column term of depth does not depend on the sample: compute it once for all planes.
        let columns = lanes.block_columns(simd, block);
        for (sample, plane) in planes.iter_mut().enumerate() {
            let start = start(sample);
            // Test hierarchical z, then the corners of the block against the edges.
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
    /// Rasterizes the part of a large triangle in one row of blocks.
    ///
    /// All eight blocks are classified and bounded by vector instructions; then only touched blocks
    /// are visited, in the bit order of a mask. Before the samples of a block are written, its
    /// bounds are raised to fit them.
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
        // Hierarchical z: touched blocks that are not completely hidden. A block needs no depth
        // test if the triangle fills it and is completely in front of it.
        let touched = coverage.is_touched & max_depth.simd_gt(farthest);
        let full = touched & coverage.is_full & is_unclamped;
        let in_front = min_depth.simd_gt(nearest);
        // Update the bounds: a full block is at least as near as the farthest point of the triangle
        // in it.
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
                // A partly covered block can come nearer as a whole only if the triangle may reach
                // all of it; otherwise its 64 samples need not be reduced.
                if lanes.bounds_contain(block) {
                    self.block_farthest[block.index] = self.farthest_in_block(simd, block);
                    self.count_nearer_blocks(1);
                }
            }
        }
        self.count_nearer_blocks(full.count_ones());
    }

    /// Overwrites a block that the triangle fills and hides completely.
    ///
    /// There is no coverage test, depth test or clamping: a depth and an index are stored for each
    /// sample. This is the fastest path, for a large triangle that is the first in a block or in
    /// front of all earlier ones.
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

    /// Rasterizes a block that the triangle fills: only the depth test is needed.
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

    /// Rasterizes a block that an edge may cross: coverage and depth test of each sample.
    ///
    /// Depth is clamped to the depths of the vertices, because on a steep sliver, rounding may move
    /// a sample's depth out of their range.
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
            // Coverage: the combined sign bits of the three edge functions. All are clear inside.
            let covered = (edges[0] | edges[1] | edges[2]).simd_ge(i32x8::splat(simd, 0));
            let depth = lanes.clamp_depth(depths + lanes.row_depth(simd, start, block, row));
            self.depth_test_row(simd, block.row_index(row), depth, Some(covered), triangle);
            // Edge functions are linear: the next row is one addition away.
            for (edge, step) in edges.iter_mut().zip(lanes.functions.b) {
                *edge += i32x8::splat(simd, step);
            }
        }
    }

    /// Depth-tests and writes eight samples of a row, starting at array index `first`.
    ///
    /// The test is strict: at equal depth, the stored triangle, which was submitted earlier, wins.
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
        // Depth test. A depth tie fails the comparison: the triangle drawn first wins.
        let nearer = depth.simd_gt(old);
        let visible = covered.map_or(nearer, |covered| covered & nearer);
        // Both stores are unconditional: lanes that fail the test write back the stored value.
        visible.select(depth, old).store_slice(depths);
        let triangles: &mut [u32] = &mut self.triangle[first..first + BLOCK_SIDE];
        let old = u32x8::from_slice(simd, triangles);
        visible.select(u32x8::splat(simd, triangle), old).store_slice(triangles);
    }

    /// Calls `each(array index, x, y, depth)` for every covered sample that passes the depth test.
    ///
    /// This method writes nothing. It is for masked triangles, whose alpha test comes between the
    /// depth test and the depth write, and for translucent triangles. `compare` is the depth test.
    ///
    /// `each` may write to the plane: the depth test of a row is done before its samples are
    /// visited, and no sample is visited twice.
    #[inline(always)]
    pub(crate) fn visit_visible_samples<S: Simd>(
        &mut self,
        simd: S,
        lanes: &TriangleLanes<S>,
        start: &SampleStart,
        compare: DepthCompare,
        mut each: impl FnMut(&mut Self, usize, usize, usize, f32),
    ) {
        let functions = &lanes.functions;
        for block in blocks_in_bounds(functions) {
            // Beyond the visible region, the bound is +∞, so nothing is drawn there.
            let farthest = self.block_farthest[block.index];
            let is_hidden = if compare == DepthCompare::Always {
                farthest == f32::INFINITY
            } else {
                functions.max_depth < farthest
            };
            if is_hidden || lanes.rejects_block(start, block) {
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
                let passing = compare.passes(depth, old);
                let mut visible = (covered & passing).to_bitmask();
                while visible != 0 {
                    let lane = visible.trailing_zeros() as usize;
                    visible &= visible - 1;
                    let (x, y) = (block.x as usize + lane, block.y as usize + row);
                    // The vector may extend beyond the right border of the visible region.
                    if (x as i32) < functions.x1 {
                        each(self, first + lane, x, y, depth[lane]);
                    }
                }
            }
        }
    }

    /// Returns the depth of the farthest sample of a block.
    ///
    /// There are 64 depths: eight vectors are reduced to one, then eight lanes to one number.
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

    /// Depth-tests and writes one sample, without a branch.
    ///
    /// The block's nearest bound is raised if necessary; its farthest bound can safely stay as is.
    #[inline(always)]
    pub(crate) fn depth_test_sample(&mut self, index: usize, depth: f32, triangle: u32) {
        let (old, old_triangle) = (self.depth[index], self.triangle[index]);
        let is_nearer = depth > old;
        self.depth[index] = if is_nearer { depth } else { old };
        self.triangle[index] = if is_nearer { triangle } else { old_triangle };
        let nearest = &mut self.block_nearest[index / (BLOCK_SIDE * BLOCK_SIDE)];
        *nearest = nearer_depth(*nearest, depth);
    }

    /// Writes the depth and triangle of one sample without a test.
    ///
    /// The block's nearest bound is raised if necessary; its farthest bound can safely stay as is.
    pub(crate) fn write_sample(&mut self, index: usize, depth: f32, triangle: u32) {
        self.depth[index] = depth;
        self.triangle[index] = triangle;
        let nearest = &mut self.block_nearest[index / (BLOCK_SIDE * BLOCK_SIDE)];
        *nearest = nearer_depth(*nearest, depth);
    }
}

/// Returns the nearer of two depths, neither of which may be NaN. This takes one comparison;
/// `f32::max` takes more.
fn nearer_depth(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
