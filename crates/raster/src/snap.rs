//! The vertex stage's end in bulk: from clip space to the grid, eight vertices at a time.
//!
//! The divide, the way to the screen and the rounding go through the same steps as for a single point, so that a vertex has the
//! same place in a mesh that is drawn whole and in a triangle that was clipped beside it. Plain loops over eight
//! lanes become vector instructions.

use crate::threads::share;
use crate::vertex::{GUARD_BAND, SUBPIXELS};
use crate::{Instructions, ScreenVertex, Selection};
use fearless_simd::dispatch;
use glam::{DMat4, DVec4};
use homog::{Affine, Clip, HPoint, Ndc, Projective, Screen, Space};

const COUNT: usize = 8;
type Eight = [f64; COUNT];

/// What a thread takes at once of many positions.
const SHARE: usize = 8192;

impl ScreenVertex {
    /// Takes positions to clip space, divides them by their w, takes them to the screen and snaps them: what
    /// [`snap`](Self::snap) gives for each of their images, bit for bit. `vertices` is as long as `positions` afterwards;
    /// where it had been long enough before, it is not allocated anew. Uses up to `threads` threads.
    pub fn project_all<A: Space>(
        positions: &[[f32; 3]],
        to_clip: Projective<A, Clip>,
        ndc_to_screen: Affine<Ndc, Screen>,
        instructions: Instructions,
        threads: usize,
        vertices: &mut Vec<Option<Self>>,
    ) {
        vertices.resize(positions.len(), None);
        let (to_clip, rows) = (to_clip.raw().transpose(), ndc_to_screen.raw().transpose());
        let shares = positions.chunks(SHARE).zip(vertices.chunks_mut(SHARE));
        share(threads, shares, |(positions, vertices)| {
            dispatch!(instructions.level(), _simd => project(positions, to_clip, rows, vertices));
        });
    }

    /// As [`project_all`](Self::project_all), but only those positions that a selection needs. What `vertices` holds for the others
    /// is not to be looked at.
    pub fn project_selected<A: Space>(
        positions: &[[f32; 3]],
        selection: &Selection,
        to_clip: Projective<A, Clip>,
        ndc_to_screen: Affine<Ndc, Screen>,
        instructions: Instructions,
        threads: usize,
        vertices: &mut Vec<Option<Self>>,
    ) {
        vertices.resize(positions.len(), None);
        let (to_clip, rows) = (to_clip.raw().transpose(), ndc_to_screen.raw().transpose());
        let shares = positions.chunks(SHARE).zip(vertices.chunks_mut(SHARE)).enumerate();
        share(threads, shares, |(number, (positions, vertices))| {
            let count = positions.len();
            for run in selection.vertices_within(number * SHARE..number * SHARE + count) {
                let (positions, vertices) = (&positions[run.clone()], &mut vertices[run]);
                dispatch!(instructions.level(), _simd => project(positions, to_clip, rows, vertices));
            }
        });
    }

    /// Divides points by their w, takes them to the screen and snaps them: `vertices` gets what [`snap`](Self::snap) gives for
    /// each, bit for bit.
    pub fn snap_all(
        points: &[HPoint<Clip>],
        ndc_to_screen: Affine<Ndc, Screen>,
        instructions: Instructions,
        vertices: &mut [Option<Self>],
    ) {
        let rows = ndc_to_screen.raw().transpose();
        let eights = points.chunks_exact(COUNT).zip(vertices.chunks_exact_mut(COUNT));
        dispatch!(instructions.level(), _simd => {
            for (points, vertices) in eights {
                if let (Ok(points), Ok(vertices)) = (points.try_into(), <&mut [_; COUNT]>::try_from(vertices)) {
                    *vertices = snap_eight(coordinates(points), rows);
                }
            }
        });
        let done = points.len().min(vertices.len()) / COUNT * COUNT;
        for (&point, vertex) in points[done..].iter().zip(&mut vertices[done..]) {
            let place = point.divide().map(|point| ndc_to_screen.point(point));
            *vertex = place.and_then(|place| Self::snap(place, point.w()));
        }
    }
}

/// The images of positions on the screen; matrices are given by rows.
#[inline(always)]
fn project(
    positions: &[[f32; 3]],
    to_clip: DMat4,
    to_screen: DMat4,
    vertices: &mut [Option<ScreenVertex>],
) {
    for (positions, vertices) in positions.chunks(COUNT).zip(vertices.chunks_mut(COUNT)) {
        if let (Ok(positions), Ok(vertices)) =
            (<&[[f32; 3]; COUNT]>::try_from(positions), <&mut [_; COUNT]>::try_from(&mut *vertices))
        {
            *vertices = snap_eight(in_clip_space(positions, to_clip), to_screen);
        } else {
            let mut eight = [[0.0; 3]; COUNT];
            eight[..positions.len()].copy_from_slice(positions);
            let eight = snap_eight(in_clip_space(&eight, to_clip), to_screen);
            vertices.copy_from_slice(&eight[..vertices.len()]);
        }
    }
}

/// The products of a matrix, given by rows, with positions: x, y, z and w, in the order in which glam adds up.
#[inline(always)]
fn in_clip_space(positions: &[[f32; 3]; COUNT], rows: DMat4) -> [Eight; 4] {
    let mut clip = [[0.0; COUNT]; 4];
    let rows = [rows.x_axis, rows.y_axis, rows.z_axis, rows.w_axis];
    for (row, coordinates) in rows.iter().zip(&mut clip) {
        for (lane, coordinate) in coordinates.iter_mut().enumerate() {
            let [x, y, z] = positions[lane].map(f64::from);
            *coordinate = row.x * x + row.y * y + row.z * z + row.w;
        }
    }
    clip
}

/// The coordinates of points, each kind together: x, y, z and w.
#[inline(always)]
fn coordinates(points: &[HPoint<Clip>; COUNT]) -> [Eight; 4] {
    let mut clip = [[0.0; COUNT]; 4];
    for (lane, point) in points.iter().enumerate() {
        let [x, y, z, w] = point.raw().to_array();
        (clip[0][lane], clip[1][lane], clip[2][lane], clip[3][lane]) = (x, y, z, w);
    }
    clip
}

#[inline(always)]
fn snap_eight([x, y, z, w]: [Eight; 4], to_screen: DMat4) -> [Option<ScreenVertex>; COUNT] {
    let mut ndc = [x, y, z];
    for coordinates in &mut ndc {
        for (coordinate, w) in coordinates.iter_mut().zip(&w) {
            *coordinate /= w;
        }
    }
    let (x, is_x) = to_grid(&image(to_screen.x_axis, &ndc));
    let (y, is_y) = to_grid(&image(to_screen.y_axis, &ndc));
    let z = image(to_screen.z_axis, &ndc);
    let (mut depth, mut inv_w) = ([0.0_f32; COUNT], [0.0_f32; COUNT]);
    for lane in 0..COUNT {
        depth[lane] = z[lane] as f32;
        inv_w[lane] = (1.0 / w[lane]) as f32;
    }
    let mut vertices = [None; COUNT];
    for (lane, vertex) in vertices.iter_mut().enumerate() {
        // Within the guard band is on the grid.
        let on_grid = is_x[lane] & is_y[lane] & w[lane].is_finite();
        *vertex = ScreenVertex::if_drawable(on_grid, x[lane], y[lane], depth[lane], inv_w[lane]);
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

    /// A map with a number in every place.
    fn to_clip() -> Projective<homog::Model, Clip> {
        let columns = core::array::from_fn(|k| 0.37 * k as f64 - 2.9 + 1.0 / (k + 1) as f64);
        Projective::from_raw(DMat4::from_cols_array(&columns))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4096))]

        #[test]
        fn many_are_projected_as_each(
            positions in prop::collection::vec(prop::array::uniform3(coordinate()), 0..20),
            threads in 1..3_usize,
        ) {
            let positions: Vec<_> =
                positions.iter().map(|position| position.map(|c| c as f32)).collect();
            let ndc_to_screen = Affine::<Ndc, Screen>::scale(960.0, -540.0, 1.0);
            let each = positions.iter().map(|position| {
                let point = to_clip().point(position.map(f64::from).into());
                ScreenVertex::snap(ndc_to_screen.point(point.divide()?), point.w())
            });
            for instructions in Instructions::available() {
                let mut all = Vec::new();
                ScreenVertex::project_all(
                    &positions, to_clip(), ndc_to_screen, instructions, threads, &mut all,
                );
                prop_assert_eq!(&all, &each.clone().collect::<Vec<_>>());
            }
        }

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
                let mut all = vec![None; points.len()];
                ScreenVertex::snap_all(&points, ndc_to_screen, instructions, &mut all);
                prop_assert_eq!(&all, &each.clone().collect::<Vec<_>>());
            }
        }
    }
}
