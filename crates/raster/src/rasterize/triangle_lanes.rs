//! A triangle's functions in eight lanes: coverage and depth of the blocks in a row, and of the
//! pixels in a row of a block.

use crate::sample_plane::{BLOCK_SIDE, BLOCKS_PER_ROW};
use crate::triangle_setup::{SampleStart, TriangleFunctions};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, i32x8, mask32x8};

/// A block of 8 × 8 pixels: its index in the tile and its upper left pixel.
#[derive(Clone, Copy)]
pub(super) struct Block {
    /// The index of the block in the tile, row by row, from 0 to 63.
    pub(super) index: usize,
    /// The column of the upper left pixel in the tile.
    pub(super) x: i32,
    /// The row of the upper left pixel in the tile.
    pub(super) y: i32,
}

impl Block {
    /// Returns the block at this column and row of the tile's grid of blocks.
    #[inline(always)]
    pub(super) fn from_column_row(column: i32, row: i32) -> Self {
        Self { index: row as usize * BLOCKS_PER_ROW + column as usize, x: column * 8, y: row * 8 }
    }

    /// Returns the array index of the first pixel in a row of the block.
    #[inline(always)]
    pub(super) fn row_index(self, row: usize) -> usize {
        (self.index * BLOCK_SIDE + row) * BLOCK_SIDE
    }
}

/// A block with the part of depth that depends on the column: dx·x for each of its eight columns.
#[derive(Clone, Copy)]
pub(super) struct BlockColumns<S: Simd> {
    pub(super) block: Block,
    pub(super) depths: f32x8<S>,
}

/// Returns the blocks that a triangle's bounds touch, row by row.
#[inline(always)]
pub(super) fn blocks_in_bounds(
    functions: &TriangleFunctions,
) -> impl Iterator<Item = Block> + use<> {
    let (columns, rows) = (
        functions.x0 / 8..(functions.x1 - 1) / 8 + 1,
        functions.y0 / 8..(functions.y1 - 1) / 8 + 1,
    );
    rows.flat_map(move |row| columns.clone().map(move |column| Block::from_column_row(column, row)))
}

/// The coverage of the eight blocks of a row.
pub(super) struct BlockCoverage<S: Simd> {
    /// Whether the triangle may touch the block (conservative).
    pub(super) is_touched: mask32x8<S>,
    /// Whether the triangle covers every sample of the block.
    pub(super) is_full: mask32x8<S>,
}

/// Bounds of a triangle's depth in the eight blocks of a row.
pub(super) struct BlockDepths<S: Simd> {
    /// The minimum depth in each block, at least the depth of the farthest vertex.
    pub(super) min_depth: f32x8<S>,
    /// The maximum depth in each block, at most the depth of the nearest vertex.
    pub(super) max_depth: f32x8<S>,
    /// Whether the depth plane stays within the depths of the vertices, so no sample needs
    /// clamping.
    pub(super) is_unclamped: mask32x8<S>,
}

/// A triangle's edge functions and depth plane for eight pixels of a row at once.
pub(crate) struct TriangleLanes<S: Simd> {
    pub(super) functions: TriangleFunctions,
    /// The integers 0 to 7.
    pub(super) lane_indices: i32x8<S>,
    /// The changes of the edge functions from the first pixel to each of eight pixels.
    pub(super) edge_steps: [i32x8<S>; 3],
    /// The numbers 0.0 to 7.0.
    pub(super) lane_offsets: f32x8<S>,
    /// The change of depth per pixel to the right, in all lanes.
    pub(super) dx: f32x8<S>,
    /// The depth of the farthest vertex, in all lanes.
    pub(super) min_depth: f32x8<S>,
    /// The depth of the nearest vertex, in all lanes.
    pub(super) max_depth: f32x8<S>,
}

impl<S: Simd> TriangleLanes<S> {
    /// Spreads the functions of a triangle over eight lanes. All planes share the result.
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

    /// Evaluates edge function k at a pixel: E₀ + a·x + b·y.
    ///
    /// This uses 32 bits: E₀ is clamped to ±2³⁰ and changes by less than 2³⁰ across a tile, so
    /// nothing overflows and the sign is correct.
    #[inline(always)]
    pub(super) fn edge_value(&self, k: usize, start: &SampleStart, x: i32, y: i32) -> i32 {
        start.edges[k] + self.functions.a[k] * x + self.functions.b[k] * y
    }

    /// Evaluates the edge functions at the eight pixels in a row of a block.
    #[inline(always)]
    pub(super) fn row_edge_values(
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

    /// Returns whether an edge excludes the whole block, that is, its function is negative even at
    /// the innermost corner.
    ///
    /// The maximum of a linear function over a square is at a corner, which the signs of A and B
    /// select: seven pixels to the right if A > 0, seven down if B > 0.
    #[inline(always)]
    pub(super) fn rejects_block(&self, start: &SampleStart, block: Block) -> bool {
        (0..3).any(|k| {
            let to_innermost = 7 * (self.functions.a[k].max(0) + self.functions.b[k].max(0));
            self.edge_value(k, start, block.x, block.y) + to_innermost < 0
        })
    }

    /// Returns the rows of a block that the triangle's bounds touch.
    #[inline(always)]
    pub(super) fn rows_in_block(&self, block: Block) -> core::ops::Range<usize> {
        let first = (self.functions.y0 - block.y).max(0) as usize;
        let end = (self.functions.y1 - block.y).min(BLOCK_SIDE as i32) as usize;
        first..end
    }

    /// Classifies the eight blocks of a row by the edge functions at their corners.
    ///
    /// A block is touched if no edge excludes its innermost corner, and full if no edge excludes
    /// its outermost corner.
    ///
    /// The sign bits of the three edges are combined with "or": a set bit means that some edge
    /// excludes the corner.
    #[inline(always)]
    pub(super) fn classify_blocks(
        &self,
        simd: S,
        start: &SampleStart,
        row: i32,
    ) -> BlockCoverage<S> {
        let TriangleFunctions { a, b, x0, x1, .. } = self.functions;
        let mut innermost = i32x8::splat(simd, 0);
        let mut outermost = i32x8::splat(simd, 0);
        for k in 0..3 {
            let first = i32x8::splat(simd, self.edge_value(k, start, 0, row * 8));
            // E at the upper left sample of each block, then at the corners with the maximum and
            // the minimum.
            let corner = self.lane_indices * i32x8::splat(simd, 8 * a[k]) + first;
            innermost |= corner + i32x8::splat(simd, 7 * (a[k].max(0) + b[k].max(0)));
            outermost |= corner + i32x8::splat(simd, 7 * (a[k].min(0) + b[k].min(0)));
        }
        let zero = i32x8::splat(simd, 0);
        // Exclude blocks outside the bounding box: beyond a sharp vertex, no single edge excludes
        // them.
        let after_first = self.lane_indices.simd_ge(i32x8::splat(simd, x0 / 8));
        let to_last = self.lane_indices.simd_le(i32x8::splat(simd, (x1 - 1) / 8));
        let is_full = outermost.simd_ge(zero);
        BlockCoverage { is_touched: innermost.simd_ge(zero) & after_first & to_last, is_full }
    }

    /// Computes bounds of the depth in the eight blocks of a row: the depth at two opposite corners
    /// of each block.
    ///
    /// Every operation in the evaluation of depth is monotonic, including rounding, so no sample in
    /// between exceeds the bounds.
    #[inline(always)]
    pub(super) fn block_depth_bounds(
        &self,
        simd: S,
        start: &SampleStart,
        row: i32,
    ) -> BlockDepths<S> {
        let TriangleFunctions { x0, y0, dx, dy, .. } = self.functions;
        let at_row = |y: i32| start.z + dy * (row * 8 + y - y0) as f32;
        // The corner toward which depth decreases, and the corner toward which it increases.
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

    /// Returns a block with the first term of its depth, dx·x; the second term is
    /// [`row_depth`](Self::row_depth).
    #[inline(always)]
    pub(super) fn block_columns(&self, simd: S, block: Block) -> BlockColumns<S> {
        let x = self.lane_offsets + f32x8::splat(simd, (block.x - self.functions.x0) as f32);
        BlockColumns { block, depths: self.dx * x }
    }

    /// Returns the second term of the depth in a row of a block: z + dy·y.
    ///
    /// The terms are added in the same order everywhere, so a sample's depth has the same bits on
    /// every path.
    #[inline(always)]
    pub(super) fn row_depth(
        &self,
        simd: S,
        start: &SampleStart,
        block: Block,
        row: usize,
    ) -> f32x8<S> {
        let y = block.y + row as i32 - self.functions.y0;
        f32x8::splat(simd, start.z + self.functions.dy * y as f32)
    }

    /// Clamps a depth to the depths of the vertices.
    #[inline(always)]
    pub(super) fn clamp_depth(&self, depth: f32x8<S>) -> f32x8<S> {
        let depth = depth.simd_lt(self.min_depth).select(self.min_depth, depth);
        depth.simd_gt(self.max_depth).select(self.max_depth, depth)
    }

    /// Returns whether the triangle's bounds contain the whole block, so that its farthest sample
    /// may have come nearer.
    ///
    /// This is conservative: if the triangle itself misses a corner, recomputing the bound is
    /// wasted work.
    #[inline(always)]
    pub(super) fn bounds_contain(&self, block: Block) -> bool {
        let TriangleFunctions { x0, y0, x1, y1, .. } = self.functions;
        x0 <= block.x && y0 <= block.y && x1 >= block.x + 8 && y1 >= block.y + 8
    }
}
