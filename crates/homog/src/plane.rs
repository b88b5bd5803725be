//! Planes: the points at distance zero.

use crate::{HPoint, Normal, Point, Space};
use core::marker::PhantomData;
use glam::{DVec3, DVec4};

/// The plane a x + b y + c z + d = 0 of space `S`, as the four numbers (a, b, c, d).
///
/// (a, b, c) points to the positive side. Any positive multiple is the same oriented plane.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Plane<S: Space> {
    raw: DVec4,
    space: PhantomData<S>,
}

impl<S: Space> Plane<S> {
    /// Tags four plain coefficients (a, b, c, d) with a space.
    #[must_use]
    pub const fn from_raw(raw: DVec4) -> Self {
        Self { raw, space: PhantomData }
    }

    /// The plane through `point` perpendicular to `normal`, its positive side where the normal
    /// points.
    #[must_use]
    pub fn through(point: Point<S>, normal: Normal<S>) -> Self {
        let n: DVec3 = normal.raw();
        Self::from_raw(n.extend(-n.dot(point.raw())))
    }

    /// The coefficients (a, b, c, d).
    #[must_use]
    pub const fn raw(self) -> DVec4 {
        self.raw
    }

    /// The direction to the positive side.
    #[must_use]
    pub fn normal(self) -> Normal<S> {
        Normal::from_raw(self.raw.truncate())
    }

    /// a x + b y + c z + d w: positive on the side of the normal, 0 on the plane. It is the
    /// distance for a place (w = 1) if the normal has length 1.
    #[must_use]
    pub fn evaluate(self, point: impl Into<HPoint<S>>) -> f64 {
        self.raw.dot(point.into().raw())
    }
}
