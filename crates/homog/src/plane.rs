//! Oriented planes, stored as the coefficients of a x + b y + c z + d = 0.

use crate::{HPoint, Normal, Point, Space};
use core::marker::PhantomData;
use glam::{DVec3, DVec4};

/// The plane a x + b y + c z + d = 0 of space `S`, stored as the four numbers (a, b, c, d).
///
/// (a, b, c) points to the positive side. Any positive multiple is the same oriented plane.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Plane<S: Space> {
    pub(crate) raw: DVec4,
    space: PhantomData<S>,
}

impl<S: Space> Plane<S> {
    pub(crate) const fn tagged(raw: DVec4) -> Self {
        Self { raw, space: PhantomData }
    }

    /// Creates the plane a x + b y + c z + d = 0.
    #[must_use]
    pub const fn new(a: f64, b: f64, c: f64, d: f64) -> Self {
        Self::tagged(DVec4::new(a, b, c, d))
    }

    /// Returns the coefficients [a, b, c, d].
    #[must_use]
    pub const fn coefficients(self) -> [f64; 4] {
        self.raw.to_array()
    }

    /// Returns the plane through `point` perpendicular to `normal`, which points to the positive
    /// side.
    #[must_use]
    pub fn through(point: Point<S>, normal: Normal<S>) -> Self {
        let n: DVec3 = normal.raw;
        Self::tagged(n.extend(-n.dot(point.raw)))
    }

    /// Returns the direction to the positive side.
    #[must_use]
    pub fn normal(self) -> Normal<S> {
        Normal::tagged(self.raw.truncate())
    }

    /// Evaluates a x + b y + c z + d w, which is positive on the side of the normal and 0 on the
    /// plane. For w = 1 and a normal of length 1, the value is the signed distance.
    #[must_use]
    pub fn evaluate(self, point: impl Into<HPoint<S>>) -> f64 {
        self.raw.dot(point.into().raw)
    }
}
