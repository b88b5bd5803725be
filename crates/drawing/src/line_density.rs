//! Draws dense lines thinner and paler so that they do not merge into a solid area.
//!
//! ```text
//!   coverage   area of the ink / area of the page, near the lines
//!        1 ┤            ╱  a thousand edges in the space of ten
//!    0.6 ┤ · · · ╭─────    above this, the pen gets thinner, then paler
//!        0 ┤    ╱
//! ```
//!
//! The measure is the mean coverage around the points of the lines. It is a single number for all
//! lines that are thinned together, so thinning leaves no visible borders in the drawing.

use crate::Drawing;
use glam::DVec2;
use hidden_line::EdgeSegment;

/// The side length of the squares in which coverage is measured, in pixels.
const CELL_SIDE: f64 = 16.0;
/// The coverage up to which lines are drawn unchanged.
const MAX_COVERAGE: f64 = 0.6;
/// The minimum fraction of its width that a line keeps; beyond that, lines become paler.
const MIN_WIDTH_FACTOR: f64 = 0.4;
/// The minimum fraction of its contrast that a line keeps.
const MIN_CONTRAST: f64 = 0.4;

/// The thinning of dense lines.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Thinning {
    /// The factor for the width.
    pub(crate) width: f64,
    /// The factor for the contrast with the paper.
    pub(crate) contrast: f64,
}

impl Thinning {
    /// No thinning.
    pub(crate) const NONE: Self = Self { width: 1.0, contrast: 1.0 };

    /// Computes the thinning of selected segments of a drawing with the given line width in pixels.
    ///
    /// With `keeps_width`, lines become paler but not thinner, for widths that follow a standard.
    pub(crate) fn for_lines(
        drawing: &Drawing,
        width: f64,
        keeps_width: bool,
        selects: impl Fn(&EdgeSegment) -> bool,
    ) -> Self {
        let coverage = mean_coverage(drawing, width, selects);
        if coverage <= MAX_COVERAGE {
            return Self::NONE;
        }
        let factor = MAX_COVERAGE / coverage;
        let width = if keeps_width { 1.0 } else { factor.max(MIN_WIDTH_FACTOR) };
        // Uses the square root, because overlapping lines darken the page less than separate ones.
        Self { width, contrast: (factor / width).sqrt().clamp(MIN_CONTRAST, 1.0) }
    }
}

/// Returns the mean coverage around the points of the selected segments. It may exceed 1, because
/// lines may overlap.
fn mean_coverage(drawing: &Drawing, width: f64, selects: impl Fn(&EdgeSegment) -> bool) -> f64 {
    let [columns, rows] =
        [drawing.size.x, drawing.size.y].map(|side| (side / CELL_SIDE).ceil().max(1.0));
    let mut lengths = vec![0.0; columns as usize * rows as usize];
    for segment in drawing.segments.iter().filter(|segment| selects(segment)) {
        let [from, to] = segment.ends;
        let length = from.distance(to);
        // Divides the segment into steps of at most half a cell, each counted at its midpoint.
        let steps = (2.0 * length / CELL_SIDE).ceil().max(1.0);
        for step in 0..steps as usize {
            let middle = from.lerp(to, (step as f64 + 0.5) / steps);
            let cell = (middle / CELL_SIDE).floor();
            let cell = cell.clamp(DVec2::ZERO, DVec2::new(columns - 1.0, rows - 1.0));
            lengths[cell.y as usize * columns as usize + cell.x as usize] += length / steps;
        }
    }
    let total: f64 = lengths.iter().sum();
    let squares: f64 = lengths.iter().map(|length| length * length).sum();
    if total > 0.0 { squares / total * width / (CELL_SIDE * CELL_SIDE) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hidden_line::EdgeClass;

    /// Returns a drawing of 160 × 160 pixels with `count` horizontal lines from side to side.
    fn drawing_of_lines(count: usize) -> Drawing {
        let segment = |line: usize| EdgeSegment {
            ends: [0.0, 160.0].map(|x| DVec2::new(x, 160.0 * (line as f64 + 0.5) / count as f64)),
            depths: [1.0; 2],
            class: EdgeClass::Facet,
            visible: true,
            object: 0,
            edge: 0,
        };
        Drawing {
            size: DVec2::splat(160.0),
            segments: (0..count).map(segment).collect(),
            ..Drawing::default()
        }
    }

    #[test]
    fn coverage_is_the_inked_fraction_of_the_page() {
        for (count, width, coverage) in [(10, 1.0, 10.0 / 160.0), (100, 0.5, 50.0 / 160.0)] {
            let mean = mean_coverage(&drawing_of_lines(count), width, |_| true);
            assert!((mean - coverage).abs() < 0.1 * coverage, "{count}: {mean}");
        }
        assert_eq!(mean_coverage(&drawing_of_lines(10), 1.0, |_| false), 0.0);
        assert_eq!(mean_coverage(&drawing_of_lines(0), 1.0, |_| true), 0.0);
    }

    #[test]
    fn only_dense_lines_are_thinned_first_in_width_then_in_contrast() {
        let thinning = |count, keeps_width| {
            Thinning::for_lines(&drawing_of_lines(count), 1.0, keeps_width, |_| true)
        };
        assert_eq!(thinning(40, false), Thinning::NONE);
        let dense = thinning(160, false);
        assert!((0.5..0.7).contains(&dense.width) && dense.contrast > 0.99, "{dense:?}");
        let denser = thinning(1600, false);
        assert!(denser.width == MIN_WIDTH_FACTOR && denser.contrast < 0.5, "{denser:?}");
        let kept = thinning(160, true);
        assert!(kept.width == 1.0 && kept.contrast < 0.9, "{kept:?}");
    }
}
