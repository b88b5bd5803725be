//! Why there is no drawing.

/// A subject that cannot be drawn as lines.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DrawError {
    /// The picture has no viewport.
    #[error(transparent)]
    Viewport(#[from] viewport::ViewportError),
    /// The z-buffer picture under the lines is out of range.
    #[error(transparent)]
    Raster(#[from] raster::RasterError),
    /// There are more triangles than the z-buffer can number.
    #[error("the scene has more than {} points, lines and triangles", u32::MAX)]
    TooManyPrimitives,
}
