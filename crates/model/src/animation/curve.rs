//! Curves: values at key times, and what they are between two of them, which the interpolation says (glTF 2.0
//! appendix C):
//!
//! ```text
//!  Step                Linear              CubicSpline
//!        ┌───•              •                  ╭─•      a value and two tangents at each key: the curve leaves a key
//!  •─────┘               ╱                   ╱          along the one and arrives along the other
//!                     •                   •─╯
//! ```
//!
//! Before the first key and after the last the values stand still. Rotations turn at constant speed about one axis.

/// Values at key times. All numbers are finite.
#[derive(Clone, PartialEq, Debug)]
pub struct AnimationCurve {
    /// What the values are between the keys.
    pub interpolation: Interpolation,
    /// The times of the keys in seconds, rising; at least one.
    pub times: Vec<f32>,
    /// `width` numbers for each key; for cubic splines three times as many: tangent before, value, tangent behind.
    pub values: Vec<f32>,
    /// The numbers of one value.
    pub components: usize,
}

/// What the values of a curve are between two keys.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Interpolation {
    /// That of the earlier key.
    Step,
    /// On the straight way from one to the other.
    Linear,
    /// Of rotations: on the shorter arc from one to the other. Files call it LINEAR too.
    Spherical,
    /// On a cubic Hermite spline.
    CubicSpline,
}

impl AnimationCurve {
    /// The value at a time; a rotation is a quaternion of any length but 0, or 0 where two opposite ones meet.
    #[must_use]
    pub fn sample(&self, seconds: f64) -> Vec<f64> {
        let after = self.times.partition_point(|&time| f64::from(time) <= seconds);
        let (from, to) = (after.saturating_sub(1), after.min(self.times.len().saturating_sub(1)));
        if from == to {
            return self.key_value(from);
        }
        let [start, end] = [from, to].map(|key| f64::from(self.times[key]));
        let (length, part) = (end - start, (seconds - start) / (end - start));
        match self.interpolation {
            Interpolation::Step => self.key_value(from),
            Interpolation::Spherical => slerp(&self.key_value(from), &self.key_value(to), part),
            Interpolation::Linear => {
                weighted_sum(&[(1.0 - part, self.key_value(from)), (part, self.key_value(to))])
            }
            Interpolation::CubicSpline => {
                let (t, t2, t3) = (part, part * part, part * part * part);
                weighted_sum(&[
                    (2.0 * t3 - 3.0 * t2 + 1.0, self.key_value(from)),
                    (length * (t3 - 2.0 * t2 + t), self.stored_row(3 * from + 2)),
                    (-2.0 * t3 + 3.0 * t2, self.key_value(to)),
                    (length * (t3 - t2), self.stored_row(3 * to)),
                ])
            }
        }
    }

    /// The value at a key.
    fn key_value(&self, key: usize) -> Vec<f64> {
        match self.interpolation {
            Interpolation::CubicSpline => self.stored_row(3 * key + 1),
            _ => self.stored_row(key),
        }
    }

    fn stored_row(&self, row: usize) -> Vec<f64> {
        let numbers = self.values.get(row * self.components..).unwrap_or(&[]);
        numbers.iter().take(self.components).map(|&number| f64::from(number)).collect()
    }
}

fn weighted_sum(rows: &[(f64, Vec<f64>)]) -> Vec<f64> {
    let width = rows.iter().map(|(_, row)| row.len()).min().unwrap_or(0);
    (0..width).map(|at| rows.iter().map(|(weight, row)| weight * row[at]).sum()).collect()
}

/// The rotation at a part of the shorter way from one to another, at constant speed.
fn slerp(from: &[f64], to: &[f64], part: f64) -> Vec<f64> {
    let unit = |q: &[f64]| {
        let length = libm::sqrt(q.iter().map(|x| x * x).sum());
        q.iter().map(|x| if length > 0.0 { x / length } else { 0.0 }).collect::<Vec<_>>()
    };
    let (from, to) = (unit(from), unit(to));
    let cosine: f64 = from.iter().zip(&to).map(|(a, b)| a * b).sum();
    let side = if cosine < 0.0 { -1.0 } else { 1.0 };
    let angle = libm::acos(cosine.abs().min(1.0));
    let sine = libm::sin(angle);
    // Where both are nearly the same the straight way is as good, and there is no division by nearly nothing.
    let (first, second) = if sine < 1e-6 {
        (1.0 - part, part)
    } else {
        (libm::sin(angle * (1.0 - part)) / sine, libm::sin(angle * part) / sine)
    };
    weighted_sum(&[(first, from), (side * second, to)])
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

    fn nearly_equal(found: &[f64], due: &[f64]) -> bool {
        found.len() == due.len() && found.iter().zip(due).all(|(a, b)| (a - b).abs() < 1e-7)
    }

    #[test]
    fn steps_and_lines_stand_still_outside() {
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
    fn splines_are_the_cubics_they_were_made_of() {
        // x³ at 1 and 3: slopes 3 and 27; the tangents outside are never looked at.
        let keys = [99.0, 1.0, 3.0, 27.0, 27.0, 99.0];
        let spline = curve(Interpolation::CubicSpline, &[1.0, 3.0], &keys, 1);
        for x in [1.0, 1.25, 2.0, 2.75, 3.0] {
            assert!(nearly_equal(&spline.sample(x), &[x * x * x]), "at {x}");
        }
        assert_eq!(spline.sample(0.0), [1.0]);
        assert_eq!(spline.sample(9.0), [27.0]);
    }

    #[test]
    fn rotations_turn_at_constant_speed_on_the_shorter_way() {
        let (c, s) = (FRAC_1_SQRT_2 as f32, FRAC_1_SQRT_2 as f32);
        for sign in [1.0, -1.0] {
            // From rest to a quarter about y, written as one quaternion and as its opposite.
            let values = [0.0, 0.0, 0.0, 1.0, 0.0, sign * s, 0.0, sign * c];
            let turn = curve(Interpolation::Spherical, &[0.0, 2.0], &values, 4);
            let due = [0.0, libm::sin(FRAC_PI_8), 0.0, libm::cos(FRAC_PI_8)];
            assert!(nearly_equal(&turn.sample(1.0), &due), "{sign}");
        }
        let still =
            curve(Interpolation::Spherical, &[0.0, 1.0], &[0.0, 0.0, 0.6, 0.8].repeat(2), 4);
        assert!(nearly_equal(&still.sample(0.3), &[0.0, 0.0, 0.6, 0.8]));
    }
}
