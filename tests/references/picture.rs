//! Pictures of red, green and blue, and what is written beside a reference.

use crate::score::largest_step;
use std::fs::File;
use std::io::{BufReader, BufWriter};
use std::path::Path;

/// Eight-bit sRGB, rows from the top.
#[derive(Clone, PartialEq, Debug)]
pub struct Picture {
    pub width: u32,
    pub height: u32,
    pub pixels: Vec<[u8; 3]>,
}

impl Picture {
    /// Reads a PNG; alpha is left out.
    pub fn read(path: &Path) -> Result<Self, String> {
        let with_path = |error: String| format!("{}: {error}", path.display());
        let file = File::open(path).map_err(|error| with_path(error.to_string()))?;
        decode(BufReader::new(file)).map_err(with_path)
    }

    /// Writes a PNG.
    pub fn write(&self, path: &Path) -> Result<(), String> {
        let with_path = |error: String| format!("{}: {error}", path.display());
        let file = File::create(path).map_err(|error| with_path(error.to_string()))?;
        let mut encoder = png::Encoder::new(BufWriter::new(file), self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header().map_err(|error| with_path(error.to_string()))?;
        let written = writer.write_image_data(self.pixels.as_flattened());
        written.map_err(|error| with_path(error.to_string()))
    }

    /// Ours, theirs and what differs, side by side. Differences are grey, eight times as bright as they are.
    pub fn beside(&self, theirs: &Self) -> Self {
        let width = self.width as usize;
        let mut pixels = Vec::with_capacity(3 * self.pixels.len());
        for (ours, theirs) in self.pixels.chunks(width).zip(theirs.pixels.chunks(width)) {
            pixels.extend_from_slice(ours);
            pixels.extend_from_slice(theirs);
            let difference = |(a, b): (&[u8; 3], &[u8; 3])| [largest_step(*a, *b); 3];
            let bright = |grey: [u8; 3]| grey.map(|channel| channel.saturating_mul(8));
            pixels.extend(ours.iter().zip(theirs).map(difference).map(bright));
        }
        Self { width: 3 * self.width, height: self.height, pixels }
    }
}

fn decode(source: BufReader<File>) -> Result<Picture, String> {
    let mut decoder = png::Decoder::new(source);
    decoder.set_transformations(
        png::Transformations::normalize_to_color8() | png::Transformations::ALPHA,
    );
    let mut reader = decoder.read_info().map_err(|error| error.to_string())?;
    let mut bytes = vec![0; reader.output_buffer_size().ok_or("too large")?];
    let info = reader.next_frame(&mut bytes).map_err(|error| error.to_string())?;
    let pixels = match info.color_type {
        png::ColorType::Rgba => bytes.as_chunks().0.iter().map(|&[r, g, b, _]| [r, g, b]).collect(),
        png::ColorType::GrayscaleAlpha => {
            bytes.as_chunks().0.iter().map(|&[grey, _]| [grey; 3]).collect()
        }
        other => return Err(format!("unexpected colour type {other:?}")),
    };
    Ok(Picture { width: info.width, height: info.height, pixels })
}
