//! `--compare`: image comparison of the rendered picture with a reference.
//!
//! Output is bit-exact on every machine, so the default tolerance is 0. A tolerance is meant for
//! references from other programs or older versions.
//!
//! The rendered picture and `NAME.compare.png` are written whether or not the pictures agree; the
//! exit code is the verdict.

use super::CliError;
use super::passes::sibling_path;
use files::visible_path;
use homog::PixelRect;
use pipeline::{AtomicFile, OutputError, Picture};
use std::fmt;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The reference picture and the tolerance.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Comparison")]
pub(crate) struct CompareArgs {
    /// Compare the picture with this reference; exit with 1 if they differ
    ///
    /// Prints the maximum difference and the fraction of differing pixels, and writes
    /// NAME.compare.png with reference, difference and picture side by side.
    #[arg(long, value_name = "PNG")]
    compare: Option<PathBuf>,
    /// Maximum channel difference of pixels that count as equal, from 0 to 255
    #[arg(long, value_name = "N", default_value_t = 0, requires = "compare")]
    tolerance: u8,
}

/// The result of comparing two equally large pictures.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct PictureComparison {
    /// The maximum channel difference over all pixels, 0 to 255.
    pub(super) max_difference: u8,
    /// The number of pixels that differ by more than the tolerance.
    pub(super) differing_pixels: usize,
    /// The number of pixels in the picture.
    pub(super) total_pixels: usize,
    /// The maximum channel difference that counts as equal.
    pub(super) tolerance: u8,
}

impl PictureComparison {
    /// Compares two equally large pictures, pixel by pixel.
    ///
    /// The caller guarantees equal sizes: references of other sizes are rejected before rendering.
    fn new(expected: &Picture, actual: &Picture, tolerance: u8) -> Self {
        let mut comparison = Self {
            max_difference: 0,
            differing_pixels: 0,
            total_pixels: actual.pixels.len(),
            tolerance,
        };
        for (expected, actual) in expected.pixels.iter().zip(&actual.pixels) {
            let difference = pixel_difference(*expected, *actual);
            comparison.max_difference = comparison.max_difference.max(difference);
            comparison.differing_pixels += usize::from(difference > tolerance);
        }
        comparison
    }

    /// Whether no pixel differs by more than the tolerance.
    pub(super) const fn agrees(&self) -> bool {
        self.differing_pixels == 0
    }

    /// Returns the fraction of pixels that differ, from 0 to 1.
    ///
    /// An empty picture does not differ.
    pub(super) fn differing_fraction(&self) -> f64 {
        self.differing_pixels as f64 / self.total_pixels.max(1) as f64
    }
}

/// ```text
/// compared: differs; the maximum difference is 12 of 255, and 0.0045% of the pixels (31) exceed
/// the tolerance of 0
/// ```
impl fmt::Display for PictureComparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { max_difference: greatest, differing_pixels: beyond, tolerance, .. } = self;
        let verdict = if self.agrees() { "agrees" } else { "differs" };
        let percent = 100.0 * self.differing_fraction();
        write!(
            f,
            "compared: {verdict}; the maximum difference is {greatest} of 255, and {percent:.4}% of the pixels ({beyond}) exceed the tolerance of {tolerance}"
        )
    }
}

/// Returns the maximum difference over the channels of two pixels. Fully transparent pixels are
/// equal even if their colors differ.
///
/// Encoded values are compared, not linear light: the difference is in the file's units, 0 to 255.
/// Alpha counts like any other channel.
fn pixel_difference(expected: [u8; 4], actual: [u8; 4]) -> u8 {
    if expected[3] == 0 && actual[3] == 0 {
        return 0;
    }
    (0..4).map(|k| expected[k].abs_diff(actual[k])).max().unwrap_or(0)
}

impl CompareArgs {
    /// Whether `--compare` is set.
    pub(super) const fn is_requested(&self) -> bool {
        self.compare.is_some()
    }

    /// Reads the reference picture, if `--compare` is set.
    ///
    /// Called before rendering, so that a wrong path wastes no time.
    ///
    /// # Errors
    /// Returns an error if the picture cannot be read, or its size is not the rendered region's.
    pub(super) fn load_reference(&self, region: PixelRect) -> Result<Option<Picture>, CliError> {
        let Some(path) = &self.compare else { return Ok(None) };
        let fault = |why: String| {
            CliError::Usage(format!("cannot compare with {}: {why}", visible_path(path)))
        };
        if !path.exists() {
            return Err(fault("the file does not exist".to_owned()));
        }
        let picture = read_reference(path, region).map_err(fault)?;
        Ok(Some(picture))
    }

    /// Compares the pictures and writes both and their difference to a temporary file.
    ///
    /// The file is returned with its final path.
    ///
    /// # Errors
    /// Returns an error if the temporary file cannot be created or written.
    pub(super) fn create_comparison(
        &self,
        expected: &Picture,
        actual: &Picture,
        output: &Path,
    ) -> Result<(PictureComparison, (PathBuf, AtomicFile)), CliError> {
        let comparison = PictureComparison::new(expected, actual, self.tolerance);
        let path = sibling_path(output, "compare", "png");
        let mut draft = AtomicFile::create(&path)?;
        let bytes = side_by_side(expected, actual).to_png();
        draft.write_all(&bytes).map_err(|cause| OutputError { path: path.clone(), cause })?;
        Ok((comparison, (path, draft)))
    }
}

/// Reads a PNG of the region's size as RGBA; 16-bit channels are rounded to 8 bits.
///
/// Palettes, gray and low bit depths are expanded, and a missing alpha channel is added. The size
/// is checked before the pixels are decoded. 16-bit codes `c` become `(c + 128) / 257`, the nearest
/// 8-bit code.
///
/// # Errors
/// Returns an error if the file cannot be read, is not a PNG, or has another size.
fn read_reference(path: &Path, region: PixelRect) -> Result<Picture, String> {
    let file = std::fs::File::open(path).map_err(|error| error.to_string())?;
    let mut decoder = png::Decoder::new(std::io::BufReader::new(file));
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::ALPHA);
    let not_png = |error| match error {
        png::DecodingError::Format(_) => "it is not a PNG file, or it is damaged".to_owned(),
        error => error.to_string(),
    };
    let mut reader = decoder.read_info().map_err(not_png)?;
    let (width, height) = (reader.info().width, reader.info().height);
    if (width, height) != (region.width, region.height) {
        let (across, down) = (region.width, region.height);
        return Err(format!(
            "its size is {width} x {height}, but the picture is {across} x {down}"
        ));
    }
    let mut bytes = vec![0; reader.output_buffer_size().ok_or("it is too large")?];
    let info = reader.next_frame(&mut bytes).map_err(not_png)?;
    let channels: Vec<u8> = if info.bit_depth == png::BitDepth::Sixteen {
        let halves = bytes.as_chunks::<2>().0.iter();
        halves.map(|&pair| ((u32::from(u16::from_be_bytes(pair)) + 128) / 257) as u8).collect()
    } else {
        bytes
    };
    let pixels = match info.color_type {
        png::ColorType::Rgba => channels.as_chunks::<4>().0.to_vec(),
        _ => channels
            .as_chunks::<2>()
            .0
            .iter()
            .map(|&[gray, alpha]| [gray, gray, gray, alpha])
            .collect(),
    };
    Ok(Picture { width, height, pixels })
}

/// Returns the expected picture, the difference and the actual picture side by side.
///
/// The difference image is white where the pictures are equal, and turns from pink to dark red as
/// the difference grows.
///
/// The output is three times as wide as the pictures. The difference image is opaque even where the
/// pictures are transparent.
fn side_by_side(expected: &Picture, actual: &Picture) -> Picture {
    let width = actual.width as usize;
    let rows = expected.pixels.chunks_exact(width).zip(actual.pixels.chunks_exact(width));
    let mut pixels = Vec::with_capacity(3 * actual.pixels.len());
    for (expected, actual) in rows {
        pixels.extend(expected);
        pixels.extend(expected.iter().zip(actual).map(|(expected, actual)| {
            // A jump from 255 to 191 keeps even a difference of 1 visible.
            let shade = match pixel_difference(*expected, *actual) {
                0 => 255,
                far => 191 - (f64::from(far) * 191.0 / 255.0) as u8,
            };
            [if shade == 255 { 255 } else { 255 - shade / 2 }, shade, shade, 255]
        }));
        pixels.extend(actual);
    }
    Picture { width: 3 * actual.width, height: actual.height, pixels }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transparent_pixels_are_equal() {
        assert_eq!(pixel_difference([9, 9, 9, 0], [0; 4]), 0);
        assert_eq!(pixel_difference([9, 9, 9, 255], [0, 20, 9, 254]), 11);
        let picture = |pixels: Vec<[u8; 4]>| Picture { width: 2, height: 1, pixels };
        let [a, b] = [picture(vec![[0; 4], [7; 4]]), picture(vec![[0; 4], [9, 7, 7, 7]])];
        let comparison = PictureComparison::new(&a, &b, 1);
        assert_eq!((comparison.max_difference, comparison.differing_pixels), (2, 1));
        assert!(!comparison.agrees());
        assert!(PictureComparison::new(&a, &b, 2).agrees());
        assert_eq!(side_by_side(&a, &b).pixels[2], [255; 4]);
        assert_ne!(side_by_side(&a, &b).pixels[3], [255; 4]);
    }
}
