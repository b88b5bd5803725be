//! The bulk vertex stage: clip space, perspective divide, viewport transform and snapping, eight
//! vertices at a time.
//!
//! ```text
//!   position ─to_clip─► (x, y, z, w) ─÷ w─► NDC ─ndc_to_screen─► pixels ─round─► ScreenVertex
//! ```
//!
//! Operations are in the same order as for a single point ([`ScreenVertex::snap`]). A vertex is
//! therefore bit-identical in an unclipped mesh and in a clipped triangle next to it, so no cracks
//! appear between them. The loops over eight lanes compile to vector instructions.
//!
//! Vertices may be on either side of the eye. Vertices with w ≤ 0 or beyond the guard band become
//! `None`, and triangles that use them must be clipped.

use crate::parallel::for_each_parallel;
use crate::screen_vertex::{GUARD_BAND, SUBPIXELS};
use crate::simd_level::dispatch;
use crate::{MeshSelection, ScreenVertex, SimdLevel};
use core::ops::Range;
use glam::{DMat4, DVec4};
use homog::{Affine, Clip, HPoint, Ndc, Projective, Screen, Space};

/// The number of vertices projected at once.
const SNAP_LANES: usize = 8;
/// One `f64` for each of eight vertices.
///
/// Positions are transformed in `f64`, so a vertex far from the origin keeps its subpixel bits.
type F64x8 = [f64; SNAP_LANES];

/// The number of positions in a work item.
///
/// This is a multiple of the block size of selections, so runs begin at block boundaries.
const CHUNK_POSITIONS: usize = 8192;

/// The projection of a mesh's positions in space `A` to the screen, with settings for computing it.
///
/// It is plain data, so rebuilding it for each mesh costs no more than a copy.
#[derive(Clone, Copy, Debug)]
pub struct VertexProjection<A: Space> {
    /// The model-view-projection matrix.
    pub to_clip: Projective<A, Clip>,
    /// The viewport transform.
    pub ndc_to_screen: Affine<Ndc, Screen>,
    /// The vector instructions to use. The result does not depend on them.
    pub simd_level: SimdLevel,
    /// The maximum number of threads. The result does not depend on it.
    pub threads: usize,
}

impl<A: Space> VertexProjection<A> {
    /// Projects positions to the screen and snaps them, bit for bit like [`ScreenVertex::snap`].
    ///
    /// `vertices` is resized to the length of `positions`; nothing is allocated if its capacity
    /// suffices.
    ///
    /// Positions that are not finite or cannot be drawn without clipping become `None`.
    pub fn project_positions(
        &self,
        positions: &[[f32; 3]],
        vertices: &mut Vec<Option<ScreenVertex>>,
    ) {
        self.project_chunks(positions, vertices, |chunk| core::iter::once(0..chunk.len()));
    }

    /// Projects only the positions that a selection needs.
    ///
    /// The other entries of `vertices` keep their old values and are meaningless.
    ///
    /// Vertices of culled clusters are skipped in blocks of 64.
    pub fn project_selected_positions(
        &self,
        positions: &[[f32; 3]],
        selection: &MeshSelection,
        vertices: &mut Vec<Option<ScreenVertex>>,
    ) {
        self.project_chunks(positions, vertices, |chunk| selection.vertices_within(chunk));
    }

    /// Projects the runs that `runs` returns for each chunk of positions, relative to the start of
    /// the chunk.
    ///
    /// Chunks are disjoint slices of positions and vertices, so threads write without locks.
    fn project_chunks<I: Iterator<Item = Range<usize>>>(
        &self,
        positions: &[[f32; 3]],
        vertices: &mut Vec<Option<ScreenVertex>>,
        runs: impl Fn(Range<usize>) -> I + Sync,
    ) {
        vertices.resize(positions.len(), None);
        // Rows of the matrices, to compute a coordinate as a row times the vector.
        let (to_clip, rows) =
            (self.to_clip.raw().transpose(), self.ndc_to_screen.raw().transpose());
        let chunks = positions.chunks(CHUNK_POSITIONS).zip(vertices.chunks_mut(CHUNK_POSITIONS));
        for_each_parallel(self.threads, chunks.enumerate(), |(index, (positions, vertices))| {
            let first = index * CHUNK_POSITIONS;
            for run in runs(first..first + positions.len()) {
                let (positions, vertices) = (&positions[run.clone()], &mut vertices[run]);
                project_run(self.simd_level, positions, [to_clip, rows], vertices);
            }
        });
    }
}

impl ScreenVertex {
    /// Divides many points by w, applies the viewport transform and snaps the results. Each entry
    /// of `vertices` matches [`snap`](Self::snap), bit for bit. Extra elements of the longer slice
    /// are ignored.
    ///
    /// Use it for points that are already in clip space, such as the vertices of clipped polygons.
    pub fn divide_and_snap_points(
        points: &[HPoint<Clip>],
        ndc_to_screen: Affine<Ndc, Screen>,
        simd_level: SimdLevel,
        vertices: &mut [Option<Self>],
    ) {
        let rows = ndc_to_screen.raw().transpose();
        // Whole vectors first.
        let eights = points.chunks_exact(SNAP_LANES).zip(vertices.chunks_exact_mut(SNAP_LANES));
        dispatch!(simd_level.level(), _simd => {
            for (points, vertices) in eights {
                let vertices = <&mut [_; SNAP_LANES]>::try_from(vertices);
                if let (Ok(points), Ok(vertices)) = (points.try_into(), vertices) {
                    *vertices = divide_and_snap(split_coordinates(points), rows);
                }
            }
        });
        // The last few points, one by one.
        let done = points.len().min(vertices.len()) / SNAP_LANES * SNAP_LANES;
        for (&point, vertex) in points[done..].iter().zip(&mut vertices[done..]) {
            let screen = point.divide().map(|point| ndc_to_screen.transform_point(point));
            *vertex = screen.and_then(|screen| Self::snap(screen, point.w()));
        }
    }
}

/// Projects positions and snaps them with vector instructions; matrices are passed as rows.
///
/// It is not generic, so it is compiled in this crate.
fn project_run(
    simd_level: SimdLevel,
    positions: &[[f32; 3]],
    [to_clip, to_screen]: [DMat4; 2],
    vertices: &mut [Option<ScreenVertex>],
) {
    dispatch!(simd_level.level(), _simd => project_chunk(positions, to_clip, to_screen, vertices));
}

/// Projects positions and snaps them; matrices are passed as rows.
///
/// Padding lanes are zeros, and their results are discarded.
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
            // The last few positions, padded with zeros.
            let mut eight = [[0.0; 3]; SNAP_LANES];
            eight[..positions.len()].copy_from_slice(positions);
            let eight = divide_and_snap(transform_to_clip(&eight, to_clip), to_screen);
            vertices.copy_from_slice(&eight[..vertices.len()]);
        }
    }
}

/// Returns the clip-space x, y, z and w of positions: a matrix, passed as rows, times each
/// position, added in the same order as in glam.
///
/// The sum is ((x·m₀ + y·m₁) + z·m₂) + m₃: another order would round differently and leave cracks
/// between clipped and unclipped triangles.
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

/// Returns the x, y, z and w of points as a structure of arrays.
///
/// This transposes eight points to four vectors.
#[inline(always)]
fn split_coordinates(points: &[HPoint<Clip>; SNAP_LANES]) -> [F64x8; 4] {
    let mut clip = [[0.0; SNAP_LANES]; 4];
    for (lane, point) in points.iter().enumerate() {
        let [x, y, z, w] = point.raw().to_array();
        (clip[0][lane], clip[1][lane], clip[2][lane], clip[3][lane]) = (x, y, z, w);
    }
    clip
}

/// Divides eight points by w, applies the viewport transform (a matrix as rows) and snaps the
/// results.
///
/// A lane is `None` if its point cannot be drawn: if it is outside the guard band, if its w is not
/// positive and finite, or if its depth is beyond ±2²⁰. All lanes are computed to the end, without
/// branches.
#[inline(always)]
fn divide_and_snap(
    [x, y, z, w]: [F64x8; 4],
    to_screen: DMat4,
) -> [Option<ScreenVertex>; SNAP_LANES] {
    // Perspective divide. Division by 0 gives an infinity, which the guard band test rejects.
    let mut ndc = [x, y, z];
    for coordinates in &mut ndc {
        for (coordinate, w) in coordinates.iter_mut().zip(&w) {
            *coordinate /= w;
        }
    }
    // Viewport transform, then rounding to the subpixel grid.
    let (x, is_x) = snap_to_grid(&transform_row(to_screen.x_axis, &ndc));
    let (y, is_y) = snap_to_grid(&transform_row(to_screen.y_axis, &ndc));
    // Depth comes from a row of the same matrix, which maps z/w to 0 at far and 1 at near, in f64.
    let z = transform_row(to_screen.z_axis, &ndc);
    // Rounded to f32 once, at the end.
    let (mut depth, mut inv_w) = ([0.0_f32; SNAP_LANES], [0.0_f32; SNAP_LANES]);
    for lane in 0..SNAP_LANES {
        depth[lane] = z[lane] as f32;
        inv_w[lane] = (1.0 / w[lane]) as f32;
    }
    let mut vertices = [None; SNAP_LANES];
    for (lane, vertex) in vertices.iter_mut().enumerate() {
        // A point inside the guard band is on the grid.
        let on_grid = is_x[lane] & is_y[lane] & w[lane].is_finite();
        *vertex =
            ScreenVertex::new_if_drawable(on_grid, x[lane], y[lane], depth[lane], inv_w[lane]);
    }
    vertices
}

/// Multiplies a row of a matrix by the points (x, y, z, 1), adding in the same order as glam.
///
/// The parentheses match glam: x and y are added first, then z, then w.
#[inline(always)]
fn transform_row(row: DVec4, [x, y, z]: &[F64x8; 3]) -> F64x8 {
    let mut sums = [0.0; SNAP_LANES];
    for (lane, sum) in sums.iter_mut().enumerate() {
        *sum = row.w + (row.z * z[lane] + (row.y * y[lane] + row.x * x[lane]));
    }
    sums
}

/// Returns the nearest grid steps, with halves rounded up, and whether the coordinates are within
/// the guard band.
///
/// Lanes outside the guard band give 0, which converts safely to `i32`.
#[inline(always)]
fn snap_to_grid(pixels: &F64x8) -> ([i32; SNAP_LANES], [bool; SNAP_LANES]) {
    let (mut steps, mut within) = ([0; SNAP_LANES], [false; SNAP_LANES]);
    for lane in 0..SNAP_LANES {
        let at = pixels[lane];
        within[lane] = (at >= *GUARD_BAND.start()) & (at <= *GUARD_BAND.end());
        let at = if within[lane] { at * f64::from(SUBPIXELS) + 0.5 } else { 0.0 };
        // Compute the floor by truncation and correction: SSE2 has no instruction for it, and
        // `floor` would be a library call that prevents vectorization of the loop.
        let truncated = at as i32;
        steps[lane] = truncated - i32::from(f64::from(truncated) > at);
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

    /// Returns a matrix without zeros.
    fn to_clip() -> Projective<homog::Model, Clip> {
        let columns = core::array::from_fn(|k| 0.37 * k as f64 - 2.9 + 1.0 / (k + 1) as f64);
        Projective::from_raw(DMat4::from_cols_array(&columns))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4096))]

        #[test]
        fn bulk_projection_matches_single_points(
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
            for simd_level in SimdLevel::available() {
                let mut all = Vec::new();
                let to_clip = to_clip();
                VertexProjection { to_clip, ndc_to_screen, simd_level, threads }
                    .project_positions(&positions, &mut all);
                prop_assert_eq!(&all, &each.clone().collect::<Vec<_>>());
            }
        }

        #[test]
        fn bulk_snapping_matches_single_points(
            points in prop::collection::vec(prop::array::uniform4(coordinate()), 0..20),
        ) {
            let points: Vec<_> = points.iter().map(|&[x, y, z, w]| HPoint::new(x, y, z, w)).collect();
            let flip = Affine::<Ndc, Ndc>::scale(960.0, -540.0, 1.0);
            let shift = Affine::<Ndc, Screen>::translation(homog::Vector::new(960.0, 540.0, 0.0));
            let ndc_to_screen = flip.then(shift);
            let each = points.iter().map(|point: &HPoint<Clip>| {
                ScreenVertex::snap(ndc_to_screen.transform_point(point.divide()?), point.w())
            });
            for simd_level in SimdLevel::available() {
                let mut all = vec![None; points.len()];
                ScreenVertex::divide_and_snap_points(&points, ndc_to_screen, simd_level, &mut all);
                prop_assert_eq!(&all, &each.clone().collect::<Vec<_>>());
            }
        }
    }
}
