//! Micro-triangles: the coverage of triangles a few pixels wide, computed eight at a time.
//!
//! ```text
//!   y0 ┌─┬─┬─┬─┐   A triangle within 4 × 4 pixels. At each of the 16 positions, for each sample,
//!      │ │◢│ │ │   each edge function of eight such triangles is one vector. Coverage is 16 bits
//!      │ │█│◣│ │   per triangle and sample plane, and only samples with a set bit get a depth
//!      └─┴─┴─┴─┘   test and depth write, one by one.
//!      x0
//! ```
//!
//! In a fine mesh, a triangle covers few of the samples in its bounds: two thirds of the
//! eight-pixel rows that it touches contain none of its samples. Here, the eight lanes are
//! triangles, not pixels. For a mesh of 600,000 triangles that cover five samples each, drawn with
//! four samples per pixel, this saves 27% of the visibility instructions and 6% of the drawing
//! time.
//!
//! The following were measured and rejected, because they cost more than they save:
//! - hierarchical z for micro-triangles, and micro-triangles with one sample per pixel;
//! - for larger triangles, a branch that skips rows without a sample: 14% fewer instructions, but
//!   9% to 39% more time, because it cannot be predicted;
//! - separate bounds of each triangle in each sample plane: 16% more instructions, because the
//!   loops over blocks then start in each plane;
//! - four samples of two pixels in a vector instead of eight pixels: drawing takes 0.96 times as
//!   long with four samples per pixel but 1.13 times as long with one, and the code grows by 16
//!   KiB.

use crate::sample_plane::{BLOCK_SIDE, BLOCKS_PER_ROW, SamplePlane, TILE_PIXELS};
use crate::tile_grid::TILE;
use crate::triangle_batch::{BATCH_SIZE, BatchStarts, TriangleBatch};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, i32x8};

/// The longest side of a micro-triangle's bounds in pixels.
const SIDE: usize = 4;
/// The number of sample planes whose positions fit into the bits of one word.
const PLANES_PER_WORD: usize = 4;
/// The minimum number of micro-triangles in a batch for which setting up all eight lanes pays off.
const MIN_COUNT: u32 = 2;

/// The micro-triangles of a batch, with their coverage and depth terms.
#[derive(Debug, Default)]
pub(crate) struct MicroTriangles {
    /// The triangles of the batch that are micro-triangles, one bit each.
    lanes: u32,
    /// For each sample plane and triangle, the covered positions: bit 4 · row + column.
    covered: Vec<[i32; BATCH_SIZE]>,
    /// For each sample plane, row and triangle, z + dy · y.
    row_depths: Vec<[f32; BATCH_SIZE]>,
    /// For each column and triangle, dx · x.
    column_depths: [[f32; BATCH_SIZE]; SIDE],
    /// For each row and triangle, the row's term of a sample's index in its plane.
    row_indices: [[i32; BATCH_SIZE]; SIDE],
    /// For each column and triangle, the column's term of that index.
    column_indices: [[i32; BATCH_SIZE]; SIDE],
}

impl MicroTriangles {
    /// Returns whether a triangle of the batch is a micro-triangle.
    #[inline(always)]
    pub(crate) const fn contain(&self, lane: usize) -> bool {
        self.lanes >> lane & 1 != 0
    }

    /// Prepares the micro-triangles of a batch, using the start values `starts` of each plane.
    #[inline(always)]
    pub(crate) fn prepare<S: Simd>(
        &mut self,
        simd: S,
        batch: &TriangleBatch,
        starts: &[BatchStarts],
    ) {
        self.lanes = 0;
        if starts.len() == 1 {
            return;
        }
        let (lanes, heights) = micro_lanes(batch);
        if lanes.count_ones() < MIN_COUNT {
            return;
        }
        self.lanes = lanes;
        let [x0, y0, ..] = batch.bounds.map(|corner| i32x8::from_slice(simd, &corner));
        let [dx, dy] = batch.depth_step.map(|step| f32x8::from_slice(simd, &step));
        for place in 0..SIDE {
            let (x, y) = (x0 + place as i32, y0 + place as i32);
            // Like `pixel_index`: blocks of 64 samples, rows of 8.
            let (side, blocks) = (BLOCK_SIDE as i32, BLOCKS_PER_ROW as i32);
            let column = (x >> 3) * (side * side) + (x & (side - 1));
            let row = (y >> 3) * (side * side * blocks) + (y & (side - 1)) * side;
            column.store_slice(&mut self.column_indices[place]);
            row.store_slice(&mut self.row_indices[place]);
            (dx * place as f32).store_slice(&mut self.column_depths[place]);
        }
        self.covered.resize(starts.len(), [0; BATCH_SIZE]);
        self.row_depths.resize(starts.len() * SIDE, [0.0; BATCH_SIZE]);
        let a = batch.a.map(|a| i32x8::from_slice(simd, &a));
        let b = batch.b.map(|b| i32x8::from_slice(simd, &b));
        let rows = self.row_depths.as_chunks_mut::<SIDE>().0.iter_mut();
        for ((start, covered), row_depths) in starts.iter().zip(&mut self.covered).zip(rows) {
            let z = f32x8::from_slice(simd, &start.depth);
            for (y, depths) in row_depths[..heights].iter_mut().enumerate() {
                (z + dy * y as f32).store_slice(depths);
            }
            let edge = |k: usize| i32x8::from_slice(simd, &start.edges[k]) + a[k] * x0 + b[k] * y0;
            let mut row = [edge(0), edge(1), edge(2)];
            let mut inside = i32x8::splat(simd, 0);
            for y in 0..heights {
                let mut edges = row;
                for x in 0..SIDE {
                    // Combine the sign bits of the edge functions: all are clear inside.
                    let signs = (edges[0] | edges[1] | edges[2]) >> 31;
                    inside |= !signs & (1 << (SIDE * y + x));
                    for k in 0..3 {
                        edges[k] += a[k];
                    }
                }
                for k in 0..3 {
                    row[k] += b[k];
                }
            }
            inside.store_slice(covered);
        }
    }

    /// Depth-tests and writes the samples covered by one of the triangles.
    #[inline(always)]
    pub(crate) fn rasterize(
        &self,
        planes: &mut [SamplePlane],
        lane: usize,
        [min_depth, max_depth]: [f32; 2],
        triangle: u32,
    ) {
        let words = planes.chunks_mut(PLANES_PER_WORD).zip(self.covered.chunks(PLANES_PER_WORD));
        let depths = self.row_depths.chunks(PLANES_PER_WORD * SIDE);
        for ((planes, covered), row_depths) in words.zip(depths) {
            let mut places = 0;
            for (plane, covered) in covered.iter().enumerate() {
                places |= u64::from(covered[lane] as u16) << (16 * plane);
            }
            while places != 0 {
                let place = places.trailing_zeros() as usize;
                places &= places - 1;
                let (row, column) = (place / SIDE, place % SIDE);
                let index = self.row_indices[row % SIDE][lane] + self.column_indices[column][lane];
                let depth = self.column_depths[column][lane] + row_depths[row][lane];
                let depth = if depth < min_depth { min_depth } else { depth };
                let depth = if depth > max_depth { max_depth } else { depth };
                let plane = &mut planes[place / (SIDE * SIDE)];
                plane.depth_test_sample(index as usize % TILE_PIXELS, depth, triangle);
            }
        }
    }
}

/// Returns the triangles of a batch whose bounds are at most 4 × 4 pixels, one bit each, and the
/// maximum height of their bounds.
///
/// All 16 positions are in the tile; positions beyond the border of the picture are never shown.
#[inline(always)]
fn micro_lanes(batch: &TriangleBatch) -> (u32, usize) {
    let [x0, y0, x1, y1] = &batch.bounds;
    let last = TILE as i32 - SIDE as i32;
    let (mut lanes, mut heights) = (0, 0);
    for lane in 0..BATCH_SIZE {
        let (x0, y0, x1, y1) = (x0[lane], y0[lane], x1[lane], y1[lane]);
        let is_small = (x1 - x0 <= SIDE as i32) & (y1 - y0 <= SIDE as i32);
        let is_within = (x0 <= last) & (y0 <= last) & batch.is_prepared(lane);
        let is_micro = is_small & is_within;
        lanes |= u32::from(is_micro) << lane;
        heights = if is_micro { (y1 - y0).max(heights) } else { heights };
    }
    (lanes, (heights as usize).min(SIDE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitive::{ScreenTriangle, WeightSource};
    use crate::rasterize::{TriangleLanes, rasterize_triangle};
    use crate::sample_plane::pixel_index;
    use crate::simd_level::dispatch;
    use crate::tile_grid::TileRect;
    use crate::{Opacity, Samples, ScreenVertex, SimdLevel, signed_area};
    use proptest::prelude::*;

    const TILE_RECT: TileRect = TileRect { x: 64, y: 0, left: 0, top: 0, right: 64, bottom: 56 };

    /// Generates clockwise triangles of up to four pixels, inside the tile and across its borders.
    fn triangle() -> impl Strategy<Value = ScreenTriangle> {
        let corner = (0..900_i32, 0..900_i32, 0.0..1.0_f32);
        let place = (-3..64_i32, -3..64_i32);
        (prop::array::uniform3(corner), place).prop_filter_map("flat", |(corners, (x, y))| {
            let vertex = |k: usize| {
                let (dx, dy, depth) = corners[k];
                ScreenVertex::new((64 + x) * 256 + dx, y * 256 + dy, depth, 1.0)
            };
            let [p, q, r] = [vertex(0)?, vertex(1)?, vertex(2)?];
            let vertices = match signed_area([p, q, r]) {
                0 => return None,
                1.. => [p, q, r],
                _ => [p, r, q],
            };
            let (source, opacity) = (WeightSource::Unclipped, Opacity::Opaque);
            Some(ScreenTriangle { vertices, id: 0, source, opacity })
        })
    }

    /// Returns the depth and visible triangle at each sample of the planes.
    fn visible_samples(planes: &[SamplePlane]) -> Vec<(f32, u32)> {
        let pixels = || (0..56).flat_map(|y| (0..64).map(move |x| pixel_index(x, y)));
        let samples = |plane: &SamplePlane| {
            pixels().map(|at| (plane.depth[at], plane.triangle[at])).collect::<Vec<_>>()
        };
        planes.iter().flat_map(samples).collect()
    }

    proptest! {
        #[test]
        fn micro_triangles_match_the_general_rasterizer(
            triangles in prop::array::uniform8(triangle()), count in 0..3_usize,
        ) {
            let samples = [Samples::Four, Samples::Eight, Samples::Sixteen][count];
            for level in SimdLevel::available() {
                let mut planes = [(); 2].map(|()| Vec::new());
                for planes in &mut planes {
                    planes.resize_with(samples.count(), SamplePlane::new);
                }
                let [together, one_by_one] = &mut planes;
                dispatch!(level.level(), simd => {
                    let range = samples.offset_range();
                    let batch = TriangleBatch::new(triangles.each_ref(), TILE_RECT, range);
                    let starts = samples.sample_offsets().map(|offset| batch.sample_starts(offset));
                    let starts: Vec<_> = starts.collect();
                    let mut micro_triangles = MicroTriangles::default();
                    micro_triangles.prepare(simd, &batch, &starts);
                    for lane in 0..BATCH_SIZE {
                        if !micro_triangles.contain(lane) || batch.is_outside(lane) {
                            continue;
                        }
                        let functions = batch.lane_functions(lane);
                        let depths = [functions.min_depth, functions.max_depth];
                        micro_triangles.rasterize(together, lane, depths, lane as u32);
                        let lanes = TriangleLanes::new(simd, &functions);
                        let start = |plane: usize| starts[plane].lane_start(lane);
                        rasterize_triangle(simd, one_by_one, &lanes, start, lane as u32);
                    }
                });
                prop_assert!(visible_samples(&planes[0]) == visible_samples(&planes[1]));
            }
        }
    }
}
