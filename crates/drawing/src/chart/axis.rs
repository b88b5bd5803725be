//! Chart axes: linear and logarithmic scales, and round ticks.
//!
//! ```text
//!   linear       position = (v − from) / (to − from)
//!   logarithmic  position = log(v / from) / log(to / from)
//! ```
//!
//! Ticks are round numbers, few enough to label (Heckbert, *Nice Numbers for Graph Labels*, 1990):
//! multiples of 1, 2 or 5 times a power of ten.

/// The maximum number of ticks on an axis.
const MAX_TICKS: usize = 9;

/// An axis of a chart.
///
/// ```
/// use drawing::{Axis, Spacing};
///
/// let axis = Axis { title: "w".into(), from: 1.0, to: 100.0, spacing: Spacing::Logarithmic };
/// assert_eq!(axis.ticks(), [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0]);
/// assert_eq!(axis.fraction_at(10.0), 0.5);
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Axis {
    /// The quantity on the axis.
    pub title: String,
    /// The value at the start of the axis; greater than 0 if it is logarithmic.
    pub from: f64,
    /// The value at the end, greater than `from`.
    pub to: f64,
    /// The scale: linear or logarithmic.
    pub spacing: Spacing,
}

/// The spacing of values on an axis.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Spacing {
    /// Equal distances for equal differences.
    Linear,
    /// Equal distances for equal ratios.
    Logarithmic,
}

impl Axis {
    /// Returns the position of a value on the axis, clamped to 0 at its start and 1 at its end.
    #[must_use]
    pub fn fraction_at(&self, value: f64) -> f64 {
        let part = match self.spacing {
            Spacing::Linear => (value - self.from) / (self.to - self.from),
            Spacing::Logarithmic => {
                let [from, to, value] = [self.from, self.to, value].map(libm::log10);
                (value - from) / (to - from)
            }
        };
        if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) }
    }

    /// Returns round values in ascending order, at most nine.
    #[must_use]
    pub fn ticks(&self) -> Vec<f64> {
        match self.spacing {
            Spacing::Linear => self.linear_ticks(),
            Spacing::Logarithmic => self.logarithmic_ticks(),
        }
    }

    /// Returns ticks at multiples of 1, 2 or 5 · 10ⁿ, with the smallest step for at most nine.
    ///
    /// If the step is a fraction, values are computed as quotients: 3 / 10 has the same bits as
    /// 0.3, but 3 · 0.1 does not.
    fn linear_ticks(&self) -> Vec<f64> {
        let span = self.to - self.from;
        if !(span > 0.0 && span.is_finite()) {
            // An axis with a single value has no step.
            return vec![self.from];
        }
        let power = libm::floor(libm::log10(span)) as i32;
        let steps = [power - 1, power].into_iter().flat_map(|n| [1.0, 2.0, 5.0].map(|d| (d, n)));
        for (digit, power) in steps {
            let step = nearest_decimal(digit, power);
            // Rounding must not lose a tick at an end, so ticks up to 1/2000 of a step beyond the
            // end are included.
            let first = libm::ceil(self.from / step - 5e-4) as i64;
            let last = libm::floor(self.to / step + 5e-4) as i64;
            if last - first < MAX_TICKS as i64 {
                // If the step is a fraction, divides by an integer to get the exact bits.
                let value = |n: i64| match power {
                    ..0 => n as f64 * digit / power_of_ten(-power),
                    _ => n as f64 * step,
                };
                return (first..=last).map(value).collect();
            }
        }
        vec![self.from, self.to]
    }

    /// Returns ticks at 1, 2 and 5 · 10ⁿ, or at every k-th power of ten if there would be too many.
    /// Uses linear ticks if there would be too few.
    fn logarithmic_ticks(&self) -> Vec<f64> {
        let [low, high] = [self.from, self.to].map(|end| libm::floor(libm::log10(end)) as i32);
        let fitting = |digits: &[f64], every: i32| -> Vec<f64> {
            let powers = (low..=high).filter(|power| power.rem_euclid(every) == 0);
            let values =
                powers.flat_map(|power| digits.iter().map(move |&d| nearest_decimal(d, power)));
            let range = self.from * (1.0 - 1e-9)..=self.to * (1.0 + 1e-9);
            values.filter(|value| range.contains(value)).collect()
        };
        let fine = fitting(&[1.0, 2.0, 5.0], 1);
        if fine.len() < 3 {
            return self.linear_ticks();
        }
        let coarser = (1..).map(|every| fitting(&[1.0], every));
        let mut all = std::iter::once(fine).chain(coarser);
        all.find(|ticks| ticks.len() <= MAX_TICKS).unwrap_or_default()
    }
}

/// Returns the float nearest to a digit times a power of ten, as a decimal literal would give it.
fn nearest_decimal(digit: f64, power: i32) -> f64 {
    format!("{digit}e{power}").parse().unwrap_or(1.0)
}

/// Returns the float nearest to a power of ten.
fn power_of_ten(power: i32) -> f64 {
    nearest_decimal(1.0, power)
}

/// Formats a round number as compactly as possible.
pub(super) fn format_tick(value: f64) -> String {
    let value = value + 0.0;
    let size = value.abs();
    if size == 0.0 || (1e-3..1e5).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ticks(from: f64, to: f64, spacing: Spacing) -> Vec<f64> {
        Axis { title: String::new(), from, to, spacing }.ticks()
    }

    #[test]
    fn ticks_are_round_and_few() {
        use Spacing::{Linear, Logarithmic};
        assert_eq!(ticks(0.0, 1.0, Linear), [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]);
        assert_eq!(ticks(-1.0, 1.0, Linear), [-1.0, -0.5, 0.0, 0.5, 1.0]);
        assert_eq!(ticks(2.0, 40.0, Linear), [5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0]);
        assert_eq!(ticks(2.0, 40.0, Logarithmic), [2.0, 5.0, 10.0, 20.0]);
        assert_eq!(ticks(0.1, 1000.0, Logarithmic), [0.1, 1.0, 10.0, 100.0, 1000.0]);
        assert_eq!(ticks(1e-10, 1e5, Logarithmic).len(), 8);
        assert_eq!(ticks(3.0, 3.5, Logarithmic), [3.0, 3.1, 3.2, 3.3, 3.4, 3.5]);
    }

    /// Every axis, however wide or narrow, has a limited number of ticks, in ascending order and
    /// within its range.
    #[test]
    fn every_axis_has_ticks() {
        for spacing in [Spacing::Linear, Spacing::Logarithmic] {
            for power in -300..300 {
                for ratio in [1.001, 1.5, 7.0, 1e3, 1e7] {
                    let from = power_of_ten(power) * 1.7;
                    let actual = ticks(from, from * ratio, spacing);
                    assert!((2..=MAX_TICKS).contains(&actual.len()), "{from} {ratio} {actual:?}");
                    assert!(actual.windows(2).all(|pair| pair[0] < pair[1]), "{actual:?}");
                    if (-9..9).contains(&power) && ratio > 1.4 {
                        let long =
                            actual.iter().map(|tick| format_tick(*tick)).find(|t| t.len() > 7);
                        assert_eq!(long, None, "{from} {ratio} {spacing:?}");
                    }
                    let tolerance = from * (ratio - 1.0) * 1e-3;
                    let on_axis = from - tolerance..=from * ratio + tolerance;
                    assert!(actual.iter().all(|tick| on_axis.contains(tick)), "{from} {actual:?}");
                }
            }
        }
    }

    #[test]
    fn ticks_are_formatted_compactly() {
        let texts = [0.0, -0.0, 0.3, 1e-7, 2e5, 1000.0].map(format_tick);
        assert_eq!(texts, ["0", "0", "0.3", "1e-7", "2e5", "1000"]);
    }
}
