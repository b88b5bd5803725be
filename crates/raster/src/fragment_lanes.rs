//! Eight fragments at once, one per vector lane. The results are bit-identical to [`Fragment`], but
//! are computed several times as fast.
//!
//! Everything here is a plain loop over eight lanes, inlined into a function compiled for the
//! processor's vector instructions ([`SimdLevel::run_kernel`](crate::SimdLevel::run_kernel)). Loops
//! are written out, because closures over arrays (`map`, `from_fn`) are not always inlined, and one
//! call in the middle prevents vectorization.
//!
//! ```text
//!   areaₖ   = Δx_a Δy_b − Δy_a Δx_b          f64, exact: whole grid steps, 24 bits each
//!   weightₖ = areaₖ / wₖ · 1 / Σ (areaᵢ / wᵢ)  f32, perspective-correct (IN-2)
//! ```

use crate::Fragment;
use crate::fragment::{pixel_center, weight_steps_x, weight_steps_y};
use crate::primitive::{ScreenTriangle, SourceWeights, WeightSource};
use crate::screen_vertex::SUBPIXELS;

/// The number of fragments shaded at once.
pub const LANES: usize = 8;

/// One `f32` for each of eight fragments.
pub type F32x8 = [f32; LANES];

/// Eight fragments in one row of pixels, to be shaded at once.
///
/// There are always eight: if fewer are to be shaded, the other lanes repeat one of them, and their
/// colors are ignored. The fragments need not be adjacent or belong to one primitive.
#[derive(Clone, Copy, Debug)]
pub struct Fragments<'a> {
    /// The columns of the pixels.
    pub x: [u32; LANES],
    /// The row of the pixels, from the top.
    pub y: u32,
    /// Whether all are fragments of one triangle in adjacent pixels.
    ///
    /// This is set for runs of pixels covered by one triangle. It avoids gathering vertices and
    /// lets shading fetch attributes once.
    is_single: bool,
    /// The screen triangle of each fragment.
    triangles: [&'a ScreenTriangle; LANES],
    /// The frame's table of weights for triangles that are part of a clipped primitive.
    source_weights: &'a [SourceWeights],
}

impl<'a> Fragments<'a> {
    /// Creates the fragments of one triangle in eight pixels from (x, y) to the right.
    ///
    /// Pixels outside the triangle are allowed: their weights are clamped and their colors ignored.
    #[inline(always)]
    pub(crate) fn from_one_triangle(
        triangle: &'a ScreenTriangle,
        source_weights: &'a [SourceWeights],
        first: u32,
        y: u32,
    ) -> Self {
        let mut x = [first; LANES];
        for (lane, x) in x.iter_mut().enumerate() {
            *x += lane as u32;
        }
        Self { x, y, is_single: true, triangles: [triangle; LANES], source_weights }
    }

    /// Creates the fragments of any eight triangles, each in its own pixel.
    #[inline(always)]
    pub(crate) fn from_triangles(
        triangles: [&'a ScreenTriangle; LANES],
        source_weights: &'a [SourceWeights],
        x: [u32; LANES],
        y: u32,
    ) -> Self {
        Self { x, y, is_single: false, triangles, source_weights }
    }

    /// Returns the id with which a fragment's primitive was submitted; `lane` is from 0 to 7.
    #[inline(always)]
    #[must_use]
    pub const fn id(&self, lane: usize) -> u32 {
        self.triangles[lane].id
    }

    /// Returns whether all fragments are known to belong to one primitive, so that vertex
    /// attributes can be fetched once.
    #[inline(always)]
    #[must_use]
    pub const fn is_single_primitive(&self) -> bool {
        self.is_single
    }

    /// Returns the weights of the vertices in the eight fragments.
    ///
    /// They are perspective-correct and nonnegative, and the three weights in a lane add up to 1.
    #[inline(always)]
    #[must_use]
    pub fn weights(&self) -> WeightLanes<'a> {
        let vertices = if self.is_single {
            VertexLanes::from_one_triangle(self.triangles[0], self.x[0], self.y)
        } else {
            VertexLanes::from_triangles(self.triangles, &self.x, self.y)
        };
        let (barycentrics, inv_sum) = vertices.barycentric_weights();
        let Self { is_single, triangles, source_weights, .. } = *self;
        let values = to_source_weights(is_single, triangles, source_weights, barycentrics);
        WeightLanes { values, barycentrics, inv_sum, is_single, triangles, source_weights }
    }

    /// Returns one of the fragments, with `lane` from 0 to 7, given the weights of all fragments.
    ///
    /// The result is bit-identical to a fragment computed individually.
    #[inline(always)]
    #[must_use]
    pub fn fragment(&self, lane: usize, weights: &WeightLanes<'a>) -> Fragment<'a> {
        let of_lane = |[p, q, r]: &[F32x8; 3]| [p[lane], q[lane], r[lane]];
        Fragment {
            id: self.id(lane),
            x: self.x[lane],
            y: self.y,
            weights: of_lane(&weights.values),
            barycentrics: of_lane(&weights.barycentrics),
            inv_sum: weights.inv_sum[lane],
            triangle: self.triangles[lane],
            source_weights: self.source_weights,
        }
    }
}

/// The weights of the vertices in eight fragments, with their screen derivatives.
///
/// The derivatives are methods, so they are computed only if a surface calls them.
#[derive(Clone, Copy, Debug)]
pub struct WeightLanes<'a> {
    /// For each vertex, its weights at the fragments: see [`Fragment::weights`].
    pub values: [F32x8; 3],
    is_single: bool,
    /// The weights of the screen triangles' vertices.
    barycentrics: [F32x8; 3],
    /// The reciprocals of the sums by which the barycentric weights were normalized.
    inv_sum: F32x8,
    triangles: [&'a ScreenTriangle; LANES],
    source_weights: &'a [SourceWeights],
}

impl WeightLanes<'_> {
    /// Returns the derivatives of the weights with respect to the column: see
    /// [`Fragment::weights_dx`].
    #[inline(always)]
    #[must_use]
    pub fn dx(&self) -> [F32x8; 3] {
        self.derivatives(weight_steps_x)
    }

    /// Returns the derivatives of the weights with respect to the row: see
    /// [`Fragment::weights_dy`].
    #[inline(always)]
    #[must_use]
    pub fn dy(&self) -> [F32x8; 3] {
        self.derivatives(weight_steps_y)
    }

    /// Computes derivatives by the quotient rule, given the change of area times 1/w per pixel.
    ///
    /// With parts pₖ = areaₖ / wₖ, linear on the screen, and S their sum, a weight is pₖ / S and
    /// its derivative (∂pₖ − weightₖ · ∂S) / S.
    #[inline(always)]
    fn derivatives(&self, steps_of: impl Fn(&ScreenTriangle) -> [f32; 3]) -> [F32x8; 3] {
        let mut steps = [[0.0; LANES]; 3];
        if self.is_single {
            let of_all = steps_of(self.triangles[0]);
            for (steps, step) in steps.iter_mut().zip(of_all) {
                *steps = [step; LANES];
            }
        } else {
            for (lane, triangle) in self.triangles.iter().enumerate() {
                let [p, q, r] = steps_of(triangle);
                steps[0][lane] = p;
                steps[1][lane] = q;
                steps[2][lane] = r;
            }
        }
        // ∂S, the change of the normalizing sum.
        let mut sum = [0.0; LANES];
        for (lane, sum) in sum.iter_mut().enumerate() {
            *sum = steps[0][lane] + steps[1][lane] + steps[2][lane];
        }
        // Quotient rule; the division was done once, when the weights were computed.
        for (steps, weights) in steps.iter_mut().zip(&self.barycentrics) {
            for (lane, step) in steps.iter_mut().enumerate() {
                *step = (*step - weights[lane] * sum[lane]) * self.inv_sum[lane];
            }
        }
        to_source_weights(self.is_single, self.triangles, self.source_weights, steps)
    }
}

/// Converts weights of the screen triangles' vertices to weights of the source primitives'
/// vertices.
///
/// Assembly may have swapped two vertices or clipped the primitive; this hides both from shading.
#[inline(always)]
fn to_source_weights(
    is_single: bool,
    triangles: [&ScreenTriangle; LANES],
    source_weights: &[SourceWeights],
    [p, q, r]: [F32x8; 3],
) -> [F32x8; 3] {
    if is_single {
        match triangles[0].source {
            WeightSource::Unclipped => return [p, q, r],
            WeightSource::Flipped => return [p, r, q],
            WeightSource::Clipped(_) => {}
        }
    }
    // Most triangles of a mesh are flipped, because the rasterizer needs them clockwise.
    let mut weights = [p, r, q];
    // One pass handles all lanes: it selects between swapped and original vertices and flags
    // clipped triangles.
    let mut is_clipped = false;
    for lane in 0..LANES {
        let source = triangles[lane].source;
        is_clipped |= matches!(source, WeightSource::Clipped(_));
        if source == WeightSource::Unclipped {
            weights[1][lane] = q[lane];
            weights[2][lane] = r[lane];
        }
    }
    if is_clipped {
        return clipped_source_weights(triangles, source_weights, [p, q, r], weights);
    }
    weights
}

/// Replaces the weights in those lanes whose triangles are part of a clipped primitive.
///
/// Kept out of line, because few pixels need it and the gather would slow down all others.
#[cold]
fn clipped_source_weights(
    triangles: [&ScreenTriangle; LANES],
    source_weights: &[SourceWeights],
    [p, q, r]: [F32x8; 3],
    mut weights: [F32x8; 3],
) -> [F32x8; 3] {
    for lane in 0..LANES {
        let WeightSource::Clipped(entry) = triangles[lane].source else { continue };
        let [at_p, at_q, at_r] = source_weights[entry as usize];
        for (k, weights) in weights.iter_mut().enumerate() {
            // A convex combination of convex combinations: the weights still add up to 1.
            weights[lane] = p[lane] * at_p[k] + q[lane] * at_q[k] + r[lane] * at_r[k];
        }
    }
    weights
}

/// The vertices of the triangles in eight pixels: their offsets from the pixel centers, and 1/w.
///
/// Offsets are integer grid steps in `f64`, where their products and differences are exact.
///
/// Offsets are relative to the pixel and therefore small where it matters: next to a vertex, no
/// digits are lost to cancellation.
struct VertexLanes {
    /// The offset of each vertex from the center of the pixel, in grid steps to the right.
    dx: [[f64; LANES]; 3],
    /// The offset of each vertex from the center of the pixel, in grid steps down.
    dy: [[f64; LANES]; 3],
    /// 1/w of each vertex.
    inv_w: [F32x8; 3],
}

impl VertexLanes {
    const ZERO: Self =
        Self { dx: [[0.0; LANES]; 3], dy: [[0.0; LANES]; 3], inv_w: [[0.0; LANES]; 3] };

    /// Spreads one triangle over eight adjacent pixels; no gathering is needed.
    #[inline(always)]
    fn from_one_triangle(triangle: &ScreenTriangle, x: u32, y: u32) -> Self {
        let mut lanes = Self::ZERO;
        let (cx, cy) = (pixel_center(x), pixel_center(y));
        for (k, vertex) in triangle.vertices.iter().enumerate() {
            // Along the row, the offset decreases by one pixel, or 256 steps, per lane.
            let first = f64::from(vertex.x - cx);
            for (lane, dx) in lanes.dx[k].iter_mut().enumerate() {
                *dx = first - f64::from(lane as i32 * SUBPIXELS);
            }
            lanes.dy[k] = [f64::from(vertex.y - cy); LANES];
            lanes.inv_w[k] = [vertex.inv_w(); LANES];
        }
        lanes
    }

    /// Gathers the vertices of eight triangles, each in its own pixel.
    #[inline(always)]
    fn from_triangles(triangles: [&ScreenTriangle; LANES], x: &[u32; LANES], y: u32) -> Self {
        let mut lanes = Self::ZERO;
        let cy = pixel_center(y);
        for lane in 0..LANES {
            let (triangle, cx) = (triangles[lane], pixel_center(x[lane]));
            for (k, vertex) in triangle.vertices.iter().enumerate() {
                lanes.dx[k][lane] = f64::from(vertex.x - cx);
                lanes.dy[k][lane] = f64::from(vertex.y - cy);
                lanes.inv_w[k][lane] = vertex.inv_w();
            }
        }
        lanes
    }

    /// Returns the perspective-correct weights of the vertices and the reciprocals of the sums by
    /// which they were normalized (IN-2).
    #[inline(always)]
    fn barycentric_weights(&self) -> ([F32x8; 3], F32x8) {
        let Self { dx, dy, inv_w } = self;
        let mut weights = *inv_w;
        // Twice the area opposite each vertex, times its 1/w. The conversion to f32 rounds once.
        for (weight, (a, b)) in weights.iter_mut().zip([(1, 2), (2, 0), (0, 1)]) {
            for (lane, weight) in weight.iter_mut().enumerate() {
                let area = (dx[a][lane] * dy[b][lane] - dy[a][lane] * dx[b][lane]) as f32;
                // Clamped as in `Fragment::new`: the center may be outside.
                *weight *= area.max(0.0);
            }
        }
        // Normalize: one division per lane, then products.
        let mut inv_sum = [0.0_f32; LANES];
        for (lane, inv_sum) in inv_sum.iter_mut().enumerate() {
            *inv_sum = 1.0 / (weights[0][lane] + weights[1][lane] + weights[2][lane]);
        }
        for weight in &mut weights {
            for (weight, inv_sum) in weight.iter_mut().zip(inv_sum) {
                *weight *= inv_sum;
            }
        }
        (weights, inv_sum)
    }
}
