//! RGB pictures, read from and written to PNG.

use crate::references::score::largest_step;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// An 8-bit sRGB picture, with rows from the top.
#[derive(Clone, PartialEq, Debug)]
pub struct Picture {
    pub width: u32,
    pub height: u32,
    pub pixels: Vec<[u8; 3]>,
}

impl Picture {
    /// Reads a PNG and drops its alpha.
    pub fn read_png(path: &Path) -> Result<Self, String> {
        let (width, height, pixels) = alberti_tests::read_png(path)?;
        Ok(Self {
            width,
            height,
            pixels: pixels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect(),
        })
    }

    /// Writes a PNG.
    pub fn write_png(&self, path: &Path) -> Result<(), String> {
        let with_path = |error: String| format!("{}: {error}", path.display());
        let file = File::create(path).map_err(|error| with_path(error.to_string()))?;
        let mut encoder = png::Encoder::new(BufWriter::new(file), self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header().map_err(|error| with_path(error.to_string()))?;
        let written = writer.write_image_data(self.pixels.as_flattened());
        written.map_err(|error| with_path(error.to_string()))
    }

    /// Returns our picture, the reference and their difference side by side. The difference is gray
    /// and multiplied by eight.
    pub fn side_by_side(&self, theirs: &Self) -> Self {
        let width = self.width as usize;
        let mut pixels = Vec::with_capacity(3 * self.pixels.len());
        for (ours, theirs) in self.pixels.chunks(width).zip(theirs.pixels.chunks(width)) {
            pixels.extend_from_slice(ours);
            pixels.extend_from_slice(theirs);
            let difference = |(a, b): (&[u8; 3], &[u8; 3])| [largest_step(*a, *b); 3];
            let bright = |gray: [u8; 3]| gray.map(|channel| channel.saturating_mul(8));
            pixels.extend(ours.iter().zip(theirs).map(difference).map(bright));
        }
        Self { width: 3 * self.width, height: self.height, pixels }
    }
}
