//! A triangle prepared for one tile: everything that its samples need, in 32 bits.
//!
//! Edge functions are exact in 64 bits ([`Edge`]). Within a tile the samples of one plane lie whole pixels apart, so all
//! of them have the same value of E modulo 256, and E ≥ 0 holds if and only if ⌊E/256⌋ ≥ 0: the quotient steps by whole numbers
//! and fits 32 bits. Where it is too large, it is cut off at ±2³⁰: the steps across a tile are smaller than that,
//! so the sign, which is all that counts, stays right.

use crate::bins::TILE;
use crate::edge::Edge;
use crate::primitive::Piece;
use crate::vertex::{SUBPIXEL_BITS, SUBPIXELS};

/// The part of the picture a tile stands for, in pixels: [x0, x1) × [y0, y1).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct TileRect {
    pub(crate) x0: u32,
    pub(crate) y0: u32,
    pub(crate) x1: u32,
    pub(crate) y1: u32,
}

impl TileRect {
    /// The tile in the given column and row of a picture.
    pub(crate) fn of(column: u32, row: u32, width: u32, height: u32) -> Self {
        let (x0, y0) = (column * TILE, row * TILE);
        Self { x0, y0, x1: (x0 + TILE).min(width), y1: (y0 + TILE).min(height) }
    }

    pub(crate) fn width(&self) -> usize {
        (self.x1 - self.x0) as usize
    }

    pub(crate) fn height(&self) -> usize {
        (self.y1 - self.y0) as usize
    }
}

/// A triangle as the samples of one plane of one tile see it. Pixels are counted from the tile's corner.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Setup {
    /// ⌊E/256⌋ at pixel (0, 0), for each edge.
    pub(crate) e: [i32; 3],
    /// The step of E/256 per pixel to the right.
    pub(crate) a: [i32; 3],
    /// The step of E/256 per pixel down.
    pub(crate) b: [i32; 3],
    /// The pixels whose samples the triangle's bounds hold: [x0, x1) × [y0, y1), not empty.
    pub(crate) x0: i32,
    pub(crate) y0: i32,
    pub(crate) x1: i32,
    pub(crate) y1: i32,
    pub(crate) depth: DepthPlane,
}

/// Depth is a linear function of the place on the screen: it is z/w already, so it needs no correction (RA-2).
///
/// It is evaluated as (z + dy·y) + dx·x with x and y counted from the corner of the bounds within the tile, and
/// cut off at the corners' least and greatest depth: a sliver's plane is steep, and beside the sliver it means nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DepthPlane {
    pub(crate) z: f32,
    pub(crate) dx: f32,
    pub(crate) dy: f32,
    pub(crate) least: f32,
    pub(crate) greatest: f32,
}

impl Setup {
    /// Prepares a triangle for the samples at `offset` (grid steps) from the upper left corners of their pixels; `None` if
    /// its bounds hold none of the tile's samples.
    pub(crate) fn new(piece: &Piece, tile: TileRect, offset: (i64, i64)) -> Option<Self> {
        let [p, q, r] = piece.corners;
        let (left, right) = (p.x.min(q.x).min(r.x), p.x.max(q.x).max(r.x));
        let (top, bottom) = (p.y.min(q.y).min(r.y), p.y.max(q.y).max(r.y));
        let origin = (
            i64::from(tile.x0) * i64::from(SUBPIXELS) + offset.0,
            i64::from(tile.y0) * i64::from(SUBPIXELS) + offset.1,
        );
        // The first sample at or right of (below) a bound, and the first beyond one.
        let first = |bound: i32, from: i64| (i64::from(bound) - from + 255) >> SUBPIXEL_BITS;
        let beyond = |bound: i32, from: i64| ((i64::from(bound) - from) >> SUBPIXEL_BITS) + 1;
        let x0 = first(left, origin.0).max(0) as i32;
        let y0 = first(top, origin.1).max(0) as i32;
        let x1 = beyond(right, origin.0).min(tile.width() as i64) as i32;
        let y1 = beyond(bottom, origin.1).min(tile.height() as i64) as i32;
        if x0 >= x1 || y0 >= y1 {
            return None;
        }
        let edges = [Edge::new(p, q), Edge::new(q, r), Edge::new(r, p)];
        let limit = 1_i64 << 30;
        let quotient = |edge: &Edge| {
            (edge.at(origin.0, origin.1) >> SUBPIXEL_BITS).clamp(-limit, limit) as i32
        };
        let corner = (
            origin.0 + i64::from(x0) * i64::from(SUBPIXELS),
            origin.1 + i64::from(y0) * i64::from(SUBPIXELS),
        );
        Some(Self {
            e: [quotient(&edges[0]), quotient(&edges[1]), quotient(&edges[2])],
            a: [edges[0].a as i32, edges[1].a as i32, edges[2].a as i32],
            b: [edges[0].b as i32, edges[1].b as i32, edges[2].b as i32],
            x0,
            y0,
            x1,
            y1,
            depth: DepthPlane::new(piece, corner),
        })
    }
}

impl DepthPlane {
    fn new(piece: &Piece, corner: (i64, i64)) -> Self {
        let [p, q, r] = piece.corners;
        let d = |a: i32, b: i32| f64::from(a) - f64::from(b);
        let (qx, qy, qz) = (d(q.x, p.x), d(q.y, p.y), f64::from(q.depth) - f64::from(p.depth));
        let (rx, ry, rz) = (d(r.x, p.x), d(r.y, p.y), f64::from(r.depth) - f64::from(p.depth));
        let per_area = 1.0 / (qx * ry - qy * rx);
        let dx = (qz * ry - rz * qy) * per_area;
        let dy = (rz * qx - qz * rx) * per_area;
        let (x, y) = ((corner.0 - i64::from(p.x)) as f64, (corner.1 - i64::from(p.y)) as f64);
        let step = f64::from(SUBPIXELS);
        Self {
            z: (f64::from(p.depth) + dx * x + dy * y) as f32,
            dx: (dx * step) as f32,
            dy: (dy * step) as f32,
            least: p.depth.min(q.depth).min(r.depth),
            greatest: p.depth.max(q.depth).max(r.depth),
        }
    }
}
