//! Rays: half-lines that begin at a point, as picking and ray casting use them.

use crate::{Point, Space, Vector};

/// A half-line: every point `origin + t · direction` with t ≥ 0.
///
/// ```
/// use homog::{Point, Ray, Vector, World};
/// let ray = Ray::<World> { origin: Point::new(0.0, 2.0, 0.0), direction: Vector::X };
/// assert_eq!(ray.at(3.0), Point::new(3.0, 2.0, 0.0));
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ray<S: Space> {
    /// The point at which the ray begins.
    pub origin: Point<S>,
    /// The direction of the ray. With length 1, parameters along the ray are distances.
    pub direction: Vector<S>,
}

impl<S: Space> Ray<S> {
    /// The point at parameter `t`, a distance if the direction has length 1.
    #[must_use]
    pub fn at(self, t: f64) -> Point<S> {
        self.origin + self.direction * t
    }
}
