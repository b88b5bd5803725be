//! The orientation of three points in a plane, exact for single-precision coordinates.
//!
//! Source: J. R. Shewchuk, *Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
//! Predicates*, 1997: the error bound of the filter (`ccwerrboundA`), TWO-SUM and GROW-EXPANSION.

/// The bound on the relative error of the rounded determinant: (3 + 16 ε) ε with ε = 2⁻⁵³.
const ERROR_BOUND: f64 = (3.0 + 16.0 * EPSILON) * EPSILON;
/// Half the distance from 1 to the next larger `f64`.
const EPSILON: f64 = f64::EPSILON / 2.0;

/// Returns about twice the signed area of the triangle a, b, c, with the exact sign: positive for
/// counterclockwise order, 0 if the points are collinear.
///
/// The coordinates must be finite `f32` values, because the product of two such values is exact in
/// `f64`.
pub(super) fn orient2d(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let left = (a[0] - c[0]) * (b[1] - c[1]);
    let right = (a[1] - c[1]) * (b[0] - c[0]);
    let determinant = left - right;
    if determinant.abs() > ERROR_BOUND * (left.abs() + right.abs()) {
        return determinant;
    }
    exact_orient2d(a, b, c)
}

/// Returns the largest component of the exact determinant, which has the sign of the determinant.
fn exact_orient2d(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let products =
        [a[0] * b[1], -(a[1] * b[0]), b[0] * c[1], -(b[1] * c[0]), c[0] * a[1], -(c[1] * a[0])];
    // The exact sum of the products as nonoverlapping components, smallest first.
    let mut expansion = [0.0; 6];
    for (length, product) in products.into_iter().enumerate() {
        let mut sum = product;
        for component in &mut expansion[..length] {
            (sum, *component) = two_sum(sum, *component);
        }
        expansion[length] = sum;
    }
    expansion.into_iter().rev().find(|component| *component != 0.0).unwrap_or(0.0)
}

/// Returns the rounded sum of two numbers, and the rounding error.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    let of_a = sum - of_b;
    (sum, (a - of_a) + (b - of_b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_match_integer_arithmetic() {
        // Coordinates are integers far from the origin, so arithmetic in i128 is exact.
        let mut state = 12345_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 40) as i128 % 5 + 16_777_200
        };
        let mut zeros = 0;
        for _ in 0..20_000 {
            let p: [[i128; 2]; 3] = std::array::from_fn(|_| [next(), next()]);
            let whole = (p[0][0] - p[2][0]) * (p[1][1] - p[2][1])
                - (p[0][1] - p[2][1]) * (p[1][0] - p[2][0]);
            let [a, b, c] = p.map(|point| point.map(|x| f64::from(x as f32)));
            for computed in [orient2d(a, b, c), exact_orient2d(a, b, c)] {
                assert_eq!(computed.partial_cmp(&0.0).unwrap(), whole.cmp(&0), "{p:?}");
            }
            zeros += usize::from(whole == 0);
        }
        assert!(zeros > 100, "some triples must be collinear");
    }

    #[test]
    fn one_unit_in_the_last_place_changes_the_sign() {
        // Points on the line y = x, from very small to very large; the first is then moved by one
        // bit.
        let on = |x: f32| [f64::from(x), f64::from(x)];
        let (a, b, c) = (on(1e-30), on(3.0), on(2e30));
        assert_eq!(orient2d(a, b, c), 0.0);
        let above = [f64::from(1e-30_f32), f64::from(1e-30_f32.next_up())];
        assert!(orient2d(above, c, b) != 0.0);
        assert!(orient2d(above, b, c) > 0.0, "left of the line from b to c");
    }
}
