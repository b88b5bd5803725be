//! The map from a window to a viewport in the plane, by both textbook methods (WV-1, WV-2).
//!
//! ```text
//!   window                         viewport
//!   ┌───────────────┐ yw max       ┌──────────┐ yv max
//!   │        ● p    │       ──►    │     ● q  │         q divides the viewport's sides
//!   └───────────────┘ yw min       └──────────┘ yv min  as p divides the window's sides
//! xw min         xw max         xv min     xv max
//! ```

use crate::ViewportError;
use crate::error::check_interval;
use glam::{DMat3, DVec2};
use homog::Homography;

/// A rectangle, defined by its limits [min, max] on each axis. If max < min, the rectangle is
/// mirrored, which is allowed and mirrors the picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Limits {
    /// The limits on the x axis.
    pub x: [f64; 2],
    /// The limits on the y axis.
    pub y: [f64; 2],
}

/// The map from a window to a viewport.
///
/// ```
/// use viewport::{Limits, WindowToViewport};
/// let map = WindowToViewport::new(
///     Limits { x: [-1.0, 3.0], y: [2.0, 4.0] },
///     Limits { x: [0.0, 8.0], y: [0.0, 4.0] },
/// )?;
/// assert_eq!(map.map_by_ratio([1.0, 3.0]), [4.0, 2.0]);
/// assert_eq!(map.map_by_chain([1.0, 3.0]), [4.0, 2.0]);
/// assert!(map.is_undistorted());
/// # Ok::<(), viewport::ViewportError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct WindowToViewport {
    window: Limits,
    viewport: Limits,
}

impl WindowToViewport {
    /// Creates the map that takes the sides of `window` to the sides of `viewport`.
    ///
    /// # Errors
    /// Returns an error if a limit is not finite, if a width or height of the window or viewport is
    /// 0, or if their sizes differ too much for finite factors.
    pub fn new(window: Limits, viewport: Limits) -> Result<Self, ViewportError> {
        check_interval("window's x", window.x)?;
        check_interval("window's y", window.y)?;
        check_interval("viewport's x", viewport.x)?;
        check_interval("viewport's y", viewport.y)?;
        let map = Self { window, viewport };
        for map in [map, map.inverse()] {
            if map.scale_factors().contains(&0.0) || !map.homography().raw().is_finite() {
                return Err(ViewportError::OutOfRange { name: "window-viewport factor" });
            }
        }
        Ok(map)
    }

    /// Returns the scale factors (sx, sy).
    #[must_use]
    pub fn scale_factors(&self) -> [f64; 2] {
        let factor = |window: [f64; 2], viewport: [f64; 2]| {
            (viewport[1] - viewport[0]) / (window[1] - window[0])
        };
        [factor(self.window.x, self.viewport.x), factor(self.window.y, self.viewport.y)]
    }

    /// Returns whether a circle stays a circle: |sx| = |sy|, to about 14 digits.
    #[must_use]
    pub fn is_undistorted(&self) -> bool {
        let [sx, sy] = self.scale_factors().map(f64::abs);
        (sx - sy).abs() <= 1e-14 * sx.max(sy)
    }

    /// Returns the image of a point by equal ratios (WV-1): (xv − xv min)/(xv max − xv min) = (xw −
    /// xw min)/(xw max − xw min). Points outside the window map to points outside the viewport by
    /// the same ratio.
    #[must_use]
    pub fn map_by_ratio(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let image = |x: f64, window: [f64; 2], viewport: [f64; 2]| {
            let ratio = (x - window[0]) / (window[1] - window[0]);
            viewport[0] + ratio * (viewport[1] - viewport[0])
        };
        [image(x, self.window.x, self.viewport.x), image(y, self.window.y, self.viewport.y)]
    }

    /// Returns the image of a point by the matrix of the chain (WV-2). Up to rounding, the result
    /// is the same as from [`map_by_ratio`](Self::map_by_ratio).
    #[must_use]
    pub fn map_by_chain(&self, point: [f64; 2]) -> [f64; 2] {
        self.homography().raw().transform_point2(point.into()).into()
    }

    /// Returns the three factors of the chain, in the order in which a point passes through them.
    /// T(−xw min, −yw min) moves the window's corner to the origin, S(sx, sy) scales, and T(xv min,
    /// yv min) moves that corner to the viewport's.
    ///
    /// Both signs in the first factor are negative; one source prints T(−xw min, +yw min) (misprint
    /// M18).
    #[must_use]
    pub fn factor_chain(&self) -> [Homography; 3] {
        let low = |limits: Limits| DVec2::new(limits.x[0], limits.y[0]);
        [
            DMat3::from_translation(-low(self.window)),
            DMat3::from_scale(self.scale_factors().into()),
            DMat3::from_translation(low(self.viewport)),
        ]
        .map(Homography::from_raw)
    }

    /// Returns the product of the chain, for column vectors (x, y, 1).
    #[must_use]
    pub fn homography(&self) -> Homography {
        let [to_origin, scale, to_place] = self.factor_chain();
        to_origin.then(scale).then(to_place)
    }

    /// Returns the inverse map.
    #[must_use]
    pub fn inverse(&self) -> Self {
        Self { window: self.viewport, viewport: self.window }
    }
}
