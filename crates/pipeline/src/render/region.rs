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
use viewport::{Tile, Viewport};

/// The longest side of a picture in pixels. Pictures beyond 16,384 pixels are drawn region by region.
pub const MAX_SIDE: u32 = 1 << 20;

/// The most pixels that are held at once.
const MOST_PIXELS: u64 = (SHEET as u64) * (SHEET as u64);

/// That the region is in the picture and can be held at once.
pub(crate) fn check_region(image: ImageSpec, region: PixelRect) -> Result<(), RenderError> {
    let whole = image.rect();
    let fits = whole.width <= MAX_SIDE && whole.height <= MAX_SIDE;
    let pixels = u64::from(region.width) * u64::from(region.height);
    if !fits || whole.intersection(region) != Some(region) || pixels > MOST_PIXELS {
        let PixelRect { x, y, width, height } = region;
        return Err(raster::RasterError::Size { x, y, width, height }.into());
    }
    Ok(())
}

/// A sheet of a picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Sheet {
    /// Its pixels in the picture.
    pub(super) area: PixelRect,
    /// Width and height of the picture, if it has more than this sheet.
    of: Option<[u32; 2]>,
}

impl Sheet {
    /// From the world to the clip space in which the sheet is all that is seen.
    pub(super) fn world_to_clip(
        &self,
        scene: &Scene,
    ) -> Result<Projective<World, Clip>, RenderError> {
        let world_to_clip = scene.view_projection.world_to_clip();
        let Some([width, height]) = self.of else { return Ok(world_to_clip) };
        let PixelRect { x, y, width: across, height: down } = self.area;
        let tile = Tile { x, y, width: across, height: down };
        let narrowed = Viewport::image(width, height)?.pick_matrix(tile.area())?;
        Ok(Projective::from_raw(narrowed.raw() * world_to_clip.raw()))
    }
}

/// What a region has of a sheet.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct PartOfSheet {
    pub(super) sheet: Sheet,
    /// Its pixels in the picture.
    pub(super) shown: PixelRect,
}

impl PartOfSheet {
    /// A pixel of a picture.
    pub(super) fn of_pixel(image: ImageSpec, [x, y]: [u32; 2]) -> Self {
        let shown = PixelRect { x, y, width: 1, height: 1 };
        Self { sheet: sheet_at(image, [x / SHEET, y / SHEET]), shown }
    }

    /// The first column and row in the sheet.
    pub(super) const fn corner(&self) -> [u32; 2] {
        [self.shown.x - self.sheet.area.x, self.shown.y - self.sheet.area.y]
    }

    /// Width and height.
    pub(super) const fn size(&self) -> [u32; 2] {
        [self.shown.width, self.shown.height]
    }

    pub(super) const fn area(&self) -> usize {
        self.shown.area()
    }

    /// Copies its pixels to their places among those of a region.
    pub(super) fn put<P: Copy>(&self, pixels: &[P], region: PixelRect, all: &mut [P]) {
        let (width, across) = (self.shown.width as usize, region.width as usize);
        let left = (self.shown.x - region.x) as usize;
        let top = (self.shown.y - region.y) as usize;
        let rows = all.chunks_exact_mut(across).skip(top).zip(pixels.chunks_exact(width));
        for (row, pixels) in rows {
            row[left..left + width].copy_from_slice(pixels);
        }
    }
}

/// What a region has of each sheet of the picture: of most pictures there is only one.
pub(super) fn sheets(image: ImageSpec, region: PixelRect) -> Vec<PartOfSheet> {
    let (columns, rows) = (image.width.div_ceil(SHEET), image.height.div_ceil(SHEET));
    let places = (0..rows).flat_map(|row| (0..columns).map(move |column| [column, row]));
    let parts = places.filter_map(|place| {
        let sheet = sheet_at(image, place);
        sheet.area.intersection(region).map(|shown| PartOfSheet { sheet, shown })
    });
    parts.collect()
}

fn sheet_at(image: ImageSpec, [column, row]: [u32; 2]) -> Sheet {
    let (x, y) = (column * SHEET, row * SHEET);
    let (width, height) = (SHEET.min(image.width - x), SHEET.min(image.height - y));
    let is_whole = [width, height] == [image.width, image.height];
    let of = (!is_whole).then_some([image.width, image.height]);
    Sheet { area: PixelRect { x, y, width, height }, of }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raster::Samples;

    fn image(width: u32, height: u32) -> ImageSpec {
        let (background, backdrop, samples) = ([0.0; 4], None, Samples::One);
        ImageSpec { width, height, background, backdrop, samples, anisotropy: 1 }
    }

    #[test]
    fn a_region_is_cut_where_sheets_meet() {
        let image = image(20_000, 40_000);
        let region = PixelRect { x: 16_000, y: 16_300, width: 1000, height: 100 };
        let parts = sheets(image, region);
        assert_eq!(parts.iter().map(PartOfSheet::area).sum::<usize>(), region.area());
        assert_eq!(parts.len(), 4);
        assert_eq!(parts[3].corner(), [0, 0]);
        assert_eq!(parts[3].sheet.area.width, 20_000 - 16_384);
        let mut all = vec![0; region.area()];
        for (number, part) in (1..).zip(&parts) {
            part.put(&vec![number; part.area()], region, &mut all);
        }
        let at = |x: usize, y: usize| all[y * 1000 + x];
        assert_eq!([at(383, 83), at(384, 83), at(383, 84), at(384, 84)], [1, 2, 3, 4]);
    }

    #[test]
    fn what_is_not_in_the_picture_or_too_much_is_refused() {
        let wrong = PixelRect { x: 90, y: 0, width: 20, height: 10 };
        assert!(check_region(image(100, 100), wrong).is_err());
        assert!(check_region(image(100, 100), PixelRect { width: 0, ..wrong }).is_err());
        assert!(check_region(image(100, 100), PixelRect { width: 10, ..wrong }).is_ok());
        assert!(check_region(image(20_000, 20_000), image(20_000, 20_000).rect()).is_err());
        assert!(check_region(image(MAX_SIDE + 1, 1), image(MAX_SIDE + 1, 1).rect()).is_err());
    }
}
