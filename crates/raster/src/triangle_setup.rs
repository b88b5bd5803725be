//! A triangle prepared for one tile: everything that its samples need, in 32 bits.
//!
//! Edge functions are exact in 64 bits ([`EdgeFunction`]). Within a tile the samples of one plane lie whole pixels apart, so all
//! of them have the same value of E modulo 256, and E ≥ 0 holds if and only if ⌊E/256⌋ ≥ 0: the quotient steps by whole numbers
//! and fits 32 bits. Where it is too large, it is cut off at ±2³⁰: the steps across a tile are smaller than that,
//! so the sign, which is all that counts, stays right.

use crate::edge_function::EdgeFunction;
use crate::primitive::ScreenTriangle;
use crate::screen_vertex::{SUBPIXEL_BITS, SUBPIXELS};
use crate::tile_grid::TileRect;

/// A triangle as one tile sees it, whatever the sample. Pixels are counted from the tile's corner.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct TriangleFunctions {
    /// The step of E/256 per pixel to the right, for each edge.
    pub(crate) a: [i32; 3],
    /// The step of E/256 per pixel down.
    pub(crate) b: [i32; 3],
    /// The pixels that may have a sample within the triangle's bounds: [x0, x1) × [y0, y1), not empty. Depth is counted from
    /// the first, so that it must not depend on what of the tile is shown.
    pub(crate) x0: i32,
    pub(crate) y0: i32,
    pub(crate) x1: i32,
    pub(crate) y1: i32,
    /// The steps of depth per pixel.
    pub(crate) dx: f32,
    pub(crate) dy: f32,
    /// The depth of the corner that is farthest and of the one that is nearest.
    pub(crate) min_depth: f32,
    pub(crate) max_depth: f32,
}

/// A triangle prepared for a tile.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleSetup {
    pub(crate) functions: TriangleFunctions,
    /// The edge functions.
    edges: [EdgeFunction; 3],
    /// The grid position of the tile's corner.
    origin: (i64, i64),
    depth: DepthPlane,
}

/// What differs from sample plane to sample plane: where a triangle's functions start.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct SampleStart {
    /// ⌊E/256⌋ at the sample of pixel (0, 0), for each edge.
    pub(crate) edges: [i32; 3],
    /// The depth at the sample of pixel (x0, y0), on the triangle's plane.
    pub(crate) z: f32,
}

/// Depth is a linear function of the place on the screen: it is z/w already, so it needs no correction (RA-2).
///
/// Samples evaluate it as (z + dy·y) + dx·x with x and y counted from the corner of the bounds within the tile, and
/// cut it off at the corners' least and greatest depth: a sliver's plane is steep, and beside the sliver it means nothing.
#[derive(Clone, Copy, Debug)]
struct DepthPlane {
    /// A corner's grid position and depth.
    origin: (i64, i64),
    z: f64,
    /// The steps of depth per grid step.
    dx: f64,
    dy: f64,
}

impl TriangleSetup {
    /// Prepares a triangle; `None` if its bounds hold none of the tile's samples. `reach` is the least and the greatest
    /// offset of a sample from its pixel's borders, in grid steps.
    pub(crate) fn new(piece: &ScreenTriangle, tile: TileRect, reach: (i32, i32)) -> Option<Self> {
        let [p, q, r] = piece.corners;
        let (left, right) = (p.x.min(q.x).min(r.x), p.x.max(q.x).max(r.x));
        let (top, bottom) = (p.y.min(q.y).min(r.y), p.y.max(q.y).max(r.y));
        let origin = (tile.x as i32 * SUBPIXELS, tile.y as i32 * SUBPIXELS);
        // The first pixel whose last sample is not before a bound, and the first whose first sample is behind one.
        let first = |bound: i32, from: i32| (bound - from - reach.1 + 255) >> SUBPIXEL_BITS;
        let beyond = |bound: i32, from: i32| ((bound - from - reach.0) >> SUBPIXEL_BITS) + 1;
        let (x0, y0) = (first(left, origin.0).max(0), first(top, origin.1).max(0));
        let x1 = beyond(right, origin.0).min(tile.right as i32);
        let y1 = beyond(bottom, origin.1).min(tile.bottom as i32);
        if x0 >= x1 || y0 >= y1 {
            return None;
        }
        let edges = [EdgeFunction::new(p, q), EdgeFunction::new(q, r), EdgeFunction::new(r, p)];
        let depth = DepthPlane::new(piece);
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

    /// Where the functions start for the samples at `offset` (grid steps) from the upper left corners of their pixels.
    pub(crate) fn sample_start(&self, offset: (i64, i64)) -> SampleStart {
        let limit = 1_i64 << 30;
        let (x, y) = (self.origin.0 + offset.0, self.origin.1 + offset.1);
        let quotient =
            |edge: EdgeFunction| (edge.evaluate(x, y) >> SUBPIXEL_BITS).clamp(-limit, limit) as i32;
        let pixels = |count: i32| i64::from(count) * i64::from(SUBPIXELS);
        let corner = (x + pixels(self.functions.x0), y + pixels(self.functions.y0));
        SampleStart { edges: self.edges.map(quotient), z: self.depth.depth_at(corner) as f32 }
    }
}

/// What a piece's depth grows by from pixel to pixel to the right and downwards, cut off at the range of its corners' depths.
pub(crate) fn clamped_depth_slopes(piece: &ScreenTriangle) -> [f32; 2] {
    let plane = DepthPlane::new(piece);
    let depths = piece.corners.map(|corner| corner.depth);
    let least = depths[0].min(depths[1]).min(depths[2]);
    let range = depths[0].max(depths[1]).max(depths[2]) - least;
    [plane.dx, plane.dy].map(|step| ((step * f64::from(SUBPIXELS)) as f32).clamp(-range, range))
}

impl DepthPlane {
    fn new(piece: &ScreenTriangle) -> Self {
        let [p, q, r] = piece.corners;
        let d = |a: i32, b: i32| f64::from(a) - f64::from(b);
        let (qx, qy, qz) = (d(q.x, p.x), d(q.y, p.y), f64::from(q.depth) - f64::from(p.depth));
        let (rx, ry, rz) = (d(r.x, p.x), d(r.y, p.y), f64::from(r.depth) - f64::from(p.depth));
        let per_area = 1.0 / (qx * ry - qy * rx);
        Self {
            origin: (i64::from(p.x), i64::from(p.y)),
            z: f64::from(p.depth),
            dx: (qz * ry - rz * qy) * per_area,
            dy: (rz * qx - qz * rx) * per_area,
        }
    }

    fn depth_at(&self, (x, y): (i64, i64)) -> f64 {
        self.z + self.dx * (x - self.origin.0) as f64 + self.dy * (y - self.origin.1) as f64
    }
}
