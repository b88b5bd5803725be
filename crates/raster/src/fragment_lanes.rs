//! Eight fragments at once: what [`Fragment`] is to one pixel, bit for bit, and several times as fast.
//!
//! Everything here is a plain loop over eight lanes and is made part of the function that calls it, which is compiled for
//! the processor's vector instructions. (Closures over arrays are not always taken along.)

use crate::Fragment;
use crate::fragment::{pixel_center, weight_steps_x, weight_steps_y};
use crate::primitive::{ScreenTriangle, SourceWeights, WeightSource};
use crate::screen_vertex::SUBPIXELS;

/// The fragments that are shaded at once.
pub const LANES: usize = 8;

/// One number for each of eight fragments.
pub type F32x8 = [f32; LANES];

/// Eight fragments of one row of pixels, to be shaded at once.
///
/// There are always eight: where fewer are to be shaded, the others repeat one of them, and nobody looks at their colours.
/// They need not be neighbours, nor of one primitive.
#[derive(Clone, Copy, Debug)]
pub struct Fragments<'a> {
    /// The pixels' columns.
    pub x: [u32; LANES],
    /// The pixels' row, from the top.
    pub y: u32,
    /// Whether all are fragments of one piece, in pixels side by side.
    is_single: bool,
    triangles: [&'a ScreenTriangle; LANES],
    source_weights: &'a [SourceWeights],
}

impl<'a> Fragments<'a> {
    /// One piece in eight pixels from (x, y) to the right.
    #[inline(always)]
    pub(crate) fn from_one_triangle(
        piece: &'a ScreenTriangle,
        source_weights: &'a [SourceWeights],
        first: u32,
        y: u32,
    ) -> Self {
        let mut x = [first; LANES];
        for (lane, x) in x.iter_mut().enumerate() {
            *x += lane as u32;
        }
        Self { x, y, is_single: true, triangles: [piece; LANES], source_weights }
    }

    /// Any eight pieces, each in a pixel of its own.
    #[inline(always)]
    pub(crate) fn from_triangles(
        triangles: [&'a ScreenTriangle; LANES],
        source_weights: &'a [SourceWeights],
        x: [u32; LANES],
        y: u32,
    ) -> Self {
        Self { x, y, is_single: false, triangles: triangles, source_weights }
    }

    /// The name that the primitive of one of the fragments was submitted with; `lane` is 0 to 7.
    #[inline(always)]
    #[must_use]
    pub const fn id(&self, lane: usize) -> u32 {
        self.triangles[lane].id
    }

    /// Whether all are known to be fragments of one primitive, so that what its corners carry need be fetched only once.
    #[inline(always)]
    #[must_use]
    pub const fn is_single_primitive(&self) -> bool {
        self.is_single
    }

    /// The corners' shares in the eight fragments.
    #[inline(always)]
    #[must_use]
    pub fn weights(&self) -> WeightLanes<'a> {
        let corners = if self.is_single {
            VertexLanes::from_one_triangle(self.triangles[0], self.x[0], self.y)
        } else {
            VertexLanes::from_triangles(self.triangles, &self.x, self.y)
        };
        let (shares, per_sum) = corners.barycentric_weights();
        let Self { is_single: one, triangles: pieces, source_weights, .. } = *self;
        let here = to_source_weights(one, pieces, source_weights, shares);
        WeightLanes { values: here, shares, per_sum, is_single: one, pieces, source_weights }
    }

    /// One of the fragments, `lane` from 0 to 7, with the weights of all.
    #[inline(always)]
    #[must_use]
    pub fn fragment(&self, lane: usize, weights: &WeightLanes<'a>) -> Fragment<'a> {
        let of_lane = |[p, q, r]: &[F32x8; 3]| [p[lane], q[lane], r[lane]];
        Fragment {
            id: self.id(lane),
            x: self.x[lane],
            y: self.y,
            weights: of_lane(&weights.values),
            barycentrics: of_lane(&weights.shares),
            inv_sum: weights.per_sum[lane],
            triangle: self.triangles[lane],
            source_weights: self.source_weights,
        }
    }
}

/// For each corner its shares in eight fragments, and how they change across the picture.
#[derive(Clone, Copy, Debug)]
pub struct WeightLanes<'a> {
    /// The shares at the fragments: see [`Fragment::weights`].
    pub values: [F32x8; 3],
    is_single: bool,
    shares: [F32x8; 3],
    per_sum: F32x8,
    pieces: [&'a ScreenTriangle; LANES],
    source_weights: &'a [SourceWeights],
}

impl WeightLanes<'_> {
    /// The derivatives of the weights by the pixel's column: see [`Fragment::weights_dx`].
    #[inline(always)]
    #[must_use]
    pub fn dx(&self) -> [F32x8; 3] {
        self.derivatives(weight_steps_x)
    }

    /// The derivatives of the weights by the pixel's row, downwards.
    #[inline(always)]
    #[must_use]
    pub fn dy(&self) -> [F32x8; 3] {
        self.derivatives(weight_steps_y)
    }

    #[inline(always)]
    fn derivatives(&self, steps_of: impl Fn(&ScreenTriangle) -> [f32; 3]) -> [F32x8; 3] {
        let mut steps = [[0.0; LANES]; 3];
        if self.is_single {
            let of_all = steps_of(self.pieces[0]);
            for (steps, step) in steps.iter_mut().zip(of_all) {
                *steps = [step; LANES];
            }
        } else {
            for (lane, piece) in self.pieces.iter().enumerate() {
                let [p, q, r] = steps_of(piece);
                steps[0][lane] = p;
                steps[1][lane] = q;
                steps[2][lane] = r;
            }
        }
        let mut sum = [0.0; LANES];
        for (lane, sum) in sum.iter_mut().enumerate() {
            *sum = steps[0][lane] + steps[1][lane] + steps[2][lane];
        }
        for (steps, shares) in steps.iter_mut().zip(&self.shares) {
            for (lane, step) in steps.iter_mut().enumerate() {
                *step = (*step - shares[lane] * sum[lane]) * self.per_sum[lane];
            }
        }
        to_source_weights(self.is_single, self.pieces, self.source_weights, steps)
    }
}

/// Shares of the source primitives' corners from those of the pieces'.
#[inline(always)]
fn to_source_weights(
    one: bool,
    pieces: [&ScreenTriangle; LANES],
    source_weights: &[SourceWeights],
    [p, q, r]: [F32x8; 3],
) -> [F32x8; 3] {
    if one {
        match pieces[0].source {
            WeightSource::Unclipped => return [p, q, r],
            WeightSource::Flipped => return [p, r, q],
            WeightSource::Clipped(_) => {}
        }
    }
    let mut turned = [p, r, q];
    let mut is_cut = false;
    for lane in 0..LANES {
        let source = pieces[lane].source;
        is_cut |= matches!(source, WeightSource::Clipped(_));
        if source == WeightSource::Unclipped {
            turned[1][lane] = q[lane];
            turned[2][lane] = r[lane];
        }
    }
    if is_cut {
        return clipped_source_weights(pieces, source_weights, [p, q, r], turned);
    }
    turned
}

/// Puts the shares of those pieces right that clipping has left.
#[cold]
fn clipped_source_weights(
    pieces: [&ScreenTriangle; LANES],
    source_weights: &[SourceWeights],
    [p, q, r]: [F32x8; 3],
    mut shares: [F32x8; 3],
) -> [F32x8; 3] {
    for lane in 0..LANES {
        let WeightSource::Clipped(entry) = pieces[lane].source else { continue };
        let [at_p, at_q, at_r] = source_weights[entry as usize];
        for (k, shares) in shares.iter_mut().enumerate() {
            shares[lane] = p[lane] * at_p[k] + q[lane] * at_q[k] + r[lane] * at_r[k];
        }
    }
    shares
}

/// The corners of the pieces of eight pixels: how far they are from the pixels' centres, and 1/w.
struct VertexLanes {
    dx: [[f64; LANES]; 3],
    dy: [[f64; LANES]; 3],
    inv_w: [F32x8; 3],
}

impl VertexLanes {
    const ZERO: Self =
        Self { dx: [[0.0; LANES]; 3], dy: [[0.0; LANES]; 3], inv_w: [[0.0; LANES]; 3] };

    /// One piece in eight pixels side by side, and nothing has to be gathered.
    #[inline(always)]
    fn from_one_triangle(piece: &ScreenTriangle, x: u32, y: u32) -> Self {
        let mut corners = Self::ZERO;
        let (cx, cy) = (pixel_center(x), pixel_center(y));
        for (k, corner) in piece.corners.iter().enumerate() {
            let first = f64::from(corner.x - cx);
            for (lane, dx) in corners.dx[k].iter_mut().enumerate() {
                *dx = first - f64::from(lane as i32 * SUBPIXELS);
            }
            corners.dy[k] = [f64::from(corner.y - cy); LANES];
            corners.inv_w[k] = [corner.inv_w(); LANES];
        }
        corners
    }

    #[inline(always)]
    fn from_triangles(pieces: [&ScreenTriangle; LANES], x: &[u32; LANES], y: u32) -> Self {
        let mut corners = Self::ZERO;
        let cy = pixel_center(y);
        for lane in 0..LANES {
            let (piece, cx) = (pieces[lane], pixel_center(x[lane]));
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
    fn barycentric_weights(&self) -> ([F32x8; 3], F32x8) {
        let Self { dx, dy, inv_w } = self;
        let mut shares = *inv_w;
        for (share, (a, b)) in shares.iter_mut().zip([(1, 2), (2, 0), (0, 1)]) {
            for (lane, share) in share.iter_mut().enumerate() {
                let area = (dx[a][lane] * dy[b][lane] - dy[a][lane] * dx[b][lane]) as f32;
                // With the centre outside, the nearest place is near enough: no share goes below 0.
                *share *= area.max(0.0);
            }
        }
        let mut per_sum = [0.0_f32; LANES];
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
