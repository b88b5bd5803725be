//! Stereo: two eyes side by side, each with an off-axis window.
//!
//! ```text
//!  ●━━━━━━━━━━━━━━━━━━━●    the plane of zero parallax: the same rectangle for both eyes
//!   ╲ ╲             ╱ ╱
//!    ╲   ╲       ╱   ╱      nearer points appear in front of the picture,
//!     ╲     ╲ ╱     ╱       farther points appear behind it
//!      ╲   ╱   ╲   ╱
//!       ╲╱       ╲╱
//!    left eye  right eye    interocular distance apart along u
//! ```
//!
//! Both eyes look in the same direction; turning them inward (toe-in) would shift points
//! vertically. Instead, their windows are off the axis: for an eye e to the right of the middle, a
//! side at l moves to l − e · distance/zero_parallax on the plane at that distance.
//!
//! [`apex_moved_view`] treats an off-axis window like `createFrustum` in one lesson (LW-1, misprint
//! M12): it moves the eye until it is opposite the center of the window, and keeps the frustum
//! symmetric. The two pictures agree only in the plane of the window, and a stereo pair made this
//! way does not have the requested plane of zero parallax. It is provided for comparison.

use crate::window::{check_finite, check_positive};
use crate::{Camera, CameraError, ViewWindow};

/// The separation of the eyes and the distance at which their views coincide.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct StereoRig {
    /// The distance between the eyes in world units, greater than 0. For people it is about 0.064
    /// m.
    pub interocular: f64,
    /// The distance along the gaze of the plane whose points both eyes see at the same position in
    /// the picture, greater than 0.
    pub zero_parallax: f64,
}

/// A camera and its window.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CameraView {
    /// The camera.
    pub camera: Camera,
    /// The window of the camera.
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
    /// Returns the correct off-axis pair around a middle camera and its window. Both eyes have the
    /// same gaze and are separated along u, and their windows are shifted to show both eyes the
    /// same rectangle in the plane of zero parallax.
    ///
    /// # Errors
    /// Returns an error if a distance of the rig is not positive and finite, or if an eye is too
    /// far away. The window must be finite, not empty, and in front of the eye.
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

    /// Returns the pair from [`off_axis_pair`](Self::off_axis_pair), with the apex of each frustum
    /// moved opposite the center of its window (LW-1).
    ///
    /// This is for comparison only: the eyes are closer together than requested, and their pictures
    /// coincide at a different distance.
    ///
    /// # Errors
    /// See [`off_axis_pair`](Self::off_axis_pair).
    pub fn pair_apex_moved(
        self,
        middle: Camera,
        window: ViewWindow,
    ) -> Result<StereoPair, CameraError> {
        let StereoPair { left, right } = self.off_axis_pair(middle, window)?;
        let moved = |eye: CameraView| apex_moved_view(eye.camera, eye.window);
        Ok(StereoPair { left: moved(left)?, right: moved(right)? })
    }

    /// Returns the parallax of a point at `distance`: how far the right eye's image is to the right
    /// of the left eye's image. The offset is measured on the plane of zero parallax. It is
    /// negative in front of that plane and equals the interocular distance at infinity.
    ///
    /// # Errors
    /// Returns an error if a distance is not positive and finite.
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

/// Returns the camera and window that LW-1 makes from an off-axis window: the eye moves parallel to
/// the window until it is opposite the center, and the window becomes symmetric. The picture is
/// unchanged only in the plane of the window.
///
/// # Errors
/// Returns an error if the window is empty, not finite or not in front of the eye, or if the eye is
/// too far away.
pub fn apex_moved_view(camera: Camera, window: ViewWindow) -> Result<CameraView, CameraError> {
    window.check_perspective()?;
    let ViewWindow { left, right, bottom, top, distance } = window;
    let (half_width, half_height) = ((right - left) / 2.0, (top - bottom) / 2.0);
    let (x, y) = (left / 2.0 + right / 2.0, bottom / 2.0 + top / 2.0);
    let camera = camera.moved(camera.u() * x + camera.v() * y)?;
    let (left, right, bottom, top) = (-half_width, half_width, -half_height, half_height);
    Ok(CameraView { camera, window: ViewWindow { left, right, bottom, top, distance } })
}
