//! Changes to the window: lens shift, tiles, jitter, and the four angles of one eye of a headset.
//!
//! They change only the window, so they work the same way for perspective and parallel projections.
//! Depth stays the same, as do lines and vanishing points on the picture plane.
//!
//! ```
//! use projection::{Convention, Fov, Perspective, ViewOffset};
//! // The right half of a 200 × 100 picture.
//! let whole = Perspective::new(Fov::vertical_degrees(40.0), 2.0, 0.1, 50.0)?;
//! let right = ViewOffset { full: (200.0, 100.0), corner: (100.0, 0.0), size: (100.0, 100.0) };
//! let half = whole.view_offset(right)?;
//! assert_eq!(half.window().left(), 0.0);
//! assert_eq!(half.window().right(), whole.to_frustum().window().right());
//! # Ok::<(), projection::ProjectionError>(())
//! ```

use crate::error::{check_finite, check_positive};
use crate::{Frustum, Orthographic, Perspective, ProjectionError, Window};
use core::f64::consts::FRAC_PI_2;

/// A tile of a larger picture, like the view offset of three.js: a rectangle in pixels from
/// the top left corner, with y down. It may extend beyond the picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ViewOffset {
    /// The width and height of the whole picture.
    pub full: (f64, f64),
    /// The tile's top left corner.
    pub corner: (f64, f64),
    /// The width and height of the tile.
    pub size: (f64, f64),
}

/// A sample position relative to the pixel center, in pixels, with x to the right and y down, for
/// accumulated antialiasing.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Jitter {
    /// The width and height of the picture in pixels.
    pub image: (f64, f64),
    /// The offset of the sample from the pixel center, usually within ±½.
    pub offset: (f64, f64),
}

/// The angles from the line of sight to the four edges, in radians, positive to the right and up
/// (as in OpenXR).
///
/// A centered lens of 90° has left = down = −π/4 and right = up = π/4.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct FourAngles {
    /// The angle to the left edge, negative if the edge is left of the line of sight.
    pub left: f64,
    /// The angle to the right edge.
    pub right: f64,
    /// The angle to the bottom edge, negative if the edge is below the line of sight.
    pub down: f64,
    /// The angle to the top edge.
    pub up: f64,
}

impl FourAngles {
    /// Returns the frustum between the four edges.
    ///
    /// # Errors
    /// Returns an error if an angle is not between −π/2 and π/2, opposite angles are equal, or 0 <
    /// near < far does not hold.
    pub fn frustum(self, near: f64, far: f64) -> Result<Frustum, ProjectionError> {
        let left = angle_slope("left angle", self.left)?;
        let right = angle_slope("right angle", self.right)?;
        let down = angle_slope("down angle", self.down)?;
        let up = angle_slope("up angle", self.up)?;
        Frustum::from_slopes(Window::new(left, right, down, up)?, near, far)
    }
}

fn angle_slope(parameter: &'static str, angle: f64) -> Result<f64, ProjectionError> {
    if check_finite(parameter, angle)?.abs() < FRAC_PI_2 {
        return Ok(libm::tan(angle));
    }
    let allowed = "between −π/2 and π/2 radians, exclusive";
    Err(ProjectionError::OutOfRange { parameter, value: angle, allowed })
}

impl Window {
    /// Returns the part of the window that `offset` shows. Neighboring tiles share their edges
    /// exactly.
    ///
    /// # Errors
    /// Returns an error if a size is not positive or a number is not finite.
    pub fn view_offset(self, offset: ViewOffset) -> Result<Self, ProjectionError> {
        let width = check_positive("full width", offset.full.0)?;
        let height = check_positive("full height", offset.full.1)?;
        let (x, y) =
            (check_finite("tile x", offset.corner.0)?, check_finite("tile y", offset.corner.1)?);
        let (w, h) = (
            check_positive("tile width", offset.size.0)?,
            check_positive("tile height", offset.size.1)?,
        );
        let across = |fraction: f64| self.left() * (1.0 - fraction) + self.right() * fraction;
        let down = |fraction: f64| self.top() * (1.0 - fraction) + self.bottom() * fraction;
        let (left, right) = (across(x / width), across((x + w) / width));
        Self::new(left, right, down((y + h) / height), down(y / height))
    }

    /// Returns the window shifted by `x` times its width to the right and `y` times its height up:
    /// a lens shift.
    ///
    /// # Errors
    /// Returns an error if a number is not finite.
    pub fn shifted(self, x: f64, y: f64) -> Result<Self, ProjectionError> {
        let dx = check_finite("shift x", x)? * self.width();
        let dy = check_finite("shift y", y)? * self.height();
        Self::new(self.left() + dx, self.right() + dx, self.bottom() + dy, self.top() + dy)
    }

    /// Returns the window shifted so that each pixel is sampled at the given offset.
    ///
    /// # Errors
    /// Returns an error if a size is not positive or a number is not finite.
    pub fn jittered(self, jitter: Jitter) -> Result<Self, ProjectionError> {
        let width = check_positive("image width", jitter.image.0)?;
        let height = check_positive("image height", jitter.image.1)?;
        self.shifted(jitter.offset.0 / width, -jitter.offset.1 / height)
    }
}

macro_rules! window_methods {
    ($projection:ty, $result:ty, $with:expr) => {
        impl $projection {
            /// Returns the projection that shows only the given tile of this projection's picture.
            ///
            /// # Errors
            /// Returns an error if a size is not positive or a number is not finite.
            pub fn view_offset(self, offset: ViewOffset) -> Result<$result, ProjectionError> {
                $with(self, &|window: Window| window.view_offset(offset))
            }

            /// Returns the projection through the window shifted by `x` times its width and `y`
            /// times its height.
            ///
            /// # Errors
            /// Returns an error if a number is not finite.
            pub fn shifted(self, x: f64, y: f64) -> Result<$result, ProjectionError> {
                $with(self, &|window: Window| window.shifted(x, y))
            }

            /// Returns the projection that samples each pixel at the given offset.
            ///
            /// # Errors
            /// Returns an error if a size is not positive or a number is not finite.
            pub fn jittered(self, jitter: Jitter) -> Result<$result, ProjectionError> {
                $with(self, &|window: Window| window.jittered(jitter))
            }
        }
    };
}

type MoveWindow<'a> = &'a dyn Fn(Window) -> Result<Window, ProjectionError>;

fn with_frustum(frustum: Frustum, change: MoveWindow<'_>) -> Result<Frustum, ProjectionError> {
    Frustum::from_window(change(frustum.window())?, frustum.near(), frustum.far())
}

fn with_lens(lens: Perspective, change: MoveWindow<'_>) -> Result<Frustum, ProjectionError> {
    with_frustum(lens.to_frustum(), change)
}

fn with_box(volume: Orthographic, change: MoveWindow<'_>) -> Result<Orthographic, ProjectionError> {
    Orthographic::from_window(change(volume.window())?, volume.near(), volume.far())
}

window_methods!(Frustum, Frustum, with_frustum);
window_methods!(Perspective, Frustum, with_lens);
window_methods!(Orthographic, Orthographic, with_box);
