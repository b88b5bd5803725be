//! Orientation by yaw, pitch and roll, as for an aircraft.
//!
//! ```text
//! [ u v w ] = R_y(yaw) · R_x(pitch) · R_z(roll)
//!
//! yaw    about the world's +y: positive turns the gaze to the left
//! pitch  about the camera's own right axis: positive raises the gaze
//! roll   about the camera's own w: positive tips the camera to the left, and the picture
//!        turns clockwise
//! ```
//!
//! All three are 0 for a camera that looks along −z with y up. Positive angles follow the
//! right-hand rule.

use crate::window::check_finite;
use crate::{Basis, CameraError};
use homog::{Vector, World};

/// Yaw, pitch and roll in radians.
///
/// ```
/// use camera::Orientation;
/// use homog::Vector;
/// let left = Orientation { yaw: 90_f64.to_radians(), pitch: 0.0, roll: 0.0 };
/// assert!((left.basis()?.gaze() + Vector::X).length() < 1e-15); // from −z to −x
/// # Ok::<(), camera::CameraError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Orientation {
    /// The rotation about +y; a positive angle turns the gaze to the left.
    pub yaw: f64,
    /// The rotation about the right axis; a positive angle raises the gaze.
    pub pitch: f64,
    /// The rotation about the axis out of the picture; a positive angle tips the camera
    /// counterclockwise, as seen from behind it.
    pub roll: f64,
}

impl Orientation {
    /// Returns the basis with these angles.
    ///
    /// # Errors
    /// Returns an error if an angle is not finite.
    pub fn basis(self) -> Result<Basis, CameraError> {
        check_finite("pitch", self.pitch)?;
        // Seen from its target, a camera that looks along −w is in the direction of w.
        Basis::from_azimuth_elevation(self.yaw, -self.pitch)?.rolled(self.roll)
    }

    /// Returns the angles of an orientation: yaw and roll in (−π, π], pitch in [−π/2, π/2].
    ///
    /// When looking straight up or down, only the sum or difference of yaw and roll is determined,
    /// and roll is set to 0.
    #[must_use]
    pub fn from_basis(basis: Basis) -> Self {
        let (u, v, w) = (basis.u(), basis.v(), basis.w());
        let level = libm::hypot(w.x(), w.z());
        let pitch = libm::atan2(-w.y(), level);
        if level < 1e-12 {
            let yaw = libm::atan2(-u.z(), u.x());
            return Self { yaw, pitch, roll: 0.0 };
        }
        let yaw = libm::atan2(w.x(), w.z());
        let roll = libm::atan2(u.y(), v.y());
        Self { yaw, pitch, roll }
    }
}

impl Basis {
    /// Returns this orientation rotated about its own w by `angle` radians. A positive angle tips
    /// the camera counterclockwise as seen from behind it, so the picture turns clockwise.
    ///
    /// # Errors
    /// Returns an error if the angle is not finite.
    pub fn rolled(self, angle: f64) -> Result<Self, CameraError> {
        check_finite("roll", angle)?;
        let (s, c) = libm::sincos(angle);
        let (u, v): (Vector<World>, Vector<World>) = (self.u(), self.v());
        Ok(Self::from_orthonormal(u * c + v * s, v * c - u * s, self.w()))
    }
}
