//! Errors of line drawings.

/// A subject that cannot be drawn as lines.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DrawError {
    /// The image has no pixels, or more than a viewport may have.
    #[error(transparent)]
    Viewport(#[from] viewport::ViewportError),
    /// The z-buffer image under the lines is out of range.
    #[error(transparent)]
    Raster(#[from] raster::RasterError),
    /// There are more triangles than the z-buffer has ids for.
    #[error("the scene has more than {} points, lines and triangles", u32::MAX)]
    TooManyPrimitives,
}
