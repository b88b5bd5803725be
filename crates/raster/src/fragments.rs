//! Eight fragments at once: what [`Fragment`](crate::Fragment) is to one pixel, bit for bit, and several times as fast.
//!
//! Everything here is a plain loop over eight lanes and is made part of the function that calls it, which is compiled for
//! the processor's vector instructions. (Closures over arrays are not always taken along.)

use crate::Fragment;
use crate::fragment::{center, steps_down, steps_right};
use crate::primitive::{Piece, Source, SourceWeights};
use crate::vertex::SUBPIXELS;

/// The fragments that are shaded at once.
pub const WIDE: usize = 8;

/// One number for each of eight fragments.
pub type Eight = [f32; WIDE];

/// Eight fragments of one row of pixels, to be shaded at once.
///
/// There are always eight: where fewer are to be shaded, the others repeat one of them, and nobody looks at their colours.
/// They need not be neighbours, nor of one primitive.
#[derive(Clone, Copy, Debug)]
pub struct Fragments<'a> {
    /// The pixels' columns.
    pub x: [u32; WIDE],
    /// The pixels' row, from the top.
    pub y: u32,
    /// Whether all are fragments of one piece, in pixels side by side.
    one: bool,
    pieces: [&'a Piece; WIDE],
    source_weights: &'a [SourceWeights],
}

impl<'a> Fragments<'a> {
    /// One piece in eight pixels from (x, y) to the right.
    #[inline(always)]
    pub(crate) fn of_one(
        piece: &'a Piece,
        source_weights: &'a [SourceWeights],
        first: u32,
        y: u32,
    ) -> Self {
        let mut x = [first; WIDE];
        for (lane, x) in x.iter_mut().enumerate() {
            *x += lane as u32;
        }
        Self { x, y, one: true, pieces: [piece; WIDE], source_weights }
    }

    /// Any eight pieces, each in a pixel of its own.
    #[inline(always)]
    pub(crate) fn of_each(
        pieces: [&'a Piece; WIDE],
        source_weights: &'a [SourceWeights],
        x: [u32; WIDE],
        y: u32,
    ) -> Self {
        Self { x, y, one: false, pieces, source_weights }
    }

    /// The name that the primitive of one of the fragments was submitted with; `lane` is 0 to 7.
    #[inline(always)]
    #[must_use]
    pub const fn id(&self, lane: usize) -> u32 {
        self.pieces[lane].id
    }

    /// Whether all are known to be fragments of one primitive, so that what its corners carry need be fetched only once.
    #[inline(always)]
    #[must_use]
    pub const fn are_of_one(&self) -> bool {
        self.one
    }

    /// The corners' shares in the eight fragments.
    #[inline(always)]
    #[must_use]
    pub fn weights(&self) -> Weights<'a> {
        let corners = if self.one {
            Corners::of_one(self.pieces[0], self.x[0], self.y)
        } else {
            Corners::of_each(self.pieces, &self.x, self.y)
        };
        let (shares, per_sum) = corners.shares();
        let Self { one, pieces, source_weights, .. } = *self;
        let here = in_source(one, pieces, source_weights, shares);
        Weights { here, shares, per_sum, one, pieces, source_weights }
    }

    /// One of the fragments, `lane` from 0 to 7, with the weights of all.
    #[inline(always)]
    #[must_use]
    pub fn lane(&self, lane: usize, weights: &Weights<'a>) -> Fragment<'a> {
        let of_lane = |[p, q, r]: &[Eight; 3]| [p[lane], q[lane], r[lane]];
        Fragment {
            id: self.id(lane),
            x: self.x[lane],
            y: self.y,
            weights: of_lane(&weights.here),
            shares: of_lane(&weights.shares),
            per_sum: weights.per_sum[lane],
            piece: self.pieces[lane],
            source_weights: self.source_weights,
        }
    }
}

/// For each corner its shares in eight fragments, and how they change across the picture.
#[derive(Clone, Copy, Debug)]
pub struct Weights<'a> {
    /// The shares at the fragments: see [`Fragment::weights`].
    pub here: [Eight; 3],
    one: bool,
    shares: [Eight; 3],
    per_sum: Eight,
    pieces: [&'a Piece; WIDE],
    source_weights: &'a [SourceWeights],
}

impl Weights<'_> {
    /// The derivatives of the weights by the pixel's column: see [`Fragment::weights_dx`].
    #[inline(always)]
    #[must_use]
    pub fn dx(&self) -> [Eight; 3] {
        self.along(steps_right)
    }

    /// The derivatives of the weights by the pixel's row, downwards.
    #[inline(always)]
    #[must_use]
    pub fn dy(&self) -> [Eight; 3] {
        self.along(steps_down)
    }

    #[inline(always)]
    fn along(&self, steps_of: impl Fn(&Piece) -> [f32; 3]) -> [Eight; 3] {
        let mut steps = [[0.0; WIDE]; 3];
        if self.one {
            let of_all = steps_of(self.pieces[0]);
            for (steps, step) in steps.iter_mut().zip(of_all) {
                *steps = [step; WIDE];
            }
        } else {
            for (lane, piece) in self.pieces.iter().enumerate() {
                let [p, q, r] = steps_of(piece);
                steps[0][lane] = p;
                steps[1][lane] = q;
                steps[2][lane] = r;
            }
        }
        let mut sum = [0.0; WIDE];
        for (lane, sum) in sum.iter_mut().enumerate() {
            *sum = steps[0][lane] + steps[1][lane] + steps[2][lane];
        }
        for (steps, shares) in steps.iter_mut().zip(&self.shares) {
            for (lane, step) in steps.iter_mut().enumerate() {
                *step = (*step - shares[lane] * sum[lane]) * self.per_sum[lane];
            }
        }
        in_source(self.one, self.pieces, self.source_weights, steps)
    }
}

/// Shares of the source primitives' corners from those of the pieces'.
#[inline(always)]
fn in_source(
    one: bool,
    pieces: [&Piece; WIDE],
    source_weights: &[SourceWeights],
    [p, q, r]: [Eight; 3],
) -> [Eight; 3] {
    if one {
        match pieces[0].source {
            Source::Whole => return [p, q, r],
            Source::Turned => return [p, r, q],
            Source::Weights(_) => {}
        }
    }
    let mut turned = [p, r, q];
    let mut is_cut = false;
    for lane in 0..WIDE {
        let source = pieces[lane].source;
        is_cut |= matches!(source, Source::Weights(_));
        if source == Source::Whole {
            turned[1][lane] = q[lane];
            turned[2][lane] = r[lane];
        }
    }
    if is_cut {
        return of_cut_pieces(pieces, source_weights, [p, q, r], turned);
    }
    turned
}

/// Puts the shares of those pieces right that clipping has left.
#[cold]
fn of_cut_pieces(
    pieces: [&Piece; WIDE],
    source_weights: &[SourceWeights],
    [p, q, r]: [Eight; 3],
    mut shares: [Eight; 3],
) -> [Eight; 3] {
    for lane in 0..WIDE {
        let Source::Weights(entry) = pieces[lane].source else { continue };
        let [at_p, at_q, at_r] = source_weights[entry as usize];
        for (k, shares) in shares.iter_mut().enumerate() {
            shares[lane] = p[lane] * at_p[k] + q[lane] * at_q[k] + r[lane] * at_r[k];
        }
    }
    shares
}

/// The corners of the pieces of eight pixels: how far they are from the pixels' centres, and 1/w.
struct Corners {
    dx: [[f64; WIDE]; 3],
    dy: [[f64; WIDE]; 3],
    inv_w: [Eight; 3],
}

impl Corners {
    const NONE: Self = Self { dx: [[0.0; WIDE]; 3], dy: [[0.0; WIDE]; 3], inv_w: [[0.0; WIDE]; 3] };

    /// One piece in eight pixels side by side, and nothing has to be gathered.
    #[inline(always)]
    fn of_one(piece: &Piece, x: u32, y: u32) -> Self {
        let mut corners = Self::NONE;
        let (cx, cy) = (center(x), center(y));
        for (k, corner) in piece.corners.iter().enumerate() {
            let first = f64::from(corner.x - cx);
            for (lane, dx) in corners.dx[k].iter_mut().enumerate() {
                *dx = first - f64::from(lane as i32 * SUBPIXELS);
            }
            corners.dy[k] = [f64::from(corner.y - cy); WIDE];
            corners.inv_w[k] = [corner.inv_w(); WIDE];
        }
        corners
    }

    #[inline(always)]
    fn of_each(pieces: [&Piece; WIDE], x: &[u32; WIDE], y: u32) -> Self {
        let mut corners = Self::NONE;
        let cy = center(y);
        for lane in 0..WIDE {
            let (piece, cx) = (pieces[lane], center(x[lane]));
            for (k, corner) in piece.corners.iter().enumerate() {
                corners.dx[k][lane] = f64::from(corner.x - cx);
                corners.dy[k][lane] = f64::from(corner.y - cy);
                corners.inv_w[k][lane] = corner.inv_w();
            }
        }
        corners
    }

    /// Each corner's share, and what the parts were multiplied by so that they add up to 1 (IN-2). Products and differences of
    /// grid coordinates are exact in double precision.
    #[inline(always)]
    fn shares(&self) -> ([Eight; 3], Eight) {
        let Self { dx, dy, inv_w } = self;
        let mut shares = *inv_w;
        for (share, (a, b)) in shares.iter_mut().zip([(1, 2), (2, 0), (0, 1)]) {
            for (lane, share) in share.iter_mut().enumerate() {
                let area = (dx[a][lane] * dy[b][lane] - dy[a][lane] * dx[b][lane]) as f32;
                // With the centre outside, the nearest place is near enough: no share goes below 0.
                *share *= area.max(0.0);
            }
        }
        let mut per_sum = [0.0_f32; WIDE];
        for (lane, per) in per_sum.iter_mut().enumerate() {
            *per = 1.0 / (shares[0][lane] + shares[1][lane] + shares[2][lane]);
        }
        for share in &mut shares {
            for (share, per) in share.iter_mut().zip(per_sum) {
                *share *= per;
            }
        }
        (shares, per_sum)
    }
}
