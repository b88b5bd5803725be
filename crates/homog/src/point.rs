//! Points: positions in a space.

use crate::{Space, Vector};
use core::marker::PhantomData;
use core::ops::{Add, Sub};
use glam::DVec3;

/// A position in space `S`.
///
/// Points can be subtracted from each other and moved by vectors. They cannot be added or scaled,
/// because the result would depend on the choice of origin.
///
/// ```
/// use homog::{Point, Vector, World};
/// let roof = Point::<World>::new(0.0, 3.0, 0.0);
/// let floor = Point::<World>::ORIGIN;
/// assert_eq!(roof - floor, Vector::new(0.0, 3.0, 0.0));
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Point<S: Space> {
    pub(crate) raw: DVec3,
    space: PhantomData<S>,
}

impl<S: Space> Point<S> {
    /// The origin of the space.
    pub const ORIGIN: Self = Self::tagged(DVec3::ZERO);

    /// Creates the point (x, y, z).
    #[must_use]
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self::tagged(DVec3::new(x, y, z))
    }

    pub(crate) const fn tagged(raw: DVec3) -> Self {
        Self { raw, space: PhantomData }
    }

    /// Returns the x coordinate.
    #[must_use]
    pub const fn x(self) -> f64 {
        self.raw.x
    }

    /// Returns the y coordinate.
    #[must_use]
    pub const fn y(self) -> f64 {
        self.raw.y
    }

    /// Returns the z coordinate.
    #[must_use]
    pub const fn z(self) -> f64 {
        self.raw.z
    }

    /// Returns the point at fraction `t` of the way to `end`: this point at 0, `end` at 1. A `t`
    /// outside [0, 1] extrapolates.
    #[must_use]
    pub fn lerp(self, end: Self, t: f64) -> Self {
        self + (end - self) * t
    }

    /// Returns the distance to another point.
    #[must_use]
    pub fn distance(self, other: Self) -> f64 {
        (self - other).length()
    }

    /// Returns the coordinates in single precision.
    #[must_use]
    pub fn to_f32(self) -> [f32; 3] {
        self.raw.as_vec3().to_array()
    }

    /// Returns whether all coordinates are finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.raw.is_finite()
    }
}

impl<S: Space> Sub for Point<S> {
    type Output = Vector<S>;
    fn sub(self, start: Self) -> Vector<S> {
        Vector::tagged(self.raw - start.raw)
    }
}

impl<S: Space> Add<Vector<S>> for Point<S> {
    type Output = Self;
    fn add(self, by: Vector<S>) -> Self {
        Self::tagged(self.raw + by.raw)
    }
}

impl<S: Space> Sub<Vector<S>> for Point<S> {
    type Output = Self;
    fn sub(self, by: Vector<S>) -> Self {
        Self::tagged(self.raw - by.raw)
    }
}

impl<S: Space> From<[f64; 3]> for Point<S> {
    fn from(raw: [f64; 3]) -> Self {
        Self::tagged(raw.into())
    }
}

impl<S: Space> From<[f32; 3]> for Point<S> {
    fn from(raw: [f32; 3]) -> Self {
        Self::tagged(raw.map(f64::from).into())
    }
}

impl<S: Space> From<Point<S>> for [f64; 3] {
    fn from(point: Point<S>) -> Self {
        point.raw.into()
    }
}
