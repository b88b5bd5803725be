//! Clip ranges: the extent of clip space after the divide.
//!
//! ```text
//!  range        near   far    y     used by
//!  CHAPTER       +1     −1    up    the textbook, with w > 0 (PE-3)
//!  OPENGL        −1     +1    up    OpenGL, WebGL
//!  ZERO_ONE       0      1    up    Direct3D, Metal, WebGPU
//!  VULKAN         0      1    down  Vulkan
//! ```
//!
//! Projection, clipping and viewport must agree on the range. Each accepts it as a value, so you
//! choose it once and pass it to all three. In OpenGL, `glClipControl` selects the range; in
//! Vulkan, `VK_EXT_depth_clip_control` does.

use thiserror::Error;

/// The direction of the y axis after the divide.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum NdcY {
    /// The top edge of the window maps to y = +1.
    Up,
    /// The top edge of the window maps to y = −1.
    Down,
}

/// The reason why [`ClipRange::with_depths`] rejects the depths.
#[derive(Clone, Copy, PartialEq, Debug, Error)]
pub enum ClipRangeError {
    /// A depth is not a number from −1 to 1.
    #[error("`{name}` is {value}; it must be between −1 and 1")]
    Depth {
        /// The name of the depth: `near_depth` or `far_depth`.
        name: &'static str,
        /// The rejected value.
        value: f64,
    },
    /// The depths of the near and far planes are less than 10⁻⁶ apart.
    #[error("`far_depth` is {far}; it must be at least 0.000001 away from `near_depth`")]
    TooClose {
        /// The depth of the far plane.
        far: f64,
    },
}

/// The depths of the near and far planes after the divide, and the direction of y.
///
/// # Guarantees
/// Both depths are in [−1, 1] and at least 10⁻⁶ apart.
///
/// ```
/// use homog::ClipRange;
/// let z_buffer = ClipRange::ZERO_ONE.reversed();
/// assert_eq!((z_buffer.near_depth(), z_buffer.far_depth()), (1.0, 0.0));
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ClipRange {
    near_depth: f64,
    far_depth: f64,
    y: NdcY,
}

impl ClipRange {
    /// The canonical volume of the textbook (Shirley and Marschner, ch. 8) in its w > 0 form
    /// (PE-3): [−1, 1]³ with near at +1.
    pub const CHAPTER: Self = Self::new(1.0, -1.0, NdcY::Up);
    /// OpenGL and WebGL: [−1, 1]³ with near at −1.
    pub const OPENGL: Self = Self::new(-1.0, 1.0, NdcY::Up);
    /// Direct3D, Metal and WebGPU: near at 0, far at 1, y up.
    pub const ZERO_ONE: Self = Self::new(0.0, 1.0, NdcY::Up);
    /// Vulkan: near at 0, far at 1, y down.
    pub const VULKAN: Self = Self::new(0.0, 1.0, NdcY::Down);

    const fn new(near_depth: f64, far_depth: f64, y: NdcY) -> Self {
        Self { near_depth, far_depth, y }
    }

    /// Returns this range with the near and far depths swapped (reversed z).
    #[must_use]
    pub const fn reversed(self) -> Self {
        Self::new(self.far_depth, self.near_depth, self.y)
    }

    /// Returns this range with the given direction of y.
    #[must_use]
    pub const fn with_y(self, y: NdcY) -> Self {
        Self { y, ..self }
    }

    /// Returns this range with different depths for the near and far planes.
    ///
    /// # Errors
    /// Returns an error unless both depths are in [−1, 1] and at least 10⁻⁶ apart.
    pub fn with_depths(self, near_depth: f64, far_depth: f64) -> Result<Self, ClipRangeError> {
        for (name, value) in [("near_depth", near_depth), ("far_depth", far_depth)] {
            if !(-1.0..=1.0).contains(&value) {
                return Err(ClipRangeError::Depth { name, value });
            }
        }
        if (near_depth - far_depth).abs() < 1e-6 {
            return Err(ClipRangeError::TooClose { far: far_depth });
        }
        Ok(Self::new(near_depth, far_depth, self.y))
    }

    /// Returns the depth of the near plane after the divide.
    #[must_use]
    pub const fn near_depth(self) -> f64 {
        self.near_depth
    }

    /// Returns the depth of the far plane after the divide.
    #[must_use]
    pub const fn far_depth(self) -> f64 {
        self.far_depth
    }

    /// Returns the direction of y after the divide.
    #[must_use]
    pub const fn y(self) -> NdcY {
        self.y
    }

    /// Returns the y coordinate of the window's top edge after the divide: +1 or −1.
    #[must_use]
    pub const fn top(self) -> f64 {
        match self.y {
            NdcY::Up => 1.0,
            NdcY::Down => -1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depths_are_checked() {
        let range = ClipRange::VULKAN.with_depths(0.25, 0.75).expect("allowed");
        assert_eq!((range.near_depth(), range.far_depth(), range.y()), (0.25, 0.75, NdcY::Down));
        for (near, far) in [(0.0, 1.5), (-1.1, 0.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
            let error = ClipRange::OPENGL.with_depths(near, far);
            assert!(matches!(error, Err(ClipRangeError::Depth { .. })), "{near} {far}");
        }
        let error = ClipRange::OPENGL.with_depths(0.5, 0.500_000_1);
        assert!(matches!(error, Err(ClipRangeError::TooClose { .. })));
    }
}
