//! Surface geometry at fragments: positions, view directions and shading normals.
//!
//! ```text
//!        v   n           v  unit vector to the viewer
//!         ╲ │            n  shading normal on the visible side: interpolated from the
//!          ╲│               vertices (Phong 1975), or the triangle's normal
//!   ────────●──────      ●  position in the world
//! ```
//!
//! Normals in the file may be missing (triangles are then flat), cancel out between vertices (the
//! face normal is then used) or point away from the viewer.
//!
//! The triangle's normal determines whether its back face is visible, because near a silhouette the
//! interpolated normal may legitimately point away from the viewer.

mod normal_mapping;

pub(crate) use normal_mapping::TangentLanes;

use super::Draw;
use super::attributes::{Attributes, NORMAL, POSITION, VertexIndices, interpolate};
use super::fragment_lanes::FragmentLanes;
use super::lanes::{Lanes, Mask, Vec3Lanes};
use super::vector::try_normalize;
use normal_mapping::apply_normal_map;

/// The geometry of the surfaces at `N` fragments, and the directions to the viewer.
///
/// All vectors are in world space. The geometry with smooth normals is used for shadows, ambient
/// occlusion and a clearcoat without a normal map; the geometry with mapped normals is used for the
/// rest of the BRDF.
#[derive(Clone, Copy, Debug)]
pub(super) struct SurfaceGeometry<const N: usize> {
    /// The positions in the world.
    pub(super) positions: Vec3Lanes<N>,
    /// The unit vectors to the viewer.
    pub(super) views: Vec3Lanes<N>,
    /// The unit shading normals on the visible side.
    pub(super) normals: Vec3Lanes<N>,
    /// Whether the visible side is the back face.
    is_back_facing: Mask<N>,
    /// The dot product n·v, clamped to at least 0.
    pub(super) n_dot_v: Lanes<N>,
    /// The angle between the interpolated normals of neighboring pixels in radians, at most 1.
    pub(super) normal_variation: Lanes<N>,
}

impl<const N: usize> SurfaceGeometry<N> {
    /// Creates surfaces with unit normals that are already on the visible side.
    #[inline(always)]
    pub(super) fn new(
        positions: Vec3Lanes<N>,
        views: Vec3Lanes<N>,
        normals: Vec3Lanes<N>,
        is_back_facing: Mask<N>,
        normal_variation: Lanes<N>,
    ) -> Self {
        let n_dot_v = normals.dot(views).clamp(0.0, 1.0);
        Self { positions, views, normals, is_back_facing, n_dot_v, normal_variation }
    }

    /// Returns the surfaces with the normals of a normal map. On a back face, the whole frame of
    /// tangent, bitangent and normal is flipped.
    #[inline(always)]
    pub(super) fn with_tangent_normal(
        &self,
        tangents: &TangentLanes<N>,
        tangent_normal: Vec3Lanes<N>,
    ) -> Self {
        let front_normals = flip_vectors(self.normals, &self.is_back_facing);
        let mapped = apply_normal_map(front_normals, tangents, tangent_normal);
        let normals = flip_vectors(mapped, &self.is_back_facing);
        let Self { positions, views, is_back_facing, normal_variation, .. } = *self;
        Self::new(positions, views, normals, is_back_facing, normal_variation)
    }
}

impl Draw<'_> {
    /// Returns the world positions of each fragment's vertices.
    #[inline(always)]
    pub(super) fn vertex_positions<const N: usize>(
        &self,
        vertices: &VertexIndices<N>,
    ) -> Attributes<N, 3> {
        vertices.fetch_attributes(&self.vertices, POSITION)
    }

    /// Interpolates the world positions of fragments.
    #[inline(always)]
    pub(super) fn interpolate_positions<const N: usize>(
        &self,
        vertices: &VertexIndices<N>,
        fragments: &impl FragmentLanes<N>,
    ) -> Vec3Lanes<N> {
        interpolate(&self.vertex_positions(vertices), &fragments.weights()).into()
    }

    /// Interpolates the unit normals on the front side, and computes how much they vary from pixel
    /// to pixel. For a flat draw, returns the constant normals of the triangles.
    #[inline(always)]
    pub(super) fn interpolate_normals<const N: usize>(
        &self,
        vertices: &VertexIndices<N>,
        fragments: &impl FragmentLanes<N>,
        face_normals: Vec3Lanes<N>,
    ) -> (Vec3Lanes<N>, Lanes<N>) {
        let mut normals = face_normals;
        let mut variation = Lanes::ZERO;
        if self.is_smooth {
            let attributes = vertices.fetch_attributes::<_, 3>(&self.vertices, NORMAL);
            normals = interpolate(&attributes, &fragments.weights()).into();
            // The lengths shrink where normals diverge; the derivatives refer to the unnormalized
            // vectors.
            let squares = normals.dot(normals);
            let steps = [
                interpolate(&attributes, &fragments.weights_dx()).into(),
                interpolate(&attributes, &fragments.weights_dy()).into(),
            ];
            if !normalize_vectors(&mut normals, squares) {
                self.replace_degenerate_normals(vertices, squares, &mut normals);
            }
            variation = normal_variation(normals, squares, steps);
        } else {
            let squares = normals.dot(normals);
            if !normalize_vectors(&mut normals, squares) {
                self.replace_degenerate_normals(vertices, squares, &mut normals);
            }
        }
        (normals, variation)
    }

    /// Substitutes the face normal, or any unit vector, for a normal that is too short or too long
    /// to have a direction, for example where opposite vertex normals cancel out.
    #[cold]
    fn replace_degenerate_normals<const N: usize>(
        &self,
        vertices: &VertexIndices<N>,
        squares: Lanes<N>,
        normals: &mut Vec3Lanes<N>,
    ) {
        let face_normals = self.face_normals(&self.vertex_positions(vertices));
        for lane in 0..N {
            if !(squares[lane] > 0.0 && squares[lane].is_finite()) {
                let unit = try_normalize(face_normals.lane(lane)).unwrap_or([0.0, 0.0, 1.0]);
                [normals.x[lane], normals.y[lane], normals.z[lane]] = unit;
            }
        }
    }

    /// Computes the front-side normals of triangles, each with a length of twice the triangle's
    /// area.
    #[inline(always)]
    pub(super) fn face_normals<const N: usize>(
        &self,
        positions: &Attributes<N, 3>,
    ) -> Vec3Lanes<N> {
        // The cross product of two edges, right-handed for counter-clockwise front faces.
        let [a, b, c] = *positions;
        let (a, b, c) = (Vec3Lanes::from(a), Vec3Lanes::from(b), Vec3Lanes::from(c));
        let sign = if self.flips_winding { -1.0 } else { 1.0 };
        (b - a).cross(c - a) * sign
    }
}

/// Normalizes vectors, given their squared lengths. Returns whether all have a direction, that is,
/// none is too short or too long.
#[inline(always)]
fn normalize_vectors<const N: usize>(vectors: &mut Vec3Lanes<N>, squares: Lanes<N>) -> bool {
    let lengths = squares.sqrt();
    *vectors = *vectors * (1.0 / lengths);
    let mut have_directions = true;
    // Do not use `all`, which would branch at each lane.
    for length in lengths.0 {
        have_directions &= length > 0.0 && length < f32::INFINITY;
    }
    have_directions
}

/// Computes the angle in radians, at most 1, between unit normals and the normals at the next
/// pixels.
///
/// `squares` are the squared lengths of the interpolated normals, and `steps` are the normals'
/// derivatives with respect to column and row. A unit vector turns by the component of a step that
/// is perpendicular to it.
///
/// The angle increases roughness in the BRDF (geometric specular antialiasing); without this, a
/// distant curved surface would sparkle.
#[inline(always)]
fn normal_variation<const N: usize>(
    normals: Vec3Lanes<N>,
    squares: Lanes<N>,
    steps: [Vec3Lanes<N>; 2],
) -> Lanes<N> {
    let mut perpendicular = Lanes::ZERO;
    for step in steps {
        // Only the perpendicular component of a step turns the normal.
        let along = normals.dot(step);
        perpendicular = perpendicular.max_lanes(step.dot(step) - along * along);
    }
    let angles = (perpendicular / squares).sqrt();
    // NaN, from a normal without a direction, also becomes 1.
    angles.map(|angle| if angle < 1.0 { angle } else { 1.0 })
}

/// Computes the unit vectors from positions to the viewer, a homogeneous point: the eye or, at
/// infinity, the direction of a parallel projection. The vector is zero at the eye itself.
#[inline(always)]
pub(super) fn view_directions<const N: usize>(
    positions: Vec3Lanes<N>,
    [x, y, z, w]: [f32; 4],
) -> Vec3Lanes<N> {
    let directions = Vec3Lanes::splat([x, y, z]) - positions * w;
    let inv_length = directions
        .dot(directions)
        .map(|square| if square > 0.0 { 1.0 / square.sqrt() } else { 0.0 });
    directions * inv_length
}

/// Finds the fragments on visible back faces, given the normals of their triangles.
#[inline(always)]
pub(super) fn find_back_faces<const N: usize>(
    face_normals: Vec3Lanes<N>,
    views: Vec3Lanes<N>,
) -> Mask<N> {
    face_normals.dot(views).is_below(0.0)
}

/// Negates vectors in some lanes.
#[inline(always)]
pub(super) fn flip_vectors<const N: usize>(vectors: Vec3Lanes<N>, mask: &Mask<N>) -> Vec3Lanes<N> {
    vectors.map(|component| (-component).select(mask, component))
}
