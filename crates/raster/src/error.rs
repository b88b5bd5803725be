//! Rasterizer errors.

use crate::MAX_SIDE;

/// The reason why a frame cannot be drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RasterError {
    /// The picture has no pixels or extends beyond [`MAX_SIDE`].
    #[error(
        "cannot draw a picture of {width} x {height} pixels at pixel ({x}, {y}): its \
         sides must be at least 1, and it must end within {MAX_SIDE} x {MAX_SIDE} pixels"
    )]
    Size {
        /// The leftmost column.
        x: u32,
        /// The top row.
        y: u32,
        /// The requested width in pixels.
        width: u32,
        /// The requested height in pixels.
        height: u32,
    },
    /// The number of depths in a buffer does not match its size, or the buffer does not match the
    /// frame.
    #[error("a depth buffer with {found} samples does not match a frame with {expected}")]
    DepthCount {
        /// The expected number of depths.
        expected: usize,
        /// The number of depths in the buffer.
        found: usize,
    },
}
