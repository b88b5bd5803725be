//! Image tiles, which divide pictures larger than the rasterizer's grid, and regions of pictures.
//!
//! ```text
//!   ┌───────────────┬──────┐   The rasterizer's grid ends at 16,384 pixels. A larger picture is
//!   │  ┌─────────┐  │      │   divided into tiles of that size. Each is rendered like a picture:
//!   │  │ region  │  │      │   a pick matrix narrows the view volume to the tile. A region is
//!   │  └─────────┘  │      │   rendered tile by tile.
//!   ├───────────────┼──────┤
//!   └───────────────┴──────┘
//! ```
//! Pixels depend on the scene, the size of the whole picture and the tile, but never on the region.
//! The same pixel is therefore bit-identical in every region.

use super::RenderError;
use homog::{Clip, ClipRange, PixelRect, Projective, World};
use raster::MAX_SIDE as TILE_SIDE;
use scene::{ImageSpec, MAX_IMAGE_SIDE, Scene};
use viewport::Viewport;

/// The maximum number of pixels in one region: a full tile.
const MAX_PIXELS_IN_MEMORY: u64 = (TILE_SIDE as u64) * (TILE_SIDE as u64);

/// Checks that a region is inside the picture and fits in memory.
///
/// # Errors
/// Returns [`RasterError::Size`](raster::RasterError::Size) with the region.
pub(crate) fn validate_region(image: ImageSpec, region: PixelRect) -> Result<(), RenderError> {
    let image_rect = image.pixel_rect();
    let size_fits = image_rect.width <= MAX_IMAGE_SIDE && image_rect.height <= MAX_IMAGE_SIDE;
    let pixels = u64::from(region.width) * u64::from(region.height);
    if !size_fits
        || image_rect.intersection(region) != Some(region)
        || pixels > MAX_PIXELS_IN_MEMORY
    {
        let PixelRect { x, y, width, height } = region;
        return Err(raster::RasterError::Size { x, y, width, height }.into());
    }
    Ok(())
}

/// One tile of a picture, at most 16,384 pixels per side.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct ImageTile {
    /// The rectangle in the picture.
    pub(super) rect: PixelRect,
    /// The width and height of the picture, or `None` if this tile covers all of it.
    image_size: Option<[u32; 2]>,
}

impl ImageTile {
    /// Returns the transform from world to clip space, narrowed so that the tile fills the view
    /// volume (`gluPickMatrix`).
    pub(super) fn world_to_clip(
        &self,
        scene: &Scene,
    ) -> Result<Projective<World, Clip>, RenderError> {
        let world_to_clip = scene.view_projection.world_to_clip();
        let Some([width, height]) = self.image_size else { return Ok(world_to_clip) };
        let pick_matrix = Viewport::image_for(width, height, ClipRange::CHAPTER)?
            .pick_matrix(self.rect.into())?;
        Ok(Projective::from_raw(pick_matrix.raw() * world_to_clip.raw()))
    }
}

/// A part of a region: its intersection with a tile.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct TileRegion {
    /// The tile.
    pub(super) tile: ImageTile,
    /// The rectangle in the picture.
    pub(super) rect: PixelRect,
}

impl TileRegion {
    /// Returns the region of a single pixel.
    pub(super) fn for_pixel(image: ImageSpec, [x, y]: [u32; 2]) -> Self {
        let rect = PixelRect { x, y, width: 1, height: 1 };
        Self { tile: tile_at(image, [x / TILE_SIDE, y / TILE_SIDE]), rect }
    }

    /// Returns the region that covers a picture no larger than one tile.
    pub(super) fn for_whole(image: ImageSpec) -> Self {
        Self { tile: tile_at(image, [0, 0]), rect: image.pixel_rect() }
    }

    /// Returns the first column and row relative to the tile.
    pub(super) const fn offset_in_tile(&self) -> [u32; 2] {
        [self.rect.x - self.tile.rect.x, self.rect.y - self.tile.rect.y]
    }

    /// Returns the width and height.
    pub(super) const fn size(&self) -> [u32; 2] {
        [self.rect.width, self.rect.height]
    }

    /// Returns the number of pixels.
    pub(super) const fn pixel_count(&self) -> usize {
        self.rect.area()
    }

    /// Copies the pixels of this part into `all`, the pixels of the region, row by row.
    pub(super) fn copy_into_region<P: Copy>(&self, pixels: &[P], region: PixelRect, all: &mut [P]) {
        let (width, region_width) = (self.rect.width as usize, region.width as usize);
        let left = (self.rect.x - region.x) as usize;
        let top = (self.rect.y - region.y) as usize;
        let rows = all.chunks_exact_mut(region_width).skip(top).zip(pixels.chunks_exact(width));
        for (row, pixels) in rows {
            row[left..left + width].copy_from_slice(pixels);
        }
    }
}

/// Divides a region at tile borders, row by row from the upper left. Usually there is one part.
pub(super) fn tile_regions(image: ImageSpec, region: PixelRect) -> Vec<TileRegion> {
    let (columns, rows) = (image.width.div_ceil(TILE_SIDE), image.height.div_ceil(TILE_SIDE));
    let tile_indices = (0..rows).flat_map(|row| (0..columns).map(move |column| [column, row]));
    let regions = tile_indices.filter_map(|index| {
        let tile = tile_at(image, index);
        tile.rect.intersection(region).map(|rect| TileRegion { tile, rect })
    });
    regions.collect()
}

/// Returns the tile at a column and row of the tile grid.
fn tile_at(image: ImageSpec, [column, row]: [u32; 2]) -> ImageTile {
    let (x, y) = (column * TILE_SIDE, row * TILE_SIDE);
    let (width, height) = (TILE_SIDE.min(image.width - x), TILE_SIDE.min(image.height - y));
    let is_whole = [width, height] == [image.width, image.height];
    let image_size = (!is_whole).then_some([image.width, image.height]);
    ImageTile { rect: PixelRect { x, y, width, height }, image_size }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regions_are_split_at_tile_borders() {
        let image = ImageSpec::new(20_000, 40_000);
        let region = PixelRect { x: 16_000, y: 16_300, width: 1000, height: 100 };
        let regions = tile_regions(image, region);
        assert_eq!(regions.iter().map(TileRegion::pixel_count).sum::<usize>(), region.area());
        assert_eq!(regions.len(), 4);
        assert_eq!(regions[3].offset_in_tile(), [0, 0]);
        assert_eq!(regions[3].tile.rect.width, 20_000 - 16_384);
        let mut all = vec![0; region.area()];
        for (number, tile) in (1..).zip(&regions) {
            tile.copy_into_region(&vec![number; tile.pixel_count()], region, &mut all);
        }
        let at = |x: usize, y: usize| all[y * 1000 + x];
        assert_eq!([at(383, 83), at(384, 83), at(383, 84), at(384, 84)], [1, 2, 3, 4]);
    }

    /// Returns the rectangle that the error reports, or `None` if the region is valid.
    fn refused(image: ImageSpec, region: PixelRect) -> Option<PixelRect> {
        match validate_region(image, region) {
            Ok(()) => None,
            Err(RenderError::Raster(raster::RasterError::Size { x, y, width, height })) => {
                Some(PixelRect { x, y, width, height })
            }
            Err(error) => panic!("unexpected error: {error}"),
        }
    }

    #[test]
    fn oversized_and_outside_regions_are_rejected() {
        let small = ImageSpec::new(100, 100);
        let outside = PixelRect { x: 90, y: 0, width: 20, height: 10 };
        assert_eq!(refused(small, outside), Some(outside));
        let empty = PixelRect { width: 0, ..outside };
        assert_eq!(refused(small, empty), Some(empty));
        assert_eq!(refused(small, PixelRect { width: 10, ..outside }), None);
        for large in [ImageSpec::new(20_000, 20_000), ImageSpec::new(MAX_IMAGE_SIDE + 1, 1)] {
            assert_eq!(refused(large, large.pixel_rect()), Some(large.pixel_rect()));
        }
    }
}
