//! What one face hides of one edge (HL-1).
//!
//! ```text
//!              ╱╲            On the screen the face is a triangle: the edge is within it where it is on the inner side of
//!    a ───────╱──╲─── b      each of the three sides, an interval of s. In the world the face is a plane: the edge is
//!            ╱    ╲          behind it on a half-line of u. What is in both is hidden.
//!           ╱──────╲
//! ```
//! The sides are measured in pixels and the plane in lengths of the world, where their tolerances have a meaning that
//! neither the projection nor the slope of the face can change.

use super::{ProjectedEdge, Tolerance};
use glam::{DVec2, DVec3};

/// A face, or what the view volume leaves of it, as a triangle on the screen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Occluder {
    /// The corners, with a positive area.
    pub(super) vertices: [DVec2; 3],
    /// The unit normal of the face in the world, towards the viewer.
    pub(super) normal: DVec3,
    /// The distance of its plane from the origin, along the normal.
    pub(super) offset: f64,
}

/// What is hidden: an interval of s, and whether the edge runs along the border there.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Occlusion {
    /// The edge passes behind the inside of the face.
    Interior([f64; 2]),
    /// It runs exactly behind a side of the face, which is on the left as the edge goes (on a screen with y up).
    FaceLeft([f64; 2]),
    /// The same with the face on the right.
    FaceRight([f64; 2]),
}

/// The value at the start and at the end of the edge of a function that is linear along it.
type LinearFunction = [f64; 2];

fn evaluate_linear([start, end]: LinearFunction, s: f64) -> f64 {
    start + (end - start) * s
}

impl Occluder {
    /// What the face hides of an edge.
    pub(super) fn occlude_edge(
        &self,
        edge: &ProjectedEdge,
        tolerance: &Tolerance,
    ) -> Option<Occlusion> {
        let (sides, lengths) = self.side_functions(edge);
        let beyond = |k: usize| sides[k][0].max(sides[k][1]) < -tolerance.screen * lengths[k];
        if (0..3).any(beyond) {
            return None;
        }
        let side_along_edge =
            (0..3).find(|&k| runs_along_side(k, &sides, lengths[k], edge, tolerance));
        let span =
            positive_interval((0..3).filter(|&k| Some(k) != side_along_edge).map(|k| sides[k]))?;
        let span = self.interval_behind_plane(edge, span, tolerance)?;
        let Some(k) = side_along_edge else { return Some(Occlusion::Interior(span)) };
        let side = self.vertices[(k + 1) % 3] - self.vertices[k];
        let runs_with = side.dot(edge.screen[1] - edge.screen[0]) > 0.0;
        Some(if runs_with { Occlusion::FaceLeft(span) } else { Occlusion::FaceRight(span) })
    }

    /// How far inside of each side the ends of the edge are, times the length of the side.
    fn side_functions(&self, edge: &ProjectedEdge) -> ([LinearFunction; 3], [f64; 3]) {
        let [a, b, c] = self.vertices;
        let sides = [[a, b], [b, c], [c, a]];
        (sides.map(|side| side_function(side, edge)), sides.map(|[from, to]| (to - from).length()))
    }

    /// The part of an interval where the edge is behind the plane, if it gets behind it at all.
    fn interval_behind_plane(
        &self,
        edge: &ProjectedEdge,
        span: [f64; 2],
        tolerance: &Tolerance,
    ) -> Option<[f64; 2]> {
        let height = edge.world.map(|end| self.normal.dot(end) - self.offset);
        let ends = span.map(|s| evaluate_linear(height, edge.world_fraction(s)));
        if ends[0].min(ends[1]) >= -tolerance.world {
            return None;
        }
        let pierced =
            || edge.screen_fraction(height[0] / (height[0] - height[1])).clamp(span[0], span[1]);
        let span = match ends.map(|height| height < 0.0) {
            [true, false] => [span[0], pierced()],
            [false, true] => [pierced(), span[1]],
            _ => span,
        };
        (span[0] < span[1]).then_some(span)
    }
}

/// How far to the left of a side the ends of an edge are. Computed from the same end of the side whichever way it runs,
/// so that the faces on both sides of it see the edge cross at the same bits.
fn side_function([from, to]: [DVec2; 2], edge: &ProjectedEdge) -> LinearFunction {
    let is_reversed = (to.x, to.y) < (from.x, from.y);
    let [p, q] = if is_reversed { [to, from] } else { [from, to] };
    edge.screen.map(|end| {
        let left = (q - p).perp_dot(end - p);
        if is_reversed { -left } else { left }
    })
}

/// Where all functions are positive.
fn positive_interval(functions: impl Iterator<Item = LinearFunction>) -> Option<[f64; 2]> {
    let mut span = [0.0_f64, 1.0];
    for [start, end] in functions {
        match [start > 0.0, end > 0.0] {
            [true, true] => {}
            [false, false] => return None,
            [true, false] => span[1] = span[1].min(start / (start - end)),
            [false, true] => span[0] = span[0].max(start / (start - end)),
        }
    }
    (span[0] < span[1]).then_some(span)
}

/// Whether, as long as it is inside of the two other sides, the edge runs on this one.
fn runs_along_side(
    k: usize,
    sides: &[LinearFunction; 3],
    length: f64,
    edge: &ProjectedEdge,
    tolerance: &Tolerance,
) -> bool {
    let near = tolerance.screen * length;
    let [start, end] = sides[k];
    if start.min(end) > near || start.max(end) < -near {
        return false;
    }
    let others = [sides[(k + 1) % 3], sides[(k + 2) % 3]];
    positive_interval(others.into_iter()).is_some_and(|span| {
        let is_long = (span[1] - span[0]) * edge.screen_length() > 8.0 * tolerance.screen;
        is_long && span.iter().all(|&s| evaluate_linear(sides[k], s).abs() <= near)
    })
}
