//! Line drawing errors.

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
    /// The [monitor](raster::Monitor) requested cancellation.
    #[error("the drawing was canceled")]
    Canceled,
    /// Mesh copies have too many triangles for a line drawing, and
    /// [`DrawOptions::is_unlimited`](crate::DrawOptions::is_unlimited) is not set.
    #[error(
        "drawing lines of {count} triangles would take too long: the models have only {distinct}, \
         and all copies together may have at most {most}; use fewer copies, choose a style that \
         shows surfaces, or lift the limit (`--no-line-limits`)"
    )]
    TooManyCopies {
        /// The number of triangles in all copies.
        count: u64,
        /// The number of triangles in the models.
        distinct: u64,
        /// The maximum number for these models.
        most: u64,
    },
}
