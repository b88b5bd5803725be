//! Kinds of homogeneous points, finite or at infinity, and their equivalence (HO-1, HO-2).

use crate::{HPoint, Point, Projective, Space, Vector};
use core::fmt;

/// The kind of a homogeneous point: finite, at infinity or invalid.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum HPointKind<S: Space> {
    /// w ≠ 0: a position in space, the result of the divide.
    Finite(Point<S::Divided>),
    /// w = 0: a point at infinity, that is, a direction. The opposite direction is the same point.
    AtInfinity(Vector<S>),
    /// Not a point: all four coordinates are 0, one is not finite, or the position is too far away
    /// to represent.
    Invalid,
}

impl<S: Space> HPointKind<S> {
    /// Returns the name of the kind: "point", "direction" or "none".
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Finite(_) => "point",
            Self::AtInfinity(_) => "direction",
            Self::Invalid => "none",
        }
    }
}

impl<S: Space> fmt::Display for HPointKind<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finite(place) => {
                f.write_str("the point ")?;
                fmt::Display::fmt(place, f)
            }
            Self::AtInfinity(direction) => {
                f.write_str("the point at infinity along ")?;
                fmt::Display::fmt(direction, f)
            }
            Self::Invalid => f.write_str("not a point"),
        }
    }
}

impl<S: Space> HPoint<S> {
    /// Returns the kind of this point, based on the exact value of w.
    ///
    /// ```
    /// use homog::{HPoint, HPointKind, Point, Vector, World};
    /// let meaning = |x, y, z, w| HPoint::<World>::new(x, y, z, w).kind();
    /// assert_eq!(meaning(2.0, 8.0, 14.0, 2.0), HPointKind::Finite(Point::new(1.0, 4.0, 7.0)));
    /// assert_eq!(meaning(1.0, 4.0, 7.0, 0.0), HPointKind::AtInfinity(Vector::new(1.0, 4.0, 7.0)));
    /// assert_eq!(meaning(0.0, 0.0, 0.0, 0.0), HPointKind::Invalid);
    /// ```
    #[must_use]
    pub fn kind(self) -> HPointKind<S> {
        self.kind_within(0.0)
    }

    /// Returns the kind of this point, with w counted as 0 if it is at most `relative` times the
    /// largest coordinate. With a rotated camera, rounding may give 10⁻¹⁷ instead of 0.
    #[must_use]
    pub fn kind_within(self, relative: f64) -> HPointKind<S> {
        let largest = self.raw.abs().max_element();
        if !self.is_finite() || largest == 0.0 {
            return HPointKind::Invalid;
        }
        if self.w().abs() <= relative * largest {
            return HPointKind::AtInfinity(Vector::tagged(self.raw.truncate()));
        }
        self.divide().map_or(HPointKind::Invalid, HPointKind::Finite)
    }

    /// Returns whether both represent the same position or direction, that is, whether one is a
    /// multiple of the other (HO-2): |aᵢ bⱼ − aⱼ bᵢ| ≤ `relative` · ‖a‖ ‖b‖ for all i, j. For
    /// computed points, 10⁻¹² is a good value for `relative`.
    ///
    /// Returns `None` if either is zero or not finite.
    ///
    /// ```
    /// use homog::{HPoint, World};
    /// let a = HPoint::<World>::new(1.0, 4.0, 7.0, 1.0);
    /// assert_eq!(a.equivalent(HPoint::new(-0.125, -0.5, -0.875, -0.125), 0.0), Some(true));
    /// assert_eq!(a.equivalent(HPoint::new(1.0, 4.0, 7.0, 2.0), 1e-12), Some(false));
    /// assert_eq!(a.equivalent(HPoint::new(0.0, 0.0, 0.0, 0.0), 1e-12), None);
    /// ```
    #[must_use]
    pub fn equivalent(self, other: Self, relative: f64) -> Option<bool> {
        are_proportional(&self.raw.to_array(), &other.raw.to_array(), relative)
    }
}

/// Returns whether one list is a multiple of the other, or `None` if either is all zeros or not
/// finite.
pub(crate) fn are_proportional(a: &[f64], b: &[f64], relative: f64) -> Option<bool> {
    let (a_unit, b_unit) = (power_of_two_scale(a)?, power_of_two_scale(b)?);
    let minor =
        |i: usize, j: usize| a[i] * a_unit * (b[j] * b_unit) - a[j] * a_unit * (b[i] * b_unit);
    let mut pairs = (0..a.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let (a_length, b_length) = (scaled_length(a, a_unit), scaled_length(b, b_unit));
    Some(pairs.all(|(i, j)| minor(i, j).abs() <= relative * a_length * b_length))
}

/// Returns the power of two that scales the largest number to near 1, or `None` if all numbers are
/// 0 or one is not finite.
fn power_of_two_scale(numbers: &[f64]) -> Option<f64> {
    let largest = numbers.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let finite = numbers.iter().all(|x| x.is_finite());
    (finite && largest > 0.0).then(|| libm::scalbn(1.0, -libm::ilogb(largest).max(-1020)))
}

fn scaled_length(numbers: &[f64], unit: f64) -> f64 {
    libm::sqrt(numbers.iter().map(|x| (x * unit) * (x * unit)).sum())
}

impl<A: Space, B: Space> Projective<A, B> {
    /// Returns the point where the images of all lines along `direction` meet (VN-1): the image of
    /// their point at infinity. It is a position, or a direction if the images stay parallel.
    ///
    /// As in [`HPoint::kind_within`], w counts as 0 up to `relative` times the largest coordinate.
    /// A tolerance of 10⁻¹² handles lines perpendicular to the gaze of a rotated camera.
    ///
    /// ```
    /// use homog::{HPointKind, Ndc, Point, Projective, Clip, Vector, View};
    /// // One-point perspective: the eye is at distance 1 in front of the plane z = 0.
    /// let [x, y, z] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    /// let rows = [x, y, z, [0.0, 0.0, -1.0, 1.0]];
    /// let map = Projective::<View, Clip>::from_rows(rows);
    /// let rails = map.vanishing_point(Vector::new(0.0, 0.0, -1.0), 0.0);
    /// assert_eq!(rails, HPointKind::Finite(Point::<Ndc>::new(0.0, 0.0, -1.0)));
    /// let ties = map.vanishing_point(Vector::X, 0.0);
    /// assert_eq!(ties, HPointKind::AtInfinity(Vector::X));
    /// ```
    #[must_use]
    pub fn vanishing_point(self, direction: Vector<A>, relative: f64) -> HPointKind<B> {
        self.transform_direction(direction).kind_within(relative)
    }

    /// Returns the vanishing points of the x, y and z axes. The number of finite vanishing points
    /// determines whether the picture is a one-, two- or three-point perspective.
    #[must_use]
    pub fn principal_vanishing_points(self, relative: f64) -> [HPointKind<B>; 3] {
        [Vector::X, Vector::Y, Vector::Z].map(|axis| self.vanishing_point(axis, relative))
    }

    /// Returns whether the two maps are the same, that is, whether one matrix is a multiple of the
    /// other (HO-2).
    ///
    /// Returns `None` if either is zero or not finite.
    #[must_use]
    pub fn equivalent(self, other: Self, relative: f64) -> Option<bool> {
        let entries = |map: Self| map.raw.to_cols_array();
        are_proportional(&entries(self), &entries(other), relative)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Clip, World};

    #[test]
    fn misprint_m2_the_factor_multiplies_the_point() {
        // Misprinted as "x ~ α"; the correct form is x ~ αx for α ≠ 0.
        let x = HPoint::<World>::new(1.0, -2.0, 3.0, 4.0);
        for alpha in [-7.0, 1e-3, 1e300, -1e-300, 5e-324] {
            let multiple = HPoint::tagged(x.raw * alpha);
            assert_eq!(x.equivalent(multiple, 1e-15), Some(true), "times {alpha}");
            let printed = HPoint::new(alpha, alpha, alpha, alpha);
            assert_eq!(x.equivalent(printed, 1e-15), Some(false), "{alpha} by itself is not x");
        }
    }

    #[test]
    fn opposite_directions_are_the_same_point_at_infinity() {
        let ahead = HPoint::<World>::new(0.0, 0.0, -1.0, 0.0);
        assert_eq!(ahead.equivalent(HPoint::new(0.0, 0.0, 5.0, 0.0), 0.0), Some(true));
        assert_eq!(ahead.equivalent(HPoint::new(0.0, 0.0, -1e9, 1.0), 1e-12), Some(false));
        assert_eq!(ahead.equivalent(HPoint::new(0.0, f64::NAN, 0.0, 0.0), 0.0), None);
    }

    #[test]
    fn rounding_errors_in_w_can_be_ignored() {
        let almost = HPoint::<Clip>::new(1.0, 2.0, 0.0, 1e-17);
        assert_eq!(almost.kind().name(), "point");
        assert_eq!(almost.kind_within(1e-12).name(), "direction");
        assert_eq!(HPoint::<Clip>::new(0.0, 0.0, 0.0, 1e-17).kind_within(1e-12).name(), "point");
        assert_eq!(HPoint::<Clip>::new(1.0, f64::INFINITY, 0.0, 1.0).kind().name(), "none");
    }
}
