//! Animation curves: keyframes and their interpolation (glTF 2.0 appendix C).
//!
//! ```text
//!  Step                Linear              CubicSpline
//!        ┌───•              •                  ╭─•    a value and two tangents at each keyframe:
//!  •─────┘               ╱                   ╱        the curve leaves along the out-tangent and
//!                     •                   •─╯         arrives along the in-tangent
//! ```
//!
//! Between keyframes at t₀ and t₁ with t = (time − t₀) / (t₁ − t₀) and Δ = t₁ − t₀:
//!
//! ```text
//!  Step         v₀
//!  Linear       (1 − t) v₀ + t v₁
//!  Spherical    slerp(q₀, ±q₁, t)          the sign that gives the shorter arc
//!  CubicSpline  (2t³ − 3t² + 1) v₀ + Δ (t³ − 2t² + t) out₀ + (−2t³ + 3t²) v₁ + Δ (t³ − t²) in₁
//! ```
//!
//! Values are constant before the first keyframe and after the last. Sines and arccosines come from
//! `libm`, so that all machines compute identical bits.

/// A keyframe curve (a glTF animation sampler). All numbers are finite.
#[derive(Clone, PartialEq, Debug)]
pub struct AnimationCurve {
    /// Interpolation between keyframes.
    pub interpolation: Interpolation,
    /// Keyframe times in seconds, strictly increasing; at least one.
    pub times: Vec<f32>,
    /// `components` numbers per keyframe. Cubic splines have three times as many: in-tangent, value
    /// and out-tangent.
    pub values: Vec<f32>,
    /// Number of components of one value.
    pub components: usize,
}

/// The interpolation between two keyframes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Interpolation {
    /// The value of the earlier keyframe.
    Step,
    /// Linear interpolation.
    Linear,
    /// Spherical linear interpolation of quaternions along the shorter arc, also called LINEAR in
    /// files.
    Spherical,
    /// Cubic Hermite spline.
    CubicSpline,
}

impl AnimationCurve {
    /// Returns the value at a time in seconds.
    ///
    /// A rotation is a quaternion of any length. A cubic spline between two opposite quaternions
    /// may even pass through 0.
    ///
    /// The keyframe is found by binary search in O(log n). A time at or after the last keyframe
    /// gives the last value.
    #[must_use]
    pub fn sample(&self, seconds: f64) -> Vec<f64> {
        let after = self.times.partition_point(|&time| f64::from(time) <= seconds);
        let (from, to) = (after.saturating_sub(1), after.min(self.times.len().saturating_sub(1)));
        if from == to {
            return self.key_value(from);
        }
        let [start, end] = [from, to].map(|key| f64::from(self.times[key]));
        let (length, t) = (end - start, (seconds - start) / (end - start));
        match self.interpolation {
            Interpolation::Step => self.key_value(from),
            Interpolation::Spherical => slerp(&self.key_value(from), &self.key_value(to), t),
            Interpolation::Linear => {
                weighted_sum(&[(1.0 - t, self.key_value(from)), (t, self.key_value(to))])
            }
            Interpolation::CubicSpline => {
                let (t2, t3) = (t * t, t * t * t);
                weighted_sum(&[
                    (2.0 * t3 - 3.0 * t2 + 1.0, self.key_value(from)),
                    (length * (t3 - 2.0 * t2 + t), self.stored_row(3 * from + 2)),
                    (-2.0 * t3 + 3.0 * t2, self.key_value(to)),
                    (length * (t3 - t2), self.stored_row(3 * to)),
                ])
            }
        }
    }

    /// Returns the value at a keyframe without its tangents.
    fn key_value(&self, key: usize) -> Vec<f64> {
        match self.interpolation {
            Interpolation::CubicSpline => self.stored_row(3 * key + 1),
            _ => self.stored_row(key),
        }
    }

    /// Returns the `row`-th group of `components` numbers in `values`.
    fn stored_row(&self, row: usize) -> Vec<f64> {
        let numbers = self.values.get(row * self.components..).unwrap_or(&[]);
        numbers.iter().take(self.components).map(|&number| f64::from(number)).collect()
    }
}

/// Computes the weighted sum of the rows, with as many components as the shortest row.
///
/// Terms are added in order, so that rounding is the same on all machines.
fn weighted_sum(rows: &[(f64, Vec<f64>)]) -> Vec<f64> {
    let width = rows.iter().map(|(_, row)| row.len()).min().unwrap_or(0);
    (0..width).map(|at| rows.iter().map(|(weight, row)| weight * row[at]).sum()).collect()
}

/// Interpolates spherically along the shorter arc (Shoemake 1985), at `t` in [0, 1].
///
/// Both quaternions are normalized first, because files contain rounded values. If the dot product
/// is negative, negating the second gives the shorter arc to the same rotation.
fn slerp(from: &[f64], to: &[f64], t: f64) -> Vec<f64> {
    let unit = |q: &[f64]| {
        let length = libm::sqrt(q.iter().map(|x| x * x).sum());
        q.iter().map(|x| if length > 0.0 { x / length } else { 0.0 }).collect::<Vec<_>>()
    };
    let (from, to) = (unit(from), unit(to));
    let cosine: f64 = from.iter().zip(&to).map(|(a, b)| a * b).sum();
    let sign = if cosine < 0.0 { -1.0 } else { 1.0 };
    let angle = libm::acos(cosine.abs().min(1.0));
    let sine = libm::sin(angle);
    // For nearly equal rotations, linear interpolation is as accurate, and avoids dividing by
    // almost zero.
    let (first, second) = if sine < 1e-6 {
        (1.0 - t, t)
    } else {
        (libm::sin(angle * (1.0 - t)) / sine, libm::sin(angle * t) / sine)
    };
    weighted_sum(&[(first, from), (sign * second, to)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_8};

    fn curve(
        interpolation: Interpolation,
        times: &[f32],
        values: &[f32],
        width: usize,
    ) -> AnimationCurve {
        AnimationCurve {
            interpolation,
            times: times.to_vec(),
            values: values.to_vec(),
            components: width,
        }
    }

    fn nearly_equal(actual: &[f64], expected: &[f64]) -> bool {
        actual.len() == expected.len()
            && actual.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-7)
    }

    #[test]
    fn values_are_constant_outside_the_keyframes() {
        let [times, values] = [&[1.0, 2.0, 4.0], &[10.0, 20.0, 0.0]];
        for (seconds, step, line) in [
            (-1.0, 10.0, 10.0),
            (1.0, 10.0, 10.0),
            (1.5, 10.0, 15.0),
            (2.0, 20.0, 20.0),
            (3.5, 20.0, 5.0),
            (4.0, 0.0, 0.0),
            (f64::INFINITY, 0.0, 0.0),
        ] {
            let at = |kind| curve(kind, times, values, 1).sample(seconds);
            assert_eq!(at(Interpolation::Step), [step], "at {seconds}");
            assert_eq!(at(Interpolation::Linear), [line], "at {seconds}");
        }
        let one = curve(Interpolation::Linear, &[3.0], &[7.0, 8.0, 9.0], 3);
        assert_eq!(one.sample(0.0), [7.0, 8.0, 9.0]);
    }

    #[test]
    fn splines_reproduce_cubic_polynomials() {
        // x³ has slope 3 at 1 and 27 at 3; the outer tangents are never read.
        let keys = [99.0, 1.0, 3.0, 27.0, 27.0, 99.0];
        let spline = curve(Interpolation::CubicSpline, &[1.0, 3.0], &keys, 1);
        for x in [1.0, 1.25, 2.0, 2.75, 3.0] {
            assert!(nearly_equal(&spline.sample(x), &[x * x * x]), "at {x}");
        }
        assert_eq!(spline.sample(0.0), [1.0]);
        assert_eq!(spline.sample(9.0), [27.0]);
    }

    #[test]
    fn rotations_have_constant_speed_along_the_shorter_arc() {
        let (c, s) = (FRAC_1_SQRT_2 as f32, FRAC_1_SQRT_2 as f32);
        for sign in [1.0, -1.0] {
            // From the identity to a quarter turn about y, as a quaternion and its negative.
            let values = [0.0, 0.0, 0.0, 1.0, 0.0, sign * s, 0.0, sign * c];
            let rotation = curve(Interpolation::Spherical, &[0.0, 2.0], &values, 4);
            let expected = [0.0, libm::sin(FRAC_PI_8), 0.0, libm::cos(FRAC_PI_8)];
            assert!(nearly_equal(&rotation.sample(1.0), &expected), "{sign}");
        }
        let still =
            curve(Interpolation::Spherical, &[0.0, 1.0], &[0.0, 0.0, 0.6, 0.8].repeat(2), 4);
        assert!(nearly_equal(&still.sample(0.3), &[0.0, 0.0, 0.6, 0.8]));
    }
}
