//! Line-drawing errors.

/// The reason why a subject cannot be drawn as lines.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DrawError {
    /// The image has no pixels, or more than a viewport supports.
    #[error(transparent)]
    Viewport(#[from] viewport::ViewportError),
    /// The size of the z-buffer image under the lines is out of range.
    #[error(transparent)]
    Raster(#[from] raster::RasterError),
    /// There are more triangles than z-buffer ids.
    #[error("a scene can have at most {} points, lines and triangles", u32::MAX)]
    TooManyPrimitives,
    /// The [monitor](raster::Monitor) canceled the drawing.
    #[error("the drawing was canceled")]
    Canceled,
    /// The mesh instances have too many triangles for a line drawing, and
    /// [`DrawOptions::is_unlimited`](crate::DrawOptions::is_unlimited) is not set.
    #[error(
        "a line drawing of {count} triangles would take too long: the meshes have only {distinct}, \
         and all their instances together may have at most {most}; use fewer instances, choose a \
         style that shows surfaces, or lift the limit (`--no-line-limits`)"
    )]
    TooManyCopies {
        /// The number of triangles in all mesh instances.
        count: u64,
        /// The number of triangles in the meshes, each counted once.
        distinct: u64,
        /// The maximum number of triangles for these models.
        most: u64,
    },
}
