//! Occlusion of one edge by one face: the interval of the edge that the face hides (rule HL-1).
//!
//! ```text
//!              ╱╲            screen: inside where three linear functions of s are positive
//!    a ───────╱██╲─── b      world:  behind the plane where its height, linear in u, is negative
//!            ╱    ╲          each leaves a half-line; their intersection is one interval, █
//!           ╱──────╲
//! ```
//!
//! Sides are measured in pixels and heights in lengths of the world. In these units a tolerance has
//! a meaning that neither the projection nor the slope of the face changes: an edge a thousandth of
//! a pixel inside a side runs along it, and an edge a millionth of the model behind a plane lies in
//! it.

use super::{ProjectedEdge, Tolerance};
use glam::{DVec2, DVec3};

/// A face on the screen, or a triangle of what clipping to the view volume left of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Occluder {
    /// The vertices in pixels, ordered so that `(b − a) × (c − a)` is positive.
    pub(super) vertices: [DVec2; 3],
}

/// The plane of a face in the world: the unit normal on the side of the viewer, and the distance
/// from the origin along it. Points of the plane have `normal · p = offset`.
pub(super) type NormalAndOffset = (DVec3, f64);

/// The interval of s in which a face hides an edge, and how: by its interior or only along a side.
///
/// An edge exactly behind a side is hidden only if another face continues on the other side of it;
/// a single face would only touch it. Left and right are those of a viewer who follows the edge on
/// a screen with y up.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Occlusion {
    /// The edge passes behind the interior of the face: the interval is hidden without a condition.
    Interior([f64; 2]),
    /// The edge runs exactly behind a side, and the face is on its left.
    FaceLeft([f64; 2]),
    /// The edge runs exactly behind a side, and the face is on its right.
    FaceRight([f64; 2]),
}

/// A function that is linear along the edge: its values at the start and at the end.
type LinearFunction = [f64; 2];

/// The value of a linear function at fraction s.
fn evaluate_linear([start, end]: LinearFunction, s: f64) -> f64 {
    start + (end - start) * s
}

impl Occluder {
    /// Finds the parts of an edge that this face hides, by itself or together with another.
    ///
    /// Three steps, the cheapest rejection first: a triangle side with the whole edge outside; the
    /// interval inside the triangle; the part of it behind the plane, which is asked for only then.
    /// A side that the edge runs along is left out of the second step, because rounding decides on
    /// which side of it the edge lies. Without a plane there is no third step.
    ///
    /// Where an edge runs outside a side, no farther than the width of a crack, it is hidden if
    /// another face is as near on its other side: together they leave a crack that shows nothing.
    pub(super) fn occlude_edge(
        &self,
        edge: &ProjectedEdge,
        tolerance: &Tolerance,
        plane: Option<impl FnOnce() -> Option<NormalAndOffset>>,
        mut found: impl FnMut(Occlusion),
    ) {
        let [a, b, c] = self.vertices;
        let sides = [[a, b], [b, c], [c, a]].map(|side| side_function(side, edge));
        let triangle = TriangleSides { values: sides, vectors: [b - a, c - b, a - c] };
        let is_outside = triangle.have_outside(tolerance.screen);
        if is_outside && triangle.have_outside(tolerance.crack.max(tolerance.screen)) {
            return;
        }
        let along = if is_outside { None } else { triangle.side_along(edge, tolerance.screen) };
        let inside = if is_outside { None } else { triangle.interval_inside(along) };
        let beside = match (along, inside) {
            (Some(side), Some(interval)) => Some((side, interval)),
            (Some(_), None) => None,
            _ if tolerance.crack <= tolerance.screen => None,
            (None, _) => triangle.interval_beside(edge, tolerance),
        };
        if inside.is_none() && beside.is_none() {
            return;
        }
        let heights = match plane.map(|plane| plane()) {
            Some(None) => return,
            Some(Some((normal, offset))) => Some(edge.world.map(|end| normal.dot(end) - offset)),
            None => None,
        };
        let behind = |interval| match heights {
            Some(heights) => interval_behind_plane(heights, edge, interval, tolerance),
            None => Some(interval),
        };
        if along.is_none() {
            inside.and_then(behind).into_iter().for_each(|part| found(Occlusion::Interior(part)));
        }
        let beside = beside.and_then(|(side, interval)| Some((side, behind(interval)?)));
        if let Some((side, part)) = beside {
            let runs_with = triangle.vectors[side].dot(edge.screen[1] - edge.screen[0]) > 0.0;
            found(if runs_with { Occlusion::FaceLeft(part) } else { Occlusion::FaceRight(part) });
        }
    }
}

/// The sides of a triangle against an edge.
struct TriangleSides {
    /// The signed distances of the edge from each side, times the length of the side: that spares a
    /// division, and tolerances are times the length instead.
    values: [LinearFunction; 3],
    /// From the start of each side to its end, in pixels.
    vectors: [DVec2; 3],
}

impl TriangleSides {
    /// Whether all of the edge is outside one of the sides, by more than some pixels.
    fn have_outside(&self, distance: f64) -> bool {
        (0..3).any(|k| {
            let [start, end] = self.values[k];
            let most = if start > end { start } else { end };
            most < 0.0 && most < -distance * self.vectors[k].length()
        })
    }

    /// The first side that the edge runs along: within `distance` in pixels as long as it is inside
    /// the two others.
    ///
    /// The stretch must be longer than eight times the distance; shorter ones occur where the edge
    /// crosses a vertex, and say nothing about its direction.
    fn side_along(&self, edge: &ProjectedEdge, distance: f64) -> Option<usize> {
        (0..3).find(|&k| {
            let [start, end] = self.values[k];
            let vector = self.vectors[k].abs();
            // The sum of both components is not less than the length: few sides need the root.
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

    /// The first side that the edge runs beside on the outside, no farther than the width of a
    /// crack, and the interval of s in which it does.
    ///
    /// It must be longer than four times that width, and so the angle between both is small.
    fn interval_beside(
        &self,
        edge: &ProjectedEdge,
        tolerance: &Tolerance,
    ) -> Option<(usize, [f64; 2])> {
        (0..3).find_map(|k| {
            let [start, end] = self.values[k];
            let vector = self.vectors[k].abs();
            let widest = tolerance.crack * (vector.x + vector.y);
            let (least, most) = if start < end { (start, end) } else { (end, start) };
            if least > 0.0 || most < -widest {
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

    /// The open interval of s in which the edge is inside all sides but one.
    fn interval_inside(&self, but: Option<usize>) -> Option<[f64; 2]> {
        positive_interval((0..3).filter(|&k| Some(k) != but).map(|k| self.values[k]))
    }
}

/// The part of an interval of s in which the edge is behind the plane of the face.
///
/// ```text
///    height over the plane
///       +│╲
///        ├──╲────────── 0
///       −│    ╲████████        hidden
///        └──────────── u
/// ```
///
/// The height is linear in u, not in s: its zero is found in the world and mapped to the screen
/// by IN-1. An edge that nowhere gets farther behind the plane than `tolerance.world` lies in
/// it and is not hidden at all.
///
/// `height` is that of the ends of the edge over the plane.
fn interval_behind_plane(
    height: [f64; 2],
    edge: &ProjectedEdge,
    interval: [f64; 2],
    tolerance: &Tolerance,
) -> Option<[f64; 2]> {
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

/// Twice the signed area between a side and each end of the edge; positive where the edge is left
/// of the side.
///
/// It is computed from the same end of the side whichever way the side runs, so that the two faces
/// at a side find the same bits with opposite signs: no gap and no overlap between what they hide.
fn side_function([from, to]: [DVec2; 2], edge: &ProjectedEdge) -> LinearFunction {
    let is_reversed = (to.x, to.y) < (from.x, from.y);
    let [p, q] = if is_reversed { [to, from] } else { [from, to] };
    edge.screen.map(|end| {
        let left = (q - p).perp_dot(end - p);
        if is_reversed { -left } else { left }
    })
}

/// The open interval of s in [0, 1] where all functions are positive; `None` if it is empty.
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
