//! The vertex stage's end in bulk: from clip space to the grid, eight vertices at a time.
//!
//! The divide, the way to the screen and the rounding go through the same steps as for a single point, so that a vertex has the
//! same place in a mesh that is drawn whole and in a triangle that was clipped beside it. Plain loops over eight
//! lanes become vector instructions.

use crate::vertex::{GUARD_BAND, SUBPIXELS};
use crate::{Instructions, ScreenVertex};
use fearless_simd::dispatch;
use glam::DVec4;
use homog::{Affine, Clip, HPoint, Ndc, Screen};

const COUNT: usize = 8;
type Eight = [f64; COUNT];

impl ScreenVertex {
    /// Divides points by their w, takes them to the screen and snaps them: `vertices` gets what [`snap`](Self::snap) gives for
    /// each, bit for bit. Where it had been long enough before, it is not allocated anew.
    pub fn snap_all(
        points: &[HPoint<Clip>],
        ndc_to_screen: Affine<Ndc, Screen>,
        instructions: Instructions,
        vertices: &mut Vec<Option<Self>>,
    ) {
        vertices.clear();
        vertices.reserve(points.len());
        let (eights, rest) = points.as_chunks::<COUNT>();
        dispatch!(instructions.level(), _simd => {
            for eight in eights {
                vertices.extend_from_slice(&snap_eight(eight, ndc_to_screen));
            }
        });
        vertices.extend(
            rest.iter().map(|&point| Self::snap(ndc_to_screen.point(point.divide()?), point.w())),
        );
    }
}

#[inline(always)]
fn snap_eight(
    points: &[HPoint<Clip>; COUNT],
    ndc_to_screen: Affine<Ndc, Screen>,
) -> [Option<ScreenVertex>; COUNT] {
    let mut ndc = [[0.0; COUNT]; 3];
    let mut w = [0.0; COUNT];
    for (lane, point) in points.iter().enumerate() {
        let [x, y, z, own_w] = point.raw().to_array();
        (ndc[0][lane], ndc[1][lane], ndc[2][lane], w[lane]) = (x, y, z, own_w);
    }
    for coordinates in &mut ndc {
        for (coordinate, w) in coordinates.iter_mut().zip(&w) {
            *coordinate /= w;
        }
    }
    let rows = ndc_to_screen.raw().transpose();
    let (x, is_x) = to_grid(&image(rows.x_axis, &ndc));
    let (y, is_y) = to_grid(&image(rows.y_axis, &ndc));
    let z = image(rows.z_axis, &ndc);
    let (mut depth, mut inv_w) = ([0.0_f32; COUNT], [0.0_f32; COUNT]);
    for lane in 0..COUNT {
        depth[lane] = z[lane] as f32;
        inv_w[lane] = (1.0 / w[lane]) as f32;
    }
    let mut vertices = [None; COUNT];
    for (lane, vertex) in vertices.iter_mut().enumerate() {
        if is_x[lane] & is_y[lane] & w[lane].is_finite() {
            *vertex = ScreenVertex::new(x[lane], y[lane], depth[lane], inv_w[lane]);
        }
    }
    vertices
}

/// A row of a matrix times the points, in the order in which glam adds up.
#[inline(always)]
fn image(row: DVec4, [x, y, z]: &[Eight; 3]) -> Eight {
    let mut sums = [0.0; COUNT];
    for (lane, sum) in sums.iter_mut().enumerate() {
        *sum = row.w + (row.z * z[lane] + (row.y * y[lane] + row.x * x[lane]));
    }
    sums
}

/// The nearest grid steps, halves up, and whether they are within the guard band.
#[inline(always)]
fn to_grid(pixels: &Eight) -> ([i32; COUNT], [bool; COUNT]) {
    let (mut steps, mut within) = ([0; COUNT], [false; COUNT]);
    for lane in 0..COUNT {
        let place = pixels[lane];
        within[lane] = (place >= *GUARD_BAND.start()) & (place <= *GUARD_BAND.end());
        let place = if within[lane] { place * f64::from(SUBPIXELS) + 0.5 } else { 0.0 };
        // Without a call for the floor, which not every processor has an instruction for.
        let cut = place as i32;
        steps[lane] = cut - i32::from(f64::from(cut) > place);
    }
    (steps, within)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn coordinate() -> impl Strategy<Value = f64> {
        let extreme = [0.0, -0.0, 1e-300, f64::NAN, f64::INFINITY, f64::MAX, -1.0, 1.0];
        prop_oneof![8 => -3.0..3.0_f64, 1 => prop::sample::select(extreme.to_vec())]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4096))]

        #[test]
        fn many_are_snapped_as_each(
            points in prop::collection::vec(prop::array::uniform4(coordinate()), 0..20),
        ) {
            let points: Vec<_> = points.iter().map(|&[x, y, z, w]| HPoint::new(x, y, z, w)).collect();
            let flip = Affine::<Ndc, Ndc>::scale(960.0, -540.0, 1.0);
            let shift = Affine::<Ndc, Screen>::translation(homog::Vector::new(960.0, 540.0, 0.0));
            let ndc_to_screen = flip.then(shift);
            let each = points.iter().map(|point: &HPoint<Clip>| {
                ScreenVertex::snap(ndc_to_screen.point(point.divide()?), point.w())
            });
            for instructions in Instructions::available() {
                let mut all = Vec::new();
                ScreenVertex::snap_all(&points, ndc_to_screen, instructions, &mut all);
                prop_assert_eq!(&all, &each.clone().collect::<Vec<_>>());
            }
        }
    }
}
