//! Vectors: differences of points, with a length and a direction but no position.

use crate::Space;
use core::marker::PhantomData;
use core::ops::{Add, Div, Mul, Neg, Sub};
use glam::DVec3;

/// A difference of two points of space `S`. Translations leave it unchanged (HO-1, HO-4).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Vector<S: Space> {
    pub(crate) raw: DVec3,
    space: PhantomData<S>,
}

impl<S: Space> Vector<S> {
    /// The zero vector.
    pub const ZERO: Self = Self::tagged(DVec3::ZERO);
    /// The unit vector along x.
    pub const X: Self = Self::tagged(DVec3::X);
    /// The unit vector along y.
    pub const Y: Self = Self::tagged(DVec3::Y);
    /// The unit vector along z.
    pub const Z: Self = Self::tagged(DVec3::Z);

    /// Creates the vector (x, y, z).
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

    /// Returns the dot product.
    #[must_use]
    pub fn dot(self, other: Self) -> f64 {
        self.raw.dot(other.raw)
    }

    /// Returns the cross product, which is perpendicular to both vectors (right-hand rule).
    #[must_use]
    pub fn cross(self, other: Self) -> Self {
        Self::tagged(self.raw.cross(other.raw))
    }

    /// Returns the Euclidean length, correct even if the squares of the coordinates overflow or
    /// underflow.
    #[must_use]
    pub fn length(self) -> f64 {
        let largest = self.raw.abs().max_element();
        if largest == 0.0 || !largest.is_finite() {
            return largest;
        }
        largest * (self.raw / largest).length()
    }

    /// Returns the vector of length 1 in the same direction, or `None` if this one is zero or not
    /// finite.
    #[must_use]
    pub fn normalized(self) -> Option<Self> {
        let largest = self.raw.abs().max_element();
        if !self.is_finite() || largest == 0.0 {
            return None;
        }
        let scaled = self.raw / largest;
        Some(Self::tagged(scaled / scaled.length()))
    }

    /// Returns the vector at fraction `t` of the way to `end`.
    #[must_use]
    pub fn lerp(self, end: Self, t: f64) -> Self {
        self + (end - self) * t
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

impl<S: Space> Add for Vector<S> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::tagged(self.raw + other.raw)
    }
}

impl<S: Space> Sub for Vector<S> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::tagged(self.raw - other.raw)
    }
}

impl<S: Space> Neg for Vector<S> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::tagged(-self.raw)
    }
}

impl<S: Space> Mul<f64> for Vector<S> {
    type Output = Self;
    fn mul(self, by: f64) -> Self {
        Self::tagged(self.raw * by)
    }
}

impl<S: Space> Div<f64> for Vector<S> {
    type Output = Self;
    fn div(self, by: f64) -> Self {
        Self::tagged(self.raw / by)
    }
}

impl<S: Space> From<[f64; 3]> for Vector<S> {
    fn from(raw: [f64; 3]) -> Self {
        Self::tagged(raw.into())
    }
}

impl<S: Space> From<[f32; 3]> for Vector<S> {
    fn from(raw: [f32; 3]) -> Self {
        Self::tagged(raw.map(f64::from).into())
    }
}

impl<S: Space> From<Vector<S>> for [f64; 3] {
    fn from(vector: Vector<S>) -> Self {
        vector.raw.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::World;

    #[test]
    fn length_is_correct_for_huge_and_tiny_coordinates() {
        for unit in [1e200, 1.0, 1e-200] {
            let length = Vector::<World>::new(3.0 * unit, 4.0 * unit, 0.0).length();
            assert!((length / unit - 5.0).abs() < 1e-14, "{length:e} is not 5 x {unit:e}");
        }
        assert!(Vector::<World>::new(1e300, 1e300, 1e300).normalized().is_some());
        assert_eq!(Vector::<World>::ZERO.normalized(), None);
        assert_eq!(Vector::<World>::new(f64::NAN, 0.0, 1.0).normalized(), None);
        assert_eq!(Vector::<World>::new(f64::INFINITY, 0.0, 1.0).normalized(), None);
    }
}
