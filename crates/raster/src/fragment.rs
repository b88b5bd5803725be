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

/// Eight pieces at the centres of eight neighbouring pixels: the same as eight fragments, bit for bit, and several times as
/// fast to find, for the loops over the lanes become vector instructions.
pub(crate) struct FragmentRow<'a> {
    pieces: [&'a Piece; 8],
    source_weights: &'a [SourceWeights],
    x: u32,
    y: u32,
    areas: [[f32; 8]; 3],
    shares: [[f32; 8]; 3],
}

impl<'a> FragmentRow<'a> {
    /// The pieces at the pixels from (x, y) to the right.
    #[inline(always)]
    pub(crate) fn new(
        pieces: [&'a Piece; 8],
        source_weights: &'a [SourceWeights],
        x: u32,
        y: u32,
    ) -> Self {
        let same = pieces.iter().all(|piece| std::ptr::eq(*piece, pieces[0]));
        let (cx, cy) = (center(x), center(y));
        let corners = if same {
            Corners::of_one(pieces[0], cx, cy)
        } else {
            Corners::of_each(pieces, cx, cy)
        };
        let areas = corners.areas();
        let shares = corners.shares(&areas);
        Self { pieces, source_weights, x, y, areas, shares }
    }

    /// The fragment of one of the pixels.
    #[inline(always)]
    pub(crate) fn lane(&self, lane: usize) -> Fragment<'a> {
        let piece = self.pieces[lane];
        let [a, b, c] = &self.areas;
        let [p, q, r] = &self.shares;
        let weights = in_source(piece, self.source_weights, [p[lane], q[lane], r[lane]]);
        Fragment {
            id: piece.id,
            x: self.x + lane as u32,
            y: self.y,
            weights,
            areas: [a[lane], b[lane], c[lane]],
            piece,
            source_weights: self.source_weights,
        }
    }
}

/// The corners of the pieces of eight pixels of a row: how far they are from the pixels' centres, and 1/w.
///
/// Plain loops everywhere: closures over arrays are not always taken into the function that has the vector instructions.
struct Corners {
    dx: [[f64; 8]; 3],
    dy: [[f64; 8]; 3],
    inv_w: [[f32; 8]; 3],
}

impl Corners {
    const NONE: Self = Self { dx: [[0.0; 8]; 3], dy: [[0.0; 8]; 3], inv_w: [[0.0; 8]; 3] };

    /// All pixels show one piece, the usual case, and nothing has to be gathered.
    #[inline(always)]
    fn of_one(piece: &Piece, x: i32, y: i32) -> Self {
        let mut corners = Self::NONE;
        for (k, corner) in piece.corners.iter().enumerate() {
            let first = f64::from(corner.x - x);
            for (lane, dx) in corners.dx[k].iter_mut().enumerate() {
                *dx = first - f64::from(lane as i32 * SUBPIXELS);
            }
            corners.dy[k] = [f64::from(corner.y - y); 8];
            corners.inv_w[k] = [corner.inv_w; 8];
        }
        corners
    }

    #[inline(always)]
    fn of_each(pieces: [&Piece; 8], x: i32, y: i32) -> Self {
        let mut corners = Self::NONE;
        for (lane, piece) in pieces.iter().enumerate() {
            for (k, corner) in piece.corners.iter().enumerate() {
                corners.dx[k][lane] = f64::from(corner.x - (x + lane as i32 * SUBPIXELS));
                corners.dy[k][lane] = f64::from(corner.y - y);
                corners.inv_w[k][lane] = corner.inv_w;
            }
        }
        corners
    }

    /// [`areas`] for each pixel. Products and differences of grid coordinates are exact in double precision.
    #[inline(always)]
    fn areas(&self) -> [[f32; 8]; 3] {
        let Self { dx, dy, .. } = self;
        let mut areas = [[0.0_f32; 8]; 3];
        for (area, (a, b)) in areas.iter_mut().zip([(1, 2), (2, 0), (0, 1)]) {
            for (lane, area) in area.iter_mut().enumerate() {
                *area = (dx[a][lane] * dy[b][lane] - dy[a][lane] * dx[b][lane]) as f32;
            }
        }
        areas
    }

    /// [`shares`] for each pixel, of the areas that are not negative.
    #[inline(always)]
    fn shares(&self, areas: &[[f32; 8]; 3]) -> [[f32; 8]; 3] {
        let mut shares = self.inv_w;
        for (share, area) in shares.iter_mut().zip(areas) {
            for (share, area) in share.iter_mut().zip(area) {
                *share *= area.max(0.0);
            }
        }
        let mut per_sum = [0.0_f32; 8];
        for (lane, per) in per_sum.iter_mut().enumerate() {
            *per = 1.0 / (shares[0][lane] + shares[1][lane] + shares[2][lane]);
        }
        for share in &mut shares {
            for (share, per) in share.iter_mut().zip(per_sum) {
                *share *= per;
            }
        }
        shares
    }
}

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
