//! Receivers of shadows: where the smooth surface is that a mesh of flat triangles stands for.
//!
//! Normals are smooth and triangles are not: near the border of light and shade whole triangles face away from a light that
//! their normals still see, and would be in their own shadow, one by one. The place that is asked for its shadow is therefore
//! moved onto the planes that the corners' normals stand for, where the surface bulges (Hanika, *Hacking the shadow
//! terminator*, Ray Tracing Gems II, 2021).

use super::Draw;
use super::attributes::{NORMAL, VertexIndices, interpolate};
use super::fragment_lanes::{FragmentLanes, dot, lane_vector};
use super::surface_geometry::SurfaceGeometry;

/// The places and the unit normals of surfaces that shadows fall on.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShadowReceiver<const N: usize> {
    pub(super) positions: [[f32; N]; 3],
    pub(super) normals: [[f32; N]; 3],
}

impl<const N: usize> ShadowReceiver<N> {
    /// Those of a draw's fragments that lie so.
    #[inline(always)]
    pub(super) fn from_geometry(
        draw: &Draw<'_>,
        corners: &VertexIndices<N>,
        seen: &impl FragmentLanes<N>,
        facing: &SurfaceGeometry<N>,
    ) -> Self {
        let mut receivers = Self { positions: facing.positions, normals: facing.normals };
        if draw.is_smooth {
            let carried = draw.vertex_positions(corners);
            let normals = corners.fetch_attributes::<_, 3>(&draw.vertices, NORMAL);
            // The front's normals point to the side that is seen, or all of them away from it.
            let fronts = interpolate(&normals, &seen.weights());
            for lane in 0..N {
                let here = lane_vector(&facing.positions, lane);
                let seen_side = dot(lane_vector(&fronts, lane), lane_vector(&facing.normals, lane));
                let side = if seen_side < 0.0 { -1.0 } else { 1.0 };
                for corner in 0..3 {
                    let at = lane_vector(&carried[corner], lane);
                    let n = lane_vector(&normals[corner], lane).map(|c| c * side);
                    let below =
                        dot([here[0] - at[0], here[1] - at[1], here[2] - at[2]], n).min(0.0);
                    let share = seen.weights()[corner][lane] * below;
                    for axis in 0..3 {
                        receivers.positions[axis][lane] -= share * n[axis];
                    }
                }
            }
        }
        receivers
    }
}
