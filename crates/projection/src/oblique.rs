//! Oblique projection: parallel projectors that are not perpendicular to the plane (OB-1, OB-2;
//! C77..C79).
//!
//! ```text
//!        y │   ● image of (0,0,1)        α  angle between projector and plane
//!          │ ⟋ L1                        L1 = cot α, the drawn length of a unit of depth
//!          ⟋ φ                           φ  direction in which depth is drawn
//!   ───────┼────── x
//! ```
//!
//! Faces parallel to the plane keep their shape and size. The cavalier projection has L1 = 1 and α
//! = 45°, and the cabinet projection has L1 = ½ and tan α = 2.

use crate::ProjectionError;
use crate::error::check_finite;
use crate::matrix::{from_rows, is_bounded};
use homog::{Affine, Vector, View};

/// An oblique projection onto a plane z = const, or the orthographic projection if L1 = 0.
///
/// # Guarantees
/// The slant and the plane are finite.
///
/// ```
/// use homog::Point;
/// use projection::Oblique;
/// let cabinet = Oblique::cabinet(0.0)?;
/// // Depth is drawn at half length, to the right.
/// let image = cabinet.onto_plane().transform_point(Point::new(1.0, 2.0, 3.0));
/// assert_eq!(image, Point::new(2.5, 2.0, 0.0));
/// # Ok::<(), projection::ProjectionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Oblique {
    slant_x: f64,
    slant_y: f64,
    plane_z: f64,
}

/// Kinds of oblique projections, by the drawn length of a unit of depth.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ObliqueKind {
    /// L1 = 0: the projectors are perpendicular to the plane.
    Orthographic,
    /// L1 = 1: full depth.
    Cavalier,
    /// L1 = ½: half depth.
    Cabinet,
    /// Any other length.
    General,
}

impl Oblique {
    /// Creates a projection onto z = 0 that draws a unit of z with length `length` in direction
    /// `phi`, in radians counterclockwise from the right (OB-1).
    ///
    /// z points toward the viewer. Drafters measure the receding axis instead: depth that recedes
    /// to the upper right at 45° corresponds to φ = 225°.
    ///
    /// # Errors
    /// Returns an error if a number is not finite or the length is negative.
    pub fn new(length: f64, phi: f64) -> Result<Self, ProjectionError> {
        if check_finite("length", length)? < 0.0 {
            let allowed = "0 or greater";
            return Err(ProjectionError::OutOfRange {
                parameter: "length",
                value: length,
                allowed,
            });
        }
        let (sin, cos) = libm::sincos(check_finite("phi", phi)?);
        Self::new_checked(length * cos, length * sin, 0.0)
    }

    /// Creates a projection onto z = 0 with projectors at angle `alpha` to the plane and depth
    /// drawn in direction `phi`. L1 is cot α.
    ///
    /// # Errors
    /// Returns an error if an angle is not finite or α is not in (0, π/2].
    pub fn by_angle(alpha: f64, phi: f64) -> Result<Self, ProjectionError> {
        if check_finite("alpha", alpha)? <= 0.0 || alpha > core::f64::consts::FRAC_PI_2 {
            let allowed = "above 0 and up to π/2 radians";
            return Err(ProjectionError::OutOfRange { parameter: "alpha", value: alpha, allowed });
        }
        let (sin, cos) = libm::sincos(alpha);
        Self::new((cos / sin).max(0.0), phi)
    }

    /// Creates a projection onto the plane z = `plane_z` with projectors along `direction` (OB-2).
    ///
    /// # Errors
    /// Returns an error if a number is not finite, or the direction is zero or parallel to the
    /// plane.
    pub fn by_direction(direction: Vector<View>, plane_z: f64) -> Result<Self, ProjectionError> {
        for value in <[f64; 3]>::from(direction) {
            check_finite("direction", value)?;
        }
        if direction == Vector::ZERO {
            return Err(ProjectionError::ZeroVector { parameter: "direction" });
        }
        if direction.z() == 0.0 {
            return Err(ProjectionError::ParallelToPlane);
        }
        let (x, y) = (-direction.x() / direction.z(), -direction.y() / direction.z());
        Self::new_checked(x, y, check_finite("plane z", plane_z)?)
    }

    /// Creates the cavalier projection, which draws depth at full length in direction `phi`
    /// (usually 45° or 30°).
    ///
    /// # Errors
    /// Returns an error if the angle is not finite.
    pub fn cavalier(phi: f64) -> Result<Self, ProjectionError> {
        Self::new(1.0, phi)
    }

    /// Creates the cabinet projection, which draws depth at half length in direction `phi` (usually
    /// 45° or 30°).
    ///
    /// # Errors
    /// Returns an error if the angle is not finite.
    pub fn cabinet(phi: f64) -> Result<Self, ProjectionError> {
        Self::new(0.5, phi)
    }

    fn new_checked(slant_x: f64, slant_y: f64, plane_z: f64) -> Result<Self, ProjectionError> {
        let usable = [slant_x, slant_y, plane_z, slant_x * plane_z, slant_y * plane_z];
        if usable.into_iter().all(is_bounded) {
            Ok(Self { slant_x, slant_y, plane_z })
        } else {
            Err(ProjectionError::Unrepresentable { what: "slant" })
        }
    }

    /// Returns L1, the drawn length of a unit of depth.
    #[must_use]
    pub fn length(self) -> f64 {
        libm::hypot(self.slant_x, self.slant_y)
    }

    /// Returns φ, the direction in which depth is drawn. It is 0 for the orthographic projection.
    #[must_use]
    pub fn phi(self) -> f64 {
        libm::atan2(self.slant_y, self.slant_x)
    }

    /// Returns α, the angle between the projectors and the plane. It is π/2 for the orthographic
    /// projection.
    #[must_use]
    pub fn alpha(self) -> f64 {
        libm::atan2(1.0, self.length())
    }

    /// Returns the direction of the projectors, away from the viewer: (L1 cos φ, L1 sin φ, −1).
    #[must_use]
    pub const fn direction(self) -> Vector<View> {
        Vector::new(self.slant_x, self.slant_y, -1.0)
    }

    /// Returns the z of the plane of projection.
    #[must_use]
    pub const fn plane_z(self) -> f64 {
        self.plane_z
    }

    /// Returns the kind; lengths that agree to twelve digits count as equal.
    #[must_use]
    pub fn kind(self) -> ObliqueKind {
        let is = |length: f64| (self.length() - length).abs() < 1e-12;
        match (is(0.0), is(1.0), is(0.5)) {
            (true, ..) => ObliqueKind::Orthographic,
            (_, true, _) => ObliqueKind::Cavalier,
            (_, _, true) => ObliqueKind::Cabinet,
            _ => ObliqueKind::General,
        }
    }

    /// Returns the shear that makes the projectors parallel to z and preserves z: x' = x + (z −
    /// z_p) L1 cos φ, and y' likewise.
    #[must_use]
    pub fn depth_preserving(self) -> Affine<View, View> {
        self.shear(self.slant_x, self.slant_y)
    }

    /// Returns the inverse of [`depth_preserving`](Self::depth_preserving): the opposite shear.
    #[must_use]
    pub fn depth_preserving_inverse(self) -> Affine<View, View> {
        self.shear(-self.slant_x, -self.slant_y)
    }

    fn shear(self, x: f64, y: f64) -> Affine<View, View> {
        let rows = from_rows([
            [1.0, 0.0, x, -x * self.plane_z],
            [0.0, 1.0, y, -y * self.plane_z],
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ]);
        Affine::from_raw(rows).unwrap_or(Affine::IDENTITY)
    }

    /// Returns the classical projection, which maps every point to the plane z = z_p. It is
    /// singular.
    #[must_use]
    pub fn onto_plane(self) -> Affine<View, View> {
        let drop = Affine::<View, View>::scale(1.0, 1.0, 0.0);
        let lift = Affine::translation(Vector::new(0.0, 0.0, self.plane_z));
        self.depth_preserving().then(drop).then(lift)
    }
}

/// The plan oblique, or planometric, projection: the ground plan keeps its shape, and heights are
/// drawn vertically.
///
/// With full heights it is the military projection.
///
/// ```
/// use homog::Point;
/// use projection::Planometric;
/// let military = Planometric::military(0.0)?;
/// // x is drawn to the right, −z (away) is drawn up, and the height is added to it.
/// let image = military.onto_plane().transform_point(Point::new(1.0, 2.0, -3.0));
/// assert_eq!(image, Point::new(1.0, 5.0, 0.0));
/// # Ok::<(), projection::ProjectionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Planometric {
    turn: f64,
    rise: Oblique,
}

impl Planometric {
    /// Creates the projection with the plan rotated by `turn` radians counterclockwise and heights
    /// scaled by `height`.
    ///
    /// # Errors
    /// Returns an error if a number is not finite or the height is negative.
    pub fn new(turn: f64, height: f64) -> Result<Self, ProjectionError> {
        check_finite("turn", turn)?;
        if check_finite("height", height)? < 0.0 {
            let allowed = "0 or greater";
            return Err(ProjectionError::OutOfRange {
                parameter: "height",
                value: height,
                allowed,
            });
        }
        Ok(Self { turn, rise: Oblique::new_checked(0.0, height, 0.0)? })
    }

    /// Creates the military projection, with full heights and the plan rotated by `turn`, usually
    /// 45° or 30°.
    ///
    /// # Errors
    /// Returns an error if the angle is not finite.
    pub fn military(turn: f64) -> Result<Self, ProjectionError> {
        Self::new(turn, 1.0)
    }

    /// Returns the angle by which the plan is rotated, in radians counterclockwise.
    #[must_use]
    pub const fn turn(self) -> f64 {
        self.turn
    }

    /// Returns the scale factor of heights.
    #[must_use]
    pub const fn height(self) -> f64 {
        self.rise.slant_y
    }

    /// Returns the map that rotates the plan, views it from above, and shears it to draw heights
    /// vertically. Its z is the height.
    #[must_use]
    pub fn depth_preserving(self) -> Affine<View, View> {
        let from_above = crate::PrincipalView::Top.depth_preserving();
        Affine::<View, View>::rotation_y(self.turn)
            .then(from_above)
            .then(self.rise.depth_preserving())
    }

    /// Returns the inverse of [`depth_preserving`](Self::depth_preserving).
    #[must_use]
    pub fn depth_preserving_inverse(self) -> Affine<View, View> {
        // The view from below rotates in the opposite direction about x.
        let from_front = crate::PrincipalView::Bottom.depth_preserving();
        self.rise.depth_preserving_inverse().then(from_front).then(Affine::rotation_y(-self.turn))
    }

    /// Returns the classical projection onto the picture, z = 0. It is singular.
    #[must_use]
    pub fn onto_plane(self) -> Affine<View, View> {
        self.depth_preserving().then(Affine::scale(1.0, 1.0, 0.0))
    }
}
