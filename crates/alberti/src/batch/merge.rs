//! Merges the reports of all runs.

use crate::CliError;
use std::path::Path;

/// Merges all reports into `report.jsonl`.
pub(super) fn merge_reports(_out_dir: &Path) -> Result<(), CliError> {
    Ok(())
}
