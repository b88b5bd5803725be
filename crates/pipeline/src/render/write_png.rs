//! PNG files rendered in bands of rows, so that the whole picture is never in memory.
//!
//! ```text
//!  region ─► band of rows ─► render_region ─► rows to the PNG encoder ─► next band, same memory
//! ```
//! A band is an ordinary region, so the file has the same bytes as a picture encoded from memory.

use super::RenderError;
use super::prepared_scene::PreparedScene;
use crate::Picture;
use homog::PixelRect;
use picture::encode_png;
use shade::FrameChannel;
use std::io::{self, Write};

/// The maximum number of pixel bytes in a band, except for very wide pictures.
const BAND_BYTES: u64 = 64 << 20;

/// Returns the number of rows in a band for a picture of this width. A band has about 64 MiB of
/// 8-bit pixels. It has 64 to 2048 rows, a multiple of the rasterizer's tile height of 64.
#[must_use]
pub fn rows_per_band(width: u32) -> u32 {
    let rows = BAND_BYTES / (4 * u64::from(width.max(1)));
    (rows as u32 / 64 * 64).clamp(64, 2048)
}

/// The number of bits per channel in a PNG file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum BitDepth {
    /// 8 bits.
    Eight,
    /// 16 bits.
    Sixteen,
}

impl PreparedScene<'_> {
    /// Writes a region as a PNG file, rendered in bands of `rows` rows. The bytes do not depend on
    /// the height of the bands. If `copy` is set, it becomes the region's picture in 8 bits;
    /// otherwise only one band is in memory.
    ///
    /// The PNG header declares whether there is an alpha channel. Before anything is written, a
    /// picture over a translucent background is therefore rendered up to its first translucent
    /// band, and then again from the start.
    ///
    /// # Errors
    /// Returns an error if a band cannot be rendered (see [`render_region`](Self::render_region)),
    /// or if the file cannot be written.
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

    /// Writes the bands of a file with this channel type.
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

    /// Returns whether all bands are opaque. Unless the background is opaque, bands are rendered
    /// until a translucent pixel is found.
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

/// The reason why a PNG file could not be written.
#[derive(Debug, thiserror::Error)]
pub enum WritePngError {
    /// A band cannot be rendered.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The writer failed.
    #[error(transparent)]
    Output(#[from] io::Error),
}
