//! Perspective foreshortening along a segment: the function f(t), its inverse and its derivative
//! (IN-1, IN-2).
//!
//! ```text
//!  in space  r ──────────────● t = ½ ─────────────── R         w_r = 1, w_R = 3
//!  image     r/w_r ───────────────────── ● f = ¾ ── R/w_R      the far half is squeezed
//! ```
//!
//! The image of the point r + t(R − r) is at fraction f(t) = w_R t / (w_r + t(w_R − w_r)) of the
//! image segment. If both values of w have the same sign, the denominator, their weighted mean, is
//! never 0. Then f rises from 0 to 1: segments map to segments, and points on them keep their
//! order.
//!
//! Source: the textbook (Shirley and Marschner, ch. 8), §8.4 and exercise 11; IN-1, IN-2.

use crate::{HPoint, Space};

/// The error for a segment whose w values leave f(t) undefined.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
#[error(
    "a segment with w from {start} to {end} has no connected image: both values must be finite, \
     nonzero and of the same sign"
)]
pub struct SegmentCrossesEyePlane {
    /// w at the start.
    pub start: f64,
    /// w at the end.
    pub end: f64,
}

/// The relation between a segment and its perspective image, determined by w at the endpoints.
///
/// ```
/// use homog::Foreshortening;
/// let f = Foreshortening::new(1.0, 3.0)?;
/// assert_eq!(f.image_parameter(0.5), Some(0.75));
/// assert_eq!(f.source_parameter(0.75), Some(0.5));
/// assert_eq!(f.derivative(0.0), Some(3.0));
/// # Ok::<(), homog::SegmentCrossesEyePlane>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Foreshortening {
    /// w at the start; both values are scaled to be positive, with the larger in [1, 2).
    start: f64,
    end: f64,
}

impl Foreshortening {
    /// Creates the relation for w = `start` at t = 0 and w = `end` at t = 1.
    ///
    /// # Errors
    /// Returns an error unless both values are finite, nonzero and of the same sign. Clip the
    /// segment first.
    pub fn new(start: f64, end: f64) -> Result<Self, SegmentCrossesEyePlane> {
        let one_side = (start > 0.0 && end > 0.0) || (start < 0.0 && end < 0.0);
        if !(one_side && start.is_finite() && end.is_finite()) {
            return Err(SegmentCrossesEyePlane { start, end });
        }
        let exponent = libm::ilogb(start.abs().max(end.abs()));
        let scaled = |w: f64| libm::scalbn(w.abs(), -exponent).max(f64::MIN_POSITIVE);
        Ok(Self { start: scaled(start), end: scaled(end) })
    }

    /// Returns the relation for the segment between two homogeneous points.
    ///
    /// # Errors
    /// See [`new`](Self::new).
    pub fn from_endpoints<S: Space>(
        start: HPoint<S>,
        end: HPoint<S>,
    ) -> Result<Self, SegmentCrossesEyePlane> {
        Self::new(start.w(), end.w())
    }

    /// Returns f(t): the fraction of the image at which the point at fraction `t` of the segment
    /// appears.
    ///
    /// The result is always `Some` for t in [0, 1]. Beyond the endpoints, it is `None` from the
    /// point whose image is at infinity onward.
    #[must_use]
    pub fn image_parameter(self, t: f64) -> Option<f64> {
        perspective_fraction(t, self.end * t, interpolate(self.start, self.end, t))
    }

    /// Returns the inverse of f: the fraction of the segment that appears at fraction `s` of its
    /// image.
    ///
    /// The result is always `Some` for s in [0, 1]. Beyond the endpoints, it is `None` from the
    /// vanishing point onward.
    #[must_use]
    pub fn source_parameter(self, s: f64) -> Option<f64> {
        perspective_fraction(s, self.start * s, interpolate(self.end, self.start, s))
    }

    /// Returns f'(t) = w_r w_R / (w_r + t(w_R − w_r))²: the local stretch at `t`, relative to the
    /// average.
    #[must_use]
    pub fn derivative(self, t: f64) -> Option<f64> {
        let w = interpolate(self.start, self.end, t);
        finite_quotient(self.start, w)?;
        finite_quotient(self.start / w * self.end, w)
    }

    /// Returns an attribute that varies linearly from `a` to `b` along the segment, at fraction `s`
    /// of the image (IN-2): [(1−s) a/w_r + s b/w_R] / [(1−s)/w_r + s/w_R]. This is
    /// perspective-correct interpolation.
    #[must_use]
    pub fn interpolate_attribute(self, s: f64, a: f64, b: f64) -> Option<f64> {
        let t = self.source_parameter(s)?;
        Some(a * (1.0 - t) + b * t).filter(|value| value.is_finite())
    }
}

/// Interpolates from `start` at 0 to `end` at 1. Both values are reproduced exactly, and nothing
/// cancels in between.
fn interpolate(start: f64, end: f64, t: f64) -> f64 {
    start * (1.0 - t) + end * t
}

/// Returns the quotient, clamped to 1 if `of` is at most 1, because rounding may exceed it.
fn perspective_fraction(of: f64, numerator: f64, denominator: f64) -> Option<f64> {
    let fraction = finite_quotient(numerator, denominator)?;
    Some(if of <= 1.0 { fraction.min(1.0) } else { fraction })
}

/// Returns the quotient, or `None` if it is not finite or the denominator is not positive.
fn finite_quotient(numerator: f64, denominator: f64) -> Option<f64> {
    let quotient = numerator / denominator;
    (denominator > 0.0 && quotient.is_finite()).then_some(quotient)
}

/// Converts the weights of a triangle's corners in the image to weights in space, given w at the
/// corners (IN-2): λᵢ/wᵢ divided by their sum. They suit any attribute.
///
/// Returns `None` if the sum is 0 or not finite, for example if a w is 0.
#[must_use]
pub fn perspective_weights(image_weights: [f64; 3], w: [f64; 3]) -> Option<[f64; 3]> {
    let parts: [f64; 3] = core::array::from_fn(|i| image_weights[i] / w[i]);
    let sum: f64 = parts[0] + parts[1] + parts[2];
    let weights = parts.map(|part| part / sum);
    weights.iter().all(|weight| weight.is_finite()).then_some(weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exercise_11_c47_order_is_preserved() {
        let f = Foreshortening::new(1.0, 3.0).expect("both positive");
        assert_eq!([0.0, 0.5, 1.0].map(|t| f.image_parameter(t)), [0.0, 0.75, 1.0].map(Some));
        assert_eq!(f.derivative(0.0), Some(3.0));
        assert_eq!(f.derivative(1.0), Some(1.0 / 3.0));
    }

    #[test]
    fn endpoints_map_to_endpoints_even_for_extreme_w() {
        let f = Foreshortening::new(3.0, 1e-180).expect("both positive");
        assert_eq!([0.0, 1.0].map(|t| f.image_parameter(t)), [Some(0.0), Some(1.0)]);
        assert_eq!([0.0, 1.0].map(|s| f.source_parameter(s)), [Some(0.0), Some(1.0)]);
    }

    #[test]
    fn segments_across_the_eye_plane_are_rejected() {
        for [start, end] in
            [[1.0, -1.0], [0.0, 1.0], [1.0, 0.0], [f64::NAN, 1.0], [1.0, f64::INFINITY]]
        {
            assert!(Foreshortening::new(start, end).is_err(), "w from {start} to {end}");
        }
        let f = Foreshortening::new(1.0, 3.0).expect("both positive");
        assert_eq!(f.image_parameter(-0.5), None, "w is 0 there");
        assert_eq!(f.source_parameter(1.5), None, "the vanishing point of the line");
        assert_eq!(f.image_parameter(f64::NAN), None);
    }

    #[test]
    fn triangle_weights_match_the_segment_on_each_edge() {
        let f = Foreshortening::new(2.0, 5.0).expect("both positive");
        let weights = perspective_weights([0.75, 0.25, 0.0], [2.0, 5.0, 9.0]).expect("w > 0");
        assert!((weights[1] - f.source_parameter(0.25).expect("inside")).abs() < 1e-15);
        assert_eq!(weights[2], 0.0);
        assert_eq!(perspective_weights([1.0, 0.0, 0.0], [0.0, 1.0, 1.0]), None);
    }
}
