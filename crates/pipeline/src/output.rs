//! Output files: written beside their place and renamed into it, so that a failed run leaves the old file as it was.

use crate::Picture;
use std::io::Write;
use std::path::{Path, PathBuf};

/// An output file that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {cause}", path.display())]
pub struct OutputError {
    /// The file that was to be written.
    pub path: PathBuf,
    /// Why it could not be.
    pub cause: std::io::Error,
}

impl Picture {
    /// The picture as a PNG file: RGB if it is opaque, RGBA with straight alpha otherwise.
    #[must_use]
    pub fn to_png(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.pixels.len());
        let opaque = self.is_opaque();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(if opaque { png::ColorType::Rgb } else { png::ColorType::Rgba });
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_compression(png::Compression::Fast);
        let data = if opaque {
            self.pixels.iter().flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect::<Vec<u8>>()
        } else {
            self.pixels.as_flattened().to_vec()
        };
        let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&data));
        debug_assert!(written.is_ok(), "a picture always has width x height pixels: {written:?}");
        bytes
    }

    /// Writes the picture as a PNG file.
    ///
    /// # Errors
    /// If the file cannot be written; a file that was there before is then as it was.
    pub fn write_png(&self, path: &Path) -> Result<(), OutputError> {
        write_file(path, &self.to_png())
    }
}

/// Writes a file whole or not at all: beside its place first, then by renaming.
///
/// # Errors
/// If the file cannot be written; a file that was there before is then as it was.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    let fault = |cause| OutputError { path: path.to_owned(), cause };
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.part", std::process::id()));
    let beside = path.with_file_name(name);
    let written = std::fs::File::create(&beside)
        .and_then(|mut file| file.write_all(bytes).and_then(|()| file.sync_all()))
        .and_then(|()| std::fs::rename(&beside, path));
    written.map_err(|cause| {
        let _ = std::fs::remove_file(&beside);
        fault(cause)
    })
}
