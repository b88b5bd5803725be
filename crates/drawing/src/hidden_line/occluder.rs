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
    /// The part of an edge that this face hides, `None` if there is none.
    ///
    /// Three steps, the cheapest rejection first: a triangle side with the whole edge outside; the
    /// interval inside the triangle; the part of it behind the plane, which is asked for only then.
    /// A side that the edge runs along is left out of the second step, because rounding decides on
    /// which side of it the edge lies. Without a plane there is no third step.
    pub(super) fn occlude_edge(
        &self,
        edge: &ProjectedEdge,
        tolerance: &Tolerance,
        plane: Option<impl FnOnce() -> Option<NormalAndOffset>>,
    ) -> Option<Occlusion> {
        let [a, b, c] = self.vertices;
        let side_vectors = [b - a, c - b, a - c];
        let sides = [[a, b], [b, c], [c, a]].map(|side| side_function(side, edge));
        // The distances from the sides are times their lengths, which spares a division; tolerances
        // are times the length instead.
        let near = |k: usize| tolerance.screen * side_vectors[k].length();
        for (k, [start, end]) in sides.iter().enumerate() {
            let most = if start > end { *start } else { *end };
            if most < 0.0 && most < -near(k) {
                return None;
            }
        }
        let side_along_edge = (0..3).find(|&k| {
            let [start, end] = sides[k];
            let vector = side_vectors[k].abs();
            // The sum of both components is not less than the length: few sides need the root.
            let is_far = start.min(end) > tolerance.screen * (vector.x + vector.y);
            !is_far && runs_along_side(k, &sides, near(k), edge, tolerance)
        });
        let interval =
            positive_interval((0..3).filter(|&k| Some(k) != side_along_edge).map(|k| sides[k]))?;
        let interval = match plane {
            Some(plane) => interval_behind_plane(plane()?, edge, interval, tolerance)?,
            None => interval,
        };
        let Some(k) = side_along_edge else { return Some(Occlusion::Interior(interval)) };
        let runs_with = side_vectors[k].dot(edge.screen[1] - edge.screen[0]) > 0.0;
        Some(if runs_with { Occlusion::FaceLeft(interval) } else { Occlusion::FaceRight(interval) })
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
fn interval_behind_plane(
    (normal, offset): NormalAndOffset,
    edge: &ProjectedEdge,
    interval: [f64; 2],
    tolerance: &Tolerance,
) -> Option<[f64; 2]> {
    let height = edge.world.map(|end| normal.dot(end) - offset);
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

/// Whether the edge runs along side `k`: within `near`, which is `tolerance.screen` times the
/// length of the side, as long as it is inside the two other sides.
///
/// The stretch must be longer than eight tolerances; shorter ones occur where the edge crosses a
/// vertex, and say nothing about its direction.
fn runs_along_side(
    k: usize,
    sides: &[LinearFunction; 3],
    near: f64,
    edge: &ProjectedEdge,
    tolerance: &Tolerance,
) -> bool {
    let [start, end] = sides[k];
    if start.min(end) > near || start.max(end) < -near {
        return false;
    }
    let others = [sides[(k + 1) % 3], sides[(k + 2) % 3]];
    positive_interval(others.into_iter()).is_some_and(|interval| {
        let is_long = (interval[1] - interval[0]) * edge.screen_length() > 8.0 * tolerance.screen;
        is_long && interval.iter().all(|&s| evaluate_linear(sides[k], s).abs() <= near)
    })
}
