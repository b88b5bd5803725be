//! Progress of a batch.

use super::report::{FAILED, JobRecord};
use crate::CliError;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

/// Counts the jobs and shows how far the run is.
#[derive(Default)]
pub(super) struct RunProgress {
    rendered: AtomicU64,
    up_to_date: AtomicU64,
    failed: AtomicU64,
    failed_before: AtomicU64,
}

/// How the jobs of a run ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct RunCounts {
    /// Pictures that were rendered.
    pub(super) rendered: u64,
    /// Pictures that were up to date.
    pub(super) up_to_date: u64,
    /// Jobs that failed in this run.
    pub(super) failed: u64,
    /// Jobs that had failed in an earlier run.
    pub(super) failed_before: u64,
}

impl RunProgress {
    /// Starts to count.
    pub(super) fn start(_metrics: Option<&Path>) -> Self {
        Self::default()
    }

    /// Says which part of the inputs was read, from 0 to 1.
    pub(super) fn set_fraction(&self, _fraction: f64) {}

    /// Counts a job of this run.
    pub(super) fn count_record(&self, record: &JobRecord) {
        let count = if record.status == FAILED { &self.failed } else { &self.rendered };
        count.fetch_add(1, Ordering::Relaxed);
    }

    /// Counts a job of an earlier run.
    pub(super) fn count_earlier(&self, failed: bool) {
        let count = if failed { &self.failed_before } else { &self.up_to_date };
        count.fetch_add(1, Ordering::Relaxed);
    }

    /// Counts a worker that was replaced.
    pub(super) fn count_restart(&self) {}

    /// Ends the display.
    pub(super) fn finish(self) -> Result<RunCounts, CliError> {
        Ok(RunCounts {
            rendered: self.rendered.into_inner(),
            up_to_date: self.up_to_date.into_inner(),
            failed: self.failed.into_inner(),
            failed_before: self.failed_before.into_inner(),
        })
    }
}
