//! PNG files rendered in bands of rows: the whole picture is never in memory.
//!
//! ```text
//!  region ─► band of rows ─► render_region ─► rows to the PNG encoder ─► next band, same memory
//! ```
//! A band is an ordinary region: the file has the same bytes as one encoded from memory.

use super::RenderError;
use super::prepared_scene::PreparedScene;
use crate::Picture;
use homog::PixelRect;
use picture::encode_png;
use shade::FrameChannel;
use std::io::{self, Write};

/// The maximum number of pixel bytes in a band, for pictures of reasonable width.
const BAND_BYTES: u64 = 64 << 20;

/// The number of rows in a band for a picture of this width: about 64 MiB of 8-bit pixels, in whole
/// rows of the rasterizer's 64-pixel tiles, between 64 and 2048.
#[must_use]
pub fn rows_per_band(width: u32) -> u32 {
    let rows = BAND_BYTES / (4 * u64::from(width.max(1)));
    (rows as u32 / 64 * 64).clamp(64, 2048)
}

/// The bits per channel of a PNG file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum BitDepth {
    /// 8 bits.
    Eight,
    /// 16 bits.
    Sixteen,
}

impl PreparedScene<'_> {
    /// Writes a region as a PNG file, rendered in bands of `rows` rows. The bytes do not depend on
    /// the number of rows. `copy` becomes the region's picture in 8 bits; without it, only a band
    /// is in memory.
    ///
    /// The PNG header declares whether there is an alpha channel. A picture over a translucent
    /// background is therefore rendered up to its first translucent band before anything is
    /// written, and then again.
    ///
    /// # Errors
    /// A band cannot be rendered (see [`render_region`](Self::render_region)), or the file cannot
    /// be written.
    pub fn write_png(
        &mut self,
        out: &mut dyn Write,
        region: PixelRect,
        rows: u32,
        depth: BitDepth,
        copy: Option<&mut Picture>,
    ) -> Result<(), WritePngError> {
        match depth {
            BitDepth::Eight => self.write_bands::<u8>(out, region, rows, copy),
            BitDepth::Sixteen => self.write_bands::<u16>(out, region, rows, copy),
        }
    }

    /// Writes the bands of a file with channels of this type.
    fn write_bands<C: FrameChannel>(
        &mut self,
        out: &mut dyn Write,
        region: PixelRect,
        rows: u32,
        mut copy: Option<&mut Picture>,
    ) -> Result<(), WritePngError> {
        if let Some(copy) = &mut copy {
            copy.resize(region.width, 0);
        }
        self.pixels_due = region.area() as u64;
        let mut bands = region.bands(rows);
        let mut picture = Picture::<C>::default();
        self.render_region(bands.next().unwrap_or(region), &mut picture)?;
        // The color type precedes the pixels, so the opacity of all bands must be known first.
        let is_opaque =
            picture.is_opaque() && self.bands_are_opaque::<C>(region.bands(rows).skip(1))?;
        encode_png(out, [region.width, region.height], is_opaque, C::BITS, |png| {
            loop {
                if let Some(copy) = &mut copy {
                    let pixels = picture.pixels.iter().map(|pixel| pixel.map(C::to_byte));
                    copy.pixels.extend(pixels);
                    copy.height += picture.height;
                }
                self.context.measure("encode", || png.write_pixels(&picture.pixels))?;
                let Some(band) = bands.next() else { return Ok(()) };
                self.render_region(band, &mut picture)?;
            }
        })
    }

    /// Whether all bands are opaque. Over an opaque background they are; otherwise they are
    /// rendered up to the first translucent pixel.
    fn bands_are_opaque<C: FrameChannel>(
        &mut self,
        bands: impl Iterator<Item = PixelRect>,
    ) -> Result<bool, RenderError> {
        if self.context.scene.has_opaque_background() {
            return Ok(true);
        }
        let mut picture = Picture::<C>::default();
        for band in bands {
            self.render_region(band, &mut picture)?;
            if !picture.is_opaque() {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// A PNG file that could not be written.
#[derive(Debug, thiserror::Error)]
pub enum WritePngError {
    /// A band cannot be rendered.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The writer failed.
    #[error(transparent)]
    Output(#[from] io::Error),
}
