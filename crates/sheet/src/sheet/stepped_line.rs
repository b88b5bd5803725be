//! The line of a stepped section: checks its corners, and marks it in views along the step edges.
//!
//! ```text
//!   1 ────── 2                pieces perpendicular to the normal: from corner 1 to 2, 3 to 4 …
//!            │
//!            3 ────── 4       steps along the normal
//! ```

use super::composition::Composition;
use super::requested_views::{Fault, fault, unit_vector};
use super::section_line::PARALLEL_TOLERANCE;
use super::view_mark::ViewMark;
use super::view_plan::PlannedView;
use glam::DVec2;
use homog::{Point, Vector, World};

/// The maximum number of corners. A longer line is probably a mistake, and each pair of corners
/// requires another drawing.
const MAX_CORNERS: usize = 32;

/// The line of a stepped section in space.
pub(super) struct SteppedLine<'a> {
    pub(super) corners: &'a [Point<World>],
    pub(super) removed: Vector<World>,
    /// The direction of the edges of the steps. Seen along this direction, the cut is a line.
    pub(super) across: Vector<World>,
    pub(super) letter: char,
}

impl SteppedLine<'_> {
    /// Marks the line in a view if the view looks along the edges of the steps. Returns whether the
    /// line was marked.
    pub(super) fn mark(&self, one: &mut PlannedView) -> bool {
        let sees = one.view.camera.gaze().dot(self.across).abs() > 1.0 - PARALLEL_TOLERANCE;
        if !sees || !one.is_along_axis() {
            return false;
        }
        let whole = one.drawn_view();
        let shown = |point: &Point<World>| match &one.composition {
            Composition::Broken(part) => part.shortened(whole.image_of(*point)),
            _ => Some(whole.image_of(*point)),
        };
        let Some(mut corners) = self.corners.iter().map(shown).collect::<Option<Vec<DVec2>>>()
        else {
            return false;
        };
        let half = one.view.size * 0.5;
        let last = corners.len() - 1;
        corners[0] = end_at_border(corners[1], corners[0], half);
        corners[last] = end_at_border(corners[last - 1], corners[last], half);
        let retained = -one.view.direction_of(self.removed);
        one.marks.push(ViewMark::SteppedLine { corners, retained, letter: self.letter });
        true
    }
}

/// Moves the end of a line to the border of a rectangle around the origin. The line must begin
/// inside the rectangle.
fn end_at_border(from: DVec2, end: DVec2, half: DVec2) -> DVec2 {
    let direction = (end - from).normalize_or_zero();
    let to_side = |axis: usize| match direction[axis] {
        step if step.abs() < PARALLEL_TOLERANCE => f64::INFINITY,
        step => (half[axis] * step.signum() - from[axis]) / step,
    };
    let length = to_side(0).min(to_side(1));
    if length > 0.0 && length.is_finite() { from + direction * length } else { end }
}

/// Checks the corners of a stepped section and returns the direction of its pieces.
pub(super) fn check_steps(
    removed: Vector<World>,
    corners: &[Point<World>],
) -> Result<Vector<World>, Fault> {
    if corners.len() < 4 || !corners.len().is_multiple_of(2) {
        let count = corners.len();
        return Err(fault(format!(
            "its line has {count} corners; it must have two for each of at least two planes"
        )));
    }
    if corners.len() > MAX_CORNERS {
        return Err(fault(format!("its line can have at most {MAX_CORNERS} corners")));
    }
    let sides: Vec<Vector<World>> = corners.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let along = unit_vector(sides[0]).ok_or_else(|| fault("its first two corners are the same"))?;
    // The tolerance is relative to the whole line, because individual segments may be short.
    let total: f64 = sides.iter().map(|side| side.length()).sum();
    for (index, side) in sides.iter().enumerate() {
        let direction = if index % 2 == 0 { along } else { removed };
        let aside = *side - direction * side.dot(direction);
        let is_straight = aside.length() <= 1e-6 * total;
        let goes_on = index % 2 == 1 || side.dot(along) > 0.0;
        if !is_straight || !goes_on {
            let (from, to) = (index + 1, index + 2);
            return Err(fault(format!(
                "its line from corner {from} to corner {to} must run {}",
                if index % 2 == 0 {
                    "in the direction from corner 1 to corner 2, perpendicular to `removed`"
                } else {
                    "parallel to `removed`, as a step"
                }
            )));
        }
    }
    if along.dot(removed).abs() > PARALLEL_TOLERANCE {
        return Err(fault(
            "the line between its first two corners must be perpendicular to `removed`",
        ));
    }
    Ok(along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn lines_of_stepped_sections_are_checked() {
        let check = |corners: &[[f64; 3]]| {
            let corners: Vec<Point<World>> = corners.iter().map(|c| Point::from(*c)).collect();
            match check_steps(Vector::Z, &corners) {
                Ok(along) => Ok(along.raw()),
                Err(Fault::Request(reason)) => Err(reason),
                Err(Fault::Sheet(error)) => Err(error.to_string()),
            }
        };
        let (a, b) = ([-5.0, 0.0, 1.0], [0.0, 0.0, 1.0]);
        let steps = [a, b, [0.0, 0.0, 3.0], [5.0, 0.0, 3.0]];
        assert_eq!(check(&steps), Ok(DVec3::X));
        assert!(check(&[a, b]).is_err_and(|reason| reason.contains("2 corners")));
        let back = [a, b, [0.0, 0.0, 3.0], [-5.0, 0.0, 3.0]];
        assert!(check(&back).is_err_and(|reason| reason.contains("corner 3 to corner 4")));
        let askew = [a, b, [1.0, 0.0, 3.0], [5.0, 0.0, 3.0]];
        assert!(check(&askew).is_err_and(|reason| reason.contains("a step")));
        assert!(check(&[a, a, b, b]).is_err_and(|reason| reason.contains("the same")));
    }

    #[test]
    fn ends_move_to_the_border() {
        let half = DVec2::new(10.0, 5.0);
        let at = |x: f64, y: f64| DVec2::new(x, y);
        assert_eq!(end_at_border(at(2.0, 1.0), at(4.0, 1.0), half), at(10.0, 1.0));
        assert_eq!(end_at_border(at(2.0, 1.0), at(2.0, -90.0), half), at(2.0, -5.0));
    }
}
