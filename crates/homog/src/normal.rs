//! Normals: directions perpendicular to a surface.

use crate::{Space, Vector};
use core::marker::PhantomData;
use glam::DVec3;

/// A direction perpendicular to a surface of space `S`; its length is not significant.
///
/// Normals are a separate type because maps transform them differently: the inverse transpose keeps
/// them perpendicular when a surface is scaled unevenly or sheared.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Normal<S: Space> {
    pub(crate) raw: DVec3,
    space: PhantomData<S>,
}

impl<S: Space> Normal<S> {
    /// Creates the normal (x, y, z).
    #[must_use]
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self::tagged(DVec3::new(x, y, z))
    }

    pub(crate) const fn tagged(raw: DVec3) -> Self {
        Self { raw, space: PhantomData }
    }

    /// Returns the dot product with a vector of the same space: 0 if the vector is tangent to the
    /// surface.
    #[must_use]
    pub fn dot(self, vector: Vector<S>) -> f64 {
        self.raw.dot(vector.raw)
    }

    /// Returns this normal scaled to length 1, or `None` if it is zero or not finite.
    #[must_use]
    pub fn normalized(self) -> Option<Self> {
        Some(Self::tagged(Vector::<S>::tagged(self.raw).normalized()?.raw))
    }
}

impl<S: Space> From<[f64; 3]> for Normal<S> {
    fn from(raw: [f64; 3]) -> Self {
        Self::tagged(raw.into())
    }
}

impl<S: Space> From<Normal<S>> for [f64; 3] {
    fn from(normal: Normal<S>) -> Self {
        normal.raw.into()
    }
}
