//! Comparison of two pictures, pixel by pixel, and a picture of the difference.

use crate::Picture;
use core::fmt;

/// The result of comparing two equally large pictures.
///
/// Encoded values are compared, not linear light. Fully transparent pixels are equal even if their
/// colors differ.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PictureComparison {
    /// The maximum channel difference over all pixels, 0 to 255.
    pub max_difference: u8,
    /// The number of pixels that differ by more than the tolerance.
    pub differing_pixels: usize,
    /// The number of pixels in the picture.
    pub total_pixels: usize,
    /// The maximum channel difference that counts as equal.
    pub tolerance: u8,
}

impl PictureComparison {
    /// Compares two equally large pictures, pixel by pixel.
    ///
    /// Pixels that only one of the pictures has are ignored.
    #[must_use]
    pub fn new(expected: &Picture, actual: &Picture, tolerance: u8) -> Self {
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
    #[must_use]
    pub const fn agrees(&self) -> bool {
        self.differing_pixels == 0
    }

    /// Returns the fraction of pixels that differ, from 0 to 1.
    ///
    /// An empty picture does not differ.
    #[must_use]
    pub fn differing_fraction(&self) -> f64 {
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

/// Returns the expected picture, the difference and the actual picture side by side.
///
/// The difference image is white where the pictures are equal, and turns from pink to dark red as
/// the difference grows.
///
/// The output is three times as wide as the pictures. The difference image is opaque even where the
/// pictures are transparent.
#[must_use]
pub fn side_by_side(expected: &Picture, actual: &Picture) -> Picture {
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
