//! Writes output files atomically: writes a temporary file next to the target, then renames it.
//!
//! A failed run leaves the old file unchanged, and no reader ever sees an incomplete file.

use crate::partial_files::{self, forget_partial_file};
use crate::visible_path;
use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// The error for an output file that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {}{}", visible_path(path), reason(cause), self.remedy())]
pub struct OutputError {
    /// The target file.
    pub path: PathBuf,
    /// The operating system's error.
    pub cause: std::io::Error,
}

/// Returns the operating system's message without the error number, which means nothing to most
/// readers.
fn reason(cause: &std::io::Error) -> String {
    let text = cause.to_string();
    let number = cause.raw_os_error().map(|code| format!(" (os error {code})"));
    number.and_then(|number| text.strip_suffix(&number).map(str::to_owned)).unwrap_or(text)
}

impl OutputError {
    /// Returns a help line if the folder is missing.
    fn remedy(&self) -> String {
        let folder = self.path.parent().filter(|folder| !folder.as_os_str().is_empty());
        match folder {
            Some(folder) if self.cause.kind() == ErrorKind::NotFound && !folder.exists() => {
                format!("\n  = help: create the folder `{}` first", visible_path(folder))
            }
            _ => String::new(),
        }
    }
}

/// Writes a file atomically: completely or not at all.
///
/// # Errors
/// Fails if the file cannot be written. An existing file then stays unchanged.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    let mut file = AtomicFile::create(path)?;
    file.write_all(bytes).map_err(|cause| OutputError { path: path.to_owned(), cause })?;
    file.finish()
}

/// A temporary file that replaces the target next to it when finished. Dropping this value earlier
/// removes the file.
#[derive(Debug)]
pub struct AtomicFile {
    /// The file to replace when the temporary file is finished.
    target_path: PathBuf,
    /// The temporary file: the target's name followed by the process id and `.part`.
    partial_path: PathBuf,
    file: File,
    /// Whether the file was renamed, so that it must not be removed.
    is_finished: bool,
}

impl AtomicFile {
    /// Creates the temporary file for a target, and removes temporary files left by dead processes.
    ///
    /// # Errors
    /// Fails if no file can be created in the target's folder.
    pub fn create(target: &Path) -> Result<Self, OutputError> {
        let target_path = target.to_owned();
        match partial_files::create(target) {
            Ok((partial_path, file)) => {
                Ok(Self { target_path, partial_path, file, is_finished: false })
            }
            Err(cause) => Err(OutputError { path: target_path, cause }),
        }
    }

    /// Flushes the file to disk and renames it to the target.
    ///
    /// # Errors
    /// Fails if the file cannot be flushed or renamed. An existing file then stays unchanged.
    pub fn finish(mut self) -> Result<(), OutputError> {
        // Data reaches the disk before the name does, so a crash leaves either the old or the new
        // file intact.
        let renamed = self
            .file
            .sync_all()
            .and_then(|()| std::fs::rename(&self.partial_path, &self.target_path));
        self.is_finished = renamed.is_ok();
        if self.is_finished {
            forget_partial_file(&self.partial_path);
        }
        renamed.map_err(|cause| OutputError { path: self.target_path.clone(), cause })
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
            partial_files::remove(&self.partial_path);
        }
    }
}
