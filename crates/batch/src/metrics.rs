//! The metrics of a run in Prometheus text format, for the textfile collector.
//!
//! The file is replaced as a whole, so that a collector never reads half of it.

use super::report::{FAILED, JobRecord, write_error};
use crate::BatchError;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// The upper bounds of the histogram in seconds.
const BOUNDS: [f64; 11] = [0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0];

/// The outcomes of a run's jobs.
#[derive(Clone, Copy, PartialEq, Default, Debug)]
pub struct RunCounts {
    /// Pictures that were rendered.
    pub rendered: u64,
    /// Pictures that were up to date.
    pub up_to_date: u64,
    /// Jobs that failed in this run.
    pub failed: u64,
    /// Jobs that failed in an earlier run.
    pub failed_before: u64,
    /// Workers that were replaced.
    pub restarts: u64,
    /// The size of the pictures that were rendered, in bytes.
    pub bytes: u64,
    /// The total job time of this run in seconds.
    pub seconds: f64,
    /// For each bound from 0.01 s to 1000 s, the number of jobs in this run that took at most that
    /// long, but longer than the previous bound.
    pub histogram: [u64; BOUNDS.len()],
}

impl RunCounts {
    /// Counts a job that was rendered or failed.
    pub(super) fn count_record(&mut self, record: &JobRecord) {
        *(if record.status == FAILED { &mut self.failed } else { &mut self.rendered }) += 1;
        self.bytes = self.bytes.saturating_add(record.bytes);
        self.seconds += record.seconds;
        if let Some(at) = BOUNDS.iter().position(|bound| record.seconds <= *bound) {
            self.histogram[at] += 1;
        }
    }

    /// Returns the number of jobs that are settled, in this run or an earlier one.
    pub(super) const fn settled(&self) -> u64 {
        self.worked() + self.up_to_date + self.failed_before
    }

    /// Returns the number of jobs of this run.
    pub(super) const fn worked(&self) -> u64 {
        self.rendered + self.failed
    }

    /// Returns the metrics as text. `elapsed` is the time since the start of the run, in seconds.
    fn to_metrics(self, elapsed: f64) -> String {
        let mut text = String::new();
        let jobs = [
            ("rendered", self.rendered),
            ("up_to_date", self.up_to_date),
            ("failed", self.failed),
            ("failed_before", self.failed_before),
        ];
        head(&mut text, "jobs_total", "counter", "Jobs finished in this run, by status.");
        for (status, count) in jobs {
            let _ = writeln!(text, "alberti_batch_jobs_total{{status=\"{status}\"}} {count}");
        }
        head(&mut text, "job_seconds", "histogram", "Time per job, including loading and writing.");
        // Prometheus buckets are cumulative.
        let mut below = 0;
        for (bound, count) in BOUNDS.iter().zip(self.histogram) {
            below += count;
            let _ = writeln!(text, "alberti_batch_job_seconds_bucket{{le=\"{bound}\"}} {below}");
        }
        let _ = writeln!(text, "alberti_batch_job_seconds_bucket{{le=\"+Inf\"}} {}", self.worked());
        let _ = writeln!(text, "alberti_batch_job_seconds_sum {}", self.seconds);
        let _ = writeln!(text, "alberti_batch_job_seconds_count {}", self.worked());
        head(
            &mut text,
            "picture_bytes_total",
            "counter",
            "Total size of the pictures in this run.",
        );
        let _ = writeln!(text, "alberti_batch_picture_bytes_total {}", self.bytes);
        head(&mut text, "worker_restarts_total", "counter", "Workers that were replaced.");
        let _ = writeln!(text, "alberti_batch_worker_restarts_total {}", self.restarts);
        head(&mut text, "run_seconds", "gauge", "Time since the start of the run.");
        let _ = writeln!(text, "alberti_batch_run_seconds {elapsed:.1}");
        text
    }
}

/// Adds the header of a metric: its description and its type.
fn head(text: &mut String, name: &str, kind: &str, help: &str) {
    let _ = writeln!(text, "# HELP alberti_batch_{name} {help}");
    let _ = writeln!(text, "# TYPE alberti_batch_{name} {kind}");
}

/// The `--metrics` file.
pub(super) struct MetricsFile {
    path: PathBuf,
}

impl MetricsFile {
    /// Creates a metrics file without writing it yet.
    pub(super) fn new(path: &Path) -> Self {
        Self { path: path.to_owned() }
    }

    /// Replaces the file.
    ///
    /// It is not flushed to disk, because the next version follows within a second.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub(super) fn write_counts(&self, counts: RunCounts, elapsed: f64) -> Result<(), BatchError> {
        let mut name = self.path.file_name().unwrap_or_default().to_owned();
        // A collector reads only files that end in .prom.
        name.push(format!(".{}.part", std::process::id()));
        let partial = self.path.with_file_name(name);
        let written = std::fs::write(&partial, counts.to_metrics(elapsed))
            .and_then(|()| std::fs::rename(&partial, &self.path));
        written.map_err(|cause| {
            let _ = std::fs::remove_file(&partial);
            write_error(&self.path, &cause)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_records::{ReportFolder, done_record, failed_record};

    #[test]
    fn buckets_are_cumulative_and_the_last_counts_all_jobs() {
        let mut counts = RunCounts { up_to_date: 5, restarts: 1, ..RunCounts::default() };
        for seconds in [0.005, 0.02, 0.5, 0.5, 5000.0] {
            let mut record = done_record("a.png", "k");
            record.seconds = seconds;
            counts.count_record(&record);
        }
        counts.count_record(&failed_record("b.png", "k"));
        assert_eq!((counts.worked(), counts.settled()), (6, 11));
        let text = counts.to_metrics(12.34);
        let value = |name: &str| -> f64 {
            let prefix = format!("alberti_batch_{name} ");
            let line = text.lines().find_map(|line| line.strip_prefix(&prefix)).expect("a metric");
            line.parse().expect("a number")
        };
        let bucket = |bound: &str| value(&format!("job_seconds_bucket{{le=\"{bound}\"}}"));
        let buckets = ["0.01", "0.03", "0.3", "1", "1000", "+Inf"].map(bucket);
        // A failure takes 0.25 s.
        assert_eq!(buckets, [1.0, 2.0, 3.0, 5.0, 5.0, 6.0]);
        assert_eq!(value("job_seconds_count"), 6.0);
        assert_eq!(value("job_seconds_sum"), 0.005 + 0.02 + 1.0 + 5000.0 + 0.25);
        assert_eq!(value("picture_bytes_total"), 500.0);
        assert_eq!(value("jobs_total{status=\"up_to_date\"}"), 5.0);
        assert_eq!((value("worker_restarts_total"), value("run_seconds")), (1.0, 12.3));
    }

    #[test]
    fn the_file_is_replaced() {
        let folder = ReportFolder::new("metrics");
        let file = MetricsFile::new(&folder.path().join("batch.prom"));
        file.write_counts(RunCounts::default(), 0.0).unwrap();
        let counts = RunCounts { rendered: 3, ..RunCounts::default() };
        file.write_counts(counts, 1.0).unwrap();
        assert_eq!(folder.read_text("batch.prom"), counts.to_metrics(1.0));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2, "no partial file is left");
        let nowhere = MetricsFile::new(&folder.path().join("nowhere/batch.prom"));
        assert!(nowhere.write_counts(counts, 1.0).is_err());
    }
}
