//! Projection from first principles: a center, a plane and straight projectors between them (C72).
//!
//! ```text
//!        ● center (a point, or a direction if the projectors are parallel)
//!        │╲
//!        │ ╲ projector
//!   ─────●──●────── plane        M = (π·c) I − c πᵀ
//!        │   ╲
//!        ●    ●  object
//! ```
//!
//! With the center c as a homogeneous point and the plane π as four numbers, every point x maps to
//! the intersection of its projector with the plane, (π·c) x − (π·x) c. A center with w = 0 is the
//! limit of an eye that moves to infinity, so parallel projection is not a special case (PR-1).

use crate::ProjectionError;
use crate::error::check_finite;
use crate::matrix::check_representable;
use glam::{DMat4, DVec4};
use homog::{HPoint, Plane, Point, Projective, Space, Vector};

/// A center and a plane of projection in space `S`.
///
/// # Guarantees
/// The center is finite and not in the plane, and the plane has a unit normal.
///
/// ```
/// use homog::{Normal, Plane, Point, View};
/// use projection::Projector;
/// // A lamp 4 above the floor: shadows are central projections.
/// let floor = Plane::<View>::through(Point::ORIGIN, Normal::new(0.0, 1.0, 0.0));
/// let lamp = Projector::from_eye(Point::new(0.0, 4.0, 0.0), floor)?;
/// let shadow = lamp.onto_plane().transform_point(Point::new(1.0, 2.0, 0.0)).divide();
/// assert_eq!(shadow, Some(Point::new(2.0, 0.0, 0.0)));
/// # Ok::<(), projection::ProjectionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Projector<S: Space> {
    center: HPoint<S>,
    plane: Plane<S>,
    /// π·c, which is never 0.
    reach: f64,
}

impl<S: Space> Projector<S> {
    /// Creates the central projection from `eye` onto `plane`.
    ///
    /// # Errors
    /// Returns an error if a number is not finite, the plane has no normal, or the eye is in the
    /// plane.
    pub fn from_eye(eye: Point<S>, plane: Plane<S>) -> Result<Self, ProjectionError> {
        for value in <[f64; 3]>::from(eye) {
            check_finite("eye", value)?;
        }
        Self::new_checked(HPoint::from(eye), plane, ProjectionError::CenterOnPlane)
    }

    /// Creates the parallel projection along `direction` onto `plane`.
    ///
    /// # Errors
    /// Returns an error if a number is not finite, the direction or the plane's normal is zero, or
    /// the direction is parallel to the plane.
    pub fn along(direction: Vector<S>, plane: Plane<S>) -> Result<Self, ProjectionError> {
        for value in <[f64; 3]>::from(direction) {
            check_finite("direction", value)?;
        }
        let unit =
            direction.normalized().ok_or(ProjectionError::ZeroVector { parameter: "direction" })?;
        Self::new_checked(HPoint::from(unit), plane, ProjectionError::ParallelToPlane)
    }

    fn new_checked(
        center: HPoint<S>,
        plane: Plane<S>,
        touching: ProjectionError,
    ) -> Result<Self, ProjectionError> {
        for value in plane.raw().to_array() {
            check_finite("plane", value)?;
        }
        let length = Vector::<S>::from_raw(plane.raw().truncate()).length();
        if length == 0.0 {
            return Err(ProjectionError::ZeroVector { parameter: "plane normal" });
        }
        let unit = plane.raw() / length;
        check_representable(DMat4::from_diagonal(unit), "plane")?;
        let plane = Plane::from_raw(unit);
        let reach = plane.evaluate(center);
        let projector = Self { center, plane, reach };
        let size = center.raw().abs() * plane.raw().abs();
        if reach.abs() <= 8.0 * f64::EPSILON * (size.x + size.y + size.z + size.w) {
            return Err(touching);
        }
        check_representable(projector.depth_preserving().raw(), "projector")?;
        Ok(projector)
    }

    /// Returns the center of projection, with w = 0 if the projectors are parallel.
    #[must_use]
    pub const fn center(self) -> HPoint<S> {
        self.center
    }

    /// Returns the plane of projection, with a normal of length 1.
    #[must_use]
    pub const fn plane(self) -> Plane<S> {
        self.plane
    }

    /// Returns the classical projection, which maps every point to the plane. It is singular, and
    /// it does not move points of the plane.
    #[must_use]
    pub fn onto_plane(self) -> Projective<S, S> {
        let toward = self.center.raw() / self.reach;
        Projective::from_raw(DMat4::IDENTITY - outer_product(toward, self.plane.raw()))
    }

    /// Returns the depth-preserving variant: the image keeps its distance from the plane before the
    /// divide. The map is therefore invertible, and hidden surfaces can be removed (PR-1, C102).
    #[must_use]
    pub fn depth_preserving(self) -> Projective<S, S> {
        let normal = self.plane.normal().raw().extend(0.0);
        let kept = outer_product(normal, self.plane.raw());
        Projective::from_raw(self.onto_plane().raw() + kept)
    }
}

/// Returns a bᵀ.
fn outer_product(a: DVec4, b: DVec4) -> DMat4 {
    DMat4::from_cols(a * b.x, a * b.y, a * b.z, a * b.w)
}
