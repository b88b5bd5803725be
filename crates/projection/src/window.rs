//! The window: the rectangle of the view plane that becomes the picture.

use crate::ProjectionError;
use crate::error::check_finite;
use crate::matrix::WindowFit;

/// A rectangle [left, right] × [bottom, top], in units of view space or, for slopes, without units
/// (C85).
///
/// # Guarantees
/// All edges are finite, opposite edges differ, and the width and height are finite. Mirrored
/// windows, with left > right or bottom > top, are allowed and give a mirrored picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Window {
    left: f64,
    right: f64,
    bottom: f64,
    top: f64,
}

impl Window {
    /// Creates a window from its edges.
    ///
    /// # Errors
    /// Returns an error if an edge is not finite, or if opposite edges coincide or are too far
    /// apart.
    pub fn new(left: f64, right: f64, bottom: f64, top: f64) -> Result<Self, ProjectionError> {
        check_finite("left", left)?;
        check_finite("right", right)?;
        check_finite("bottom", bottom)?;
        check_finite("top", top)?;
        if left == right {
            return Err(ProjectionError::EmptyWindow { low: "left", high: "right", value: left });
        }
        if bottom == top {
            return Err(ProjectionError::EmptyWindow { low: "bottom", high: "top", value: bottom });
        }
        Self { left, right, bottom, top }.check_edges()
    }

    /// Rejects edges that are too far apart, or so close that rounding made them equal.
    pub(crate) fn check_edges(self) -> Result<Self, ProjectionError> {
        let usable = [self.width(), self.height()].iter().all(|d| d.is_finite() && *d != 0.0);
        usable.then_some(self).ok_or(ProjectionError::Unrepresentable { what: "window" })
    }

    /// Creates a window with the given size, centered on the line of sight.
    ///
    /// # Errors
    /// Returns an error if a size is 0 or not finite.
    pub fn centered(width: f64, height: f64) -> Result<Self, ProjectionError> {
        let (x, y) = (0.5 * width, 0.5 * height);
        Self::new(-x, x, -y, y)
    }

    /// Creates a window whose opposite edges are known to differ.
    pub(crate) const fn symmetric(half_width: f64, half_height: f64) -> Self {
        Self { left: -half_width, right: half_width, bottom: -half_height, top: half_height }
    }

    /// Returns the left edge of the picture.
    #[must_use]
    pub const fn left(self) -> f64 {
        self.left
    }

    /// Returns the right edge of the picture.
    #[must_use]
    pub const fn right(self) -> f64 {
        self.right
    }

    /// Returns the bottom edge of the picture.
    #[must_use]
    pub const fn bottom(self) -> f64 {
        self.bottom
    }

    /// Returns the top edge of the picture.
    #[must_use]
    pub const fn top(self) -> f64 {
        self.top
    }

    /// Returns right − left, which is negative if the window is mirrored.
    #[must_use]
    pub fn width(self) -> f64 {
        self.right - self.left
    }

    /// Returns top − bottom, which is negative if the window is mirrored.
    #[must_use]
    pub fn height(self) -> f64 {
        self.top - self.bottom
    }

    /// Returns |width / height|, the aspect at which an image shows the window undistorted (PL-3).
    #[must_use]
    pub fn aspect(self) -> f64 {
        (self.width() / self.height()).abs()
    }

    /// Returns the center of the window, (x, y).
    #[must_use]
    pub fn center(self) -> (f64, f64) {
        (0.5 * self.left + 0.5 * self.right, 0.5 * self.bottom + 0.5 * self.top)
    }

    /// Returns the window with all edges multiplied by `factor`. On a plane `factor` times as far
    /// away, the same rays pass through it.
    #[must_use]
    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self {
            left: self.left * factor,
            right: self.right * factor,
            bottom: self.bottom * factor,
            top: self.top * factor,
        }
    }

    /// Returns the map of x and y for a view plane at `distance` (1 for parallel projections).
    pub(crate) fn window_fit(self, distance: f64) -> Result<WindowFit, ProjectionError> {
        self.window_fit_unchecked(distance).check_fit()
    }

    pub(crate) fn window_fit_unchecked(self, distance: f64) -> WindowFit {
        WindowFit {
            scale_x: 2.0 * distance / self.width(),
            scale_y: 2.0 * distance / self.height(),
            center_x: (self.right + self.left) / self.width(),
            center_y: (self.top + self.bottom) / self.height(),
        }
    }
}
