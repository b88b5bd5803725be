//! Decoded pictures, and the difference between two of them.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// Eight-bit RGBA, rows from the top.
pub struct Picture {
    width: u32,
    height: u32,
    pixels: Vec<[u8; 4]>,
}

/// The difference between a golden and a picture.
pub enum Difference {
    /// Their sizes differ.
    Size(String),
    /// The number, bounds and magnitude of the differences, and a map of them: the faded golden,
    /// with differing pixels in red.
    Pixels { message: String, map: Picture },
}

impl Picture {
    /// Reads a PNG.
    pub fn read_png(path: &Path) -> Result<Self, String> {
        let (width, height, pixels) = alberti_tests::read_png(path)?;
        Ok(Self { width, height, pixels })
    }

    /// Writes the picture as a PNG.
    pub fn write_png(&self, path: &Path) -> Result<(), String> {
        let file = File::create(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let mut encoder = png::Encoder::new(BufWriter::new(file), self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header().map_err(|error| error.to_string())?;
        writer.write_image_data(self.pixels.as_flattened()).map_err(|error| error.to_string())
    }

    /// Returns the difference between `actual` and this golden, or `None` if all pixels are equal.
    pub fn difference(&self, actual: &Self) -> Option<Difference> {
        if (self.width, self.height) != (actual.width, actual.height) {
            let [golden, size] = [self, actual].map(|p| format!("{}×{}", p.width, p.height));
            return Some(Difference::Size(format!(
                "the golden has {golden} pixels, but the picture has {size}"
            )));
        }
        let pairs = || self.pixels.iter().zip(&actual.pixels);
        let differing: Vec<usize> =
            pairs().enumerate().filter(|(_, (a, b))| a != b).map(|(i, _)| i).collect();
        if differing.is_empty() {
            return None;
        }
        let pixels = pairs()
            .map(|(a, b)| if a == b { fade_color(*a) } else { [220, 20, 60, 255] })
            .collect();
        let map = Self { width: self.width, height: self.height, pixels };
        Some(Difference::Pixels { message: self.difference_message(actual, &differing), map })
    }

    fn difference_message(&self, actual: &Self, differing: &[usize]) -> String {
        let width = self.width as usize;
        let column = |i: &usize| i % width;
        let (left, right) = value_range(differing.iter().map(column));
        let (top, bottom) = value_range(differing.iter().map(|i| i / width));
        let first = differing[0];
        let most = differing.iter().map(|&i| largest_step(self.pixels[i], actual.pixels[i])).max();
        format!(
            "{} of {} pixels differ, by at most {} of 255, \
             in columns {left} to {right} and rows {top} to {bottom}; \
             the first is ({}, {}): {:?} in the golden, {:?} now",
            differing.len(),
            self.pixels.len(),
            most.unwrap_or(0),
            first % width,
            first / width,
            self.pixels[first],
            actual.pixels[first],
        )
    }
}

/// Fades a pixel toward white, to a quarter of its contrast, so that differences are easy to see.
fn fade_color([r, g, b, _]: [u8; 4]) -> [u8; 4] {
    let [r, g, b] = [r, g, b].map(|channel| 191 + channel / 4);
    [r, g, b, 255]
}

fn largest_step(a: [u8; 4], b: [u8; 4]) -> u8 {
    a.into_iter().zip(b).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
}

fn value_range(values: impl Iterator<Item = usize>) -> (usize, usize) {
    values.fold((usize::MAX, 0), |(low, high), value| (low.min(value), high.max(value)))
}
