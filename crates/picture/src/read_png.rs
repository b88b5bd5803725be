//! Reads PNG files, such as the reference of a comparison.

use crate::Picture;
use std::fs::File;
use std::io::{self, BufReader};
use std::path::Path;

/// The error for a file that cannot be read as a picture of the expected size.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadPngError {
    /// The file cannot be opened or read.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// The file is not a PNG file, or it is damaged.
    #[error("it is not a PNG file, or it is damaged")]
    NotPng,
    /// The picture has another size.
    #[error("its size is {} x {}, but the picture is {} x {}", found.0, found.1, expected.0, expected.1)]
    WrongSize {
        /// The width and height of the file's picture.
        found: (u32, u32),
        /// The expected width and height.
        expected: (u32, u32),
    },
    /// The picture does not fit in memory.
    #[error("it is too large")]
    TooLarge,
}

/// Reads a PNG file of a known width and height as RGBA; 16-bit channels are rounded to 8 bits.
///
/// Palettes, gray and low bit depths are expanded, and a missing alpha channel is added. The size
/// is checked before the pixels are decoded. 16-bit codes `c` become `(c + 128) / 257`, the nearest
/// 8-bit code.
///
/// # Errors
/// Returns an error if the file cannot be read, is not a PNG, or has another size.
pub fn read_png(path: &Path, size: (u32, u32)) -> Result<Picture, ReadPngError> {
    let file = File::open(path)?;
    let mut decoder = png::Decoder::new(BufReader::new(file));
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::ALPHA);
    let mut reader = decoder.read_info().map_err(decoding_error)?;
    let found = (reader.info().width, reader.info().height);
    if found != size {
        return Err(ReadPngError::WrongSize { found, expected: size });
    }
    let mut bytes = vec![0; reader.output_buffer_size().ok_or(ReadPngError::TooLarge)?];
    let info = reader.next_frame(&mut bytes).map_err(decoding_error)?;
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
    let (width, height) = found;
    Ok(Picture { width, height, pixels })
}

/// Returns the error for a file that the decoder rejects.
fn decoding_error(error: png::DecodingError) -> ReadPngError {
    match error {
        png::DecodingError::IoError(error) => ReadPngError::Io(error),
        png::DecodingError::LimitsExceeded => ReadPngError::TooLarge,
        _ => ReadPngError::NotPng,
    }
}
