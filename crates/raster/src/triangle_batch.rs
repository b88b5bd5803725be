//! Batched triangle setup: eight small triangles prepared for a tile at once.
//!
//! In fine meshes, most of the work on a triangle is its setup. For triangles near the tile, 32-bit
//! arithmetic is enough throughout, and the same vector instructions prepare eight of them. The
//! results match [`TriangleSetup`](crate::triangle_setup::TriangleSetup), bit for bit: edge
//! functions are exact in both, and depth uses the same operations in the same order. Everything is
//! a plain loop over eight lanes, which compiles to vector instructions in the dispatched function
//! that inlines it.
//!
//! # Why eight at a time
//!
//! A triangle of a few pixels takes less time to fill than to set up. Setup needs six differences
//! for the edge functions, and one division and eight products for the depth plane. One vector
//! instruction does one such step for several triangles. Triangles that exceed the 32-bit range are
//! set up individually, in 64 bits.

use crate::primitive::ScreenTriangle;
use crate::screen_vertex::{SUBPIXEL_BITS, SUBPIXELS};
use crate::tile_grid::TileRect;
use crate::triangle_setup::{SampleStart, TriangleFunctions};

/// The number of triangles in a batch: the lanes of one vector.
pub(crate) const BATCH_SIZE: usize = 8;
/// The minimum and maximum coordinates of a small triangle, in grid steps from the tile's corner.
///
/// An edge is then shorter than 2¹⁵ steps, and products of edges and coordinates fit in 32 bits.
///
/// Two such products are added in E = A·x + B·y + C: each is below 2³⁰, so the sum is below 2³¹.
const SMALL_RANGE: (i32, i32) = (-32 * SUBPIXELS, 95 * SUBPIXELS);

/// One `i32` for each triangle of a batch: coordinates and edge functions.
type Ints = [i32; BATCH_SIZE];
/// One `f32` for each triangle of a batch: depths and their steps per pixel.
type Floats = [f32; BATCH_SIZE];
/// One `f64` for each triangle of a batch: depth gradients before rounding.
type Doubles = [f64; BATCH_SIZE];

/// Eight triangles in the coordinates of one tile, as a structure of arrays.
///
/// All values are relative to the tile, not to the picture: subtracting the tile's corner before
/// any multiplication keeps products within 32 bits.
pub(crate) struct TriangleBatch {
    /// The vertices, in grid steps from the tile's corner.
    x: [Ints; 3],
    y: [Ints; 3],
    /// The depth of each triangle's first vertex.
    first_depth: Floats,
    /// Whether 32 bits are enough for each triangle. If not, its values are meaningless.
    is_small: [bool; BATCH_SIZE],
    /// The coefficients of the edge functions: see [`TriangleFunctions`].
    pub(crate) a: [Ints; 3],
    pub(crate) b: [Ints; 3],
    /// x0, y0, x1 and y1 of [`TriangleFunctions`].
    pub(crate) bounds: [Ints; 4],
    /// The change of depth per grid step to the right and down.
    depth_gradient: [Doubles; 2],
    /// The change of depth per pixel to the right and down.
    pub(crate) depth_step: [Floats; 2],
    pub(crate) min_depth: Floats,
    pub(crate) max_depth: Floats,
}

/// The start values of eight triangles in one plane of samples: see [`SampleStart`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct BatchStarts {
    /// ⌊E/256⌋ at the sample of the tile's pixel (0, 0), for each edge.
    pub(crate) edges: [Ints; 3],
    /// Depth at the first sample of the triangle's bounds.
    pub(crate) depth: Floats,
}

impl BatchStarts {
    /// All zeros, to be overwritten.
    pub(crate) const ZERO: Self = Self { edges: [[0; BATCH_SIZE]; 3], depth: [0.0; BATCH_SIZE] };

    /// Returns the start values of one of the triangles.
    #[inline(always)]
    pub(crate) fn lane_start(&self, lane: usize) -> SampleStart {
        let [p, q, r] = &self.edges;
        SampleStart { edges: [p[lane], q[lane], r[lane]], z: self.depth[lane] }
    }
}

impl TriangleBatch {
    /// Prepares eight triangles.
    ///
    /// `offset_range` is the minimum and maximum offset of a sample from the borders of its pixel.
    ///
    /// Lanes without a triangle may repeat another triangle. The work is the same for all lanes,
    /// whether their triangle is small or not: a branch per lane would prevent vectorization.
    #[inline(always)]
    pub(crate) fn new(
        triangles: [&ScreenTriangle; BATCH_SIZE],
        tile: TileRect,
        offset_range: (i32, i32),
    ) -> Self {
        // Gather the vertices into lanes: from here on every loop is over lanes.
        let (left, top) = (tile.x as i32 * SUBPIXELS, tile.y as i32 * SUBPIXELS);
        let mut x = [[0; BATCH_SIZE]; 3];
        let mut y = [[0; BATCH_SIZE]; 3];
        let mut z = [[0.0; BATCH_SIZE]; 3];
        for (lane, triangle) in triangles.iter().enumerate() {
            for (k, vertex) in triangle.vertices.iter().enumerate() {
                x[k][lane] = vertex.x - left;
                y[k][lane] = vertex.y - top;
                z[k][lane] = vertex.depth;
            }
        }
        // Bounding boxes, and whether 32 bits are enough for each triangle.
        let (min_x, max_x) = coordinate_extents(&x);
        let (min_y, max_y) = coordinate_extents(&y);
        let mut is_small = [false; BATCH_SIZE];
        for (lane, small) in is_small.iter_mut().enumerate() {
            let is_near = min_x[lane].min(min_y[lane]) >= SMALL_RANGE.0;
            *small = is_near && max_x[lane].max(max_y[lane]) <= SMALL_RANGE.1;
        }
        // The bounding box in pixels, clipped to the tile.
        let bounds = pixel_bounds([min_x, min_y, max_x, max_y], tile, offset_range);
        // (a, b) is the inward normal of each edge.
        let (a, b) = (edge_differences(&y, false), edge_differences(&x, true));
        // The depth plane: gradients per grid step in f64, steps per pixel rounded to f32 once. The
        // factor 256 is a power of two, so scaling adds no rounding error.
        let depth_gradient = depth_gradients(&x, &y, &z);
        let depth_step =
            depth_gradient.map(|steps| steps.map(|step| (step * f64::from(SUBPIXELS)) as f32));
        // The range to which sample depths are clamped and against which hierarchical z tests.
        let (min_depth, max_depth) = depth_extents(&z);
        Self {
            x,
            y,
            first_depth: z[0],
            is_small,
            a,
            b,
            bounds,
            depth_gradient,
            depth_step,
            min_depth,
            max_depth,
        }
    }

    /// Returns whether the triangle was prepared; if not, it is too large for 32 bits.
    #[inline(always)]
    pub(crate) const fn is_prepared(&self, lane: usize) -> bool {
        self.is_small[lane]
    }

    /// Returns whether the triangle's bounds contain none of the tile's samples.
    ///
    /// Small triangles often fall between samples; this test drops them before any block is
    /// visited.
    #[inline(always)]
    pub(crate) const fn is_outside(&self, lane: usize) -> bool {
        let [x0, y0, x1, y1] = &self.bounds;
        x0[lane] >= x1[lane] || y0[lane] >= y1[lane]
    }

    /// Returns the functions of one of the triangles.
    ///
    /// This transposes one lane: eight triangles are prepared together but filled one by one.
    #[inline(always)]
    pub(crate) fn lane_functions(&self, lane: usize) -> TriangleFunctions {
        let Self { a, b, bounds: [x0, y0, x1, y1], depth_step: [dx, dy], .. } = self;
        TriangleFunctions {
            a: [a[0][lane], a[1][lane], a[2][lane]],
            b: [b[0][lane], b[1][lane], b[2][lane]],
            x0: x0[lane],
            y0: y0[lane],
            x1: x1[lane],
            y1: y1[lane],
            dx: dx[lane],
            dy: dy[lane],
            min_depth: self.min_depth[lane],
            max_depth: self.max_depth[lane],
        }
    }

    /// Returns the start values for the samples at `offset` (grid steps) from the upper left
    /// corners of their pixels.
    ///
    /// It is called once per sample plane: the gradients stay the same, and only the first sample
    /// moves.
    #[inline(always)]
    pub(crate) fn sample_starts(&self, offset: (i64, i64)) -> BatchStarts {
        let Self { x, y, a, b, bounds: [x0, y0, _, _], depth_gradient: [dx, dy], .. } = self;
        let (right, down) = (offset.0 as i32, offset.1 as i32);
        let mut starts = BatchStarts::ZERO;
        // Edge functions with the top-left rule, as in `EdgeFunction::evaluate`. Lanes of large
        // triangles wrap around; they are never read.
        for (k, edges) in starts.edges.iter_mut().enumerate() {
            for (lane, edge) in edges.iter_mut().enumerate() {
                let (a, b) = (a[k][lane], b[k][lane]);
                // E = A·(x − x₀) + B·(y − y₀), relative to the edge's first vertex: C need not be
                // stored.
                let along = a.wrapping_mul(right - x[k][lane]);
                let value = along.wrapping_add(b.wrapping_mul(down - y[k][lane]));
                // Top-left bias: an edge that does not own its samples counts E = 0 as outside.
                let is_top_left = (a > 0) | ((a == 0) & (b > 0));
                // Divide by 256, rounding down: within a plane, all values are equal modulo 256.
                *edge = value.wrapping_sub(i32::from(!is_top_left)) >> SUBPIXEL_BITS;
            }
        }
        // The depth plane at the first sample.
        for (lane, z) in starts.depth.iter_mut().enumerate() {
            // Grid steps from the first vertex: whole numbers, exact in f64.
            let from_x = f64::from(right + x0[lane] * SUBPIXELS - x[0][lane]);
            let from_y = f64::from(down + y0[lane] * SUBPIXELS - y[0][lane]);
            *z = (f64::from(self.first_depth[lane]) + dx[lane] * from_x + dy[lane] * from_y) as f32;
        }
        starts
    }
}

/// Returns the minimum and maximum coordinates of each triangle.
///
/// They are its bounding box along one axis, in grid steps from the tile's corner.
#[inline(always)]
fn coordinate_extents([p, q, r]: &[Ints; 3]) -> (Ints, Ints) {
    let (mut low, mut high) = ([0; BATCH_SIZE], [0; BATCH_SIZE]);
    for lane in 0..BATCH_SIZE {
        low[lane] = p[lane].min(q[lane]).min(r[lane]);
        high[lane] = p[lane].max(q[lane]).max(r[lane]);
    }
    (low, high)
}

/// Returns the pixels of the tile that may have a sample within the bounds: the x0, y0, x1 and y1
/// that [`TriangleSetup::new`](crate::triangle_setup::TriangleSetup::new) computes.
///
/// `extent` contains the minimum x and y, then the maximum x and y, in grid steps from the tile's
/// corner. Pixels are clamped to 0 and to the right and bottom borders of the visible part.
#[inline(always)]
fn pixel_bounds(extent: [Ints; 4], tile: TileRect, offset_range: (i32, i32)) -> [Ints; 4] {
    let (least, greatest) = offset_range;
    let [mut x0, mut y0, mut x1, mut y1] = extent;
    for low in [&mut x0, &mut y0] {
        for low in low {
            // The first pixel whose last sample is not before the bound: division by 256, rounded
            // up.
            *low = ((*low - greatest + 255) >> SUBPIXEL_BITS).max(0);
        }
    }
    for (high, end) in [(&mut x1, tile.right), (&mut y1, tile.bottom)] {
        for high in high {
            // One past the last pixel whose first sample is not past the bound.
            *high = (((*high - least) >> SUBPIXEL_BITS) + 1).min(end as i32);
        }
    }
    [x0, y0, x1, y1]
}

/// Returns the difference between the coordinates of each edge's ends: start − end, or end − start
/// if `forward`.
///
/// With y backward and x forward, these are A and B of the edge function, as in
/// [`EdgeFunction`](crate::edge_function::EdgeFunction).
#[inline(always)]
fn edge_differences(c: &[Ints; 3], forward: bool) -> [Ints; 3] {
    let mut differences = [[0; BATCH_SIZE]; 3];
    for (k, difference) in differences.iter_mut().enumerate() {
        let end = (k + 1) % 3;
        for lane in 0..BATCH_SIZE {
            let backward = c[k][lane] - c[end][lane];
            difference[lane] = if forward { -backward } else { backward };
        }
    }
    differences
}

/// Returns the change of depth per grid step to the right and down, computed as in
/// `DepthPlane::new`.
///
/// A degenerate triangle would cause a division by 0, but primitive assembly drops such triangles.
#[inline(always)]
fn depth_gradients(x: &[Ints; 3], y: &[Ints; 3], z: &[Floats; 3]) -> [Doubles; 2] {
    let mut gradients = [[0.0; BATCH_SIZE]; 2];
    for lane in 0..BATCH_SIZE {
        let along = |c: &[Ints; 3], k: usize| f64::from(c[k][lane] - c[0][lane]);
        let (qx, qy, qz) =
            (along(x, 1), along(y, 1), f64::from(z[1][lane]) - f64::from(z[0][lane]));
        let (rx, ry, rz) =
            (along(x, 2), along(y, 2), f64::from(z[2][lane]) - f64::from(z[0][lane]));
        // Cramer's rule. Twice the area is a difference of products below 2³¹: exact in f64.
        let inv_area = 1.0 / (qx * ry - qy * rx);
        gradients[0][lane] = (qz * ry - rz * qy) * inv_area;
        gradients[1][lane] = (rz * qx - qz * rx) * inv_area;
    }
    gradients
}

/// Returns the depths of the farthest and nearest vertices of each triangle.
#[inline(always)]
fn depth_extents([p, q, r]: &[Floats; 3]) -> (Floats, Floats) {
    let (mut least, mut greatest) = ([0.0; BATCH_SIZE], [0.0; BATCH_SIZE]);
    for lane in 0..BATCH_SIZE {
        // Use comparisons instead of `f32::min`: no depth is NaN, and each comparison is one
        // instruction.
        let (low, high) = if p[lane] < q[lane] { (p[lane], q[lane]) } else { (q[lane], p[lane]) };
        least[lane] = if r[lane] < low { r[lane] } else { low };
        greatest[lane] = if r[lane] > high { r[lane] } else { high };
    }
    (least, greatest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitive::WeightSource;
    use crate::triangle_setup::TriangleSetup;
    use crate::{Opacity, Samples, ScreenVertex, signed_area};
    use proptest::prelude::*;

    fn triangle() -> impl Strategy<Value = ScreenTriangle> {
        let corner = (-40.0..110.0_f64, -40.0..110.0_f64, 0.0..1.0_f64);
        let size = prop_oneof![Just(1.0), Just(0.05), Just(0.01)];
        let vertices =
            (prop::array::uniform3(corner), size).prop_filter_map("flat", |(c, size)| {
                let vertex = |k: usize| {
                    let at = |of: f64, from: f64| from + (of - from) * size;
                    let point = homog::Point::new(at(c[k].0, c[0].0), at(c[k].1, c[0].1), c[k].2);
                    ScreenVertex::snap(point, 1.0)
                };
                let [p, q, r] = [vertex(0)?, vertex(1)?, vertex(2)?];
                match signed_area([p, q, r]) {
                    0 => None,
                    1.. => Some([p, q, r]),
                    _ => Some([p, r, q]),
                }
            });
        vertices.prop_map(|vertices| ScreenTriangle {
            vertices,
            id: 0,
            source: WeightSource::Unclipped,
            opacity: Opacity::Opaque,
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn batches_match_single_setups_bit_for_bit(triangle in triangle(), count in 0..4_usize) {
            let tile = TileRect { x: 0, y: 0, left: 0, top: 0, right: 64, bottom: 56 };
            let samples = [Samples::One, Samples::Four, Samples::Eight, Samples::Sixteen][count];
            let batch = TriangleBatch::new([&triangle; BATCH_SIZE], tile, samples.offset_range());
            let setup = TriangleSetup::new(&triangle, tile, samples.offset_range());
            if !batch.is_prepared(3) {
                return Ok(());
            }
            prop_assert_eq!(batch.is_outside(3), setup.is_none());
            let Some(setup) = setup else { return Ok(()) };
            prop_assert_eq!(batch.lane_functions(3), setup.functions);
            for offset in samples.sample_offsets() {
                prop_assert_eq!(batch.sample_starts(offset).lane_start(3), setup.sample_start(offset));
            }
        }
    }
}
