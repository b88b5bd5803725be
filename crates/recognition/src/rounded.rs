//! Rounded numbers: values with their possible rounding errors and the number of their digits.
//!
//! A matrix may be printed with three decimals, stored as f32 or computed in f64. The precision is
//! estimated from the entries and propagated to first order through sums, products and quotients:
//! near = 0.0999 ± 0.0002 is read as 0.1.

use alloc::vec::Vec;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// The digit count of a parameter that no short decimal represents.
const MANY_DIGITS: u32 = 8;

/// A number and its maximum error.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Rounded {
    pub(crate) value: f64,
    pub(crate) error: f64,
}

/// The entries of a matrix, row by row, with their precision.
pub(crate) type Entries<const N: usize> = [[Rounded; N]; N];

impl Rounded {
    pub(crate) const ONE: Self = Self::exact(1.0);

    pub(crate) const fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// Applies a function, given by its value and derivative at this number.
    pub(crate) fn mapped(self, value: f64, derivative: f64) -> Self {
        Self { value, error: self.error * derivative.abs() + 4.0 * f64::EPSILON * value.abs() }
    }

    /// Returns whether the number may equal `expected`, within its error.
    pub(crate) fn is(self, expected: f64) -> bool {
        self.is_within(expected, 0.0)
    }

    /// Returns whether the number may equal `expected`, within its error plus `slack`.
    pub(crate) fn is_within(self, expected: f64, slack: f64) -> bool {
        self.error.is_finite() && (self.value - expected).abs() <= self.error + slack
    }

    /// Returns whether two numbers may be equal, within their errors.
    pub(crate) fn equals(self, other: Self) -> bool {
        (self - other).is(0.0)
    }

    pub(crate) fn is_zero(self) -> bool {
        self.is(0.0)
    }

    /// Returns the square root, or 0 for negative numbers.
    pub(crate) fn sqrt(self) -> Self {
        let root = libm::sqrt(self.value.max(0.0));
        self.mapped(root, 0.5 / root.max(f64::MIN_POSITIVE))
    }

    /// Returns the angle with this tangent, in degrees.
    pub(crate) fn atan_degrees(self) -> Self {
        let slope = (1.0 / (1.0 + self.value * self.value)).to_degrees();
        self.mapped(libm::atan(self.value).to_degrees(), slope)
    }

    /// Returns the shortest decimal within the error, or the number itself if that decimal has more
    /// than seven digits.
    pub(crate) fn simplest(self) -> f64 {
        if self.is_zero() {
            return 0.0;
        }
        let short = (1..MANY_DIGITS).map(|digits| round_to_digits(self.value, digits));
        let mut short = short.filter(|&decimal| self.is(decimal));
        short.next().unwrap_or(self.value)
    }

    /// Returns whether the number may be a power of ten, such as 0.1, 1 or 10, within its error.
    pub(crate) fn is_power_of_ten(self) -> bool {
        let simplest = self.simplest();
        let exponent = libm::round(libm::log10(simplest.abs())) as i32;
        let power = power_of_ten(exponent.unsigned_abs());
        simplest == if exponent < 0 { 1.0 / power } else { power }
    }

    /// Returns the number of significant digits of the shortest decimal within the error. Returns 0
    /// for zero and for numbers that are not finite, and 8 if there is no short decimal.
    pub(crate) fn decimal_digits(self) -> u32 {
        if self.is_zero() || !self.value.is_finite() {
            return 0;
        }
        let found = (1..MANY_DIGITS).find(|&n| self.is(round_to_digits(self.value, n)));
        found.unwrap_or(MANY_DIGITS)
    }

    /// Returns [`Self::decimal_digits`], or a small cost for a simple fraction such as 16/9.
    pub(crate) fn digits(self) -> u32 {
        let decimal = self.decimal_digits();
        if decimal < 3 {
            return decimal;
        }
        let is_fraction = |q: u32| {
            let above = self * Self::exact(f64::from(q));
            above.value.abs() < 100.0 && above.is(libm::round(above.value))
        };
        if (3..=12).any(is_fraction) { 2 } else { decimal }
    }
}

/// Returns the decimal nearest to x with the given number of significant digits.
fn round_to_digits(x: f64, digits: u32) -> f64 {
    let exponent = libm::floor(libm::log10(x.abs())) as i32;
    let decimals = digits as i32 - 1 - exponent;
    let power = power_of_ten(decimals.unsigned_abs());
    if decimals >= 0 { libm::round(x * power) / power } else { libm::round(x / power) * power }
}

fn power_of_ten(exponent: u32) -> f64 {
    (0..exponent.min(300)).fold(1.0, |power, _| power * 10.0)
}

/// Returns the entries with their errors, estimated from their decimals or from f32 or f64
/// arithmetic.
///
/// | entries | error |
/// | --- | --- |
/// | 0 and ±1, and all entries if none has more than two decimals | 0 |
/// | others with 3 to 12 decimals | 0.6 units in the last decimal |
/// | f32 numbers | 2.4e-7 relative, 1.2e-7 of the largest |
/// | other numbers | 1e-14 relative, 1e-15 of the largest |
pub(crate) fn measure_entries<const N: usize>(rows: [[f64; N]; N]) -> Entries<N> {
    let entries = rows.as_flattened();
    let largest = entries.iter().fold(0.0, |size: f64, entry| size.max(entry.abs()));
    let (relative, absolute) = match (0..=12).find(|&n| entries.iter().all(|&x| has_decimals(x, n)))
    {
        Some(0..=2) => (0.0, 0.0),
        Some(decimals) => (0.0, 0.6 / power_of_ten(decimals)),
        None if entries.iter().all(|&x| f64::from(x as f32) == x) => (2.4e-7, 1.2e-7 * largest),
        None => (1e-14, 1e-15 * largest),
    };
    rows.map(|row| {
        row.map(|value| {
            let whole = value == 0.0 || value.abs() == 1.0;
            let error = if whole { 0.0 } else { absolute + relative * value.abs() };
            Rounded { value, error }
        })
    })
}

/// Returns all entries with the precision of the coarser entries, once for each possible precision,
/// finest first. This is for matrices assembled from numbers of different precision.
///
/// At least three of the entries with more than two decimals, and at least two thirds of them, must
/// have at most the assumed number of decimals. Entries with more decimals keep their precision.
pub(crate) fn coarser_measures<const N: usize>(rows: [[f64; N]; N]) -> Vec<Entries<N>> {
    let decimals = |x: f64| (0..=12).find(|&n| has_decimals(x, n)).unwrap_or(13);
    let mut found: Vec<u32> = rows.as_flattened().iter().map(|&x| decimals(x)).collect();
    found.retain(|&n| n > 2);
    found.sort_unstable();
    let (count, most) = (found.len(), found.last().copied().unwrap_or_default());
    let usual = |n: u32| {
        let as_coarse = found.iter().filter(|&&other| other <= n).count();
        as_coarse >= 3 && 3 * as_coarse >= 2 * count
    };
    let measure = |assumed: u32| {
        let error = |x: f64| match decimals(x).max(assumed) {
            _ if x == 0.0 || x.abs() == 1.0 => 0.0,
            13 => 1e-14 * x.abs(),
            n => 0.6 / power_of_ten(n),
        };
        rows.map(|row| row.map(|value| Rounded { value, error: error(value) }))
    };
    (3..most).rev().filter(|&n| found.contains(&n) && usual(n)).map(measure).collect()
}

/// Returns whether x has at most the given number of decimals.
fn has_decimals(x: f64, decimals: u32) -> bool {
    let shifted = x * power_of_ten(decimals);
    (shifted - libm::round(shifted)).abs() <= 4.0 * f64::EPSILON * shifted.abs()
}

/// Returns all entries divided by a number.
pub(crate) fn divide_entries<const N: usize>(entries: &Entries<N>, by: Rounded) -> Entries<N> {
    entries.map(|row| row.map(|entry| entry / by))
}

impl Neg for Rounded {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Add for Rounded {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let value = self.value + other.value;
        let size = self.value.abs().max(other.value.abs());
        Self { value, error: self.error + other.error + f64::EPSILON * size }
    }
}

impl Sub for Rounded {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Rounded {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let value = self.value * other.value;
        let error = self.error * other.value.abs() + other.error * self.value.abs();
        Self { value, error: error + f64::EPSILON * value.abs() }
    }
}

impl Div for Rounded {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        let error = (self.error + value.abs() * other.error) / other.value.abs();
        Self { value, error: error + f64::EPSILON * value.abs() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_depend_on_the_precision() {
        assert_eq!(Rounded { value: 0.0999, error: 2e-4 }.simplest(), 0.1);
        assert_eq!(Rounded { value: 0.0999, error: 2e-6 }.simplest(), 0.0999);
        assert_eq!(Rounded::exact(640.0).digits(), 2);
        let wide = Rounded { value: 16.0 / 9.0, error: 1e-15 };
        assert_eq!(wide.digits(), 2);
        assert_eq!(Rounded { value: 1.234_567_89, error: 1e-15 }.digits(), 8);
    }

    #[test]
    fn precision_is_estimated_from_the_decimals() {
        let [[a, b], [c, d]] = measure_entries([[1.732, 0.0], [-1.002, 1.0]]);
        assert_eq!((a.error, b.error, c.error, d.error), (0.0006, 0.0, 0.0006, 0.0));
        assert_eq!(measure_entries([[2.5]])[0][0].error, 0.0);
        assert!(measure_entries([[libm::sqrt(2.0)]])[0][0].error < 1e-13);
        let single = f64::from(libm::sqrt(2.0) as f32);
        assert!(measure_entries([[single]])[0][0].error > 1e-7);
    }
}
