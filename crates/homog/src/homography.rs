//! Projective maps of the plane: 3×3 matrices that act on 2-D homogeneous points.
//!
//! ```text
//!   (0,1)────(1,1)          (−1,3)──(1,3)       M = [ 2   0   −1 ]
//!     │        │                ╱    ╲              [ 0   3    0 ]
//!     │        │     ──M──►    ╱      ╲             [ 0  2/3  1/3 ]
//!   (0,0)────(1,0)        (−3,0)──────(3,0)
//! ```
//!
//! Lines map to lines, but parallel lines may meet in the image. One line, whose points get w = 0,
//! maps to infinity: in this example, 2y + 1 = 0. Any nonzero multiple of M is the same map.
//! Source: the textbook (Shirley and Marschner, ch. 8), §8.2; HO-3.

use crate::elimination::eliminate_full_pivoting;
use crate::hpoint_kind::are_proportional;
use crate::{HLine2, HPoint2};
use glam::{DMat3, DVec3};

/// A projective map of the plane (HO-3).
///
/// ```
/// use homog::{HPoint2, Homography};
/// let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
/// let photo = [[-3.0, 0.0], [3.0, 0.0], [1.0, 3.0], [-1.0, 3.0]];
/// let map = Homography::from_unit_square(photo).expect("four corners of a quadrilateral");
/// let middle = map.transform_point(HPoint2::from_xy(0.5, 0.5)).divide().expect("finite");
/// // The center maps to a point above half the height.
/// assert!((middle[1] - 2.25).abs() < 1e-14);
/// let rectify = map.inverse().expect("a quadrilateral with four corners");
/// # for (p, q) in photo.into_iter().zip(square) {
/// #     let back = rectify.transform_point(p.into()).divide().expect("finite");
/// #     assert!((back[0] - q[0]).abs() + (back[1] - q[1]).abs() < 1e-14);
/// # }
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Homography {
    pub(crate) raw: DMat3,
}

impl Homography {
    /// The identity map.
    pub const IDENTITY: Self = Self { raw: DMat3::IDENTITY };

    pub(crate) const fn tagged(raw: DMat3) -> Self {
        Self { raw }
    }

    /// Returns the map that takes the corners (0,0), (1,0), (1,1), (0,1) of the unit square to the
    /// four given points, in this order.
    ///
    /// Returns `None` if three of them are collinear or a coordinate is not finite.
    #[must_use]
    pub fn from_unit_square(corners: [[f64; 2]; 4]) -> Option<Self> {
        // Three corners are the images of three base points, each up to a factor; the fourth
        // determines the factors.
        let [p00, p10, p11, p01] = corners.map(|[x, y]| DVec3::new(x, y, 1.0));
        let base = Self::tagged(DMat3::from_cols(p00, p10, p01));
        let factors = base.inverse()?.raw * p11;
        let [a, b, c] = (DVec3::new(-1.0, 1.0, 1.0) * factors).to_array();
        let (origin, x, y) = (p00 * a, p10 * b, p01 * c);
        let map = Self::tagged(DMat3::from_cols(x - origin, y - origin, origin));
        map.inverse().map(|_| map)
    }

    /// Returns the image of a homogeneous point before the divide.
    #[must_use]
    pub fn transform_point(self, point: HPoint2) -> HPoint2 {
        HPoint2::tagged(self.raw * point.raw)
    }

    /// Returns the image of a line, or `None` if the map is singular or a coefficient of the image
    /// is not finite.
    #[must_use]
    pub fn transform_line(self, line: HLine2) -> Option<HLine2> {
        let image = self.inverse()?.raw.transpose() * line.raw;
        image.is_finite().then_some(HLine2::tagged(image))
    }

    /// Returns the line that maps to infinity: its points get w = 0. For an affine map it is the
    /// line at infinity itself.
    #[must_use]
    pub fn horizon(self) -> HLine2 {
        HLine2::tagged(self.raw.row(2))
    }

    /// Returns the map that applies this map first, then `next`.
    #[must_use]
    pub fn then(self, next: Self) -> Self {
        Self::tagged(next.raw * self.raw)
    }

    /// Returns the determinant: 0 if the plane is flattened to a line or a point.
    #[must_use]
    pub fn determinant(self) -> f64 {
        self.raw.determinant()
    }

    /// Returns the inverse map, or `None` if it is not finite or does not exist, up to rounding.
    #[must_use]
    pub fn inverse(self) -> Option<Self> {
        eliminate_full_pivoting(self.rows()).inverse.map(Self::from_rows)
    }

    /// Returns whether the two maps are the same, that is, whether one matrix is a multiple of the
    /// other (HO-2).
    ///
    /// Returns `None` if either matrix is zero or not finite.
    #[must_use]
    pub fn equivalent(self, other: Self, relative: f64) -> Option<bool> {
        are_proportional(&self.raw.to_cols_array(), &other.raw.to_cols_array(), relative)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHAPTER: [[f64; 3]; 3] = [[2.0, 0.0, -1.0], [0.0, 3.0, 0.0], [0.0, 2.0 / 3.0, 1.0 / 3.0]];
    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    const IMAGE: [[f64; 2]; 4] = [[-3.0, 0.0], [3.0, 0.0], [1.0, 3.0], [-1.0, 3.0]];

    #[test]
    fn c16_unit_square_example_from_the_chapter() {
        let map = Homography::from_rows(CHAPTER);
        for (p, q) in SQUARE.into_iter().zip(IMAGE) {
            assert_eq!(map.transform_point(p.into()).divide(), Some(q), "{p:?}");
        }
        let found = Homography::from_unit_square(IMAGE).expect("four corners");
        assert_eq!(found.equivalent(map, 1e-14), Some(true));
    }

    #[test]
    fn c17_a_multiple_of_the_matrix_is_the_same_map() {
        let map = Homography::from_rows(CHAPTER);
        let thrice = Homography::tagged(map.raw * 3.0);
        assert_eq!(map.equivalent(thrice, 1e-15), Some(true));
        for p in SQUARE {
            assert_eq!(
                map.transform_point(p.into()).divide(),
                thrice.transform_point(p.into()).divide()
            );
        }
        assert_eq!(map.equivalent(Homography::IDENTITY, 1e-15), Some(false));
        assert_eq!(map.equivalent(Homography::from_rows([[0.0; 3]; 3]), 1e-15), None);
    }

    #[test]
    fn one_line_maps_to_infinity() {
        let map = Homography::from_rows(CHAPTER);
        let wanted = HLine2::new(0.0, 2.0, 1.0); // 2y + 1 = 0
        assert_eq!(map.horizon().equivalent(wanted, 1e-15), Some(true));
        assert_eq!(
            Homography::tagged(map.raw * 3.0).transform_point(HPoint2::from_xy(7.0, -0.5)).divide(),
            None
        );
        let infinite = map.transform_line(wanted).expect("regular");
        assert_eq!(infinite.equivalent(HLine2::INFINITY, 1e-15), Some(true));
    }

    #[test]
    fn collinear_corners_give_none() {
        let flat = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [0.0, 1.0]];
        assert_eq!(Homography::from_unit_square(flat), None);
        let nan = [[0.0, 0.0], [1.0, f64::NAN], [2.0, 2.0], [0.0, 1.0]];
        assert_eq!(Homography::from_unit_square(nan), None);
    }
}
