//! Fragments: what of a primitive shows in one pixel, ready for shading.

use crate::ScreenVertex;
use crate::primitive::{ScreenTriangle, SourceWeights, WeightSource};
use crate::screen_vertex::SUBPIXELS;

/// A primitive at one pixel.
///
/// A value that the corners of the primitive carry is, at the pixel's centre, the sum of the corners' values times
/// [`weights`](Self::weights); they are perspective-correct (IN-2). How fast it changes across the picture, which texture
/// filters want to know, the same sum says with [`weights_dx`](Self::weights_dx) and [`weights_dy`](Self::weights_dy).
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
    /// The same for the corners of the piece.
    pub(crate) barycentrics: [f32; 3],
    /// One over the sum that the shares were divided by.
    pub(crate) inv_sum: f32,
    pub(crate) triangle: &'a ScreenTriangle,
    pub(crate) source_weights: &'a [SourceWeights],
}

impl<'a> Fragment<'a> {
    /// The piece at the centre of pixel (x, y).
    #[inline]
    pub(crate) fn new(
        triangle: &'a ScreenTriangle,
        source_weights: &'a [SourceWeights],
        x: u32,
        y: u32,
    ) -> Self {
        // With the centre outside, the nearest place is near enough: its share of a corner just does not go below 0.
        let areas = barycentric_areas(triangle.corners, pixel_center(x), pixel_center(y))
            .map(|area| area.max(0.0));
        let parts = [0, 1, 2].map(|k| areas[k] * triangle.corners[k].inv_w());
        let inv_sum = 1.0 / (parts[0] + parts[1] + parts[2]);
        let barycentrics = parts.map(|part| part * inv_sum);
        let weights = to_source_weights(triangle, source_weights, barycentrics);
        Self { id: triangle.id, x, y, weights, barycentrics, inv_sum, triangle, source_weights }
    }

    /// The derivative of the weights by the pixel's column: what they grow by from pixel to pixel to the right, at this
    /// place. They add up to 0.
    #[must_use]
    pub fn weights_dx(&self) -> [f32; 3] {
        self.weight_derivatives(weight_steps_x(self.triangle))
    }

    /// The derivative of the weights by the pixel's row, downwards.
    #[must_use]
    pub fn weights_dy(&self) -> [f32; 3] {
        self.weight_derivatives(weight_steps_y(self.triangle))
    }

    /// By the quotient rule: a share is a part over the sum of the parts, and these are linear on the screen.
    fn weight_derivatives(&self, steps: [f32; 3]) -> [f32; 3] {
        let sum = steps[0] + steps[1] + steps[2];
        let along = [0, 1, 2].map(|k| (steps[k] - self.barycentrics[k] * sum) * self.inv_sum);
        to_source_weights(self.triangle, self.source_weights, along)
    }
}

/// What area times 1/w of each corner grows by from pixel to pixel to the right.
#[inline(always)]
pub(crate) fn weight_steps_x(piece: &ScreenTriangle) -> [f32; 3] {
    let [p, q, r] = &piece.corners;
    let step = |a: i32, b: i32, inv_w: f32| (a - b) as f32 * SUBPIXELS as f32 * inv_w;
    [step(q.y, r.y, p.inv_w()), step(r.y, p.y, q.inv_w()), step(p.y, q.y, r.inv_w())]
}

/// The same from pixel to pixel downwards.
#[inline(always)]
pub(crate) fn weight_steps_y(piece: &ScreenTriangle) -> [f32; 3] {
    let [p, q, r] = &piece.corners;
    let step = |a: i32, b: i32, inv_w: f32| (a - b) as f32 * SUBPIXELS as f32 * inv_w;
    [step(r.x, q.x, p.inv_w()), step(p.x, r.x, q.inv_w()), step(q.x, p.x, r.inv_w())]
}

/// The grid position of a pixel's centre, in a row or in a column.
pub(crate) fn pixel_center(pixel: u32) -> i32 {
    pixel as i32 * SUBPIXELS + SUBPIXELS / 2
}

/// Twice the areas of the three triangles that a place makes with the sides of a piece, exact before they are rounded.
#[inline]
fn barycentric_areas(corners: [ScreenVertex; 3], x: i32, y: i32) -> [f32; 3] {
    let [p, q, r] = corners.map(|v| (i64::from(v.x - x), i64::from(v.y - y)));
    let area = |a: (i64, i64), b: (i64, i64)| (a.0 * b.1 - a.1 * b.0) as f32;
    [area(q, r), area(r, p), area(p, q)]
}

/// Shares of the source primitive's corners from those of a piece's.
#[inline]
pub(crate) fn to_source_weights(
    piece: &ScreenTriangle,
    source_weights: &[SourceWeights],
    [p, q, r]: [f32; 3],
) -> [f32; 3] {
    match piece.source {
        WeightSource::Unclipped => [p, q, r],
        WeightSource::Flipped => [p, r, q],
        WeightSource::Clipped(entry) => {
            let [at_p, at_q, at_r] = source_weights[entry as usize];
            [0, 1, 2].map(|k| p * at_p[k] + q * at_q[k] + r * at_r[k])
        }
    }
}
