//! Occlusion of one edge by one face: the interval of the edge that the face hides (rule HL-1).
//!
//! ```text
//!              ╱╲            screen: inside where three linear functions of s are positive
//!    a ───────╱██╲─── b      world:  behind the plane where the height, linear in u, is negative
//!            ╱    ╲          each leaves a half-line; the four intersect in one interval, █
//!           ╱──────╲
//! ```
//!
//! Distances from sides are measured in pixels, heights above planes in world units. In these
//! units, the meaning of a tolerance does not depend on the projection or on the slope of the face.
//! An edge a tiny fraction of a pixel inside a side counts as running along it, and an edge a tiny
//! fraction of the model behind a plane counts as lying in it.
//!
//! [`Occluder::overlap`] finds where the edge and the face overlap on the screen, and
//! [`OccluderInWorld::interval_behind`] finds the part of the overlap where the edge is behind the
//! face.

use super::{ProjectedEdge, Tolerance};
use crate::projector::Projector;
use glam::{DVec2, DVec3};

/// A face on the screen, or a triangle that remains after it is clipped to the view volume.
#[derive(Clone, Copy, Debug)]
pub(super) struct Occluder {
    /// The vertices in pixels, ordered so that `(b − a) × (c − a)` is positive.
    pub(super) vertices: [DVec2; 3],
}

/// The plane of a face in the world, with the equation `normal · p = offset`.
#[derive(Clone, Copy, Debug)]
struct OrientedPlane {
    /// The unit normal that faces the viewer.
    normal: DVec3,
    /// The distance from the origin along the normal.
    offset: f64,
}

/// The interval of s where a face hides an edge, and the kind of occlusion.
///
/// An edge exactly behind a side is hidden only if another face adjoins that side; a single face
/// only touches the edge.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Occlusion {
    /// The edge passes behind the interior of the face: the interval is hidden unconditionally.
    Interior([f64; 2]),
    /// The edge runs exactly behind a side of the face.
    Along(SideInterval),
    /// The edge runs outside a side of the face, no farther away than the width of a crack.
    Beside(SideInterval),
}

/// The part of an edge behind or beside a side of a face.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct SideInterval {
    /// The interval of s.
    pub(super) interval: [f64; 2],
    /// Whether the face is on the left of the edge, on a screen with y up.
    pub(super) is_left: bool,
    /// Whether the face is wider than two cracks, measured from the side. A narrower face does not
    /// bound a crack, because lines beyond it stay visible.
    pub(super) is_wide: bool,
    /// The object of the face.
    pub(super) object: u32,
}

/// The overlap of a face and an edge on the screen, regardless of depth.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct ScreenOverlap {
    /// The part where the edge passes over the interior.
    pub(super) interior: Option<[f64; 2]>,
    /// The part where the edge runs along a side or beside it.
    pub(super) side: Option<SideOverlap>,
}

/// The part of an edge along or beside a side of a face, on the screen.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct SideOverlap {
    /// The index of the side, which is also the index of the vertex where the side starts.
    pub(super) side: usize,
    /// The interval of s.
    pub(super) interval: [f64; 2],
    /// Whether the part is exactly on the side, not just near it on the outside.
    pub(super) is_along: bool,
    /// Whether the face is on the left of the edge.
    pub(super) is_left: bool,
    /// Whether the face is wider than two cracks.
    pub(super) is_wide: bool,
}

/// A function that is linear along the edge: its values at the start and at the end.
type LinearFunction = [f64; 2];

/// Returns the value of a linear function at fraction s.
fn evaluate_linear([start, end]: LinearFunction, s: f64) -> f64 {
    start + (end - start) * s
}

impl Occluder {
    /// Returns the parts of an edge that pass over this face or beside it, or `None` if none do.
    ///
    /// The cheapest rejection comes first: the whole edge is outside one side. A side that the edge
    /// runs along does not bound the interior interval, because only rounding determines which side
    /// of it the edge is on.
    pub(super) fn overlap(
        &self,
        edge: &ProjectedEdge,
        tolerance: &Tolerance,
    ) -> Option<ScreenOverlap> {
        let (triangle, is_outside) = self.sides_near(edge, tolerance)?;
        let parallel = triangle.parallel_sides(edge);
        let along = || triangle.side_along(edge, tolerance.screen, parallel);
        let along = if is_outside { None } else { along() };
        let inside = if is_outside { None } else { triangle.interval_inside(along) };
        let beside = || triangle.interval_beside(edge, tolerance, parallel);
        let (interior, side) = match along {
            Some(side) => (None, inside.map(|interval| (side, interval))),
            None if tolerance.crack <= tolerance.screen => (inside, None),
            None => (inside, beside()),
        };
        let direction = edge.screen[1] - edge.screen[0];
        let side = side.map(|(side, interval)| SideOverlap {
            side,
            interval,
            is_along: along.is_some(),
            is_left: triangle.vectors[side].dot(direction) > 0.0,
            is_wide: triangle.is_wider_than(2.0 * tolerance.crack, side),
        });
        (interior.is_some() || side.is_some()).then_some(ScreenOverlap { interior, side })
    }

    /// Returns the distances of an edge from the sides, and whether the whole edge is outside one
    /// of them. Returns `None` if it is outside by more than the width of a crack.
    fn sides_near(
        &self,
        edge: &ProjectedEdge,
        tolerance: &Tolerance,
    ) -> Option<(TriangleSides, bool)> {
        let [a, b, c] = self.vertices;
        let vectors = [b - a, c - b, a - c];
        let sides = [[a, b], [b, c], [c, a]];
        let near = tolerance.screen * tolerance.screen;
        let farthest = near.max(tolerance.crack * tolerance.crack);
        let mut values = [[0.0; 2]; 3];
        let mut is_outside = false;
        for k in 0..3 {
            let [start, end] = side_function(sides[k], edge);
            values[k] = [start, end];
            let most = if start > end { start } else { end };
            if most < 0.0 {
                // Comparing squares avoids the square root.
                let (area, length) = (most * most, vectors[k].length_squared());
                if area > farthest * length {
                    return None;
                }
                is_outside |= area > near * length;
            }
        }
        Some((TriangleSides { values, vectors }, is_outside))
    }
}

/// The triangle of an occluder in the world, with the data needed to find the parts behind it.
pub(super) struct OccluderInWorld<'a> {
    /// The vertices, in the same order as on the screen.
    pub(super) vertices: [DVec3; 3],
    /// The viewer.
    pub(super) projector: &'a Projector,
}

impl OccluderInWorld<'_> {
    /// Returns the part of an interval of an edge that is behind the plane of the triangle.
    ///
    /// Returns `None` if there is no such part, or if the triangle is seen edge-on.
    pub(super) fn interval_behind(
        &self,
        edge: &ProjectedEdge,
        interval: [f64; 2],
        tolerance: &Tolerance,
    ) -> Option<[f64; 2]> {
        let [a, b, c] = self.vertices;
        let plane = self.plane_towards_viewer((b - a).cross(c - a), a)?;
        interval_behind_plane(plane, edge, interval, tolerance)
    }

    /// Returns the part of an interval that is behind a side, for an edge that runs beside the
    /// side.
    ///
    /// The plane of the triangle is not meaningful for points outside the triangle, especially if
    /// it is tilted. Of all planes through the side, the one that faces the viewer most directly is
    /// used instead.
    pub(super) fn interval_behind_side(
        &self,
        side: usize,
        edge: &ProjectedEdge,
        interval: [f64; 2],
        tolerance: &Tolerance,
    ) -> Option<[f64; 2]> {
        let [from, to] = [side, (side + 1) % 3].map(|k| self.vertices[k]);
        let towards = self.projector.towards_viewer(from);
        let along = to - from;
        let plane = self.plane_towards_viewer(along.cross(towards).cross(along), from)?;
        interval_behind_plane(plane, edge, interval, tolerance)
    }

    /// Returns the plane through a point, with the given normal or its opposite, oriented toward
    /// the viewer.
    fn plane_towards_viewer(&self, normal: DVec3, point: DVec3) -> Option<OrientedPlane> {
        let normal = normal.normalize_or_zero();
        let towards = normal.dot(self.projector.towards_viewer(point));
        let normal = normal * towards.signum();
        (towards != 0.0).then(|| OrientedPlane { normal, offset: normal.dot(point) })
    }
}

/// The sides of a triangle in relation to an edge.
struct TriangleSides {
    /// The signed distances of the edge from each side, times the length of the side. Tolerances
    /// are multiplied by the length instead, which saves a division.
    values: [LinearFunction; 3],
    /// The vectors from the start of each side to its end, in pixels.
    vectors: [DVec2; 3],
}

impl TriangleSides {
    /// Whether the vertex opposite a side is more than `pixels` pixels away from that side.
    fn is_wider_than(&self, pixels: f64, side: usize) -> bool {
        let doubled_area = self.vectors[2].perp_dot(self.vectors[0]);
        doubled_area > pixels * self.vectors[side].length()
    }

    /// Whether the edge is nearly parallel to each side, at an angle whose sine is less than a
    /// quarter. At a steeper angle, too little of the edge is near the side to run along it.
    fn parallel_sides(&self, edge: &ProjectedEdge) -> [bool; 3] {
        let length = (edge.screen[1] - edge.screen[0]).length_squared();
        [0, 1, 2].map(|k| {
            let [start, end] = self.values[k];
            let change = end - start;
            16.0 * change * change <= 1.001 * length * self.vectors[k].length_squared()
        })
    }

    /// Returns the first side that the edge runs along: the edge stays within `distance` pixels of
    /// it while inside the other two.
    ///
    /// The interval inside the other two must be longer than eight times the distance. Shorter
    /// intervals occur wherever an edge crosses a vertex, in any direction.
    fn side_along(
        &self,
        edge: &ProjectedEdge,
        distance: f64,
        parallel: [bool; 3],
    ) -> Option<usize> {
        (0..3).filter(|&k| parallel[k]).find(|&k| {
            let [start, end] = self.values[k];
            let vector = self.vectors[k].abs();
            // The sum of both components is at least the length, so few sides need the square root.
            let widest = distance * (vector.x + vector.y);
            let (least, most) = if start < end { (start, end) } else { (end, start) };
            if least > widest || most < -widest {
                return false;
            }
            let near = distance * self.vectors[k].length();
            if least > near || most < -near {
                return false;
            }
            self.interval_inside(Some(k)).is_some_and(|interval| {
                let is_long = (interval[1] - interval[0]) * edge.screen_length() > 8.0 * distance;
                let is_near = |&s: &f64| evaluate_linear(self.values[k], s).abs() <= near;
                is_long && interval.iter().all(is_near)
            })
        })
    }

    /// Returns the first side that the edge runs beside on the outside, no farther away than the
    /// width of a crack, and the interval of s where it does so.
    ///
    /// The interval must be longer than four times that width, so the angle between the edge and
    /// the side is small.
    fn interval_beside(
        &self,
        edge: &ProjectedEdge,
        tolerance: &Tolerance,
        parallel: [bool; 3],
    ) -> Option<(usize, [f64; 2])> {
        (0..3).filter(|&k| parallel[k]).find_map(|k| {
            let [start, end] = self.values[k];
            let vector = self.vectors[k].abs();
            let widest = tolerance.crack * (vector.x + vector.y);
            let (least, most) = if start < end { (start, end) } else { (end, start) };
            if least > 0.0 || most < -widest {
                return None;
            }
            if !self.is_wider_than(2.0 * tolerance.crack, k) {
                return None;
            }
            let length = self.vectors[k].length();
            let (far, near) = (tolerance.crack * length, tolerance.screen * length);
            let band = [[start + far, end + far], [near - start, near - end]];
            let others = [self.values[(k + 1) % 3], self.values[(k + 2) % 3]];
            let interval = positive_interval(band.into_iter().chain(others))?;
            let stretch = (interval[1] - interval[0]) * edge.screen_length();
            (stretch > 4.0 * tolerance.crack).then_some((k, interval))
        })
    }

    /// Returns the open interval of s where the edge is inside all sides, ignoring the side `but`.
    fn interval_inside(&self, but: Option<usize>) -> Option<[f64; 2]> {
        positive_interval((0..3).filter(|&k| Some(k) != but).map(|k| self.values[k]))
    }
}

/// Returns the part of an interval of s where the edge is behind the plane of the face.
///
/// ```text
///    height above the plane
///       +│╲
///        ├──╲────────── 0
///       −│    ╲████████        hidden
///        └──────────── u
/// ```
///
/// The height is linear in u, not in s, so its zero is found in the world and mapped to the screen
/// by IN-1. An edge that is nowhere farther behind the plane than `tolerance.world` counts as lying
/// in the plane and is not hidden.
fn interval_behind_plane(
    plane: OrientedPlane,
    edge: &ProjectedEdge,
    interval: [f64; 2],
    tolerance: &Tolerance,
) -> Option<[f64; 2]> {
    let height = edge.world.map(|end| plane.normal.dot(end) - plane.offset);
    let ends = interval.map(|s| evaluate_linear(height, edge.world_fraction(s)));
    if ends[0].min(ends[1]) >= -tolerance.world {
        return None;
    }
    let pierced = || {
        edge.screen_fraction(height[0] / (height[0] - height[1])).clamp(interval[0], interval[1])
    };
    let interval = match ends.map(|height| height < 0.0) {
        [true, false] => [interval[0], pierced()],
        [false, true] => [pierced(), interval[1]],
        _ => interval,
    };
    (interval[0] < interval[1]).then_some(interval)
}

/// Returns twice the signed area between a side and each end of the edge; positive where the edge
/// is to the left of the side.
///
/// The area is always computed from the same end of the side. The two faces at a side therefore get
/// values that differ only in sign, so there is no gap or overlap between the parts that they hide.
fn side_function([from, to]: [DVec2; 2], edge: &ProjectedEdge) -> LinearFunction {
    let is_reversed = (to.x, to.y) < (from.x, from.y);
    let [p, q] = if is_reversed { [to, from] } else { [from, to] };
    edge.screen.map(|end| {
        let left = (q - p).perp_dot(end - p);
        if is_reversed { -left } else { left }
    })
}

/// Returns the open interval of s in [0, 1] where all functions are positive, or `None` if it is
/// empty.
fn positive_interval(functions: impl Iterator<Item = LinearFunction>) -> Option<[f64; 2]> {
    let mut interval = [0.0_f64, 1.0];
    for [start, end] in functions {
        match [start > 0.0, end > 0.0] {
            [true, true] => {}
            [false, false] => return None,
            [true, false] => interval[1] = interval[1].min(start / (start - end)),
            [false, true] => interval[0] = interval[0].max(start / (start - end)),
        }
    }
    (interval[0] < interval[1]).then_some(interval)
}
