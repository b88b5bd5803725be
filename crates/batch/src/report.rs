//! The report of a run: one line of JSON per picture, appended as soon as it is finished.
//!
//! Every run writes its own file, `OUT/reports/I-of-N.HOST.PID.RUN.jsonl`, and no file is ever
//! shared by two runs or rewritten. This is safe on network file systems without locks, and if the
//! same shard is started twice at once. A run that is killed leaves the records of its finished
//! jobs.
//!
//! ```text
//! {"input":"models/fox.glb","output":"fox.png","status":"done","key":"90a1…","seconds":0.41,
//!  "warnings":0,"message":"","bytes":20117,"sha256":"5d02…"}
//! ```
//!
//! `RUN` is one more than the highest number in the folder. It determines which records are newer,
//! because the clocks of different machines may disagree.

use super::Shard;
use super::left_over::remove_left_over;
use crate::BatchError;
use files::visible_path;
use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The report folder, below the output folder.
pub(super) const REPORTS_FOLDER: &str = "reports";
/// The time after which records are flushed to disk. A power failure loses at most this much work.
const SYNC_INTERVAL: Duration = Duration::from_secs(5);
/// The maximum length of a host name in a report name.
const MAX_HOST_LENGTH: usize = 64;

/// The outcome of one job.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub(super) struct JobRecord {
    /// The path of the input, as specified.
    pub(super) input: String,
    /// The path of the picture below the output folder.
    pub(super) output: String,
    /// `done` or `failed`.
    pub(super) status: String,
    /// The key of the content from which the picture was rendered.
    ///
    /// A job whose key has changed is run again.
    pub(super) key: String,
    /// Time in seconds, including loading and writing.
    pub(super) seconds: f64,
    /// The number of warnings.
    pub(super) warnings: usize,
    /// The error, or the first warning.
    pub(super) message: String,
    /// The size of the picture in bytes; 0 if the job failed.
    pub(super) bytes: u64,
    /// The SHA-256 of the picture in hexadecimal; empty if the job failed.
    pub(super) sha256: String,
    /// The tar file below the output folder that contains the picture, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) tar: Option<String>,
}

/// The status of a picture that was rendered.
pub(super) const DONE: &str = "done";
/// The status of a job that failed.
pub(super) const FAILED: &str = "failed";

impl JobRecord {
    /// Returns the record as one line of JSON.
    ///
    /// A time that is not finite, which no clock reports, is written as `null`.
    pub(super) fn to_line(&self) -> String {
        // The type has only strings and numbers, which can always be serialized.
        let mut line = serde_json::to_string(self).unwrap_or_default();
        line.push('\n');
        line
    }
}

/// The report of a run, shared by the threads.
pub(super) struct ReportWriter {
    /// The name of the run: shard, host, process, number.
    run_name: String,
    /// The path of the report.
    path: PathBuf,
    /// The open report; a lock keeps lines from different threads apart.
    open: Mutex<OpenReport>,
}

/// A report open for appending.
struct OpenReport {
    file: File,
    /// Whether the report contains a record.
    has_records: bool,
    /// The time of the last flush to disk.
    synced: Instant,
}

impl ReportWriter {
    /// Creates a report that no other run uses, and the report folder; removes files that killed
    /// runs left there.
    ///
    /// # Errors
    /// Returns an error before any work is done if the file cannot be created.
    pub(super) fn create(out_dir: &Path, shard: Shard) -> Result<Self, BatchError> {
        let folder = out_dir.join(REPORTS_FOLDER);
        std::fs::create_dir_all(&folder).map_err(|cause| write_error(&folder, &cause))?;
        remove_left_over(&folder);
        let prefix = format!("{}.{}.{}", shard.file_name_part(), host_name(), std::process::id());
        let mut run = last_run(&folder).map_err(|cause| write_error(&folder, &cause))?;
        loop {
            run = run.saturating_add(1);
            let run_name = format!("{prefix}.{run}");
            let path = folder.join(format!("{run_name}.jsonl"));
            match OpenOptions::new().append(true).create_new(true).open(&path) {
                Ok(file) => {
                    let open = OpenReport { file, has_records: false, synced: Instant::now() };
                    return Ok(Self { run_name, path, open: Mutex::new(open) });
                }
                // Another host with this name, such as a container, has a process with this ID.
                Err(cause) if cause.kind() == ErrorKind::AlreadyExists && run < u64::MAX => {}
                Err(cause) => return Err(write_error(&path, &cause)),
            }
        }
    }

    /// Returns the name of the run, which is unique in the output folder.
    pub(super) fn run_name(&self) -> &str {
        &self.run_name
    }

    /// Appends a record, which must belong to a finished picture or a failed job.
    ///
    /// The line is written in one call and not buffered: after a crash, at most the last line is
    /// incomplete. A poisoned lock is ignored, because a panic in another thread leaves no
    /// half-written state.
    ///
    /// # Errors
    /// Returns an error if the record cannot be written, for example because the disk is full.
    pub(super) fn append_record(&self, record: &JobRecord) -> Result<(), BatchError> {
        self.append_records(std::slice::from_ref(record))
    }

    /// Appends several records in one call.
    ///
    /// # Errors
    /// Returns an error if the records cannot be written; the report may then contain some of them.
    pub(super) fn append_records(&self, records: &[JobRecord]) -> Result<(), BatchError> {
        let lines: String = records.iter().map(JobRecord::to_line).collect();
        let mut open = self.open.lock().unwrap_or_else(PoisonError::into_inner);
        open.has_records |= !records.is_empty();
        let mut written = open.file.write_all(lines.as_bytes());
        if open.synced.elapsed() >= SYNC_INTERVAL {
            written = written.and_then(|()| open.file.sync_data());
            open.synced = Instant::now();
        }
        written.map_err(|cause| write_error(&self.path, &cause))
    }

    /// Flushes the report to disk; an empty report is removed.
    ///
    /// # Errors
    /// Returns an error if the report cannot be written.
    pub(super) fn finish(self) -> Result<(), BatchError> {
        let open = self.open.into_inner().unwrap_or_else(PoisonError::into_inner);
        if open.has_records {
            return open.file.sync_all().map_err(|cause| write_error(&self.path, &cause));
        }
        drop(open);
        // If an empty report remains, readers find no records in it.
        let _ = std::fs::remove_file(&self.path);
        Ok(())
    }
}

/// Returns the error for a file or folder that cannot be written.
pub(super) fn write_error(path: &Path, cause: &std::io::Error) -> BatchError {
    BatchError::Unusable(format!("cannot write {}: {cause}", visible_path(path)))
}

/// Returns the run number in a report name: the part before the extension.
///
/// ```text
/// 2-of-8.node17.4711.3.jsonl  ─►  3
/// ```
pub(super) fn run_number(path: &Path) -> u64 {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    stem.rsplit('.').next().and_then(|number| number.parse().ok()).unwrap_or(0)
}

/// Returns the highest run number among the reports in a folder, or 0 if there are none.
fn last_run(folder: &Path) -> std::io::Result<u64> {
    let mut last = 0;
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "jsonl") {
            last = last.max(run_number(&path));
        }
    }
    Ok(last)
}

/// Returns the name of this machine, for file names, or `host` if unknown.
///
/// Only letters, digits and `-` are kept. The name need not be unique, but helps to find the
/// machine that wrote a record.
pub(super) fn host_name() -> String {
    let name = std::fs::read_to_string("/proc/sys/kernel/hostname").ok();
    let name = name.or_else(|| std::env::var("COMPUTERNAME").ok()).unwrap_or_default();
    let allowed = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
    let name: String = name.trim().chars().take(MAX_HOST_LENGTH).map(allowed).collect();
    if name.is_empty() { "host".to_owned() } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_records::{ReportFolder, done_record};

    #[test]
    fn a_line_has_all_members_and_no_others() {
        let mut record = done_record("a \"b\"\n.png", "k1");
        let line = record.to_line();
        assert!(line.ends_with("}\n") && line.matches('\n').count() == 1, "{line}");
        let json: serde_json::Value = serde_json::from_str(&line).unwrap();
        assert_eq!(json["output"], "a \"b\"\n.png");
        assert_eq!(json.as_object().unwrap().len(), 9);
        record.tar = Some("shard-1-of-1-000000.tar".to_owned());
        assert!(record.to_line().contains("\"tar\":\"shard-1-of-1-000000.tar\""));
    }

    #[test]
    fn concurrent_runs_have_separate_reports_and_later_runs_have_higher_numbers() {
        let folder = ReportFolder::new("writer");
        let out = folder.path();
        let first = ReportWriter::create(out, Shard::ALL_JOBS).unwrap();
        let second = ReportWriter::create(out, Shard::ALL_JOBS).unwrap();
        assert_ne!(first.run_name(), second.run_name());
        assert!(run_number(&first.path) < run_number(&second.path));
        first.append_record(&done_record("a.png", "k")).unwrap();
        let kept = first.path.clone();
        first.finish().unwrap();
        second.finish().unwrap();
        let left: Vec<_> = std::fs::read_dir(out.join(REPORTS_FOLDER)).unwrap().collect();
        assert_eq!(left.len(), 1, "an empty report is removed");
        assert_eq!(std::fs::read_to_string(kept).unwrap(), done_record("a.png", "k").to_line());
    }

    #[test]
    fn report_names_have_a_run_number_and_a_plain_host_name() {
        assert_eq!(run_number(Path::new("2-of-8.node17.4711.3.jsonl")), 3);
        assert_eq!(run_number(Path::new("report.jsonl")), 0);
        assert!(host_name().chars().all(|c| c.is_ascii_alphanumeric() || c == '-'));
    }
}
