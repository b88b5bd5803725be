//! Polynomial approximations of elementary functions, and rounding. They are accurate to about six
//! digits and, unlike `libm`, can be compiled to vector instructions.
//!
//! The logarithm splits a number into exponent and mantissa, as stored in IEEE 754, and the power
//! combines them; only the mantissa needs a polynomial. The cosine removes whole turns. All
//! machines produce the same bits.

use std::f32::consts::LN_2;

/// Rounds a number, clamped to ±4,194,303, down to an integer.
///
/// Adding 3 · 2²² leaves the nearest integer in the low bits of the sum. All of this compiles to
/// vector instructions; `as i32` would convert lane by lane, with a test for NaN.
#[inline(always)]
#[expect(clippy::manual_clamp, reason = "unlike `clamp`, this replaces NaN with a bound")]
pub(crate) fn floor_to_int(x: f32) -> i32 {
    const SHIFT: f32 = 12_582_912.0;
    let shifted = x.max(-4_194_303.0).min(4_194_303.0) + SHIFT;
    let nearest = shifted.to_bits() as i32 - SHIFT.to_bits() as i32;
    nearest - i32::from(shifted - SHIFT > x)
}

/// Computes the base-2 logarithm of a normal positive number, to about six digits.
#[inline(always)]
pub(crate) fn log2_approx(x: f32) -> f32 {
    // log2(1 + t) / t from 0 to 1, fitted at the zeros of a Chebyshev polynomial.
    const COEFFICIENTS: [f32; 7] = [
        1.442_693_2,
        -0.721_162_74,
        0.477_705_93,
        -0.339_247_76,
        0.215_588_54,
        -0.096_066_25,
        0.020_490_346,
    ];
    // Exponent and mantissa: x = 2^exponent · (1 + t).
    let bits = x.to_bits();
    let exponent = (bits >> 23) as i32 - 127;
    let t = f32::from_bits(bits & 0x007f_ffff | 0x3f80_0000) - 1.0;
    // Horner's scheme.
    let mut sum = COEFFICIENTS[6];
    for k in (0..6).rev() {
        sum = sum * t + COEFFICIENTS[k];
    }
    exponent as f32 + sum * t
}

/// Computes two to the power of a number, clamped to −126 to 127, to about six digits.
#[inline(always)]
#[expect(clippy::manual_clamp, reason = "unlike `clamp`, this replaces NaN with a bound")]
pub(crate) fn exp2_approx(power: f32) -> f32 {
    // 2^t from −½ to ½, fitted at the zeros of a Chebyshev polynomial.
    const COEFFICIENTS: [f32; 6] =
        [1.000_000_1, LN_2, 0.240_221_07, 0.055_503_57, 0.009_676_03, 0.001_339_09];
    let power = power.max(-126.0).min(127.0);
    // The nearest integer, biased as an IEEE 754 exponent and thus positive.
    let exponent = floor_to_int(power + 127.5);
    let t = power - (exponent - 127) as f32;
    // Horner's scheme.
    let mut sum = COEFFICIENTS[5];
    for k in (0..5).rev() {
        sum = sum * t + COEFFICIENTS[k];
    }
    sum * f32::from_bits((exponent as u32) << 23)
}

/// Computes the cosine of an angle of up to a million turns. The error is at most 10⁻⁶ plus the
/// rounding error of the angle.
#[inline(always)]
#[expect(clippy::manual_clamp, reason = "unlike `clamp`, this replaces NaN with a bound")]
pub(crate) fn cosine_of_turns(turns: f32) -> f32 {
    // cos(2π √u) for u up to ¼, fitted at the zeros of a Chebyshev polynomial.
    const COEFFICIENTS: [f32; 7] =
        [1.0, -19.739_204, 64.939_12, -85.450_11, 60.167_43, -25.966_885, 6.527_706];
    let turns = turns.max(-1e6).min(1e6);
    // The remainder from the nearest integer, −½ to ½.
    let t = turns - floor_to_int(turns + 0.5) as f32;
    let square = t * t;
    // Horner's scheme.
    let mut sum = COEFFICIENTS[6];
    for k in (0..6).rev() {
        sum = sum * square + COEFFICIENTS[k];
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_are_rounded_down() {
        for step in -4000..4000 {
            let x = step as f32 * 0.25;
            assert_eq!(floor_to_int(x), libm::floorf(x) as i32, "{x}");
        }
        assert_eq!([1e9, f32::NAN].map(floor_to_int), [4_194_303, -4_194_303]);
    }

    #[test]
    fn logarithms_are_accurate_to_six_digits() {
        assert_eq!(log2_approx(1.0), 0.0);
        for step in 0..100_000 {
            let x = 1.0 + step as f32 * step as f32 * 0.01;
            for x in [x, 1.0 / x] {
                let exact = libm::log2(f64::from(x));
                let error = (f64::from(log2_approx(x)) - exact).abs();
                assert!(error < 3e-6 + exact.abs() * 1e-7, "{x}");
            }
        }
    }

    #[test]
    fn powers_of_two_are_accurate_to_six_digits() {
        assert_eq!(exp2_approx(-1e9), exp2_approx(-126.0));
        for step in -12_600..12_700 {
            let power = step as f32 * 0.01;
            let exact = libm::exp2(f64::from(power));
            let error = (f64::from(exp2_approx(power)) / exact - 1.0).abs();
            assert!(error < 4e-7 + 1e-7 * f64::from(power).abs(), "{power}: {error}");
        }
    }

    #[test]
    fn cosines_are_accurate_to_six_digits() {
        for step in -40_000..40_000 {
            let turns = step as f32 * 0.001;
            let exact = libm::cos(f64::from(turns) * 2.0 * std::f64::consts::PI);
            assert!((f64::from(cosine_of_turns(turns)) - exact).abs() < 3e-6, "{turns}");
        }
    }
}
