//! Flags for parts of pictures and for the depth of their channels.

use super::CliError;
use homog::PixelRect;
use pipeline::scene::ImageSpec;
use pipeline::scene::file::SceneFile;

/// Which part of the picture is drawn, and with how many bits.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Part of the picture")]
pub(crate) struct RegionArgs {
    /// Bits of each channel: 8 or 16
    #[arg(long, value_name = "N")]
    bits: Option<u32>,
    /// Draw these pixels of the picture only: column and row of the upper left one, width and height. They are those that the whole
    /// picture has there
    #[arg(long, value_name = "X,Y,W,H", value_parser = parse_region)]
    crop: Option<PixelRect>,
    /// Draw the I-th of N bands, from the top; put one under the other they are the whole picture
    #[arg(long, value_name = "I/N", value_parser = parse_tile)]
    tile: Option<[u32; 2]>,
}

impl RegionArgs {
    /// What the flags say goes before what the scene says.
    pub(crate) fn apply_to(&self, file: &mut SceneFile) {
        if let Some(bits) = self.bits {
            file.image.bits = bits;
        }
    }

    /// Whether only a part is wanted.
    pub(crate) fn is_partial(&self) -> bool {
        self.crop.is_some() || self.tile.is_some()
    }

    /// The pixels that are wanted of a picture.
    pub(super) fn resolve_region(&self, image: ImageSpec) -> Result<PixelRect, CliError> {
        let whole = image.pixel_rect();
        let crop = self.crop.unwrap_or(whole);
        if whole.intersection(crop) != Some(crop) {
            let PixelRect { x, y, width, height } = crop;
            let PixelRect { width: across, height: down, .. } = whole;
            return Err(CliError::Usage(format!(
                "--crop {x},{y},{width},{height} is not in the picture, which has {across} x {down} pixels"
            )));
        }
        let Some([number, count]) = self.tile else { return Ok(crop) };
        let band = crop.nth_band(number - 1, count);
        if band.height == 0 {
            let rows = crop.height;
            return Err(CliError::Usage(format!(
                "--tile {number}/{count} has no row: there are {rows}"
            )));
        }
        Ok(band)
    }
}

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

fn parse_tile(text: &str) -> Result<[u32; 2], String> {
    let fault = || "expected I/N with I from 1 to N, such as 2/8".to_owned();
    let (number, count) = text.split_once('/').ok_or_else(fault)?;
    let [number, count] = [number, count].map(|word| word.trim().parse().ok());
    let (number, count): (u32, u32) = number.zip(count).ok_or_else(fault)?;
    (1..=count).contains(&number).then_some([number, count]).ok_or_else(fault)
}
