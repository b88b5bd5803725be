//! Stereo: two eyes side by side, and the window each of them must have.
//!
//! ```text
//!  ●━━━━━━━━━━━━━━━━━━━●    the plane of zero parallax: the same rectangle for both eyes
//!   ╲ ╲             ╱ ╱
//!    ╲   ╲       ╱   ╱      what is nearer stands out of the picture,
//!     ╲     ╲ ╱     ╱       what is farther lies behind it
//!      ╲   ╱   ╲   ╱
//!       ╲╱       ╲╱
//!    left eye  right eye    interocular distance apart along u
//! ```
//!
//! Both eyes look the same way; turning them inwards (toe-in) would shift things vertically. Their
//! windows are off the axis instead: for an eye that is e to the right of the middle, each side is
//! at l − e · distance/zero_parallax on the plane at that distance.
//!
//! [`apex_moved_view`] is what one lesson's `createFrustum` does with an off-axis window instead
//! (LW-1, misprint M12): it moves the eye to the window's middle and keeps the frustum symmetric.
//! The two agree on the window's plane and nowhere else, and a stereo pair made so has no plane of
//! zero parallax where it was asked for. It is here to be compared.

use crate::window::{check_finite, check_positive};
use crate::{Camera, CameraError, ViewWindow};

/// How far apart the eyes are and where they meet.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct StereoRig {
    /// Between the two eyes, in units of the world, greater than 0. People have about 0.064 m.
    pub interocular: f64,
    /// Distance along the gaze of the plane whose points both eyes see at the same place of the
    /// picture, greater than 0.
    pub zero_parallax: f64,
}

/// A camera and its window.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CameraView {
    /// The camera.
    pub camera: Camera,
    /// Its window.
    pub window: ViewWindow,
}

/// The views of the left and the right eye.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct StereoPair {
    /// The left eye.
    pub left: CameraView,
    /// The right eye.
    pub right: CameraView,
}

impl StereoRig {
    /// The true off-axis pair around a middle camera with the given window: same gaze, eyes apart
    /// along u, windows shifted so that both see the same rectangle in the plane of zero parallax.
    ///
    /// # Errors
    /// Distances of the rig that are not positive and finite; a window that is empty, not finite or
    /// not in front of the eye; eyes too far out.
    ///
    /// ```
    /// use camera::{Basis, Camera, StereoRig, ViewWindow};
    /// use homog::Point;
    /// let middle = Camera::new(Point::ORIGIN, Basis::WORLD)?;
    /// let window = ViewWindow { left: -1.0, right: 1.0, bottom: -1.0, top: 1.0, distance: 2.0 };
    /// let rig = StereoRig { interocular: 0.5, zero_parallax: 4.0 };
    /// let pair = rig.off_axis_pair(middle, window)?;
    /// assert_eq!(pair.left.camera.eye(), Point::new(-0.25, 0.0, 0.0));
    /// assert_eq!((pair.left.window.left, pair.left.window.right), (-0.875, 1.125));
    /// # Ok::<(), camera::CameraError>(())
    /// ```
    pub fn off_axis_pair(
        self,
        middle: Camera,
        window: ViewWindow,
    ) -> Result<StereoPair, CameraError> {
        check_positive("interocular distance", self.interocular)?;
        check_positive("distance of zero parallax", self.zero_parallax)?;
        window.check_perspective()?;
        Ok(StereoPair {
            left: self.eye_view(middle, window, -self.interocular / 2.0)?,
            right: self.eye_view(middle, window, self.interocular / 2.0)?,
        })
    }

    /// The pair of [`off_axis_pair`](Self::off_axis_pair) with each frustum's apex moved to the
    /// middle of its window (LW-1).
    ///
    /// For comparison only: the eyes then are closer together than asked for, and their pictures
    /// meet elsewhere.
    ///
    /// # Errors
    /// As [`off_axis_pair`](Self::off_axis_pair).
    pub fn pair_apex_moved(
        self,
        middle: Camera,
        window: ViewWindow,
    ) -> Result<StereoPair, CameraError> {
        let StereoPair { left, right } = self.off_axis_pair(middle, window)?;
        let moved = |eye: CameraView| apex_moved_view(eye.camera, eye.window);
        Ok(StereoPair { left: moved(left)?, right: moved(right)? })
    }

    /// How far the right eye's image of a point at `distance` lies to the right of the left eye's,
    /// measured on the plane of zero parallax: negative in front of it, the interocular distance at
    /// infinity.
    ///
    /// # Errors
    /// Any distance that is not positive and finite.
    pub fn parallax(self, distance: f64) -> Result<f64, CameraError> {
        check_positive("interocular distance", self.interocular)?;
        check_positive("distance of zero parallax", self.zero_parallax)?;
        check_positive("distance of the point", distance)?;
        let parallax = self.interocular * (1.0 - self.zero_parallax / distance);
        check_finite("parallax", parallax)?;
        Ok(parallax)
    }

    fn eye_view(
        self,
        middle: Camera,
        window: ViewWindow,
        offset: f64,
    ) -> Result<CameraView, CameraError> {
        let shift = offset * (window.distance / self.zero_parallax);
        let window =
            ViewWindow { left: window.left - shift, right: window.right - shift, ..window };
        window.check_perspective()?;
        Ok(CameraView { camera: middle.moved(middle.u() * offset)?, window })
    }
}

/// The camera and window that LW-1 makes of an off-axis window: the eye moves, parallel to the
/// window, to opposite its middle, and the window becomes symmetric. The same picture on the
/// window's plane, another everywhere else.
///
/// # Errors
/// A window that is empty, not finite or not in front of the eye; an eye too far out.
pub fn apex_moved_view(camera: Camera, window: ViewWindow) -> Result<CameraView, CameraError> {
    window.check_perspective()?;
    let ViewWindow { left, right, bottom, top, distance } = window;
    let (half_width, half_height) = ((right - left) / 2.0, (top - bottom) / 2.0);
    let (x, y) = (left / 2.0 + right / 2.0, bottom / 2.0 + top / 2.0);
    let camera = camera.moved(camera.u() * x + camera.v() * y)?;
    let (left, right, bottom, top) = (-half_width, half_width, -half_height, half_height);
    Ok(CameraView { camera, window: ViewWindow { left, right, bottom, top, distance } })
}
