//! Homogeneous points: four numbers for a position or a direction, up to a common factor.

use crate::{Point, Space, Vector};
use core::marker::PhantomData;
use glam::DVec4;

/// A homogeneous point (x, y, z, w) of space `S` (HO-1).
///
/// With w ≠ 0 it represents the position (x/w, y/w, z/w); with w = 0, the direction (x, y, z),
/// which is a point at infinity. Any nonzero multiple represents the same point; (0, 0, 0, 0) does
/// not represent a point.
///
/// ```
/// use homog::{Clip, HPoint, Ndc, Point};
/// let visible = HPoint::<Clip>::new(1.0, 2.0, 3.0, 4.0);
/// assert_eq!(visible.divide(), Some(Point::<Ndc>::new(0.25, 0.5, 0.75)));
/// let at_infinity = HPoint::<Clip>::new(1.0, 2.0, 3.0, 0.0);
/// assert_eq!(at_infinity.divide(), None);
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HPoint<S: Space> {
    pub(crate) raw: DVec4,
    space: PhantomData<S>,
}

impl<S: Space> HPoint<S> {
    /// Creates the homogeneous point (x, y, z, w).
    #[must_use]
    pub const fn new(x: f64, y: f64, z: f64, w: f64) -> Self {
        Self::tagged(DVec4::new(x, y, z, w))
    }

    pub(crate) const fn tagged(raw: DVec4) -> Self {
        Self { raw, space: PhantomData }
    }

    /// Returns the x coordinate before the divide.
    #[must_use]
    pub const fn x(self) -> f64 {
        self.raw.x
    }

    /// Returns the y coordinate before the divide.
    #[must_use]
    pub const fn y(self) -> f64 {
        self.raw.y
    }

    /// Returns the z coordinate before the divide.
    #[must_use]
    pub const fn z(self) -> f64 {
        self.raw.z
    }

    /// Returns the homogeneous coordinate w, which is 0 for directions.
    #[must_use]
    pub const fn w(self) -> f64 {
        self.raw.w
    }

    /// Performs the perspective divide and returns the position that this point represents,
    /// (x/w, y/w, z/w).
    ///
    /// Returns `None` if w is 0, a coordinate is not finite, or a quotient is too large to
    /// represent. A point behind the eye (w < 0) divides like any other, so clip first.
    #[must_use]
    pub fn divide(self) -> Option<Point<S::Divided>> {
        let place = self.raw.truncate() / self.raw.w;
        (self.raw.w.is_finite() && place.is_finite()).then_some(Point::tagged(place))
    }

    /// Returns the homogeneous point at fraction `t` of the way to `end`, along a straight line in
    /// four dimensions (CL-2).
    #[must_use]
    pub fn lerp(self, end: Self, t: f64) -> Self {
        Self::tagged(self.raw + (end.raw - self.raw) * t)
    }

    /// Returns the coordinates in single precision.
    #[must_use]
    pub fn to_f32(self) -> [f32; 4] {
        self.raw.as_vec4().to_array()
    }

    /// Returns whether all coordinates are finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.raw.is_finite()
    }
}

impl<S: Space> From<Point<S>> for HPoint<S> {
    /// Lifts a position: w = 1 (HO-1).
    fn from(point: Point<S>) -> Self {
        Self::tagged(point.raw.extend(1.0))
    }
}

impl<S: Space> From<Vector<S>> for HPoint<S> {
    /// Lifts a direction to its point at infinity: w = 0 (HO-1).
    fn from(vector: Vector<S>) -> Self {
        Self::tagged(vector.raw.extend(0.0))
    }
}

impl<S: Space> From<[f64; 4]> for HPoint<S> {
    fn from(raw: [f64; 4]) -> Self {
        Self::tagged(raw.into())
    }
}

impl<S: Space> From<[f32; 4]> for HPoint<S> {
    fn from(raw: [f32; 4]) -> Self {
        Self::tagged(raw.map(f64::from).into())
    }
}

impl<S: Space> From<HPoint<S>> for [f64; 4] {
    fn from(point: HPoint<S>) -> Self {
        point.raw.into()
    }
}
