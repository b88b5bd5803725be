//! Depth range: the map from z in the canonical volume to the value in a depth buffer (DP-1).

use crate::ViewportError;
use crate::error::{check_finite, check_interval};

/// A linear map of depth, defined by the images of two depths.
///
/// | map | depth | near, far map to |
/// | --- | --- | --- |
/// | [`DepthRange::KEEP`] | z | themselves (VP-1) |
/// | [`DepthRange::ZERO_ONE`] | (1 + z)/2 | 1, 0 in the textbook's volume; 0, 1 in OpenGL's |
/// | [`DepthRange::ZERO_ONE_FLIPPED`] | (1 − z)/2 | 0, 1 in the textbook's; 1, 0 in OpenGL's |
///
/// The last two are easily confused (misprint M22). Which of them is correct depends on the near
/// plane of the volume. The textbook is Shirley and Marschner, ch. 8.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct DepthRange {
    scale: f64,
    offset: f64,
}

impl DepthRange {
    /// z unchanged.
    pub const KEEP: Self = Self { scale: 1.0, offset: 0.0 };
    /// (1 + z)/2: [−1, 1] to [0, 1].
    pub const ZERO_ONE: Self = Self { scale: 0.5, offset: 0.5 };
    /// (1 − z)/2: [−1, 1] to [1, 0].
    pub const ZERO_ONE_FLIPPED: Self = Self { scale: -0.5, offset: 0.5 };
    /// −z, the matrix diag(1, 1, −1, 1): from the textbook's volume to OpenGL's and back.
    pub const NEGATED: Self = Self { scale: -1.0, offset: 0.0 };

    /// Creates the map from the two depths in `ndc` to the two depths in `screen`, in this order
    /// (LI-1).
    ///
    /// `glDepthRange(n, f)` is `DepthRange::new([-1.0, 1.0], [n, f])`; Direct3D's `MinDepth` and
    /// `MaxDepth` are `DepthRange::new([0.0, 1.0], [min, max])`.
    ///
    /// # Errors
    /// Returns an error if a number is not finite or if the two depths of a pair are equal.
    pub fn new(ndc: [f64; 2], screen: [f64; 2]) -> Result<Self, ViewportError> {
        let ([a, b], [c, d]) =
            (check_interval("ndc depth", ndc)?, check_interval("screen depth", screen)?);
        let scale = check_finite("depth scale", (d - c) / (b - a))?;
        let offset = check_finite("depth offset", (c * b - d * a) / (b - a))?;
        if !(1.0 / scale).is_finite() || !(offset / scale).is_finite() {
            return Err(ViewportError::OutOfRange { name: "depth scale" });
        }
        Ok(Self { scale, offset })
    }

    /// Returns the factor of z, which is never 0.
    #[must_use]
    pub const fn scale(self) -> f64 {
        self.scale
    }

    /// Returns the offset, which is added after scaling.
    #[must_use]
    pub const fn offset(self) -> f64 {
        self.offset
    }

    /// Converts z to depth.
    #[must_use]
    pub fn ndc_to_depth(self, z: f64) -> f64 {
        self.scale * z + self.offset
    }

    /// Converts depth to z.
    #[must_use]
    pub fn depth_to_ndc(self, depth: f64) -> f64 {
        (depth - self.offset) / self.scale
    }
}
