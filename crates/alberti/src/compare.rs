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
use picture::{Picture, PictureComparison};
use pipeline::{AtomicFile, OutputError};
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
        let picture = picture::read_png(path, (region.width, region.height))
            .map_err(|error| fault(error.to_string()))?;
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
        let bytes = picture::side_by_side(expected, actual).to_png();
        draft.write_all(&bytes).map_err(|cause| OutputError { path: path.clone(), cause })?;
        Ok((comparison, (path, draft)))
    }
}
