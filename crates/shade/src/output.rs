//! Output files: written beside their place and renamed into it, so that a failed run leaves the old file as it was.

mod png_rows;

pub use png_rows::{PngRows, encode_png};

use crate::{Channel, Picture};
use std::fs::File;
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

impl<C: Channel> Picture<C> {
    /// The picture as a PNG file: RGB if it is opaque, RGBA with straight alpha otherwise, of as many bits as the picture has.
    #[must_use]
    pub fn to_png(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.pixels.len());
        let (size, opaque) = ([self.width, self.height], self.is_opaque());
        let written =
            encode_png(&mut bytes, size, opaque, C::BITS, |rows| rows.write_pixels(&self.pixels));
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
    let mut draft = AtomicFile::create(path)?;
    draft.write_all(bytes).map_err(|cause| OutputError { path: path.to_owned(), cause })?;
    draft.finish()
}

/// A file that is being written beside its place. It is gone if it is dropped before it is finished.
#[derive(Debug)]
pub struct AtomicFile {
    target_path: PathBuf,
    partial_path: PathBuf,
    file: File,
    is_finished: bool,
}

impl AtomicFile {
    /// Begins to write what is to be the file at `place`.
    ///
    /// # Errors
    /// If no file can be made there.
    pub fn create(place: &Path) -> Result<Self, OutputError> {
        let mut name = place.file_name().unwrap_or_default().to_owned();
        name.push(format!(".{}.part", std::process::id()));
        let beside = place.with_file_name(name);
        let file =
            File::create(&beside).map_err(|cause| OutputError { path: place.to_owned(), cause })?;
        Ok(Self { target_path: place.to_owned(), partial_path: beside, file, is_finished: false })
    }

    /// Puts the file in its place, whole.
    ///
    /// # Errors
    /// If it cannot be put there; a file that was there before is then as it was.
    pub fn finish(mut self) -> Result<(), OutputError> {
        let put = self
            .file
            .sync_all()
            .and_then(|()| std::fs::rename(&self.partial_path, &self.target_path));
        self.is_finished = put.is_ok();
        put.map_err(|cause| OutputError { path: self.target_path.clone(), cause })
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.flush()
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if !self.is_finished {
            // Whether there is anything to remove does not matter here.
            let _ = std::fs::remove_file(&self.partial_path);
        }
    }
}
