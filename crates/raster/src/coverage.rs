//! Coverage: which samples of a tile a triangle covers, and its depth there.

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
    pub(crate) fn width(&self) -> usize {
        (self.x1 - self.x0) as usize
    }

    pub(crate) fn height(&self) -> usize {
        (self.y1 - self.y0) as usize
    }
}

/// A triangle prepared for being filled.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Filler {
    edges: [Edge; 3],
    depth: DepthPlane,
    bounds: [i64; 4],
}

impl Filler {
    pub(crate) fn new(piece: &Piece) -> Self {
        let [p, q, r] = piece.corners;
        let edges = [Edge::new(p, q), Edge::new(q, r), Edge::new(r, p)];
        let least = |a: i32, b: i32, c: i32| i64::from(a.min(b).min(c));
        let most = |a: i32, b: i32, c: i32| i64::from(a.max(b).max(c));
        let bounds =
            [least(p.x, q.x, r.x), least(p.y, q.y, r.y), most(p.x, q.x, r.x), most(p.y, q.y, r.y)];
        Self { edges, depth: DepthPlane::new(piece), bounds }
    }

    /// Calls `run(row, columns, depth at the first of them, depth step)` for each run of covered samples in `tile`,
    /// of the samples that lie at `offset` (grid steps) from the upper left corner of their pixels.
    pub(crate) fn runs(
        &self,
        tile: TileRect,
        offset: (i64, i64),
        mut run: impl FnMut(usize, core::ops::Range<usize>, f64, f64),
    ) {
        let [left, top, right, bottom] = self.bounds;
        // Samples with left <= x <= right: the first at or right of the bound, the last at or left of it.
        let first = |bound: i64, offset: i64| (bound - offset + 255) >> SUBPIXEL_BITS;
        let last = |bound: i64, offset: i64| (bound - offset) >> SUBPIXEL_BITS;
        let x0 = first(left, offset.0).max(i64::from(tile.x0));
        let x1 = (last(right, offset.0) + 1).min(i64::from(tile.x1));
        let y0 = first(top, offset.1).max(i64::from(tile.y0));
        let y1 = (last(bottom, offset.1) + 1).min(i64::from(tile.y1));
        let step = i64::from(SUBPIXELS);
        let sample_x = x0 * step + offset.0;
        for y in y0..y1 {
            let sample_y = y * step + offset.1;
            let mut span = (0, x1 - x0);
            for edge in &self.edges {
                edge.narrow(edge.at(sample_x, sample_y), step, &mut span);
            }
            if span.0 < span.1 {
                let depth = self.depth.at(sample_x + span.0 * step, sample_y);
                let column = (x0 - i64::from(tile.x0) + span.0) as usize;
                let columns = column..column + (span.1 - span.0) as usize;
                run((y - i64::from(tile.y0)) as usize, columns, depth, self.depth.dx * step as f64);
            }
        }
    }
}

/// Depth as a linear function of the place on the screen: it is z/w already, so it needs no correction (RA-2).
#[derive(Clone, Copy, Debug)]
struct DepthPlane {
    origin: (i64, i64),
    depth: f64,
    dx: f64,
    dy: f64,
}

impl DepthPlane {
    fn new(piece: &Piece) -> Self {
        let [p, q, r] = piece.corners;
        let d = |a: i32, b: i32| f64::from(a) - f64::from(b);
        let (qx, qy, qz) = (d(q.x, p.x), d(q.y, p.y), f64::from(q.depth) - f64::from(p.depth));
        let (rx, ry, rz) = (d(r.x, p.x), d(r.y, p.y), f64::from(r.depth) - f64::from(p.depth));
        let area = qx * ry - qy * rx;
        Self {
            origin: (i64::from(p.x), i64::from(p.y)),
            depth: f64::from(p.depth),
            dx: (qz * ry - rz * qy) / area,
            dy: (rz * qx - qz * rx) / area,
        }
    }

    fn at(&self, x: i64, y: i64) -> f64 {
        self.depth + self.dx * (x - self.origin.0) as f64 + self.dy * (y - self.origin.1) as f64
    }
}

/// The tile in the given column and row of a picture.
pub(crate) fn tile_rect(column: u32, row: u32, width: u32, height: u32) -> TileRect {
    let (x0, y0) = (column * TILE, row * TILE);
    TileRect { x0, y0, x1: (x0 + TILE).min(width), y1: (y0 + TILE).min(height) }
}
