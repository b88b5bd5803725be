//! Pictures as PNG, JPEG and WebP. All encoders use integer arithmetic, so the bytes are the same
//! on every machine.

use super::OutputFormat;
use crate::CliError;
use image_webp::{ColorType, WebPEncoder};
use jpeg_encoder::Encoder;
use pipeline::Picture;

/// The default quality of a JPEG.
pub(crate) const DEFAULT_QUALITY: u8 = 90;
/// The maximum side length of a JPEG in pixels; [`MAX_WEBP_SIDE`] is the same for WebP.
const MAX_JPEG_SIDE: u32 = 65_535;
const MAX_WEBP_SIDE: u32 = 16_384;

impl OutputFormat {
    /// Whether this format stores pixels.
    pub(crate) const fn is_raster(self) -> bool {
        matches!(self, Self::Png | Self::Jpeg | Self::Webp)
    }

    /// Encodes a picture with 8 bits per channel as a file.
    ///
    /// A JPEG has no alpha: transparent pixels become white.
    ///
    /// # Errors
    /// Returns an error if a side of the picture exceeds the limit of the format.
    pub(crate) fn encode_picture(
        self,
        picture: &Picture,
        quality: u8,
    ) -> Result<Vec<u8>, CliError> {
        self.check_size([picture.width, picture.height])?;
        let failed = |error: &dyn std::fmt::Display| CliError::Usage(format!("{self:?}: {error}"));
        let mut bytes = Vec::new();
        match self {
            Self::Jpeg => {
                let pixels: Vec<u8> =
                    picture.pixels.iter().flat_map(|pixel| over_white(*pixel)).collect();
                let [width, height] = [picture.width, picture.height].map(|side| side as u16);
                let mut encoder = Encoder::new(&mut bytes, quality);
                encoder.set_optimized_huffman_tables(true);
                let written = encoder.encode(&pixels, width, height, jpeg_encoder::ColorType::Rgb);
                written.map_err(|error| failed(&error))?;
            }
            Self::Webp => {
                let pixels = picture.pixels.as_flattened();
                let encoder = WebPEncoder::new(&mut bytes);
                let written =
                    encoder.encode(pixels, picture.width, picture.height, ColorType::Rgba8);
                written.map_err(|error| failed(&error))?;
            }
            _ => bytes = picture.to_png(),
        }
        Ok(bytes)
    }

    /// Refuses a size that exceeds the limit of the format.
    ///
    /// # Errors
    /// Returns the same size error as [`encode_picture`](Self::encode_picture).
    pub(crate) fn check_size(self, [width, height]: [u32; 2]) -> Result<(), CliError> {
        let (name, most) = match self {
            Self::Jpeg => ("JPEG", MAX_JPEG_SIDE),
            Self::Webp => ("WebP", MAX_WEBP_SIDE),
            _ => return Ok(()),
        };
        if width.max(height) <= most {
            return Ok(());
        }
        Err(CliError::Usage(format!(
            "a {name} can have at most {most} pixels per side, but the picture is {width} x {height}\n  = help: write a .png"
        )))
    }
}

/// Blends a color over white paper.
fn over_white([r, g, b, alpha]: [u8; 4]) -> [u8; 3] {
    let alpha = u32::from(alpha);
    // Rounded to the nearest code.
    [r, g, b].map(|code| ((u32::from(code) * alpha + 255 * (255 - alpha) + 127) / 255) as u8)
}

/// Parses a quality from 1 to 100.
pub(crate) fn parse_quality(text: &str) -> Result<u8, String> {
    let quality = text.parse().ok().filter(|quality| (1..=100).contains(quality));
    quality.ok_or_else(|| "expected a whole number from 1 to 100".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transparent_pixels_are_white_in_a_jpeg() {
        assert_eq!(over_white([10, 20, 30, 255]), [10, 20, 30]);
        assert_eq!(over_white([10, 20, 30, 0]), [255; 3]);
        assert_eq!(over_white([0, 100, 255, 128]), [127, 177, 255]);
    }

    #[test]
    fn files_begin_with_their_format_signatures() {
        let mut picture = Picture::<u8>::default();
        picture.resize(3, 2);
        picture.pixels.fill([200, 100, 50, 255]);
        let encode = |format: OutputFormat| format.encode_picture(&picture, 90).unwrap();
        assert!(encode(OutputFormat::Jpeg).starts_with(&[0xFF, 0xD8, 0xFF]));
        let webp = encode(OutputFormat::Webp);
        assert!(webp.starts_with(b"RIFF") && &webp[8..12] == b"WEBP");
        assert!(OutputFormat::Jpeg.check_size([65_536, 1]).is_err());
    }
}
