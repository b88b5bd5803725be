//! `--compare`: the picture against one that it should be.

use super::CliError;
use super::passes::sibling_path;
use homog::PixelRect;
use pipeline::{AtomicFile, OutputError, Picture};
use std::fmt;
use std::io::Write;
use std::path::{Path, PathBuf};

/// What the picture is compared with.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Comparison")]
pub(crate) struct CompareArgs {
    /// Compare the picture with this one: tell the greatest difference and the share of other pixels, write NAME.compare.png with
    /// expected, difference and actual side by side, and end with 1 if a pixel is farther off than --tolerance
    #[arg(long, value_name = "PNG")]
    compare: Option<PathBuf>,
    /// The greatest difference of a channel that counts as none, of 255
    #[arg(long, value_name = "N", default_value_t = 0, requires = "compare")]
    tolerance: u8,
}

/// What was found.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct PictureComparison {
    /// The greatest difference of a channel, of 255.
    pub(super) max_difference: u8,
    /// How many pixels differ by more than the tolerance.
    pub(super) differing_pixels: usize,
    /// How many pixels there are.
    pub(super) total_pixels: usize,
    pub(super) tolerance: u8,
}

impl PictureComparison {
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

    /// Whether no pixel is farther off than the tolerance.
    pub(super) const fn agrees(&self) -> bool {
        self.differing_pixels == 0
    }

    /// The share of pixels that are farther off.
    pub(super) fn differing_fraction(&self) -> f64 {
        self.differing_pixels as f64 / self.total_pixels.max(1) as f64
    }
}

impl fmt::Display for PictureComparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { max_difference: greatest, differing_pixels: beyond, tolerance, .. } = self;
        let verdict = if self.agrees() { "agrees" } else { "differs" };
        let percent = 100.0 * self.differing_fraction();
        write!(
            f,
            "compared: {verdict}; greatest difference {greatest} of 255, {beyond} pixels ({percent:.4} %) beyond {tolerance}"
        )
    }
}

/// How far two pixels are apart in their farthest channel. What nobody sees has no colour.
fn pixel_difference(expected: [u8; 4], actual: [u8; 4]) -> u8 {
    if expected[3] == 0 && actual[3] == 0 {
        return 0;
    }
    (0..4).map(|k| expected[k].abs_diff(actual[k])).max().unwrap_or(0)
}

impl CompareArgs {
    pub(super) const fn is_requested(&self) -> bool {
        self.compare.is_some()
    }

    /// The picture that is expected, if one is named.
    pub(super) fn load_reference(&self, region: PixelRect) -> Result<Option<Picture>, CliError> {
        let Some(path) = &self.compare else { return Ok(None) };
        let fault =
            |why: String| CliError::Usage(format!("cannot compare with {}: {why}", path.display()));
        let picture = read_reference(path, region).map_err(fault)?;
        Ok(Some(picture))
    }

    /// Compares, and writes expected, difference and actual side by side.
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

/// A picture of the size of the region; 16 bits are rounded to 8.
fn read_reference(path: &Path, region: PixelRect) -> Result<Picture, String> {
    let file = std::fs::File::open(path).map_err(|error| error.to_string())?;
    let mut decoder = png::Decoder::new(std::io::BufReader::new(file));
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::ALPHA);
    let mut reader = decoder.read_info().map_err(|error| error.to_string())?;
    let (width, height) = (reader.info().width, reader.info().height);
    if (width, height) != (region.width, region.height) {
        let (across, down) = (region.width, region.height);
        return Err(format!(
            "it has {width} x {height} pixels, and the picture has {across} x {down}"
        ));
    }
    let mut bytes = vec![0; reader.output_buffer_size().ok_or("it is too large")?];
    let info = reader.next_frame(&mut bytes).map_err(|error| error.to_string())?;
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

/// Expected, difference, actual. The difference is white where the pictures agree, and the blacker the farther they are apart.
fn side_by_side(expected: &Picture, actual: &Picture) -> Picture {
    let width = actual.width as usize;
    let rows = expected.pixels.chunks_exact(width).zip(actual.pixels.chunks_exact(width));
    let mut pixels = Vec::with_capacity(3 * actual.pixels.len());
    for (expected, actual) in rows {
        pixels.extend(expected);
        pixels.extend(expected.iter().zip(actual).map(|(expected, actual)| {
            // Even the least difference can be seen.
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
    fn what_nobody_sees_does_not_differ() {
        assert_eq!(pixel_difference([9, 9, 9, 0], [0; 4]), 0);
        assert_eq!(pixel_difference([9, 9, 9, 255], [0, 20, 9, 254]), 11);
        let picture = |pixels: Vec<[u8; 4]>| Picture { width: 2, height: 1, pixels };
        let [a, b] = [picture(vec![[0; 4], [7; 4]]), picture(vec![[0; 4], [9, 7, 7, 7]])];
        let found = PictureComparison::new(&a, &b, 1);
        assert_eq!((found.max_difference, found.differing_pixels, found.agrees()), (2, 1, false));
        assert!(PictureComparison::new(&a, &b, 2).agrees());
        assert_eq!(side_by_side(&a, &b).pixels[2], [255; 4]);
        assert_ne!(side_by_side(&a, &b).pixels[3], [255; 4]);
    }
}
