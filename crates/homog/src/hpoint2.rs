//! Homogeneous points and lines of the plane: three numbers each, up to a common factor.
//!
//! ```text
//!          h
//!          │        ╱  the line of all [−2k, −k, 2k]
//!   h = 1 ─┼──────●─── meets the plane h = 1 at (−1, −1/2)
//!          │    ╱
//!          │  ╱
//!          0
//! ```
//!
//! A homogeneous point is a line through the origin of a space with one more dimension; the
//! position it represents is where that line meets h = 1. Points and lines are dual: the same cross
//! product gives the line through two points and the point where two lines meet. Parallel lines
//! meet too, at infinity. Source: the textbook (Shirley and Marschner, ch. 8), §8.2, figure 8.11;
//! HO-2.

use crate::hpoint_kind::are_proportional;
use glam::DVec3;

/// A homogeneous point [x, y, h] of the plane: the position (x/h, y/h), or a direction if h = 0.
///
/// ```
/// use homog::HPoint2;
/// let point = HPoint2::new(-2.0, -1.0, 2.0);
/// assert_eq!(point.divide(), Some([-1.0, -0.5]));
/// assert_eq!(point.equivalent(HPoint2::new(4.0, 2.0, -4.0), 0.0), Some(true));
/// assert_eq!(HPoint2::new(1.0, 0.0, 0.0).divide(), None); // a direction
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HPoint2 {
    pub(crate) raw: DVec3,
}

impl HPoint2 {
    /// Creates the homogeneous point [x, y, h].
    #[must_use]
    pub const fn new(x: f64, y: f64, h: f64) -> Self {
        Self::tagged(DVec3::new(x, y, h))
    }

    /// Lifts the position (x, y) to h = 1.
    #[must_use]
    pub const fn from_xy(x: f64, y: f64) -> Self {
        Self::new(x, y, 1.0)
    }

    /// Creates the point at infinity along (x, y).
    #[must_use]
    pub const fn at_infinity(x: f64, y: f64) -> Self {
        Self::new(x, y, 0.0)
    }

    pub(crate) const fn tagged(raw: DVec3) -> Self {
        Self { raw }
    }

    /// Returns the position that this point represents, or `None` if it is a direction or a number
    /// is not finite.
    #[must_use]
    pub fn divide(self) -> Option<[f64; 2]> {
        let place = self.raw.truncate() / self.raw.z;
        (self.raw.z.is_finite() && place.is_finite()).then_some(place.to_array())
    }

    /// Returns the line through this point and another, or `None` if the two are the same or either
    /// is zero.
    #[must_use]
    pub fn join(self, other: Self) -> Option<HLine2> {
        cross_product(self.raw, other.raw).map(HLine2::tagged)
    }

    /// Returns whether both represent the same point, or `None` if either is zero (HO-2).
    #[must_use]
    pub fn equivalent(self, other: Self, relative: f64) -> Option<bool> {
        are_proportional(&self.raw.to_array(), &other.raw.to_array(), relative)
    }
}

impl From<[f64; 2]> for HPoint2 {
    /// Lifts a position: h = 1.
    fn from([x, y]: [f64; 2]) -> Self {
        Self::from_xy(x, y)
    }
}

/// The line a x + b y + c = 0, or a x + b y + c h = 0 for homogeneous points, up to a factor.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HLine2 {
    pub(crate) raw: DVec3,
}

impl HLine2 {
    /// The line of all points at infinity, h = 0.
    pub const INFINITY: Self = Self { raw: DVec3::Z };

    /// Creates the line a x + b y + c = 0.
    #[must_use]
    pub const fn new(a: f64, b: f64, c: f64) -> Self {
        Self::tagged(DVec3::new(a, b, c))
    }

    pub(crate) const fn tagged(raw: DVec3) -> Self {
        Self { raw }
    }

    /// Evaluates a x + b y + c h, which is 0 on the line. For h > 0, its sign gives the side.
    #[must_use]
    pub fn evaluate(self, point: HPoint2) -> f64 {
        self.raw.dot(point.raw)
    }

    /// Returns the intersection of two lines, which is at infinity if they are parallel, or `None`
    /// if they are the same or either is not a line.
    #[must_use]
    pub fn meet(self, other: Self) -> Option<HPoint2> {
        cross_product(self.raw, other.raw).map(HPoint2::tagged)
    }

    /// Returns whether both are the same line, or `None` if either is not a line (HO-2).
    #[must_use]
    pub fn equivalent(self, other: Self, relative: f64) -> Option<bool> {
        are_proportional(&self.raw.to_array(), &other.raw.to_array(), relative)
    }
}

fn cross_product(a: DVec3, b: DVec3) -> Option<DVec3> {
    let cross = a.cross(b);
    (cross.is_finite() && cross != DVec3::ZERO).then_some(cross)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn c19_the_line_of_a_point_meets_h_1_at_its_position() {
        for k in [1.0, -3.0, 1e-200] {
            assert_eq!(HPoint2::new(-2.0 * k, -k, 2.0 * k).divide(), Some([-1.0, -0.5]));
        }
        assert_eq!(HPoint2::new(0.0, 0.0, 0.0).divide(), None);
        assert_eq!(HPoint2::new(1.0, 2.0, f64::INFINITY).divide(), None);
    }

    #[test]
    fn points_join_in_lines_and_lines_meet_in_points() {
        let (a, b) = (HPoint2::from_xy(1.0, 2.0), HPoint2::from_xy(3.0, 2.0));
        let level = a.join(b).expect("two different points");
        assert_eq!(level.equivalent(HLine2::new(0.0, 1.0, -2.0), 0.0), Some(true));
        let parallel = HLine2::new(0.0, 1.0, 5.0);
        let far = level.meet(parallel).expect("two different lines");
        assert_eq!(far.equivalent(HPoint2::at_infinity(1.0, 0.0), 0.0), Some(true));
        assert_eq!(HLine2::INFINITY.evaluate(far), 0.0);
        assert_eq!((a.join(a), level.meet(level)), (None, None));
    }
}
