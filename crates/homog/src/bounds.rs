//! Bounds: the smallest axis-aligned box that contains some points.

use crate::{Affine, Point, Space, Vector};

/// A closed axis-aligned box in space `S`, never empty: `min ≤ max` in every coordinate, and all
/// coordinates are finite.
///
/// The bounds of one point have size zero. An empty set has no bounds, so [`Bounds::from_points`]
/// returns an `Option`.
///
/// ```
/// use homog::{Bounds, Point, World};
/// let corners = [[0.0, 3.0, 1.0], [2.0, -1.0, 1.0]].map(Point::<World>::from);
/// let bounds = Bounds::from_points(corners).expect("two finite points");
/// assert_eq!(bounds.center(), Point::new(1.0, 1.0, 1.0));
/// assert_eq!(<[f64; 3]>::from(bounds.size()), [2.0, 4.0, 0.0]);
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bounds<S: Space> {
    min: Point<S>,
    max: Point<S>,
}

impl<S: Space> Bounds<S> {
    /// Returns the smallest box that contains all `points`, or `None` if there are no points or one
    /// of them is not finite.
    #[must_use]
    pub fn from_points(points: impl IntoIterator<Item = Point<S>>) -> Option<Self> {
        let mut points = points.into_iter();
        let first = points.next()?;
        let (mut min, mut max) = (first.raw, first.raw);
        let mut finite = first.is_finite();
        for point in points {
            finite &= point.is_finite();
            min = min.min(point.raw);
            max = max.max(point.raw);
        }
        finite.then_some(Self { min: Point::tagged(min), max: Point::tagged(max) })
    }

    /// Returns the corner with the minimum x, y and z.
    #[must_use]
    pub const fn min(self) -> Point<S> {
        self.min
    }

    /// Returns the corner with the maximum x, y and z.
    #[must_use]
    pub const fn max(self) -> Point<S> {
        self.max
    }

    /// Returns the smallest box that contains both boxes.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            min: Point::tagged(self.min.raw.min(other.min.raw)),
            max: Point::tagged(self.max.raw.max(other.max.raw)),
        }
    }

    /// Returns the eight corners. Bit 0 of the index selects the maximum x, bit 1 the maximum y and
    /// bit 2 the maximum z.
    #[must_use]
    pub fn corners(self) -> [Point<S>; 8] {
        let ends = [self.min.raw, self.max.raw];
        core::array::from_fn(|i| Point::new(ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2].z))
    }

    /// Returns the center of the box.
    #[must_use]
    pub fn center(self) -> Point<S> {
        Point::tagged(self.min.raw * 0.5 + self.max.raw * 0.5)
    }

    /// Returns the three edge lengths as the vector from the minimum corner to the maximum corner.
    /// A length that overflows is infinite.
    #[must_use]
    pub fn size(self) -> Vector<S> {
        self.max - self.min
    }

    /// Returns the length of the space diagonal.
    #[must_use]
    pub fn diagonal(self) -> f64 {
        self.size().length()
    }

    /// Returns whether `point` is inside the box or on its surface.
    #[must_use]
    pub fn contains(self, point: Point<S>) -> bool {
        self.min.raw.cmple(point.raw).all() && self.max.raw.cmpge(point.raw).all()
    }

    /// Returns the bounds of the image of this box, or `None` if the image of a corner is not
    /// finite. The result is usually larger than the bounds of the transformed contents.
    #[must_use]
    pub fn transformed<T: Space>(self, map: Affine<S, T>) -> Option<Bounds<T>> {
        Bounds::from_points(self.corners().map(|corner| map.transform_point(corner)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Model, World};

    #[test]
    fn an_empty_set_and_nan_have_no_bounds() {
        assert_eq!(Bounds::<World>::from_points([]), None);
        let nan = Point::new(0.0, f64::NAN, 0.0);
        assert_eq!(Bounds::<World>::from_points([Point::ORIGIN, nan]), None);
        assert_eq!(Bounds::<World>::from_points([nan, Point::ORIGIN]), None);
    }

    #[test]
    fn corners_are_distinct_and_have_the_same_bounds() {
        let bounds =
            Bounds::<Model>::from_points([[-1.0, 2.0, 3.0], [4.0, 5.0, 7.0]].map(Point::from))
                .expect("two finite points");
        let corners = bounds.corners();
        for (i, a) in corners.iter().enumerate() {
            assert!(bounds.contains(*a));
            assert!(corners[..i].iter().all(|b| a != b), "corner {i} occurs twice");
        }
        assert_eq!(Bounds::from_points(corners), Some(bounds));
    }

    #[test]
    fn the_bounds_of_a_rotated_box_contain_it() {
        let bounds =
            Bounds::<Model>::from_points([[-1.0; 3], [1.0; 3]].map(Point::from)).expect("a box");
        let turn = Affine::<Model, World>::rotation_z(core::f64::consts::FRAC_PI_4);
        let turned = bounds.transformed(turn).expect("finite");
        assert!((turned.size().x() - 8_f64.sqrt()).abs() < 1e-15);
        assert!((turned.size().z() - 2.0).abs() < 1e-15);
    }
}
