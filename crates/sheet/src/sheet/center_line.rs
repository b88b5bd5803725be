//! Center lines: crosses in circles, and the axes of circles seen from the side (ISO 128-2, chain
//! lines 04.1).
//!
//! ```text
//!        │
//!      ╭─┼─╮          ┌───────┐
//!    ──┼─┼─┼──      ──┼─ ─ ─ ─┼──      the lines extend slightly beyond the circle or the part
//!      ╰─┼─╯          └───────┘
//!        │
//! ```
//!
//! Circles on one axis share one line along it. In a view along the axis, they share one cross that
//! is large enough for the largest circle. A circle gets a cross if at least half of it is present.
//! An axis gets a line if at least two circles share it, as in a cylinder or a truncated cone.

use super::annotation::{AnnotationLayer, ViewAnnotations};
use super::sheet_view::SheetView;
use core::f64::consts::PI;
use glam::DVec2;
use hidden_line::WorldCircle;
use viewport::DrawingScale;

/// The overhang of center lines beyond the circle or part, in millimeters on paper.
pub(super) const CENTER_LINE_OVERHANG: f64 = 2.5;

/// The minimum radius, in millimeters on paper, of a circle that gets a cross. A cross would hide a
/// smaller circle.
const LEAST_RADIUS: f64 = 0.75;

/// The minimum arc of a circle that gets a cross. Smaller arcs are fillets, not holes or shafts.
const LEAST_SWEEP: f64 = PI - 1e-6;

/// Axes and centers closer than this fraction of the view size are considered the same.
const SAME: f64 = 1e-4;

/// The maximum number of crosses, and of axes, in a view. More lines would only clutter the view.
const MAX_LINES: usize = 300;

/// The center lines of a view, in object millimeters from its center, with y down.
#[derive(Clone, Debug, Default)]
pub(super) struct CenterLines {
    /// Circles seen face-on: centers and radii.
    crosses: Vec<(DVec2, f64)>,
    /// Axes seen from the side, from end to end.
    axes: Vec<[DVec2; 2]>,
    /// Lines of symmetry, which replace coincident center lines: a point, and the index of the
    /// paper axis along which the line runs.
    symmetry: Vec<(DVec2, usize)>,
    /// The maximum distance between lines that count as one.
    same: f64,
}

impl CenterLines {
    /// Finds the center lines that circles have in a view.
    pub(super) fn in_view(view: &SheetView, circles: &[WorldCircle]) -> Self {
        let same = SAME * view.size.max_element();
        let large = circles.iter().filter(|circle| circle.sweep >= LEAST_SWEEP);
        let (mut crosses, mut sides) = (Vec::new(), Vec::new());
        for circle in large {
            let center = view.image_of(circle.center);
            let radius = circle.radius * view.millimeters_per_unit;
            if view.looks_along(circle.axis.raw()) {
                crosses.push((center, radius));
            } else if view.shows_true(circle.axis.raw()) {
                let end = view.image_of(circle.center + circle.axis);
                let along = (end - center).normalize_or(DVec2::X);
                let along = if along.x < -1e-9 || (along.x <= 1e-9 && along.y < 0.0) {
                    -along
                } else {
                    along
                };
                sides.push((center, along));
            }
        }
        let (crosses, axes) = (merge_crosses(crosses, same), merge_axes(sides, same));
        Self { crosses, axes, symmetry: Vec::new(), same }
    }

    /// Omits the center lines that coincide with these lines of symmetry.
    pub(super) fn beside(self, symmetry: Vec<(DVec2, usize)>) -> Self {
        Self { symmetry, ..self }
    }

    /// Whether a line coincides with a line of symmetry.
    fn is_covered(&self, line: [DVec2; 2]) -> bool {
        self.symmetry.iter().any(|(through, axis)| {
            line.iter().all(|end| (end[1 - axis] - through[1 - axis]).abs() <= self.same)
        })
    }

    /// Whether there are no center lines.
    pub(super) const fn is_empty(&self) -> bool {
        self.crosses.is_empty() && self.axes.is_empty()
    }

    /// Adds the lines at a given scale.
    pub(super) fn annotate(&self, annotations: &mut ViewAnnotations, scale: DrawingScale) {
        let ratio = scale.ratio();
        let layer = AnnotationLayer::CenterLines;
        let large = self.crosses.iter().filter(|(_, radius)| radius * ratio >= LEAST_RADIUS);
        let arms = large.flat_map(|(center, radius)| {
            [DVec2::X, DVec2::Y].map(|along| [*center - along * *radius, *center + along * *radius])
        });
        for line in arms.chain(self.axes.iter().copied()).filter(|line| !self.is_covered(*line)) {
            let [a, b] = line.map(|end| end * ratio);
            let beyond = (b - a).normalize_or_zero() * CENTER_LINE_OVERHANG;
            annotations.push_line(layer, [a - beyond, b + beyond]);
        }
    }
}

/// Returns the largest circle at each center, in order of decreasing radius.
fn merge_crosses(mut crosses: Vec<(DVec2, f64)>, same: f64) -> Vec<(DVec2, f64)> {
    crosses.sort_by(|(a, r), (b, s)| {
        s.total_cmp(r).then(a.x.total_cmp(&b.x)).then(a.y.total_cmp(&b.y))
    });
    let mut merged: Vec<(DVec2, f64)> = Vec::new();
    for (center, radius) in crosses {
        if merged.len() < MAX_LINES
            && !merged.iter().any(|(known, _)| known.distance(center) <= same)
        {
            merged.push((center, radius));
        }
    }
    merged
}

/// Merges axes on the same line into one segment from the first to the last center. Each axis is a
/// circle's center and a direction.
fn merge_axes(sides: Vec<(DVec2, DVec2)>, same: f64) -> Vec<[DVec2; 2]> {
    let mut lines: Vec<(DVec2, DVec2, [f64; 2])> = Vec::new();
    for (center, along) in sides {
        let own = lines.iter().position(|(point, direction, _)| {
            direction.perp_dot(along).abs() < 1e-3
                && (center - *point).perp_dot(*direction).abs() <= same
        });
        match own {
            Some(index) => {
                let (point, direction, [low, high]) = &mut lines[index];
                let at = (center - *point).dot(*direction);
                (*low, *high) = (low.min(at), high.max(at));
            }
            None if lines.len() < MAX_LINES => lines.push((center, along, [0.0; 2])),
            None => {}
        }
    }
    let long = lines.into_iter().filter(|(_, _, [low, high])| high - low > same);
    long.map(|(point, along, ends)| ends.map(|end| point + along * end)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn concentric_circles_share_one_cross() {
        let at = DVec2::new(3.0, 4.0);
        let crosses = vec![(at, 2.0), (at, 5.0), (at + 1e-6, 1.0), (DVec2::ZERO, 1.0)];
        assert_eq!(merge_crosses(crosses, 1e-3), [(at, 5.0), (DVec2::ZERO, 1.0)]);
    }

    #[test]
    fn an_axis_extends_from_its_first_circle_to_its_last() {
        let on = |x: f64| (DVec2::new(x, 7.0), DVec2::X);
        let single = (DVec2::new(0.0, 9.0), DVec2::X);
        let axes = merge_axes(vec![on(2.0), on(-5.0), single, on(1.0)], 1e-3);
        assert_eq!(axes, [[DVec2::new(-5.0, 7.0), DVec2::new(2.0, 7.0)]]);
    }
}
