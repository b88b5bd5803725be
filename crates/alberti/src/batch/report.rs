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
use std::collections::BTreeMap;
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
    /// `done` or `failed`.
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
    /// The size of the picture in bytes; 0 of a job that failed.
    pub(super) bytes: u64,
    /// The SHA-256 of the picture in hexadecimal; empty of a job that failed.
    pub(super) sha256: String,
    /// The tar file below the output folder that holds the picture, if it is in one.
    pub(super) tar: Option<String>,
}

/// The status of a picture that was rendered by this run.
pub(super) const DONE: &str = "done";
/// The status of a job that failed.
pub(super) const FAILED: &str = "failed";

impl JobRecord {
    /// The record as one line of JSON.
    fn to_line(&self) -> String {
        let Self { input, output, status, key, seconds, warnings, message, .. } = self;
        let json = json!({"input": input, "output": output, "status": status, "key": key,
            "seconds": seconds, "warnings": warnings, "message": message, "bytes": self.bytes,
            "sha256": self.sha256, "tar": self.tar});
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
            bytes: json.get("bytes")?.as_u64()?,
            sha256: word("sha256")?,
            tar: json.get("tar").and_then(Value::as_str).map(str::to_owned),
        })
    }
}

/// The report of a run, shared by the threads.
pub(super) struct ReportWriter {
    /// The name of the run: shard, host, process.
    run_name: String,
    /// The open report; a lock keeps the lines of several threads apart.
    file: Mutex<File>,
    path: PathBuf,
}

impl ReportWriter {
    /// Creates a report that no other run has.
    pub(super) fn create(out_dir: &Path, shard: Shard) -> Result<Self, CliError> {
        let folder = out_dir.join("reports");
        let fault = |path: &Path, cause: std::io::Error| {
            CliError::Usage(format!("cannot write {}: {cause}", path.display()))
        };
        std::fs::create_dir_all(&folder).map_err(|cause| fault(&folder, cause))?;
        let run_name = format!("run{}-{}", shard.file_suffix(), std::process::id());
        let path = folder.join(format!("{run_name}.jsonl"));
        let file = OpenOptions::new().create(true).append(true).open(&path);
        let file = file.map_err(|cause| fault(&path, cause))?;
        Ok(Self { run_name, file: Mutex::new(file), path })
    }

    /// The name of the run, which is that of no other in the output folder.
    pub(super) fn run_name(&self) -> &str {
        &self.run_name
    }

    /// Appends a record.
    pub(super) fn append_record(&self, record: &JobRecord) -> Result<(), CliError> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.write_all(record.to_line().as_bytes()).map_err(|cause| {
            CliError::Usage(format!("cannot write {}: {cause}", self.path.display()))
        })
    }

    /// Brings the report to the disk.
    pub(super) fn finish(self) -> Result<(), CliError> {
        Ok(())
    }
}

/// The records of earlier runs.
pub(super) struct EarlierRecords(BTreeMap<(String, String), EarlierRecord>);

/// What became of a job in an earlier run.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum EarlierRecord {
    /// Its picture was made.
    Done {
        /// The size of the picture.
        bytes: u64,
        /// Whether the picture is in a tar file.
        is_in_tar: bool,
    },
    /// It failed.
    Failed,
}

impl EarlierRecords {
    /// Reads all reports of an output folder.
    pub(super) fn read(out_dir: &Path) -> Result<Self, CliError> {
        let mut found = BTreeMap::new();
        for record in read_reports(&out_dir.join("reports")) {
            let earlier = if record.status == DONE {
                EarlierRecord::Done { bytes: record.bytes, is_in_tar: record.tar.is_some() }
            } else {
                EarlierRecord::Failed
            };
            found.insert((record.output, record.key), earlier);
        }
        Ok(Self(found))
    }

    /// The record of a job with this output and key.
    pub(super) fn find(&self, output: &str, key: &str) -> Option<EarlierRecord> {
        self.0.get(&(output.to_owned(), key.to_owned())).copied()
    }
}

/// The records of all reports in a folder.
fn read_reports(folder: &Path) -> Vec<JobRecord> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.retain(|path| path.extension().is_some_and(|end| end == "jsonl"));
    paths.sort();
    let texts = paths.iter().filter_map(|path| std::fs::read_to_string(path).ok());
    let records = |text: String| -> Vec<JobRecord> {
        text.lines().filter_map(JobRecord::from_line).collect()
    };
    texts.flat_map(records).collect()
}
