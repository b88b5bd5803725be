//! Fragments: what of a primitive shows in one pixel, ready for shading.

use crate::edge::Edge;
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
    areas: [f32; 3],
    weigher: &'a Weigher<'a>,
}

impl Fragment<'_> {
    /// The corners' shares one pixel to the right, beyond the primitive's borders too; the same as here where its plane has
    /// its horizon.
    #[must_use]
    pub fn weights_right(&self) -> [f32; 3] {
        self.weights_beside(|edge| edge.a)
    }

    /// The corners' shares one pixel below, beyond the primitive's borders too; the same as here where its plane has its
    /// horizon.
    #[must_use]
    pub fn weights_below(&self) -> [f32; 3] {
        self.weights_beside(|edge| edge.b)
    }

    fn weights_beside(&self, step: impl Fn(&Edge) -> i64) -> [f32; 3] {
        let Weigher { edges, .. } = self.weigher;
        let pixel = SUBPIXELS as f32;
        let there = [0, 1, 2].map(|k| self.areas[k] + step(&edges[k]) as f32 * pixel);
        let weights = self.weigher.weights(there);
        if weights.iter().all(|weight| weight.is_finite()) { weights } else { self.weights }
    }
}

/// A triangle prepared for finding weights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weigher<'a> {
    id: u32,
    edges: [Edge; 3],
    inv_w: [f32; 3],
    source: Option<&'a SourceWeights>,
}

impl<'a> Weigher<'a> {
    pub(crate) fn new(piece: &Piece, source_weights: &'a [SourceWeights]) -> Self {
        let [p, q, r] = piece.corners;
        let source = piece.weights.checked_sub(1).map(|n| &source_weights[n as usize]);
        Self {
            id: piece.id,
            // Edge k lies opposite of corner k, so that E_k is proportional to the corner's share.
            edges: [Edge::new(q, r), Edge::new(r, p), Edge::new(p, q)],
            inv_w: [p.inv_w, q.inv_w, r.inv_w],
            source,
        }
    }

    /// The fragment at the centre of pixel (x, y).
    #[inline]
    pub(crate) fn fragment(&self, x: u32, y: u32) -> Fragment<'_> {
        let center =
            |pixel: u32| i64::from(pixel) * i64::from(SUBPIXELS) + i64::from(SUBPIXELS / 2);
        let (cx, cy) = (center(x), center(y));
        let areas = self.edges.map(|edge| edge.area_at(cx, cy) as f32);
        // With the centre outside, the nearest place is near enough: its share of a corner just does not go below 0.
        let weights = self.weights(areas.map(|area| area.max(0.0)));
        Fragment { id: self.id, x, y, weights, areas, weigher: self }
    }

    /// Shares in the source primitive from shares of area on the screen (IN-2).
    #[inline]
    fn weights(&self, areas: [f32; 3]) -> [f32; 3] {
        let shares = [0, 1, 2].map(|k| areas[k] * self.inv_w[k]);
        let per_sum = 1.0 / (shares[0] + shares[1] + shares[2]);
        let shares = shares.map(|share| share * per_sum);
        let Some(source) = self.source else { return shares };
        [0, 1, 2]
            .map(|k| shares[0] * source[0][k] + shares[1] * source[1][k] + shares[2] * source[2][k])
    }
}
