//! Dash fitting: scales patterns so that a line begins and ends with a dash.
//!
//! ```text
//!   unfitted  ━━━━  ━━━━  ━━━━  ━━━━  ━        fitted  ━━━━  ━━━━  ━━━━  ━━━━
//! ```
//!
//! A hidden edge should have dashes, not gaps, at its ends (ISO 128-2). The pattern is slightly
//! stretched or shrunk to fit a whole number n of periods plus one dash:
//!
//! ```text
//!   open    length = scale · (n · period + dash)
//!   closed  length = scale · n · period           n ≥ 2
//! ```
//!
//! n is the nearest integer, so the scale stays between about 0.6 and 1.5. Lines that would need a
//! smaller scale are drawn without gaps.

use super::page::{Pen, Polyline};

/// The minimum scale of a pattern. A line too short for two dashes at this scale is drawn without
/// gaps.
const MIN_PATTERN_SCALE: f64 = 0.6;

impl Pen {
    /// Returns the lengths of the dashes and gaps, in millimeters, with which this pen draws a
    /// line. The result is empty for a line without gaps.
    ///
    /// ```
    /// use page::{IsoLineGroup, LineType, Polyline};
    /// use glam::DVec2;
    ///
    /// let pen = LineType::Dashed.to_pen(0.25, [0; 3], Default::default(), Default::default());
    /// assert_eq!(pen.dashes, [3.0, 0.75]);
    /// let line = Polyline::through_points(&[DVec2::ZERO, DVec2::new(10.0, 0.0)], false);
    /// // Two periods and a dash: 2 · 3.75 + 3 = 10.5, so the pattern is scaled by 10 / 10.5.
    /// let dashes = pen.fitted_dashes(&line.expect("two points"));
    /// assert!((dashes[0] - 3.0 * 10.0 / 10.5).abs() < 1e-12);
    /// assert_eq!(IsoLineGroup::MM_0_5.narrow_width(), 0.25);
    /// ```
    #[must_use]
    pub fn fitted_dashes(&self, line: &Polyline) -> Vec<f64> {
        let Some(&dash) = self.dashes.first() else { return Vec::new() };
        let (length, period) = (line.length(), self.dashes.iter().sum::<f64>());
        let rest = if line.closed { 0.0 } else { dash };
        let shortest = if line.closed { 2.0 * period } else { period + dash };
        if length < MIN_PATTERN_SCALE * shortest {
            return Vec::new();
        }
        let least = if line.closed { 2.0 } else { 1.0 };
        let periods = libm::round((length - rest) / period).max(least);
        let scale = length / (periods * period + rest);
        self.dashes.iter().map(|part| part * scale).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    fn dashed_pen(dashes: &[f64]) -> Pen {
        Pen { dashes: dashes.to_vec(), ..Pen::solid(0.25, [0; 3]) }
    }

    fn test_polyline(length: f64, closed: bool) -> Polyline {
        // If closed, this is a triangle whose sides are 3, 4 and 5 twelfths of the length.
        let corners = [DVec2::ZERO, DVec2::new(length / 4.0, 0.0), DVec2::new(0.0, length / 3.0)];
        let straight = [DVec2::ZERO, DVec2::new(length, 0.0)];
        Polyline::through_points(if closed { &corners } else { &straight }, closed).expect("a line")
    }

    #[test]
    fn lines_begin_and_end_with_a_dash() {
        for pattern in [&[3.0, 0.75][..], &[6.0, 0.75, 0.125, 0.75]] {
            let pen = dashed_pen(pattern);
            let period: f64 = pattern.iter().sum();
            for step in 1..400 {
                let length = 0.5 * f64::from(step);
                let fitted = pen.fitted_dashes(&test_polyline(length, false));
                let Some(dash) = fitted.first() else {
                    assert!(length < MIN_PATTERN_SCALE * (period + pattern[0]));
                    continue;
                };
                let periods = (length - dash) / fitted.iter().sum::<f64>();
                assert!((periods - libm::round(periods)).abs() < 1e-9 && periods > 0.5, "{length}");
                let scale = dash / pattern[0];
                assert!((MIN_PATTERN_SCALE..1.5).contains(&scale), "{length} mm: {scale}");
            }
        }
    }

    #[test]
    fn closed_lines_have_a_whole_number_of_periods() {
        let pen = dashed_pen(&[3.0, 0.75]);
        for length in [6.0, 12.0, 33.0, 240.0] {
            let fitted = pen.fitted_dashes(&test_polyline(length, true));
            let periods = length / fitted.iter().sum::<f64>();
            assert!((periods - libm::round(periods)).abs() < 1e-6 && periods > 1.5, "{length}");
        }
        assert!(pen.fitted_dashes(&test_polyline(3.0, true)).is_empty());
    }

    #[test]
    fn short_lines_and_continuous_pens_have_no_gaps() {
        assert!(dashed_pen(&[3.0, 0.75]).fitted_dashes(&test_polyline(3.0, false)).is_empty());
        assert!(dashed_pen(&[]).fitted_dashes(&test_polyline(300.0, false)).is_empty());
    }
}
