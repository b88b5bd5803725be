//! A cross product that is accurate even for nearly parallel vectors.
//!
//! Each coordinate of t × g is a difference a b − c d. For directions 10⁻⁶ rad apart the two
//! products agree to six digits, and rounding them first would leave only ten digits in the
//! camera's right axis. Here the products' rounding errors are computed and added back
//! (Dekker 1971, with Veltkamp's splitting). This makes u correct to the last digits for any
//! accepted view-up.

use glam::DVec3;

/// Returns `a × b` up to a positive factor, or zero. Both vectors must be finite and nonzero.
///
/// The vectors are first scaled by powers of two, which is exact, so huge and tiny vectors work.
pub(crate) fn cross_exact(a: DVec3, b: DVec3) -> DVec3 {
    let (a, b) = (scale_near_one(a), scale_near_one(b));
    DVec3::new(
        difference_of_products(a.y, b.z, a.z, b.y),
        difference_of_products(a.z, b.x, a.x, b.z),
        difference_of_products(a.x, b.y, a.y, b.x),
    )
}

/// Returns the vector times the power of two that scales its largest coordinate to [½, 1).
pub(crate) fn scale_near_one(v: DVec3) -> DVec3 {
    let (_, exponent) = libm::frexp(v.abs().max_element());
    DVec3::from_array(v.to_array().map(|c| libm::scalbn(c, -exponent)))
}

/// Returns a b − c d, for magnitudes of at most 1.
fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let (p, p_error) = two_product(a, b);
    let (q, q_error) = two_product(c, d);
    (p - q) + (p_error - q_error)
}

/// Returns the rounded product and its rounding error.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (veltkamp_split(a), veltkamp_split(b));
    let error = ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low;
    (p, error)
}

/// Splits a number into two halves of 26 bits whose sum is the number.
fn veltkamp_split(a: f64) -> (f64, f64) {
    const FACTOR: f64 = 134_217_729.0; // 2²⁷ + 1
    let c = FACTOR * a;
    let high = c - (c - a);
    (high, a - high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_of_almost_equal_products_are_exact() {
        // (1 + e)(1 − e) − 1 · 1 = −e², which two roundings would lose completely.
        let e = 1.0 / 1_073_741_824.0;
        let half = difference_of_products((1.0 + e) / 2.0, 1.0 - e, 0.5, 1.0);
        assert_eq!(half, -e * e / 2.0);
    }

    #[test]
    fn scaling_by_powers_of_two_preserves_extreme_directions() {
        let tiny = scale_near_one(DVec3::new(3e-320, 0.0, -3e-320));
        assert!(tiny.x >= 0.5 && tiny.x < 1.0 && tiny.z == -tiny.x);
        let huge = scale_near_one(DVec3::splat(f64::MAX));
        assert!(huge.x >= 0.5 && huge.x < 1.0);
    }
}
