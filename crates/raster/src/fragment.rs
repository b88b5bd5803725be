//! Fragments: a primitive at one pixel, with perspective-correct weights for shading.
//!
//! ```text
//!   areaₖ = area of the triangle that the pixel's center forms with the edge opposite vertex k
//!   weightₖ = (areaₖ / wₖ) / Σ (areaᵢ / wᵢ)                    perspective-correct (IN-2)
//!   ∂weightₖ/∂x = (∂partₖ/∂x − weightₖ · Σ ∂partᵢ/∂x) / Σ partᵢ   with partₖ = areaₖ / wₖ
//! ```

use crate::ScreenVertex;
use crate::primitive::{ScreenTriangle, SourceWeights, WeightSource};
use crate::screen_vertex::SUBPIXELS;

/// A primitive at one pixel, ready for shading.
///
/// At the center of the pixel, a vertex attribute is the sum of the vertex values times
/// [`weights`](Self::weights), which are perspective-correct (IN-2). Its screen derivatives, which
/// determine the mip level of textures, are the same sum with [`weights_dx`](Self::weights_dx) and
/// [`weights_dy`](Self::weights_dy).
#[derive(Clone, Copy, Debug)]
pub struct Fragment<'a> {
    /// The id with which the primitive was submitted.
    pub id: u32,
    /// The column of the pixel.
    pub x: u32,
    /// The row of the pixel, from the top.
    pub y: u32,
    /// The weights of the primitive's vertices at the center of the pixel, or at a nearby point
    /// inside if the center is outside. They are nonnegative and add up to 1.
    pub weights: [f32; 3],
    /// The weights of the screen triangle's vertices. They equal the primitive's weights unless the
    /// primitive was clipped.
    pub(crate) barycentrics: [f32; 3],
    /// The reciprocal of the sum by which the barycentric weights were normalized.
    pub(crate) inv_sum: f32,
    pub(crate) triangle: &'a ScreenTriangle,
    pub(crate) source_weights: &'a [SourceWeights],
}

impl<'a> Fragment<'a> {
    /// Creates the fragment of a triangle at pixel (x, y).
    #[inline]
    pub(crate) fn new(
        triangle: &'a ScreenTriangle,
        source_weights: &'a [SourceWeights],
        x: u32,
        y: u32,
    ) -> Self {
        // At a silhouette, the center may be outside although a sample is covered. Clamping the
        // areas keeps attributes within the triangle (centroid sampling would cost a search).
        let areas = barycentric_areas(triangle.vertices, pixel_center(x), pixel_center(y))
            .map(|area| area.max(0.0));
        // Perspective-correct interpolation: weight by area over w, then normalize.
        let parts = [0, 1, 2].map(|k| areas[k] * triangle.vertices[k].inv_w());
        let inv_sum = 1.0 / (parts[0] + parts[1] + parts[2]);
        let barycentrics = parts.map(|part| part * inv_sum);
        let weights = to_source_weights(triangle, source_weights, barycentrics);
        Self { id: triangle.id, x, y, weights, barycentrics, inv_sum, triangle, source_weights }
    }

    /// Returns the derivative of the weights with respect to the column: their change per pixel to
    /// the right. The components add up to 0.
    #[must_use]
    pub fn weights_dx(&self) -> [f32; 3] {
        self.weight_derivatives(weight_steps_x(self.triangle))
    }

    /// Returns the derivative of the weights with respect to the row: their change per pixel down.
    #[must_use]
    pub fn weights_dy(&self) -> [f32; 3] {
        self.weight_derivatives(weight_steps_y(self.triangle))
    }

    /// Computes derivatives by the quotient rule: each weight is one part divided by the sum of all
    /// parts, and the parts are linear in screen space.
    fn weight_derivatives(&self, steps: [f32; 3]) -> [f32; 3] {
        // ∂weight = (∂part − weight · ∂Σ) / Σ.
        let sum = steps[0] + steps[1] + steps[2];
        let along = [0, 1, 2].map(|k| (steps[k] - self.barycentrics[k] * sum) * self.inv_sum);
        to_source_weights(self.triangle, self.source_weights, along)
    }
}

/// Returns the change of area times 1/w per pixel to the right, for each vertex.
#[inline(always)]
pub(crate) fn weight_steps_x(triangle: &ScreenTriangle) -> [f32; 3] {
    let [p, q, r] = &triangle.vertices;
    let step = |a: i32, b: i32, inv_w: f32| (a - b) as f32 * SUBPIXELS as f32 * inv_w;
    [step(q.y, r.y, p.inv_w()), step(r.y, p.y, q.inv_w()), step(p.y, q.y, r.inv_w())]
}

/// Returns the change of area times 1/w per pixel down, for each vertex.
#[inline(always)]
pub(crate) fn weight_steps_y(triangle: &ScreenTriangle) -> [f32; 3] {
    let [p, q, r] = &triangle.vertices;
    let step = |a: i32, b: i32, inv_w: f32| (a - b) as f32 * SUBPIXELS as f32 * inv_w;
    [step(r.x, q.x, p.inv_w()), step(p.x, r.x, q.inv_w()), step(q.x, p.x, r.inv_w())]
}

/// Returns the x or y coordinate of a pixel's center in grid steps.
pub(crate) fn pixel_center(pixel: u32) -> i32 {
    pixel as i32 * SUBPIXELS + SUBPIXELS / 2
}

/// Returns twice the areas of the three triangles formed by a point and the edges, exact before
/// rounding to `f32`.
#[inline]
fn barycentric_areas(vertices: [ScreenVertex; 3], x: i32, y: i32) -> [f32; 3] {
    let [p, q, r] = vertices.map(|v| (i64::from(v.x - x), i64::from(v.y - y)));
    let area = |a: (i64, i64), b: (i64, i64)| (a.0 * b.1 - a.1 * b.0) as f32;
    [area(q, r), area(r, p), area(p, q)]
}

/// Converts weights of a screen triangle's vertices to weights of the source primitive's vertices.
#[inline]
pub(crate) fn to_source_weights(
    triangle: &ScreenTriangle,
    source_weights: &[SourceWeights],
    [p, q, r]: [f32; 3],
) -> [f32; 3] {
    match triangle.source {
        WeightSource::Unclipped => [p, q, r],
        WeightSource::Flipped => [p, r, q],
        // The weights within the part, times the weights of the part's vertices within the
        // primitive.
        WeightSource::Clipped(entry) => {
            let [at_p, at_q, at_r] = source_weights[entry as usize];
            [0, 1, 2].map(|k| p * at_p[k] + q * at_q[k] + r * at_r[k])
        }
    }
}
