//! Rasterizer errors.

use crate::MAX_SIDE;

/// The reason why a frame cannot be drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RasterError {
    /// The picture has no pixels or extends beyond [`MAX_SIDE`].
    #[error(
        "cannot draw a picture of {width} x {height} pixels from pixel ({x}, {y}); each side \
         must be at least 1 and must end within {MAX_SIDE}"
    )]
    Size {
        /// The first column.
        x: u32,
        /// The first row.
        y: u32,
        /// The requested width in pixels.
        width: u32,
        /// The requested height in pixels.
        height: u32,
    },
    /// A depth buffer and a frame have different numbers of samples.
    #[error("a depth buffer of {found} samples does not fit a frame of {expected}")]
    DepthCount {
        /// The samples of the frame.
        expected: usize,
        /// The samples of the buffer.
        found: usize,
    },
}
