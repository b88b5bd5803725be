//! Homogeneous points of a line: two numbers each, up to a common factor.
//!
//! ```text
//!     x
//!     │          ╱  x = 1.5 h: all [1.5 h, h] represent the number 1.5
//! 1.5 ┤     ●
//!     │   ╱ ╎
//!     │ ╱   ╎
//!     0─────1────── h
//! ```
//!
//! Source: the textbook (Shirley and Marschner, ch. 8), §8.2, figure 8.10. (A translation of the
//! book calls a 1-D point "2 vectors"; it is one vector of two numbers.)

use crate::HPoint2;
use crate::hpoint_kind::are_proportional;

/// A homogeneous point [x, h] of a line: the number x/h, or the point at infinity if h = 0.
///
/// ```
/// use homog::HPoint1;
/// assert_eq!(HPoint1::new(3.0, 2.0).divide(), Some(1.5));
/// assert_eq!(HPoint1::new(3.0, 2.0).equivalent(HPoint1::new(-1.5, -1.0), 0.0), Some(true));
/// assert_eq!(HPoint1::new(1.0, 0.0).divide(), None);
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HPoint1 {
    /// The number times h.
    pub x: f64,
    /// The homogeneous coordinate.
    pub h: f64,
}

impl HPoint1 {
    /// Creates the homogeneous point [x, h].
    #[must_use]
    pub const fn new(x: f64, h: f64) -> Self {
        Self { x, h }
    }

    /// Returns the number that this point represents, or `None` if it is at infinity or a number is
    /// not finite.
    #[must_use]
    pub fn divide(self) -> Option<f64> {
        let number = self.x / self.h;
        (self.h.is_finite() && number.is_finite()).then_some(number)
    }

    /// Returns the perspective image, on the line z = d, of a point [y, z, h] seen from the origin:
    /// [d y, z], computed with the matrix [d 0 0; 0 1 0]. It represents y_s = (d/z) y.
    #[must_use]
    pub fn project_point(d: f64, point: HPoint2) -> Self {
        let [y, z, _] = point.raw.to_array();
        Self::new(d * y, z)
    }

    /// Returns whether both represent the same point, or `None` if one is [0, 0] or not finite
    /// (HO-2).
    #[must_use]
    pub fn equivalent(self, other: Self, relative: f64) -> Option<bool> {
        are_proportional(&[self.x, self.h], &[other.x, other.h], relative)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn c18_every_multiple_represents_the_same_number() {
        for h in [1.0, 2.0, -0.25, 1e-300] {
            assert_eq!(HPoint1::new(1.5 * h, h).divide(), Some(1.5));
        }
    }

    #[test]
    fn c21_misprint_m1_the_image_depends_on_the_points_y() {
        let (d, y, z) = (2.0, 3.0, 4.0);
        let image = HPoint1::project_point(d, HPoint2::from_xy(y, z));
        assert_eq!(image.divide(), Some(d / z * y));
        assert_ne!(
            image.divide(),
            Some(d / z),
            "the misprint y_s = d/z gives all points at depth z one height"
        );
        // Misprinted as [d y, z] ~ [d y, 1]; the correct form is [d y / z, 1].
        assert_eq!(image.equivalent(HPoint1::new(d * y / z, 1.0), 0.0), Some(true));
        assert_eq!(image.equivalent(HPoint1::new(d * y, 1.0), 1e-12), Some(false));
    }
}
