//! What can be wrong with a request to rasterise.

use crate::MAX_SIDE;

/// A request that cannot be met.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RasterError {
    /// The picture has no pixels or too many.
    #[error(
        "a picture of {width} x {height} pixels cannot be drawn; each side must be between 1 and {MAX_SIDE}"
    )]
    Size {
        /// The requested width in pixels.
        width: u32,
        /// The requested height in pixels.
        height: u32,
    },
}
