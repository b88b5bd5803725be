//! Vectors of three `f32`, for computations with a single position or direction.
//!
//! A vector of zero length has no direction, and each function handles it differently:
//! [`normalize`] returns NaN, [`normalize_or_zero`] returns zero, and [`try_normalize`] returns
//! `None`. All three divide by the length; multiplying by the inverse would give different bits.

/// Computes the dot product.
#[inline(always)]
pub(crate) fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Computes the cross product.
#[inline(always)]
pub(crate) fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Computes a − b.
#[inline(always)]
pub(crate) fn subtract(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Normalizes a vector of nonzero length. For zero length, all components are NaN.
pub(crate) fn normalize(vector: [f32; 3]) -> [f32; 3] {
    let length = dot(vector, vector).sqrt();
    vector.map(|c| c / length)
}

/// Normalizes a vector, or returns zero for a vector of length 0.
pub(crate) fn normalize_or_zero(vector: [f32; 3]) -> [f32; 3] {
    let length = dot(vector, vector).sqrt();
    if length > 0.0 { vector.map(|c| c / length) } else { [0.0; 3] }
}

/// Normalizes a vector. Returns `None` if it is too short or too long to have a direction.
pub(crate) fn try_normalize(vector: [f32; 3]) -> Option<[f32; 3]> {
    let length = dot(vector, vector).sqrt();
    (length > 0.0 && length.is_finite()).then(|| vector.map(|c| c / length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zero_vectors_are_handled_as_documented() {
        assert!(normalize([0.0; 3]).iter().all(|c| c.is_nan()));
        assert_eq!(normalize_or_zero([0.0; 3]), [0.0; 3]);
        assert_eq!(try_normalize([0.0; 3]), None);
        assert_eq!(try_normalize([f32::MAX; 3]), None, "its square is infinite");
        for vector in [[3.0, 0.0, 4.0], [0.0, -2.0, 0.0]] {
            let unit = normalize(vector);
            assert_eq!((normalize_or_zero(vector), try_normalize(vector)), (unit, Some(unit)));
            assert!((dot(unit, unit) - 1.0).abs() < 1e-6);
        }
    }
}
