//! Flags for rendering part of the picture, and for its bit depth.

use super::CliError;
use homog::PixelRect;
use scene::ImageSpec;
use scene_file::file::SceneFile;

/// The rectangle of pixels to render, and the bits per channel.
///
/// The pixels of a region are identical to the same pixels of the whole picture, so bands rendered
/// on several machines can be stacked.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct RegionArgs {
    /// Bits per channel: 8 or 16
    #[arg(help_heading = "Picture", long, value_name = "N", value_parser = parse_bits)]
    bits: Option<u32>,
    /// Render only this rectangle: column and row of its upper left pixel, width, height
    ///
    /// Its pixels are identical to the same pixels of the whole picture.
    #[arg(help_heading = "Picture", long, value_name = "X,Y,W,H", value_parser = parse_region)]
    crop: Option<PixelRect>,
    /// Render only the I-th of N horizontal bands, counted from the top
    ///
    /// Stacked from 1/N to N/N, the bands form the whole picture, or the area of --crop.
    #[arg(help_heading = "Picture", long, value_name = "I/N", value_parser = parse_band)]
    band: Option<[u32; 2]>,
}

/// Parses the number of bits per channel.
fn parse_bits(text: &str) -> Result<u32, String> {
    let bits = text.parse().ok().filter(|bits| matches!(bits, 8 | 16));
    bits.ok_or_else(|| "expected 8 or 16".to_owned())
}

impl RegionArgs {
    /// Whether 16 bits per channel were requested.
    pub(super) fn asks_sixteen_bits(&self) -> bool {
        self.bits == Some(16)
    }

    /// Replaces the scene's bit depth.
    pub(crate) fn apply_to(&self, file: &mut SceneFile) {
        if let Some(bits) = self.bits {
            file.image.bits = bits;
        }
    }

    /// Whether `--crop` or `--band` is set.
    pub(crate) fn is_partial(&self) -> bool {
        self.crop.is_some() || self.band.is_some()
    }

    /// Returns the rectangle to render: the crop (by default the whole picture), or a band of it.
    ///
    /// `--band` divides the crop if both are set. `nth_band` counts from 0, the flag from 1. Band
    /// heights differ by at most one row, and together the bands contain every row exactly once.
    ///
    /// # Errors
    /// Returns an error if the crop is not inside the picture, or if the band has no rows.
    pub(super) fn resolve_region(&self, image: ImageSpec) -> Result<PixelRect, CliError> {
        let whole = image.pixel_rect();
        let crop = self.crop.unwrap_or(whole);
        if whole.intersection(crop) != Some(crop) {
            let PixelRect { x, y, width, height } = crop;
            let PixelRect { width: across, height: down, .. } = whole;
            return Err(CliError::Usage(format!(
                "--crop {x},{y},{width},{height} is not inside the picture of {across} x {down} pixels"
            )));
        }
        let Some([index, count]) = self.band else { return Ok(crop) };
        let band = crop.nth_band(index - 1, count);
        if band.height == 0 {
            let rows = crop.height;
            return Err(CliError::Usage(format!(
                "--band {index}/{count} is empty; set N to at most {rows}, the number of rows"
            )));
        }
        Ok(band)
    }
}

/// Parses `X,Y,WIDTH,HEIGHT` with a width and a height above 0.
///
/// Whether the rectangle is inside the picture is known only after the scene is read.
fn parse_region(text: &str) -> Result<PixelRect, String> {
    let fault =
        || "expected column, row, width and height in pixels, such as 100,50,640,480".to_owned();
    let numbers: Vec<u32> = text
        .split(',')
        .map(|word| word.trim().parse().map_err(|_| fault()))
        .collect::<Result<_, _>>()?;
    match numbers[..] {
        [x, y, width, height] if width > 0 && height > 0 => Ok(PixelRect { x, y, width, height }),
        _ => Err(fault()),
    }
}

/// Parses `I/N` with `1 <= I <= N`.
fn parse_band(text: &str) -> Result<[u32; 2], String> {
    let fault = || "expected I/N with I from 1 to N, such as 2/8".to_owned();
    let (number, count) = text.split_once('/').ok_or_else(fault)?;
    let [number, count] = [number, count].map(|word| word.trim().parse().ok());
    let (number, count): (u32, u32) = number.zip(count).ok_or_else(fault)?;
    (1..=count).contains(&number).then_some([number, count]).ok_or_else(fault)
}
