//! Receivers of shadows: where the smooth surface is that a mesh of flat triangles stands for.
//!
//! Normals are smooth and triangles are not: near the border of light and shade whole triangles face away from a light that
//! their normals still see, and would be in their own shadow, one by one. The place that is asked for its shadow is therefore
//! moved onto the planes that the corners' normals stand for, where the surface bulges (Hanika, *Hacking the shadow
//! terminator*, Ray Tracing Gems II, 2021).

use super::Draw;
use super::corners::{Corners, NORMAL, blend};
use super::normal::Facing;
use super::seen::{Seen, dot, lane_of};

/// The places and the unit normals of surfaces that shadows fall on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Receivers<const N: usize> {
    pub(super) places: [[f32; N]; 3],
    pub(super) normals: [[f32; N]; 3],
}

impl<const N: usize> Receivers<N> {
    /// Those of a draw's fragments that lie so.
    #[inline(always)]
    pub(super) fn of(
        draw: &Draw<'_>,
        corners: &Corners<N>,
        seen: &impl Seen<N>,
        facing: &Facing<N>,
    ) -> Self {
        let mut receivers = Self { places: facing.places, normals: facing.normals };
        if draw.smooth {
            let carried = draw.places(corners);
            let normals = corners.carried::<_, 3>(&draw.vertices, NORMAL);
            // The front's normals point to the side that is seen, or all of them away from it.
            let fronts = blend(&normals, &seen.weights());
            for lane in 0..N {
                let here = lane_of(&facing.places, lane);
                let seen_side = dot(lane_of(&fronts, lane), lane_of(&facing.normals, lane));
                let side = if seen_side < 0.0 { -1.0 } else { 1.0 };
                for corner in 0..3 {
                    let at = lane_of(&carried[corner], lane);
                    let n = lane_of(&normals[corner], lane).map(|c| c * side);
                    let below =
                        dot([here[0] - at[0], here[1] - at[1], here[2] - at[2]], n).min(0.0);
                    let share = seen.weights()[corner][lane] * below;
                    for axis in 0..3 {
                        receivers.places[axis][lane] -= share * n[axis];
                    }
                }
            }
        }
        receivers
    }
}
