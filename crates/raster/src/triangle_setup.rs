//! Triangle setup: the edge functions and depth plane of a triangle, prepared in 32 bits for one
//! tile.
//!
//! Edge functions are exact in 64 bits ([`EdgeFunction`]), but vectors of 32-bit integers have
//! twice as many lanes. Within a tile, the samples of one plane are whole pixels apart, so all of
//! them have the same value of E modulo 256, and E ≥ 0 holds if and only if ⌊E/256⌋ ≥ 0. The
//! quotient changes by integers from pixel to pixel. Near the tile, it fits in 32 bits; farther
//! away, it is clamped to ±2³⁰. The change across a tile is smaller than that, so the sign, which
//! is all that matters, stays correct.
//!
//! ```text
//!   E(x, y) = A x + B y + C    A, B, C integers, x and y in 1/256 pixel, all exact
//!   A = y₀ − y₁,  B = x₁ − x₀    |A|, |B| ≤ 2²³ within the guard band
//!   across a tile E/256 changes by less than 64 · (|A| + |B|) ≤ 2³⁰
//! ```

use crate::edge_function::EdgeFunction;
use crate::primitive::ScreenTriangle;
use crate::screen_vertex::{SUBPIXEL_BITS, SUBPIXELS};
use crate::tile_grid::TileRect;

/// A triangle in the coordinates of one tile, shared by all samples. Pixels are relative to the
/// tile's corner.
///
/// The changes per pixel are the coefficients A and B themselves: a pixel is 256 grid steps, and E
/// is divided by 256.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct TriangleFunctions {
    /// The change of E/256 per pixel to the right, for each edge.
    pub(crate) a: [i32; 3],
    /// The change of E/256 per pixel down, for each edge.
    pub(crate) b: [i32; 3],
    /// The first column of [x0, x1) × [y0, y1), the pixels that may have a sample within the
    /// triangle's bounds. Depth is relative to pixel (x0, y0), which must not depend on the visible
    /// region.
    pub(crate) x0: i32,
    /// The first row of these pixels.
    pub(crate) y0: i32,
    /// One past the last column of these pixels.
    pub(crate) x1: i32,
    /// One past the last row of these pixels.
    pub(crate) y1: i32,
    /// The change of depth per pixel to the right.
    pub(crate) dx: f32,
    /// The change of depth per pixel down.
    pub(crate) dy: f32,
    /// The depth of the farthest vertex.
    pub(crate) min_depth: f32,
    /// The depth of the nearest vertex.
    pub(crate) max_depth: f32,
}

/// A triangle prepared for one tile.
///
/// The start values of each sample plane are computed from the exact functions in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleSetup {
    /// The functions in 32 bits and `f32`, in the coordinates of the tile.
    pub(crate) functions: TriangleFunctions,
    /// The edge functions in 64 bits, in the coordinates of the picture.
    edges: [EdgeFunction; 3],
    /// The grid position of the tile's corner.
    origin: (i64, i64),
    /// The depth plane in f64, in the coordinates of the picture.
    depth: DepthPlane,
}

/// The values of a triangle's functions at the first sample of one plane: the part that differs
/// from plane to plane.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct SampleStart {
    /// ⌊E/256⌋ at the sample of pixel (0, 0), for each edge.
    pub(crate) edges: [i32; 3],
    /// The depth at the sample of pixel (x0, y0), on the triangle's plane.
    pub(crate) z: f32,
}

/// The plane equation of depth, a linear function on the screen (RA-2).
///
/// Depth is already z/w, which is linear in screen space, so it needs no perspective correction.
///
/// Samples evaluate it as (z + dy·y) + dx·x, with x and y relative to the corner of the bounds
/// within the tile. The result is clamped to the depths of the vertices, because the plane of a
/// sliver is steep, and meaningless outside the sliver.
#[derive(Clone, Copy, Debug)]
struct DepthPlane {
    /// The grid position of the first vertex.
    origin: (i64, i64),
    /// The depth of the first vertex.
    z: f64,
    /// The change of depth per grid step to the right.
    dx: f64,
    /// The change of depth per grid step down.
    dy: f64,
}

impl TriangleSetup {
    /// Prepares a triangle, or returns `None` if its bounds contain none of the tile's samples.
    ///
    /// `offset_range` is the minimum and maximum offset of a sample from the borders of its pixel,
    /// in grid steps.
    pub(crate) fn new(
        triangle: &ScreenTriangle,
        tile: TileRect,
        offset_range: (i32, i32),
    ) -> Option<Self> {
        let [p, q, r] = triangle.vertices;
        let (left, right) = (p.x.min(q.x).min(r.x), p.x.max(q.x).max(r.x));
        let (top, bottom) = (p.y.min(q.y).min(r.y), p.y.max(q.y).max(r.y));
        let origin = (tile.x as i32 * SUBPIXELS, tile.y as i32 * SUBPIXELS);
        let (least, greatest) = offset_range;
        // The first pixel whose last sample is not before the bound, and the first pixel whose
        // first sample is past it.
        let first = |bound: i32, from: i32| (bound - from - greatest + 255) >> SUBPIXEL_BITS;
        let beyond = |bound: i32, from: i32| ((bound - from - least) >> SUBPIXEL_BITS) + 1;
        let (x0, y0) = (first(left, origin.0).max(0), first(top, origin.1).max(0));
        let x1 = beyond(right, origin.0).min(tile.right as i32);
        let y1 = beyond(bottom, origin.1).min(tile.bottom as i32);
        if x0 >= x1 || y0 >= y1 {
            return None;
        }
        // Edge functions, with the top-left bias in C.
        let edges = [EdgeFunction::new(p, q), EdgeFunction::new(q, r), EdgeFunction::new(r, p)];
        // The depth plane has gradients per grid step; the samples use gradients per pixel.
        let depth = DepthPlane::new(triangle);
        let functions = TriangleFunctions {
            a: edges.map(|edge| edge.a as i32),
            b: edges.map(|edge| edge.b as i32),
            x0,
            y0,
            x1,
            y1,
            dx: (depth.dx * f64::from(SUBPIXELS)) as f32,
            dy: (depth.dy * f64::from(SUBPIXELS)) as f32,
            min_depth: p.depth.min(q.depth).min(r.depth),
            max_depth: p.depth.max(q.depth).max(r.depth),
        };
        let origin = (i64::from(origin.0), i64::from(origin.1));
        Some(Self { functions, edges, origin, depth })
    }

    /// Returns the start values for the samples at `offset` (grid steps) from the upper left
    /// corners of their pixels.
    ///
    /// The values are exact for edges near the tile. For other edges, only the sign is correct, and
    /// only the sign is used.
    pub(crate) fn sample_start(&self, offset: (i64, i64)) -> SampleStart {
        let limit = 1_i64 << 30;
        let (x, y) = (self.origin.0 + offset.0, self.origin.1 + offset.1);
        // The shift rounds down, even below 0: ⌊E/256⌋.
        let quotient =
            |edge: EdgeFunction| (edge.evaluate(x, y) >> SUBPIXEL_BITS).clamp(-limit, limit) as i32;
        // Depth is relative to the corner of the bounds, not of the tile: the offsets of samples
        // within the triangle are then small, and so are their products' rounding errors.
        let pixels = |count: i32| i64::from(count) * i64::from(SUBPIXELS);
        let corner = (x + pixels(self.functions.x0), y + pixels(self.functions.y0));
        SampleStart { edges: self.edges.map(quotient), z: self.depth.depth_at(corner) as f32 }
    }
}

/// Returns the change of a triangle's depth per pixel to the right and down, limited to the range
/// of its vertices' depths.
///
/// The limit bounds the error next to a sliver, whose plane may be arbitrarily steep.
pub(crate) fn clamped_depth_slopes(triangle: &ScreenTriangle) -> [f32; 2] {
    let plane = DepthPlane::new(triangle);
    let depths = triangle.vertices.map(|vertex| vertex.depth);
    let least = depths[0].min(depths[1]).min(depths[2]);
    let range = depths[0].max(depths[1]).max(depths[2]) - least;
    [plane.dx, plane.dy].map(|step| ((step * f64::from(SUBPIXELS)) as f32).clamp(-range, range))
}

impl DepthPlane {
    /// Computes the plane through the vertices by Cramer's rule. The triangle must not be
    /// degenerate.
    fn new(triangle: &ScreenTriangle) -> Self {
        let [p, q, r] = triangle.vertices;
        let d = |a: i32, b: i32| f64::from(a) - f64::from(b);
        let (qx, qy, qz) = (d(q.x, p.x), d(q.y, p.y), f64::from(q.depth) - f64::from(p.depth));
        let (rx, ry, rz) = (d(r.x, p.x), d(r.y, p.y), f64::from(r.depth) - f64::from(p.depth));
        // Twice the area has at most 48 bits, so it is exact in f64, and it is not 0.
        let inv_area = 1.0 / (qx * ry - qy * rx);
        Self {
            origin: (i64::from(p.x), i64::from(p.y)),
            z: f64::from(p.depth),
            dx: (qz * ry - rz * qy) * inv_area,
            dy: (rz * qx - qz * rx) * inv_area,
        }
    }

    /// Returns the depth at a grid position.
    fn depth_at(&self, position: (i64, i64)) -> f64 {
        let (x, y) = position;
        self.z + self.dx * (x - self.origin.0) as f64 + self.dy * (y - self.origin.1) as f64
    }
}
