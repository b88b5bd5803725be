//! The vertex stage's end in bulk: from clip space to the grid, eight vertices at a time.
//!
//! The divide, the way to the screen and the rounding go through the same steps as for a single point, so that a vertex has the
//! same place in a mesh that is drawn whole and in a triangle that was clipped beside it. Plain loops over eight
//! lanes become vector instructions.

use crate::parallel::for_each_parallel;
use crate::screen_vertex::{GUARD_BAND, SUBPIXELS};
use crate::{MeshSelection, ScreenVertex, SimdLevel};
use fearless_simd::dispatch;
use glam::{DMat4, DVec4};
use homog::{Affine, Clip, HPoint, Ndc, Projective, Screen, Space};

const SNAP_LANES: usize = 8;
type F64x8 = [f64; SNAP_LANES];

/// What a thread takes at once of many positions.
const CHUNK_POSITIONS: usize = 8192;

impl ScreenVertex {
    /// Takes positions to clip space, divides them by their w, takes them to the screen and snaps them: what
    /// [`snap`](Self::snap) gives for each of their images, bit for bit. `vertices` is as long as `positions` afterwards;
    /// where it had been long enough before, it is not allocated anew. Uses up to `threads` threads.
    pub fn project_positions<A: Space>(
        positions: &[[f32; 3]],
        to_clip: Projective<A, Clip>,
        ndc_to_screen: Affine<Ndc, Screen>,
        instructions: SimdLevel,
        threads: usize,
        vertices: &mut Vec<Option<Self>>,
    ) {
        vertices.resize(positions.len(), None);
        let (to_clip, rows) = (to_clip.raw().transpose(), ndc_to_screen.raw().transpose());
        let shares = positions.chunks(CHUNK_POSITIONS).zip(vertices.chunks_mut(CHUNK_POSITIONS));
        for_each_parallel(threads, shares, |(positions, vertices)| {
            dispatch!(instructions.level(), _simd => project_chunk(positions, to_clip, rows, vertices));
        });
    }

    /// As [`project_positions`](Self::project_positions), but only those positions that a selection needs. What `vertices` holds for the others
    /// is not to be looked at.
    pub fn project_selected_positions<A: Space>(
        positions: &[[f32; 3]],
        selection: &MeshSelection,
        to_clip: Projective<A, Clip>,
        ndc_to_screen: Affine<Ndc, Screen>,
        instructions: SimdLevel,
        threads: usize,
        vertices: &mut Vec<Option<Self>>,
    ) {
        vertices.resize(positions.len(), None);
        let (to_clip, rows) = (to_clip.raw().transpose(), ndc_to_screen.raw().transpose());
        let shares =
            positions.chunks(CHUNK_POSITIONS).zip(vertices.chunks_mut(CHUNK_POSITIONS)).enumerate();
        for_each_parallel(threads, shares, |(number, (positions, vertices))| {
            let count = positions.len();
            for run in selection
                .vertices_within(number * CHUNK_POSITIONS..number * CHUNK_POSITIONS + count)
            {
                let (positions, vertices) = (&positions[run.clone()], &mut vertices[run]);
                dispatch!(instructions.level(), _simd => project_chunk(positions, to_clip, rows, vertices));
            }
        });
    }

    /// Divides points by their w, takes them to the screen and snaps them: `vertices` gets what [`snap`](Self::snap) gives for
    /// each, bit for bit.
    pub fn divide_and_snap_points(
        points: &[HPoint<Clip>],
        ndc_to_screen: Affine<Ndc, Screen>,
        instructions: SimdLevel,
        vertices: &mut [Option<Self>],
    ) {
        let rows = ndc_to_screen.raw().transpose();
        let eights = points.chunks_exact(SNAP_LANES).zip(vertices.chunks_exact_mut(SNAP_LANES));
        dispatch!(instructions.level(), _simd => {
            for (points, vertices) in eights {
                if let (Ok(points), Ok(vertices)) = (points.try_into(), <&mut [_; SNAP_LANES]>::try_from(vertices)) {
                    *vertices = divide_and_snap(split_coordinates(points), rows);
                }
            }
        });
        let done = points.len().min(vertices.len()) / SNAP_LANES * SNAP_LANES;
        for (&point, vertex) in points[done..].iter().zip(&mut vertices[done..]) {
            let place = point.divide().map(|point| ndc_to_screen.transform_point(point));
            *vertex = place.and_then(|place| Self::snap(place, point.w()));
        }
    }
}

/// The images of positions on the screen; matrices are given by rows.
#[inline(always)]
fn project_chunk(
    positions: &[[f32; 3]],
    to_clip: DMat4,
    to_screen: DMat4,
    vertices: &mut [Option<ScreenVertex>],
) {
    for (positions, vertices) in positions.chunks(SNAP_LANES).zip(vertices.chunks_mut(SNAP_LANES)) {
        if let (Ok(positions), Ok(vertices)) = (
            <&[[f32; 3]; SNAP_LANES]>::try_from(positions),
            <&mut [_; SNAP_LANES]>::try_from(&mut *vertices),
        ) {
            *vertices = divide_and_snap(transform_to_clip(positions, to_clip), to_screen);
        } else {
            let mut eight = [[0.0; 3]; SNAP_LANES];
            eight[..positions.len()].copy_from_slice(positions);
            let eight = divide_and_snap(transform_to_clip(&eight, to_clip), to_screen);
            vertices.copy_from_slice(&eight[..vertices.len()]);
        }
    }
}

/// The products of a matrix, given by rows, with positions: x, y, z and w, in the order in which glam adds up.
#[inline(always)]
fn transform_to_clip(positions: &[[f32; 3]; SNAP_LANES], rows: DMat4) -> [F64x8; 4] {
    let mut clip = [[0.0; SNAP_LANES]; 4];
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
fn split_coordinates(points: &[HPoint<Clip>; SNAP_LANES]) -> [F64x8; 4] {
    let mut clip = [[0.0; SNAP_LANES]; 4];
    for (lane, point) in points.iter().enumerate() {
        let [x, y, z, w] = point.raw().to_array();
        (clip[0][lane], clip[1][lane], clip[2][lane], clip[3][lane]) = (x, y, z, w);
    }
    clip
}

#[inline(always)]
fn divide_and_snap(
    [x, y, z, w]: [F64x8; 4],
    to_screen: DMat4,
) -> [Option<ScreenVertex>; SNAP_LANES] {
    let mut ndc = [x, y, z];
    for coordinates in &mut ndc {
        for (coordinate, w) in coordinates.iter_mut().zip(&w) {
            *coordinate /= w;
        }
    }
    let (x, is_x) = snap_to_grid(&transform_row(to_screen.x_axis, &ndc));
    let (y, is_y) = snap_to_grid(&transform_row(to_screen.y_axis, &ndc));
    let z = transform_row(to_screen.z_axis, &ndc);
    let (mut depth, mut inv_w) = ([0.0_f32; SNAP_LANES], [0.0_f32; SNAP_LANES]);
    for lane in 0..SNAP_LANES {
        depth[lane] = z[lane] as f32;
        inv_w[lane] = (1.0 / w[lane]) as f32;
    }
    let mut vertices = [None; SNAP_LANES];
    for (lane, vertex) in vertices.iter_mut().enumerate() {
        // Within the guard band is on the grid.
        let on_grid = is_x[lane] & is_y[lane] & w[lane].is_finite();
        *vertex =
            ScreenVertex::new_if_drawable(on_grid, x[lane], y[lane], depth[lane], inv_w[lane]);
    }
    vertices
}

/// A row of a matrix times the points, in the order in which glam adds up.
#[inline(always)]
fn transform_row(row: DVec4, [x, y, z]: &[F64x8; 3]) -> F64x8 {
    let mut sums = [0.0; SNAP_LANES];
    for (lane, sum) in sums.iter_mut().enumerate() {
        *sum = row.w + (row.z * z[lane] + (row.y * y[lane] + row.x * x[lane]));
    }
    sums
}

/// The nearest grid steps, halves up, and whether they are within the guard band.
#[inline(always)]
fn snap_to_grid(pixels: &F64x8) -> ([i32; SNAP_LANES], [bool; SNAP_LANES]) {
    let (mut steps, mut within) = ([0; SNAP_LANES], [false; SNAP_LANES]);
    for lane in 0..SNAP_LANES {
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
                let point = to_clip().transform_point(position.map(f64::from).into());
                ScreenVertex::snap(ndc_to_screen.transform_point(point.divide()?), point.w())
            });
            for instructions in SimdLevel::available() {
                let mut all = Vec::new();
                ScreenVertex::project_positions(
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
                ScreenVertex::snap(ndc_to_screen.transform_point(point.divide()?), point.w())
            });
            for instructions in SimdLevel::available() {
                let mut all = vec![None; points.len()];
                ScreenVertex::divide_and_snap_points(&points, ndc_to_screen, instructions, &mut all);
                prop_assert_eq!(&all, &each.clone().collect::<Vec<_>>());
            }
        }
    }
}
