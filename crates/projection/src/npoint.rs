//! One-, two- and three-point perspective, defined by the bottom row (p, q, r, 1) (ONE-1, TWO-1,
//! THREE-1; C82, C83).
//!
//! ```text
//! [ 1 0 0 0 ]     each nonzero p, q or r gives its axis a vanishing point:
//! [ 0 1 0 0 ]     x at (1/p, 0, 0), y at (0, 1/q, 0), z at (0, 0, 1/r)
//! [ 0 0 1 0 ]
//! [ p q r 1 ]     the picture is z = 0 after the divide
//! ```
//!
//! Points in the plane px + qy + rz = 0 do not move. The eye is at (0, 0, −1/r) or, for r = 0,
//! infinitely far away along z.
//!
//! One-point perspective from an eye (0, 0, d) has p = q = 0 and r = −1/d. The magnification d/(d −
//! z) of a point is below 1 behind the plane (z < 0), above 1 between the plane and the eye, and
//! negative behind the eye (M20).

use crate::ProjectionError;
use crate::error::check_finite;
use crate::matrix::{from_rows, is_bounded, is_invertible};
use homog::{HPoint, Projective, View};

/// A perspective projection defined by p, q and r.
///
/// # Guarantees
/// p, q and r are finite and not all 0.
///
/// ```
/// use homog::Point;
/// use projection::NPoint;
/// let eye_at_5 = NPoint::from_eye(5.0)?;
/// let image = eye_at_5.onto_plane().transform_point(Point::new(1.0, 2.0, 2.5)).divide();
/// assert_eq!(image, Some(Point::new(2.0, 4.0, 0.0)));
/// # Ok::<(), projection::ProjectionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NPoint {
    p: f64,
    q: f64,
    r: f64,
}

impl NPoint {
    /// Creates the perspective projection with the bottom row (p, q, r, 1).
    ///
    /// # Errors
    /// Returns an error if a number is not finite, or all are 0.
    pub fn new(p: f64, q: f64, r: f64) -> Result<Self, ProjectionError> {
        for (parameter, value) in [("p", p), ("q", q), ("r", r)] {
            check_finite(parameter, value)?;
            if value != 0.0 && !is_invertible(value) {
                return Err(ProjectionError::Unrepresentable { what: "vanishing point" });
            }
        }
        if p == 0.0 && q == 0.0 && r == 0.0 {
            return Err(ProjectionError::NoVanishingPoint);
        }
        Ok(Self { p, q, r })
    }

    /// Returns the one-point perspective onto z = 0 from the eye (0, 0, d) (ONE-1).
    ///
    /// # Errors
    /// Returns an error if d is 0 or not finite.
    pub fn from_eye(d: f64) -> Result<Self, ProjectionError> {
        if check_finite("d", d)? == 0.0 {
            return Err(ProjectionError::CenterOnPlane);
        }
        Self::new(0.0, 0.0, -1.0 / d)
    }

    /// Returns the perspective in which the axes vanish at (x, 0, 0), (0, y, 0) and (0, 0, z);
    /// `None` keeps the lines of an axis parallel.
    ///
    /// # Errors
    /// Returns an error if a coordinate is 0 or not finite, or all are `None`.
    pub fn by_vanishing_points(
        x: Option<f64>,
        y: Option<f64>,
        z: Option<f64>,
    ) -> Result<Self, ProjectionError> {
        let reciprocal = |parameter, at: Option<f64>| match at {
            None => Ok(0.0),
            Some(0.0) => {
                let allowed = "nonzero";
                Err(ProjectionError::OutOfRange { parameter, value: 0.0, allowed })
            }
            Some(value) => Ok(1.0 / check_finite(parameter, value)?),
        };
        let x = reciprocal("vanishing point of x", x)?;
        let y = reciprocal("vanishing point of y", y)?;
        Self::new(x, y, reciprocal("vanishing point of z", z)?)
    }

    /// Returns (p, q, r).
    #[must_use]
    pub const fn bottom_row(self) -> [f64; 3] {
        [self.p, self.q, self.r]
    }

    /// Returns the number of nonzero values among p, q and r: the number of principal vanishing
    /// points.
    #[must_use]
    pub fn count(self) -> usize {
        self.bottom_row().iter().filter(|&&entry| entry != 0.0).count()
    }

    /// Returns whether this is a true central projection onto z = 0: p = q = 0, so points of that
    /// plane do not move.
    #[must_use]
    pub fn preserves_picture_plane(self) -> bool {
        self.p == 0.0 && self.q == 0.0
    }

    /// Returns the eye: (0, 0, −1/r) or, for r = 0, the direction of z.
    #[must_use]
    pub fn eye(self) -> HPoint<View> {
        if self.r == 0.0 {
            return HPoint::new(0.0, 0.0, 1.0, 0.0);
        }
        HPoint::new(0.0, 0.0, -1.0 / self.r, 1.0)
    }

    fn matrix(self, z: f64, sign: f64) -> Projective<View, View> {
        Projective::from_raw(from_rows([
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, z, 0.0],
            [sign * self.p, sign * self.q, sign * self.r, 1.0],
        ]))
    }

    /// Returns the map that preserves z before the divide. It is invertible.
    #[must_use]
    pub fn depth_preserving(self) -> Projective<View, View> {
        self.matrix(1.0, 1.0)
    }

    /// Returns the inverse of [`depth_preserving`](Self::depth_preserving): its bottom row has p, q
    /// and r negated.
    #[must_use]
    pub fn depth_preserving_inverse(self) -> Projective<View, View> {
        self.matrix(1.0, -1.0)
    }

    /// Returns the classical projection, which drops z. It is singular.
    #[must_use]
    pub fn onto_plane(self) -> Projective<View, View> {
        self.matrix(0.0, 1.0)
    }

    /// Returns the image of a point on the line x = y = 0 after the divide, or `None` in the plane
    /// of the eye and behind it.
    pub(crate) fn depth_on_axis(self, z: f64) -> Option<f64> {
        let h = self.r * z + 1.0;
        (h > 0.0 && is_bounded(z / h)).then_some(z / h)
    }
}
