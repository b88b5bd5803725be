//! Rays: half-lines that start at a point, for picking and ray casting.

use crate::{Bounds, Plane, Point, Space, Vector};

/// A half-line: every point `origin + t · direction` with t ≥ 0.
///
/// ```
/// use homog::{Point, Ray, Vector, World};
/// let ray = Ray::<World> { origin: Point::new(0.0, 2.0, 0.0), direction: Vector::X };
/// assert_eq!(ray.at(3.0), Point::new(3.0, 2.0, 0.0));
/// let wall = [[5.0, 0.0, -9.0], [5.0, 0.0, 9.0], [5.0, 9.0, 0.0]].map(Point::from);
/// assert_eq!(ray.hit_triangle(wall).map(|hit| hit.t), Some(5.0));
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ray<S: Space> {
    /// The point at which the ray starts.
    pub origin: Point<S>,
    /// The direction of the ray. If its length is 1, parameters along the ray are distances.
    pub direction: Vector<S>,
}

/// The intersection of a ray with a triangle.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct TriangleHit {
    /// The parameter along the ray.
    pub t: f64,
    /// The weights of the triangle's corners at the intersection: nonnegative, with sum 1. They
    /// interpolate any attribute.
    pub weights: [f64; 3],
    /// Whether the corners are counterclockwise as seen from the origin of the ray.
    pub is_front: bool,
}

impl<S: Space> Ray<S> {
    /// Returns the point at parameter `t`, which is a distance if the direction has length 1.
    #[must_use]
    pub fn at(self, t: f64) -> Point<S> {
        self.origin + self.direction * t
    }

    /// Returns the parameter at which the ray meets a plane, or `None` if the ray is parallel to
    /// the plane or points away from it, or if a number is not finite.
    #[must_use]
    pub fn hit_plane(self, plane: Plane<S>) -> Option<f64> {
        let t = -plane.evaluate(self.origin) / plane.normal().dot(self.direction);
        (t >= 0.0 && t.is_finite()).then_some(t)
    }

    /// Returns the intersection with a triangle, from either side, or `None` if the ray misses it
    /// or lies in its plane (Möller and Trumbore, 1997).
    #[must_use]
    pub fn hit_triangle(self, [a, b, c]: [Point<S>; 3]) -> Option<TriangleHit> {
        let (ab, ac) = (b - a, c - a);
        let across = self.direction.cross(ac);
        let determinant = ab.dot(across);
        let from_a = self.origin - a;
        let around = from_a.cross(ab);
        let at_b = from_a.dot(across) / determinant;
        let at_c = self.direction.dot(around) / determinant;
        let t = ac.dot(around) / determinant;
        let is_hit = at_b >= 0.0 && at_c >= 0.0 && at_b + at_c <= 1.0 && t >= 0.0;
        let weights = [(1.0 - at_b - at_c).max(0.0), at_b, at_c];
        (is_hit && t.is_finite()).then_some(TriangleHit { t, weights, is_front: determinant > 0.0 })
    }

    /// Returns the parameters at which the ray enters and leaves a box, or `None` if it misses. The
    /// first is 0 if the ray starts inside (Kay and Kajiya, 1986).
    #[must_use]
    pub fn hit_bounds(self, bounds: Bounds<S>) -> Option<[f64; 2]> {
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        let [origin, direction]: [[f64; 3]; 2] = [self.origin.into(), self.direction.into()];
        let [min, max]: [[f64; 3]; 2] = [bounds.min().into(), bounds.max().into()];
        for axis in 0..3 {
            if direction[axis] == 0.0 {
                // Parallel to both planes: the ray is between them everywhere or nowhere.
                if !(min[axis]..=max[axis]).contains(&origin[axis]) {
                    return None;
                }
                continue;
            }
            let [a, b] = [min, max].map(|end| (end[axis] - origin[axis]) / direction[axis]);
            (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
        }
        (enter <= leave && enter.is_finite() && self.origin.is_finite()).then_some([enter, leave])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Normal, World};

    fn ray(origin: [f64; 3], direction: [f64; 3]) -> Ray<World> {
        Ray { origin: origin.into(), direction: direction.into() }
    }

    #[test]
    fn triangles_are_hit_from_both_sides() {
        let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]].map(Point::from);
        let hit = ray([1.0, 2.0, 3.0], [0.0, 0.0, -1.0]).hit_triangle(corners).expect("a hit");
        assert_eq!(hit, TriangleHit { t: 3.0, weights: [0.25, 0.25, 0.5], is_front: true });
        let hit = ray([1.0, 2.0, -3.0], [0.0, 0.0, 2.0]).hit_triangle(corners).expect("a hit");
        assert_eq!((hit.t, hit.is_front), (1.5, false));
        for (origin, direction) in [
            ([3.0, 2.0, 3.0], [0.0, 0.0, -1.0]),
            ([1.0, 2.0, 3.0], [0.0, 0.0, 1.0]),
            ([1.0, 2.0, 0.0], [1.0, 0.0, 0.0]),
            ([f64::NAN, 2.0, 3.0], [0.0, 0.0, -1.0]),
            ([1.0, 2.0, 3.0], [0.0, 0.0, 0.0]),
        ] {
            assert_eq!(ray(origin, direction).hit_triangle(corners), None, "{origin:?}");
        }
    }

    #[test]
    fn only_planes_ahead_of_the_origin_are_hit() {
        let floor = Plane::through(Point::ORIGIN, Normal::new(0.0, 1.0, 0.0));
        assert_eq!(ray([0.0, 3.0, 0.0], [1.0, -1.5, 0.0]).hit_plane(floor), Some(2.0));
        for direction in [[1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [f64::NAN, -1.0, 0.0]] {
            assert_eq!(ray([0.0, 3.0, 0.0], direction).hit_plane(floor), None, "{direction:?}");
        }
    }

    #[test]
    fn rays_enter_and_leave_boxes() {
        let bounds = Bounds::from_points([[-1.0; 3], [1.0; 3]].map(Point::from)).expect("a box");
        assert_eq!(ray([-3.0, 0.0, 0.0], [1.0, 0.0, 0.0]).hit_bounds(bounds), Some([2.0, 4.0]));
        assert_eq!(ray([0.0, 0.0, 0.0], [0.0, 0.0, -2.0]).hit_bounds(bounds), Some([0.0, 0.5]));
        // Along an edge of the box.
        assert_eq!(ray([-3.0, 1.0, 1.0], [1.0, 0.0, 0.0]).hit_bounds(bounds), Some([2.0, 4.0]));
        for (origin, direction) in [
            ([-3.0, 0.0, 0.0], [-1.0, 0.0, 0.0]),
            ([-3.0, 2.0, 0.0], [1.0, 0.0, 0.0]),
            ([-3.0, 0.0, 0.0], [1.0, 1.0, 0.0]),
            ([f64::NAN, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ] {
            assert_eq!(ray(origin, direction).hit_bounds(bounds), None, "{origin:?}");
        }
    }
}
