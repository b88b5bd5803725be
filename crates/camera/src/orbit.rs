//! Cameras that orbit a target, by azimuth, elevation and distance.
//!
//! ```text
//!            +y                          elevation ε: up from the horizon
//!             │    ● eye                 azimuth α: from the front, +z, toward the right, +x
//!             │   ╱
//!             │ ╱ ) ε                    w = (sin α cos ε, sin ε, cos α cos ε)
//!      target ●──────── +x               u = (cos α, 0, −sin α)
//!            ╱  α ╲                      v = (−sin α sin ε, cos ε, −cos α sin ε)
//!          +z                            eye = target + distance · w
//! ```
//!
//! The axes come from the angles, not from a view-up, so the poles need no special treatment. At ε
//! = 90° the camera looks straight down, and the azimuth determines which side is up. A turntable
//! does not jump there.

use crate::window::{check_finite, check_positive};
use crate::{Basis, Camera, CameraError};
use core::f64::consts::TAU;
use homog::{Point, Vector, World};

/// An orbit camera, which looks at a target from a position on a sphere around it.
///
/// ```
/// use camera::Orbit;
/// use homog::Point;
/// let orbit = Orbit { target: Point::ORIGIN, azimuth: 0.0, elevation: 0.0, distance: 5.0 };
/// assert_eq!(orbit.camera()?.eye(), Point::new(0.0, 0.0, 5.0)); // the front view
/// let quarter = orbit.turntable(4).nth(1).expect("four frames");
/// let from_the_right = Point::new(5.0, 0.0, 0.0);
/// assert!((quarter.camera()?.eye() - from_the_right).length() < 1e-15);
/// # Ok::<(), camera::CameraError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Orbit {
    /// The point that the camera looks at.
    pub target: Point<World>,
    /// Radians from the front (+z) toward the right (+x): the viewer moves counterclockwise as seen
    /// from above.
    pub azimuth: f64,
    /// Radians above the horizon. Beyond ±π/2 the picture is upside down.
    pub elevation: f64,
    /// The distance from the target to the eye, greater than 0.
    pub distance: f64,
}

impl Orbit {
    /// Returns the camera at this position.
    ///
    /// # Errors
    /// Returns an error if the distance is not positive or a number is not finite.
    pub fn camera(self) -> Result<Camera, CameraError> {
        check_positive("distance of the orbit", self.distance)?;
        let basis = Basis::from_azimuth_elevation(self.azimuth, self.elevation)?;
        if !self.target.is_finite() {
            let value = self.target - Point::ORIGIN;
            return Err(CameraError::NotFinite { name: "target", value });
        }
        Camera::new(self.target + basis.w() * self.distance, basis)
    }

    /// Returns `frames` positions, evenly spaced around the vertical axis and starting with this
    /// position. The last position is one step before the first.
    pub fn turntable(self, frames: u32) -> impl ExactSizeIterator<Item = Self> + Clone {
        let step = TAU / f64::from(frames.max(1));
        (0..frames).map(move |i| {
            let turn = step * f64::from(i);
            Self { azimuth: self.azimuth + turn, ..self }
        })
    }

    /// Returns the orbit position of `camera` around `target`, or `None` if the camera does not
    /// look at the target, is rolled, or is too far away for a finite distance.
    ///
    /// This is the inverse of [`camera`](Self::camera), with the azimuth in (−π, π] and the
    /// elevation in [−π/2, π/2].
    #[must_use]
    pub fn from_camera(camera: Camera, target: Point<World>) -> Option<Self> {
        let offset = camera.eye() - target;
        let distance = offset.length();
        let direction = offset.normalized()?;
        let looks_at_it = (direction - camera.w()).length() < 1e-9;
        let level = camera.u().y().abs() < 1e-9 && camera.v().y() > -1e-9;
        let azimuth = libm::atan2(-camera.u().z(), camera.u().x());
        let elevation = libm::atan2(camera.w().y(), camera.v().y());
        let found = looks_at_it && level && distance.is_finite();
        found.then_some(Self { target, azimuth, elevation, distance })
    }
}

impl Basis {
    /// Returns the orientation of a camera at the given azimuth and elevation that looks at the
    /// center (see [`Orbit`]).
    ///
    /// # Errors
    /// Returns an error if an angle is not finite.
    pub fn from_azimuth_elevation(azimuth: f64, elevation: f64) -> Result<Self, CameraError> {
        check_finite("azimuth", azimuth)?;
        check_finite("elevation", elevation)?;
        let ((sa, ca), (se, ce)) = (libm::sincos(azimuth), libm::sincos(elevation));
        Ok(Self::from_orthonormal(
            Vector::new(ca, 0.0, -sa),
            Vector::new(-sa * se, ce, -ca * se),
            Vector::new(sa * ce, se, ca * ce),
        ))
    }
}
