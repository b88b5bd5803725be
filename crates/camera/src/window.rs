//! The window: the rectangle in front of the eye through which the world is seen.
//!
//! ```text
//!             eye ●
//!                ╱ ╲             a plane perpendicular to the gaze, at `distance` from the eye;
//!  left ────────┼───┼──── right  x to the right and y up from where the gaze meets it
//! ```
//!
//! The window consists of plain numbers, because a camera has no projection. Pass them to a frustum
//! or an orthographic box whose near distance is `distance`.

use crate::{CameraError, Slopes};

/// The largest number in a window for which rays through pixels far outside it are finite.
const WINDOW_LIMIT: f64 = 1e290;

/// A rectangle on the plane at `distance` in front of an eye, in view space.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ViewWindow {
    /// The left side: x in view space.
    pub left: f64,
    /// The right side. Less than `left` in a mirrored picture.
    pub right: f64,
    /// The lower side: y in view space.
    pub bottom: f64,
    /// The upper side. Less than `bottom` if the picture is upside down.
    pub top: f64,
    /// The distance of the plane in front of the eye: −z in view space.
    pub distance: f64,
}

impl ViewWindow {
    /// Returns the window on the plane at another distance that subtends the same angles.
    ///
    /// # Errors
    /// Returns an error if the old or new distance is not positive and finite, or if the old or new
    /// window is empty or not finite.
    ///
    /// ```
    /// use camera::ViewWindow;
    /// let window = ViewWindow { left: -1.0, right: 3.0, bottom: -1.0, top: 1.0, distance: 2.0 };
    /// assert_eq!(window.at_distance(1.0)?.right, 1.5);
    /// # Ok::<(), camera::CameraError>(())
    /// ```
    pub fn at_distance(self, distance: f64) -> Result<Self, CameraError> {
        self.check_perspective()?;
        let by = distance / self.distance;
        let Self { left, right, bottom, top, .. } = self;
        let moved = Self {
            left: left * by,
            right: right * by,
            bottom: bottom * by,
            top: top * by,
            distance,
        };
        moved.check_perspective().map(|()| moved)
    }

    /// Returns the slopes of the four sides: the window on the plane at distance 1.
    ///
    /// # Errors
    /// See [`at_distance`](Self::at_distance).
    pub fn slopes(self) -> Result<Slopes, CameraError> {
        let Self { left, right, bottom, top, .. } = self.at_distance(1.0)?;
        Ok(Slopes { left, right, bottom, top })
    }

    /// Rejects numbers that are not finite or too large, and sides that coincide.
    pub(crate) fn check_edges(self) -> Result<(), CameraError> {
        let Self { left, right, bottom, top, distance } = self;
        for (name, value) in [
            ("left side of the window", left),
            ("right side of the window", right),
            ("lower side of the window", bottom),
            ("upper side of the window", top),
            ("distance of the window", distance),
        ] {
            check_finite(name, value)?;
            if value.abs() > WINDOW_LIMIT {
                return Err(CameraError::TooLarge { name, value, limit: WINDOW_LIMIT });
            }
        }
        if left == right || bottom == top {
            return Err(CameraError::EmptyWindow { left, right, bottom, top });
        }
        Ok(())
    }

    /// Like [`check_edges`](Self::check_edges), but also rejects windows that are not in front of
    /// the eye.
    pub(crate) fn check_perspective(self) -> Result<(), CameraError> {
        self.check_edges()?;
        check_positive("distance of the window", self.distance)
    }
}

impl Slopes {
    /// Returns the window of this frame on the plane at `distance`.
    ///
    /// # Errors
    /// Returns an error if the distance is not positive and finite, or if slopes are not finite or
    /// coincide.
    pub fn at_distance(self, distance: f64) -> Result<ViewWindow, CameraError> {
        let Self { left, right, bottom, top } = self;
        ViewWindow { left, right, bottom, top, distance: 1.0 }.at_distance(distance)
    }
}

pub(crate) fn check_finite(name: &'static str, value: f64) -> Result<(), CameraError> {
    if value.is_finite() { Ok(()) } else { Err(CameraError::NumberNotFinite { name, value }) }
}

pub(crate) fn check_positive(name: &'static str, value: f64) -> Result<(), CameraError> {
    check_finite(name, value)?;
    if value > 0.0 { Ok(()) } else { Err(CameraError::NotPositive { name, value }) }
}
