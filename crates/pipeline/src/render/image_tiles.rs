//! Regions of a picture, and the sheets that large pictures are divided into.
//!
//! ```text
//!   ┌───────────────┬──────┐   The rasteriser's grid ends at 16,384 pixels. A larger picture is divided into sheets
//!   │  ┌─────────┐  │      │   of that size, each of which is a picture of its own: the view volume is narrowed to it,
//!   │  │ region  │  │      │   as a pick matrix does it. Regions are parts of sheets.
//!   │  └─────────┘  │      │
//!   ├───────────────┼──────┤   What a pixel shows depends on the scene, on the size of the whole picture and on the
//!   └───────────────┴──────┘   pixel's sheet, and never on the region: so regions unite bit for bit.
//! ```

use super::RenderError;
use crate::scene::{ImageSpec, Scene};
use homog::{Clip, PixelRect, Projective, World};
use raster::MAX_SIDE as SHEET;
use viewport::Viewport;

/// The longest side of a picture in pixels. Pictures beyond 16,384 pixels are drawn region by region.
pub const MAX_IMAGE_SIDE: u32 = 1 << 20;

/// The most pixels that are held at once.
const MAX_PIXELS_IN_MEMORY: u64 = (SHEET as u64) * (SHEET as u64);

/// That the region is in the picture and can be held at once.
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

/// A sheet of a picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct ImageTile {
    /// Its pixels in the picture.
    pub(super) rect: PixelRect,
    /// Width and height of the picture, if it has more than this sheet.
    image_size: Option<[u32; 2]>,
}

impl ImageTile {
    /// From the world to the clip space in which the sheet is all that is seen.
    pub(super) fn world_to_clip(
        &self,
        scene: &Scene,
    ) -> Result<Projective<World, Clip>, RenderError> {
        let world_to_clip = scene.view_projection.world_to_clip();
        let Some([width, height]) = self.image_size else { return Ok(world_to_clip) };
        let pick_matrix = Viewport::image(width, height)?.pick_matrix(self.rect.into())?;
        Ok(Projective::from_raw(pick_matrix.raw() * world_to_clip.raw()))
    }
}

/// What a region has of a sheet.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct TileRegion {
    pub(super) tile: ImageTile,
    /// Its pixels in the picture.
    pub(super) rect: PixelRect,
}

impl TileRegion {
    /// A pixel of a picture.
    pub(super) fn for_pixel(image: ImageSpec, [x, y]: [u32; 2]) -> Self {
        let rect = PixelRect { x, y, width: 1, height: 1 };
        Self { tile: tile_at(image, [x / SHEET, y / SHEET]), rect }
    }

    /// The first column and row in the sheet.
    pub(super) const fn offset_in_tile(&self) -> [u32; 2] {
        [self.rect.x - self.tile.rect.x, self.rect.y - self.tile.rect.y]
    }

    /// Width and height.
    pub(super) const fn size(&self) -> [u32; 2] {
        [self.rect.width, self.rect.height]
    }

    pub(super) const fn pixel_count(&self) -> usize {
        self.rect.area()
    }

    /// Copies its pixels to their places among those of a region.
    pub(super) fn copy_into_region<P: Copy>(&self, pixels: &[P], region: PixelRect, all: &mut [P]) {
        let (width, across) = (self.rect.width as usize, region.width as usize);
        let left = (self.rect.x - region.x) as usize;
        let top = (self.rect.y - region.y) as usize;
        let rows = all.chunks_exact_mut(across).skip(top).zip(pixels.chunks_exact(width));
        for (row, pixels) in rows {
            row[left..left + width].copy_from_slice(pixels);
        }
    }
}

/// What a region has of each sheet of the picture: of most pictures there is only one.
pub(super) fn tile_regions(image: ImageSpec, region: PixelRect) -> Vec<TileRegion> {
    let (columns, rows) = (image.width.div_ceil(SHEET), image.height.div_ceil(SHEET));
    let tile_indices = (0..rows).flat_map(|row| (0..columns).map(move |column| [column, row]));
    let regions = tile_indices.filter_map(|place| {
        let sheet = tile_at(image, place);
        sheet.rect.intersection(region).map(|shown| TileRegion { tile: sheet, rect: shown })
    });
    regions.collect()
}

fn tile_at(image: ImageSpec, [column, row]: [u32; 2]) -> ImageTile {
    let (x, y) = (column * SHEET, row * SHEET);
    let (width, height) = (SHEET.min(image.width - x), SHEET.min(image.height - y));
    let is_whole = [width, height] == [image.width, image.height];
    let of = (!is_whole).then_some([image.width, image.height]);
    ImageTile { rect: PixelRect { x, y, width, height }, image_size: of }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raster::Samples;

    fn image_spec(width: u32, height: u32) -> ImageSpec {
        let (background, backdrop, samples) = ([0.0; 4], None, Samples::One);
        ImageSpec {
            width,
            height,
            background,
            environment_blur: backdrop,
            samples,
            max_anisotropy: 1,
        }
    }

    #[test]
    fn a_region_is_cut_where_sheets_meet() {
        let image = image_spec(20_000, 40_000);
        let region = PixelRect { x: 16_000, y: 16_300, width: 1000, height: 100 };
        let regions = tile_regions(image, region);
        assert_eq!(regions.iter().map(TileRegion::pixel_count).sum::<usize>(), region.area());
        assert_eq!(regions.len(), 4);
        assert_eq!(regions[3].offset_in_tile(), [0, 0]);
        assert_eq!(regions[3].tile.rect.width, 20_000 - 16_384);
        let mut all = vec![0; region.area()];
        for (number, part) in (1..).zip(&regions) {
            part.copy_into_region(&vec![number; part.pixel_count()], region, &mut all);
        }
        let at = |x: usize, y: usize| all[y * 1000 + x];
        assert_eq!([at(383, 83), at(384, 83), at(383, 84), at(384, 84)], [1, 2, 3, 4]);
    }

    #[test]
    fn what_is_not_in_the_picture_or_too_much_is_refused() {
        let wrong = PixelRect { x: 90, y: 0, width: 20, height: 10 };
        assert!(validate_region(image_spec(100, 100), wrong).is_err());
        assert!(validate_region(image_spec(100, 100), PixelRect { width: 0, ..wrong }).is_err());
        assert!(validate_region(image_spec(100, 100), PixelRect { width: 10, ..wrong }).is_ok());
        assert!(
            validate_region(image_spec(20_000, 20_000), image_spec(20_000, 20_000).pixel_rect())
                .is_err()
        );
        assert!(
            validate_region(
                image_spec(MAX_IMAGE_SIDE + 1, 1),
                image_spec(MAX_IMAGE_SIDE + 1, 1).pixel_rect()
            )
            .is_err()
        );
    }
}
