//! Fragments: what of a primitive shows in one pixel, ready for shading.

use crate::ScreenVertex;
use crate::primitive::{Piece, SourceWeights};
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
    source: Option<&'a SourceWeights>,
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
        let source = piece.weights.checked_sub(1).map(|n| &source_weights[n as usize]);
        let areas = areas(piece.corners, center(x), center(y));
        // With the centre outside, the nearest place is near enough: its share of a corner just does not go below 0.
        let weights = weights(piece, source, areas.map(|area| area.max(0.0)));
        Self { id: piece.id, x, y, weights, areas, piece, source }
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
        let weights = weights(self.piece, self.source, there);
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

/// Shares in the source primitive from shares of area on the screen (IN-2).
#[inline]
fn weights(piece: &Piece, source: Option<&SourceWeights>, areas: [f32; 3]) -> [f32; 3] {
    let shares = [0, 1, 2].map(|k| areas[k] * piece.corners[k].inv_w);
    let per_sum = 1.0 / (shares[0] + shares[1] + shares[2]);
    let shares = shares.map(|share| share * per_sum);
    let Some(source) = source else { return shares };
    [0, 1, 2]
        .map(|k| shares[0] * source[0][k] + shares[1] * source[1][k] + shares[2] * source[2][k])
}
