//! The report: a line of JSON for each job, written as soon as the job is done, so that a run that is killed is known by what
//! it did.

use super::Shard;
use crate::CliError;
use serde_json::{Value, json};
use std::fs::{File, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// What became of a job.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct JobRecord {
    /// The file, as it was given.
    pub(super) input: String,
    /// The picture, below the output folder.
    pub(super) output: String,
    /// `done`, `done before` or `failed`.
    pub(super) status: String,
    /// Of what content and settings the picture is.
    pub(super) key: String,
    /// Seconds that it took.
    pub(super) seconds: f64,
    /// How many warnings there were.
    pub(super) warnings: usize,
    /// Why it failed, or the first warning.
    pub(super) message: String,
}

pub(super) const DONE: &str = "done";
pub(super) const DONE_BEFORE: &str = "done before";
pub(super) const FAILED: &str = "failed";

impl JobRecord {
    fn to_line(&self) -> String {
        let Self { input, output, status, key, seconds, warnings, message } = self;
        let json = json!({"input": input, "output": output, "status": status, "key": key,
            "seconds": seconds, "warnings": warnings, "message": message});
        format!("{json}\n")
    }

    /// The record of a line; `None` if it is cut off, or of something else.
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

/// A report that is being written.
pub(super) struct BatchReport {
    path: PathBuf,
    file: Mutex<File>,
}

impl BatchReport {
    /// Opens the report of a shard, to write behind what is there.
    pub(super) fn open_report(folder: &Path, shard: Shard) -> Result<Self, CliError> {
        let path = folder.join(format!("report{}.jsonl", shard.file_suffix()));
        let file = OpenOptions::new().create(true).append(true).open(&path);
        let fault = |cause| CliError::Usage(format!("cannot write {}: {cause}", path.display()));
        let mut file = file.map_err(fault)?;
        // A run that was killed may have left half a line.
        file.write_all(b"\n")?;
        Ok(Self { path, file: Mutex::new(file) })
    }

    /// Writes down what became of a job.
    pub(super) fn append_record(&self, record: &JobRecord) {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        // A full disk is found when the report is finished.
        let _ = file.write_all(record.to_line().as_bytes());
    }

    /// Puts the whole report in order: a line for each job of this run, in the order of the jobs.
    pub(super) fn finish_report(self, records: &[JobRecord]) -> Result<(), CliError> {
        let text: String = records.iter().map(JobRecord::to_line).collect();
        drop(self.file);
        Ok(pipeline::write_file(&self.path, text.as_bytes())?)
    }
}

/// What all reports in a folder say, the later lines last. Lines that are cut off are left out.
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
