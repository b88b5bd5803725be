//! Pictures in tar files.

use super::report::{JobRecord, ReportWriter};
use crate::CliError;
use std::path::Path;

/// The tar files of a run.
pub(super) struct TarOutput;

impl TarOutput {
    /// Tar files of so many pictures each.
    pub(super) fn new(_out_dir: &Path, _run_name: &str, _samples: u32) -> Self {
        Self
    }

    /// Adds a picture.
    pub(super) fn add_sample(
        &self,
        record: JobRecord,
        _png: &[u8],
        report: &ReportWriter,
    ) -> Result<(), CliError> {
        report.append_record(&record)
    }

    /// Completes the last file.
    pub(super) fn finish(self, _report: &ReportWriter) -> Result<(), CliError> {
        Ok(())
    }
}
