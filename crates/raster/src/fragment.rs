//! Fragments: what of a primitive shows in one pixel, ready for shading.

use crate::ScreenVertex;
use crate::primitive::{Piece, Source, SourceWeights};
use crate::vertex::SUBPIXELS;

/// A primitive at one pixel.
///
/// A value that the corners of the primitive carry is, at the pixel's centre, the sum of the corners' values times
/// [`weights`](Self::weights); they are perspective-correct (IN-2). What it is one pixel to the right and one below, texture
/// filters can ask for: [`weights_right`](Self::weights_right), [`weights_below`](Self::weights_below).
#[derive(Clone, Copy, Debug)]
pub struct Fragment<'a> {
    /// The name the primitive was submitted with.
    pub id: u32,
    /// The pixel's column.
    pub x: u32,
    /// The pixel's row, from the top.
    pub y: u32,
    /// The corners' shares at the pixel's centre (or, where that is outside, at the nearest place inside).
    /// None is negative, and they add up to 1.
    pub weights: [f32; 3],
    /// Twice the areas between the pixel's centre and the side opposite of each corner, negative beyond the side.
    areas: [f32; 3],
    piece: &'a Piece,
    source_weights: &'a [SourceWeights],
}

impl<'a> Fragment<'a> {
    /// The piece at the centre of pixel (x, y).
    #[inline]
    pub(crate) fn new(
        piece: &'a Piece,
        source_weights: &'a [SourceWeights],
        x: u32,
        y: u32,
    ) -> Self {
        let areas = areas(piece.corners, center(x), center(y));
        // With the centre outside, the nearest place is near enough: its share of a corner just does not go below 0.
        let shares = shares(piece, areas.map(|area| area.max(0.0)));
        let weights = in_source(piece, source_weights, shares);
        Self { id: piece.id, x, y, weights, areas, piece, source_weights }
    }

    /// Eight pieces at the centres of eight neighbouring pixels, from (x, y) to the right: the same as eight times
    /// [`new`](Self::new), bit for bit, and several times as fast, for the loops over the lanes become vector instructions.
    #[inline(always)]
    pub(crate) fn row(
        pieces: [&'a Piece; 8],
        source_weights: &'a [SourceWeights],
        x: u32,
        y: u32,
    ) -> [Self; 8] {
        let areas = areas_of_row(pieces, center(x), center(y));
        let inv_w = |corner: usize| pieces.map(|piece| piece.corners[corner].inv_w);
        let mut shares = [0, 1, 2].map(|k| {
            let inv_w = inv_w(k);
            LANES.map(|lane| areas[k][lane].max(0.0) * inv_w[lane])
        });
        let per_sum = LANES.map(|lane| 1.0 / (shares[0][lane] + shares[1][lane] + shares[2][lane]));
        for share in &mut shares {
            *share = LANES.map(|lane| share[lane] * per_sum[lane]);
        }
        LANES.map(|lane| {
            let piece = pieces[lane];
            let weights = in_source(piece, source_weights, shares.map(|share| share[lane]));
            let areas = areas.map(|area| area[lane]);
            Self { id: piece.id, x: x + lane as u32, y, weights, areas, piece, source_weights }
        })
    }

    /// The corners' shares one pixel to the right, beyond the primitive's borders too; the same as here where its plane has
    /// its horizon.
    #[must_use]
    pub fn weights_right(&self) -> [f32; 3] {
        let [p, q, r] = self.piece.corners;
        self.weights_beside([q.y - r.y, r.y - p.y, p.y - q.y])
    }

    /// The corners' shares one pixel below, beyond the primitive's borders too; the same as here where its plane has its
    /// horizon.
    #[must_use]
    pub fn weights_below(&self) -> [f32; 3] {
        let [p, q, r] = self.piece.corners;
        self.weights_beside([r.x - q.x, p.x - r.x, q.x - p.x])
    }

    fn weights_beside(&self, steps: [i32; 3]) -> [f32; 3] {
        let pixel = SUBPIXELS as f32;
        let there = [0, 1, 2].map(|k| self.areas[k] + steps[k] as f32 * pixel);
        let weights = in_source(self.piece, self.source_weights, shares(self.piece, there));
        if weights.iter().all(|weight| weight.is_finite()) { weights } else { self.weights }
    }
}

/// The grid position of a pixel's centre, in a row or in a column.
fn center(pixel: u32) -> i32 {
    pixel as i32 * SUBPIXELS + SUBPIXELS / 2
}

/// Twice the areas of the three triangles that a place makes with the sides of a piece, exact before they are rounded.
#[inline]
fn areas(corners: [ScreenVertex; 3], x: i32, y: i32) -> [f32; 3] {
    let [p, q, r] = corners.map(|v| (i64::from(v.x - x), i64::from(v.y - y)));
    let area = |a: (i64, i64), b: (i64, i64)| (a.0 * b.1 - a.1 * b.0) as f32;
    [area(q, r), area(r, p), area(p, q)]
}

/// [`areas`] for eight pixels of a row. Products and differences of grid coordinates are exact in double precision.
#[inline(always)]
fn areas_of_row(pieces: [&Piece; 8], x: i32, y: i32) -> [[f32; 8]; 3] {
    let away = [0, 1, 2].map(|k: usize| {
        let dx = LANES.map(|lane| pieces[lane].corners[k].x - (x + lane as i32 * SUBPIXELS));
        let dy = LANES.map(|lane| pieces[lane].corners[k].y - y);
        (dx.map(f64::from), dy.map(f64::from))
    });
    let area = |a: usize, b: usize| {
        let ((ax, ay), (bx, by)) = (&away[a], &away[b]);
        LANES.map(|lane| (ax[lane] * by[lane] - ay[lane] * bx[lane]) as f32)
    };
    [area(1, 2), area(2, 0), area(0, 1)]
}

/// The lanes of a row of eight pixels.
const LANES: [usize; 8] = [0, 1, 2, 3, 4, 5, 6, 7];

/// Shares of a piece's corners from shares of area on the screen (IN-2).
#[inline]
fn shares(piece: &Piece, areas: [f32; 3]) -> [f32; 3] {
    let shares = [0, 1, 2].map(|k| areas[k] * piece.corners[k].inv_w);
    let per_sum = 1.0 / (shares[0] + shares[1] + shares[2]);
    shares.map(|share| share * per_sum)
}

/// Shares of the source primitive's corners from those of a piece's.
#[inline]
fn in_source(piece: &Piece, source_weights: &[SourceWeights], [p, q, r]: [f32; 3]) -> [f32; 3] {
    match piece.source {
        Source::Whole => [p, q, r],
        Source::Turned => [p, r, q],
        Source::Weights(entry) => {
            let [at_p, at_q, at_r] = source_weights[entry as usize];
            [0, 1, 2].map(|k| p * at_p[k] + q * at_q[k] + r * at_r[k])
        }
    }
}
