//! The report of a batch: one line of JSON per job, appended as soon as the job is finished.
//!
//! A run that is killed therefore leaves a record of what it has done. When a run ends, its report
//! is rewritten in the order of the jobs.
//!
//! ```text
//! {"input":"models/fox.glb","key":"90a1…","message":"","output":"fox.png",
//!  "seconds":0.41,"status":"done","warnings":0}
//! ```
//! A line is parsed only if it has all of these members. A line of an older program that lacks one
//! is ignored, and its job is run again.

use super::Shard;
use crate::CliError;
use serde_json::{Value, json};
use std::fs::{File, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// The outcome of one job.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct JobRecord {
    /// The path of the input, as it was given.
    pub(super) input: String,
    /// The path of the picture below the output folder.
    pub(super) output: String,
    /// `done`, `done before` or `failed`.
    ///
    /// Only `failed` makes the next run try again.
    pub(super) status: String,
    /// The content key that the picture was rendered from.
    ///
    /// A job whose key has changed is run again.
    pub(super) key: String,
    /// Time in seconds.
    ///
    /// It includes loading and writing. A record of an earlier run keeps its time.
    pub(super) seconds: f64,
    /// The number of warnings.
    pub(super) warnings: usize,
    /// The error, or the first warning.
    pub(super) message: String,
}

/// The status of a picture that was rendered by this run.
pub(super) const DONE: &str = "done";
/// The status of a picture that was up to date.
pub(super) const DONE_BEFORE: &str = "done before";
/// The status of a job that failed.
pub(super) const FAILED: &str = "failed";

impl JobRecord {
    /// The record as one line of JSON.
    fn to_line(&self) -> String {
        let Self { input, output, status, key, seconds, warnings, message } = self;
        let json = json!({"input": input, "output": output, "status": status, "key": key,
            "seconds": seconds, "warnings": warnings, "message": message});
        format!("{json}\n")
    }

    /// Parses a line of a report; `None` if it is truncated or of another schema.
    ///
    /// Further members are ignored, so reports of newer versions can be read.
    fn from_line(line: &str) -> Option<Self> {
        let json: Value = serde_json::from_str(line).ok()?;
        let word = |name: &str| Some(json.get(name)?.as_str()?.to_owned());
        Some(Self {
            input: word("input")?,
            output: word("output")?,
            status: word("status")?,
            key: word("key")?,
            seconds: json.get("seconds")?.as_f64()?,
            warnings: usize::try_from(json.get("warnings")?.as_u64()?).ok()?,
            message: word("message")?,
        })
    }
}

/// A report that is being written, shared by the worker threads.
///
/// The file is opened once and appended to; the operating system keeps what was written even if the
/// process is killed.
pub(super) struct BatchReport {
    /// The path of the report, to which it is rewritten at the end.
    path: PathBuf,
    /// The open report; a lock keeps the lines of several threads apart.
    file: Mutex<File>,
}

impl BatchReport {
    /// Opens the report of a shard for appending.
    ///
    /// An empty line is written first and skipped by readers.
    ///
    /// # Errors
    /// If the file cannot be created or written, which is noticed here, before any work is done.
    pub(super) fn open_report(folder: &Path, shard: Shard) -> Result<Self, CliError> {
        let path = folder.join(format!("report{}.jsonl", shard.file_suffix()));
        let file = OpenOptions::new().create(true).append(true).open(&path);
        let fault = |cause| CliError::Usage(format!("cannot write {}: {cause}", path.display()));
        let mut file = file.map_err(fault)?;
        // A killed run may have left an incomplete line.
        file.write_all(b"\n")?;
        Ok(Self { path, file: Mutex::new(file) })
    }

    /// Appends a record.
    ///
    /// The line is written in one call and not buffered: after a crash, at most the last line is
    /// incomplete. A poisoned lock is ignored, because a panic of another thread leaves no
    /// half-written state behind.
    pub(super) fn append_record(&self, record: &JobRecord) {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        // An error here, such as a full disk, comes again when the report is finished.
        let _ = file.write_all(record.to_line().as_bytes());
    }

    /// Rewrites the report: one line per job of this run, in the order of the jobs.
    ///
    /// The file is replaced atomically. Jobs of earlier runs that are no longer among the inputs
    /// disappear from it, and `done before` stands for those that were up to date.
    pub(super) fn finish_report(self, records: &[JobRecord]) -> Result<(), CliError> {
        let text: String = records.iter().map(JobRecord::to_line).collect();
        drop(self.file);
        Ok(pipeline::write_file(&self.path, text.as_bytes())?)
    }
}

/// The records of all reports in a folder, later ones last; incomplete lines are skipped.
///
/// Reports of all shards are read, in the order of their names. A folder that does not exist yet
/// has none; a report that cannot be read is as good as absent, and costs only time.
pub(super) fn read_reports(folder: &Path) -> Vec<JobRecord> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.retain(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with("report") && name.ends_with(".jsonl")
    });
    paths.sort();
    let texts = paths.iter().filter_map(|path| std::fs::read_to_string(path).ok());
    let records = |text: String| -> Vec<JobRecord> {
        text.lines().filter_map(JobRecord::from_line).collect()
    };
    texts.flat_map(records).collect()
}
