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

use super::{Tolerance, Trace};
use glam::{DVec2, DVec3};

/// A face, or what the view volume leaves of it, as a triangle on the screen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// The corners, with a positive area.
    pub(super) corners: [DVec2; 3],
    /// The unit normal of the face in the world, towards the viewer.
    pub(super) normal: DVec3,
    /// The distance of its plane from the origin, along the normal.
    pub(super) offset: f64,
}

/// What is hidden: an interval of s, and whether the edge runs along the border there.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Hiding {
    /// The edge passes behind the inside of the face.
    Inside([f64; 2]),
    /// It runs exactly behind a side of the face, which is on the left as the edge goes (on a screen with y up).
    Left([f64; 2]),
    /// The same with the face on the right.
    Right([f64; 2]),
}

/// The value at the start and at the end of the edge of a function that is linear along it.
type Linear = [f64; 2];

fn at([start, end]: Linear, s: f64) -> f64 {
    start + (end - start) * s
}

impl Piece {
    /// What the face hides of an edge.
    pub(super) fn hides(&self, edge: &Trace, tolerance: &Tolerance) -> Option<Hiding> {
        let (sides, lengths) = self.sides(edge);
        let beyond = |k: usize| sides[k][0].max(sides[k][1]) < -tolerance.screen * lengths[k];
        if (0..3).any(beyond) {
            return None;
        }
        let along = (0..3).find(|&k| runs_along(k, &sides, lengths[k], edge, tolerance));
        let span = within((0..3).filter(|&k| Some(k) != along).map(|k| sides[k]))?;
        let span = self.behind(edge, span, tolerance)?;
        let Some(k) = along else { return Some(Hiding::Inside(span)) };
        let side = self.corners[(k + 1) % 3] - self.corners[k];
        let runs_with = side.dot(edge.screen[1] - edge.screen[0]) > 0.0;
        Some(if runs_with { Hiding::Left(span) } else { Hiding::Right(span) })
    }

    /// How far inside of each side the ends of the edge are, times the length of the side.
    fn sides(&self, edge: &Trace) -> ([Linear; 3], [f64; 3]) {
        let [a, b, c] = self.corners;
        let sides = [[a, b], [b, c], [c, a]];
        (sides.map(|side| inside(side, edge)), sides.map(|[from, to]| (to - from).length()))
    }

    /// The part of an interval where the edge is behind the plane, if it gets behind it at all.
    fn behind(&self, edge: &Trace, span: [f64; 2], tolerance: &Tolerance) -> Option<[f64; 2]> {
        let height = edge.world.map(|end| self.normal.dot(end) - self.offset);
        let ends = span.map(|s| at(height, edge.to_world(s)));
        if ends[0].min(ends[1]) >= -tolerance.world {
            return None;
        }
        let pierced =
            || edge.to_screen(height[0] / (height[0] - height[1])).clamp(span[0], span[1]);
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
fn inside([from, to]: [DVec2; 2], edge: &Trace) -> Linear {
    let turned = (to.x, to.y) < (from.x, from.y);
    let [p, q] = if turned { [to, from] } else { [from, to] };
    edge.screen.map(|end| {
        let left = (q - p).perp_dot(end - p);
        if turned { -left } else { left }
    })
}

/// Where all functions are positive.
fn within(functions: impl Iterator<Item = Linear>) -> Option<[f64; 2]> {
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
fn runs_along(
    k: usize,
    sides: &[Linear; 3],
    length: f64,
    edge: &Trace,
    tolerance: &Tolerance,
) -> bool {
    let near = tolerance.screen * length;
    let [start, end] = sides[k];
    if start.min(end) > near || start.max(end) < -near {
        return false;
    }
    let others = [sides[(k + 1) % 3], sides[(k + 2) % 3]];
    within(others.into_iter()).is_some_and(|span| {
        let is_long = (span[1] - span[0]) * edge.length() > 8.0 * tolerance.screen;
        is_long && span.iter().all(|&s| at(sides[k], s).abs() <= near)
    })
}
