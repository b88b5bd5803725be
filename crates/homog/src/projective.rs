//! Projective maps, which map points to homogeneous points.

use crate::elimination::eliminate_full_pivoting;
use crate::{Affine, HPoint, Plane, Point, Space, Vector};
use core::marker::PhantomData;
use glam::DMat4;

/// A projective map from space `A` to space `B`: any 4×4 matrix, applied to column vectors (HO-3).
///
/// It maps points to *homogeneous* points; the divide is a separate step, [`HPoint::divide`], after
/// clipping. Lines map to lines and planes to planes. A nonzero multiple of the matrix is the same
/// map, but a negative factor flips the sign of w, which affects clipping: use the matrix with w >
/// 0 in front of the eye (PE-3).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Projective<A: Space, B: Space> {
    pub(crate) raw: DMat4,
    spaces: PhantomData<(A, B)>,
}

impl<A: Space, B: Space> Projective<A, B> {
    pub(crate) const fn tagged(raw: DMat4) -> Self {
        Self { raw, spaces: PhantomData }
    }

    /// Returns the image of a point before the divide.
    #[must_use]
    pub fn transform_point(self, point: Point<A>) -> HPoint<B> {
        self.transform_hpoint(point.into())
    }

    /// Writes the images of `points` to `images`, bit-identical to the results of
    /// [`transform_point`](Self::transform_point). Extra elements of the longer slice are ignored.
    pub fn transform_points_into(self, points: &[Point<A>], images: &mut [HPoint<B>]) {
        let DMat4 { x_axis, y_axis, z_axis, w_axis } = self.raw;
        for (point, image) in points.iter().zip(images) {
            let p = point.raw;
            *image = HPoint::tagged(x_axis * p.x + y_axis * p.y + z_axis * p.z + w_axis);
        }
    }

    /// Returns the vanishing point of a direction, that is, the image of its point at infinity
    /// (VN-1).
    #[must_use]
    pub fn transform_direction(self, vector: Vector<A>) -> HPoint<B> {
        self.transform_hpoint(vector.into())
    }

    /// Returns the image of a homogeneous point.
    #[must_use]
    pub fn transform_hpoint(self, point: HPoint<A>) -> HPoint<B> {
        HPoint::tagged(self.raw * point.raw)
    }

    /// Returns the image of a plane, or `None` if the map is singular or a coefficient of the image
    /// is not finite.
    #[must_use]
    pub fn transform_plane(self, plane: Plane<A>) -> Option<Plane<B>> {
        let image = self.inverse()?.raw.transpose() * plane.raw;
        image.is_finite().then_some(Plane::tagged(image))
    }

    /// Returns the map that applies this map first, then `next`.
    #[must_use]
    pub fn then<C: Space>(self, next: impl Into<Projective<B, C>>) -> Projective<A, C> {
        Projective::tagged(next.into().raw * self.raw)
    }

    /// Returns the inverse map, or `None` if it is not finite or does not exist, up to rounding.
    ///
    /// The test does not depend on units: a near plane at 10⁻⁹ does not make a map singular.
    /// [`inverse_with_report`](Self::inverse_with_report) reports details.
    #[must_use]
    pub fn inverse(self) -> Option<Projective<B, A>> {
        eliminate_full_pivoting(self.rows()).inverse.map(Projective::from_rows)
    }

    /// Returns whether all entries are finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.raw.is_finite()
    }
}

impl<A: Space, B: Space> From<Affine<A, B>> for Projective<A, B> {
    fn from(affine: Affine<A, B>) -> Self {
        Self::tagged(affine.raw)
    }
}
