//! Normals: which way a surface faces at a fragment.

use super::Draw;
use super::attributes::{Attributes, NORMAL, POSITION, VertexIndices, interpolate};
use super::fragment_lanes::{FragmentLanes, cross, dot, dot_lanes, lane_vector};

/// Some vectors, or places, in lanes.
type VectorLanes<const N: usize> = [[f32; N]; 3];

/// How surfaces lie to the viewer at some fragments.
#[derive(Clone, Copy, Debug)]
pub(super) struct SurfaceGeometry<const N: usize> {
    /// Where they are, in the world.
    pub(super) positions: VectorLanes<N>,
    /// The unit vectors to the viewer.
    pub(super) views: VectorLanes<N>,
    /// The unit normals on the side that is seen.
    pub(super) normals: VectorLanes<N>,
    /// Whether that is the back.
    is_back_facing: [bool; N],
    /// The cosines between the two, not below 0.
    pub(super) n_dot_v: [f32; N],
    /// How far the surface's own normals turn from one pixel to the next, in radians, at most 1.
    pub(super) normal_variation: [f32; N],
}

impl<const N: usize> SurfaceGeometry<N> {
    #[inline(always)]
    pub(super) fn new(
        positions: VectorLanes<N>,
        views: VectorLanes<N>,
        normals: VectorLanes<N>,
        is_back_facing: [bool; N],
        normal_variation: [f32; N],
    ) -> Self {
        let mut n_dot_v = dot_lanes(&normals, &views);
        for cosine in &mut n_dot_v {
            *cosine = cosine.clamp(0.0, 1.0);
        }
        Self { positions, views, normals, is_back_facing, n_dot_v, normal_variation }
    }

    /// The same surfaces bent by slopes. Seen from behind, the whole frame of tangent, bitangent and normal is turned round.
    #[inline(always)]
    pub(super) fn with_tangent_normal(
        &self,
        tangents: &[[f32; N]; 4],
        slope: &VectorLanes<N>,
    ) -> Self {
        let mut fronts = self.normals;
        flip_vectors(&mut fronts, &self.is_back_facing);
        let mut normals = apply_normal_map(&fronts, tangents, slope);
        flip_vectors(&mut normals, &self.is_back_facing);
        Self::new(self.positions, self.views, normals, self.is_back_facing, self.normal_variation)
    }
}

impl Draw<'_> {
    /// What the corners carry of places in the world.
    #[inline(always)]
    pub(super) fn vertex_positions<const N: usize>(
        &self,
        corners: &VertexIndices<N>,
    ) -> Attributes<N, 3> {
        corners.fetch_attributes(&self.vertices, POSITION)
    }

    /// The unit normals on the front side, and how far they turn from pixel to pixel; `faces` are those of the triangles, which count where there are no others.
    #[inline(always)]
    pub(super) fn interpolate_normals<const N: usize>(
        &self,
        corners: &VertexIndices<N>,
        seen: &impl FragmentLanes<N>,
        faces: &VectorLanes<N>,
    ) -> (VectorLanes<N>, [f32; N]) {
        let mut normals = *faces;
        let mut turned = [0.0; N];
        let squares;
        if self.is_smooth {
            let carried = corners.fetch_attributes(&self.vertices, NORMAL);
            normals = interpolate(&carried, &seen.weights());
            squares = dot_lanes(&normals, &normals);
            let steps = [
                interpolate(&carried, &seen.weights_dx()),
                interpolate(&carried, &seen.weights_dy()),
            ];
            if !normalize_vectors(&mut normals, &squares) {
                self.replace_degenerate_normals(corners, &squares, &mut normals);
            }
            turned = normal_variation(&normals, &squares, &steps);
        } else {
            squares = dot_lanes(&normals, &normals);
            if !normalize_vectors(&mut normals, &squares) {
                self.replace_degenerate_normals(corners, &squares, &mut normals);
            }
        }
        (normals, turned)
    }

    /// Where the normal is too short or too long to have a direction, that of the face, or any.
    #[cold]
    fn replace_degenerate_normals<const N: usize>(
        &self,
        corners: &VertexIndices<N>,
        squares: &[f32; N],
        normals: &mut VectorLanes<N>,
    ) {
        let faces = self.face_normals(&self.vertex_positions(corners));
        for lane in 0..N {
            if !(squares[lane] > 0.0 && squares[lane].is_finite()) {
                let face = [0, 1, 2].map(|axis: usize| faces[axis][lane]);
                let unit = try_normalize(face).unwrap_or([0.0, 0.0, 1.0]);
                for (axis, value) in normals.iter_mut().zip(unit) {
                    axis[lane] = value;
                }
            }
        }
    }

    /// Perpendicular to the triangles with corners at these places, on their front side; the lengths are twice their areas.
    #[inline(always)]
    pub(super) fn face_normals<const N: usize>(
        &self,
        [a, b, c]: &Attributes<N, 3>,
    ) -> VectorLanes<N> {
        let mut normals = [[0.0; N]; 3];
        let sign = if self.flips_winding { -1.0 } else { 1.0 };
        for lane in 0..N {
            let [ux, uy, uz] =
                [b[0][lane] - a[0][lane], b[1][lane] - a[1][lane], b[2][lane] - a[2][lane]];
            let [vx, vy, vz] =
                [c[0][lane] - a[0][lane], c[1][lane] - a[1][lane], c[2][lane] - a[2][lane]];
            normals[0][lane] = sign * (uy * vz - uz * vy);
            normals[1][lane] = sign * (uz * vx - ux * vz);
            normals[2][lane] = sign * (ux * vy - uy * vx);
        }
        normals
    }
}

/// Brings vectors to length 1, given the squares of their lengths, and tells whether all could be: none was too short or too long.
#[inline(always)]
pub(super) fn normalize_vectors<const N: usize>(
    vectors: &mut VectorLanes<N>,
    squares: &[f32; N],
) -> bool {
    let mut all_could = true;
    for lane in 0..N {
        let length = squares[lane].sqrt();
        all_could &= length > 0.0 && length < f32::INFINITY;
        let per = 1.0 / length;
        for axis in &mut *vectors {
            axis[lane] *= per;
        }
    }
    all_could
}

/// How far normals that were `blended` to these squares of lengths turn from one pixel to the next, at most: what smooth
/// normals are of unit length turns by the part of the step that is square to it.
#[inline(always)]
pub(super) fn normal_variation<const N: usize>(
    normals: &VectorLanes<N>,
    squares: &[f32; N],
    steps: &[VectorLanes<N>; 2],
) -> [f32; N] {
    let mut most = [0.0; N];
    for lane in 0..N {
        let n = lane_vector(normals, lane);
        let mut square: f32 = 0.0;
        for step in steps {
            let step = lane_vector(step, lane);
            let along = dot(n, step);
            square = square.max(dot(step, step) - along * along);
        }
        let turn = (square / squares[lane]).sqrt();
        most[lane] = if turn < 1.0 { turn } else { 1.0 };
    }
    most
}

/// The normals that a texture of slopes makes of the surface's own: red along the tangent, green along the bitangent, blue along
/// the normal (glTF 2.0 §3.9.3). Where there is no tangent, or the sum has no direction, the normals stay.
#[inline(always)]
pub(super) fn apply_normal_map<const N: usize>(
    normals: &VectorLanes<N>,
    tangents: &[[f32; N]; 4],
    slope: &VectorLanes<N>,
) -> VectorLanes<N> {
    let mut bent = *normals;
    for lane in 0..N {
        let [n, t, s] = [normals, &[tangents[0], tangents[1], tangents[2]], slope]
            .map(|v| lane_vector(v, lane));
        let bitangent = cross(n, t);
        let (across, along) = (dot(bitangent, bitangent), dot(t, t));
        let side = if tangents[3][lane] < 0.0 { -1.0 } else { 1.0 };
        let (u, v) = (s[0] / along.sqrt(), side * s[1] / across.sqrt());
        let sum = [0, 1, 2].map(|k: usize| t[k] * u + bitangent[k] * v + n[k] * s[2]);
        let square = dot(sum, sum);
        let per = 1.0 / square.sqrt();
        let is_good = across > 0.0 && square > 1e-12 && square < f32::INFINITY;
        for axis in 0..3 {
            bent[axis][lane] = if is_good { sum[axis] * per } else { n[axis] };
        }
    }
    bent
}

/// The unit vectors from places to the viewer, who is homogeneous: an eye, or a direction.
#[inline(always)]
pub(super) fn view_directions<const N: usize>(
    places: &VectorLanes<N>,
    viewer: [f32; 4],
) -> VectorLanes<N> {
    let mut ways = *places;
    for axis in 0..3 {
        for lane in 0..N {
            ways[axis][lane] = viewer[axis] - places[axis][lane] * viewer[3];
        }
    }
    for lane in 0..N {
        let way = lane_vector(&ways, lane);
        let square = dot(way, way);
        let per = if square > 0.0 { 1.0 / square.sqrt() } else { 0.0 };
        for axis in &mut ways {
            axis[lane] *= per;
        }
    }
    ways
}

/// Whether faces are seen from behind.
///
/// The face's own normal decides that: a smooth one may lean away from the viewer near the outline of a body and is right to
/// do so.
#[inline(always)]
pub(super) fn find_back_faces<const N: usize>(
    faces: &VectorLanes<N>,
    views: &VectorLanes<N>,
) -> [bool; N] {
    let towards = dot_lanes(faces, views);
    let mut is_back = [false; N];
    for lane in 0..N {
        is_back[lane] = towards[lane] < 0.0;
    }
    is_back
}

/// Turns some vectors round.
#[inline(always)]
pub(super) fn flip_vectors<const N: usize>(vectors: &mut VectorLanes<N>, which: &[bool; N]) {
    for axis in vectors {
        for lane in 0..N {
            axis[lane] = if which[lane] { -axis[lane] } else { axis[lane] };
        }
    }
}

/// The vector at length 1; `None` if it is too short or too long to have a direction.
fn try_normalize(v: [f32; 3]) -> Option<[f32; 3]> {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|c| c / length))
}
