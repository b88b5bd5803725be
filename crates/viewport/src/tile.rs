//! Tiles: parts of an image that fit together without seams.

use crate::{Rectangle, Viewport, ViewportError};
use homog::{PixelConvention, PixelRect};

impl From<PixelRect> for Rectangle {
    /// Returns the borders of the pixels, in whole pixels from the corner of the image. A width or
    /// height of 0 becomes 1.
    fn from(pixels: PixelRect) -> Self {
        let PixelRect { x, y, width, height } = pixels;
        let [x, y, width, height] = [x, y, width.max(1), height.max(1)].map(f64::from);
        Self::new_unchecked(x, y, width, height)
    }
}

/// Returns the tiles of an image, row by row: each pixel is in exactly one tile.
///
/// ```
/// use viewport::tiles;
/// let parts: Vec<_> = tiles([100, 50], [64, 64])?.collect();
/// assert_eq!(parts.len(), 2);
/// assert_eq!((parts[1].x, parts[1].width, parts[1].height), (64, 36, 50));
/// # Ok::<(), viewport::ViewportError>(())
/// ```
///
/// # Errors
/// Returns an error if a width or height of the image or of the maximum tile size is 0.
pub fn tiles(
    image: [u32; 2],
    largest: [u32; 2],
) -> Result<impl Iterator<Item = PixelRect> + Clone, ViewportError> {
    let names = ["image width", "image height", "tile width", "tile height"];
    for (name, size) in names.into_iter().zip(image.into_iter().chain(largest)) {
        if size == 0 {
            return Err(ViewportError::TooFew { name, count: 0, least: 1 });
        }
    }
    let [columns, rows] = [0, 1].map(|i| image[i].div_ceil(largest[i]));
    Ok((0..rows).flat_map(move |row| {
        (0..columns).map(move |column| {
            let (x, y) = (column * largest[0], row * largest[1]);
            let (width, height) = (largest[0].min(image[0] - x), largest[1].min(image[1] - y));
            PixelRect { x, y, width, height }
        })
    }))
}

impl Viewport {
    /// Returns this viewport for an image that consists of only the tile. It is shifted by whole
    /// pixels and otherwise unchanged, so the tiles together show the whole image.
    #[must_use]
    pub fn for_tile(&self, tile: PixelRect) -> Self {
        let (area, part) = (self.area(), Rectangle::from(tile));
        let (x, y) = (area.x() - part.x(), area.y() - part.y());
        let moved = Rectangle::new_unchecked(x, y, area.width(), area.height());
        Self::new(moved, self.convention(), self.range(), self.depth())
    }

    /// Returns the tile's borders in the coordinates of this viewport's convention, for
    /// [`Self::pick_matrix`].
    #[must_use]
    pub fn tile_area(&self, tile: PixelRect) -> Rectangle {
        let PixelConvention { centers, .. } = self.convention();
        let area = Rectangle::from(tile);
        let (x, y) = (area.x() + centers.image_border(), area.y() + centers.image_border());
        Rectangle::new_unchecked(x, y, area.width(), area.height())
    }
}
