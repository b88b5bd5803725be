//! Records and report folders for tests.

use super::report::{DONE, FAILED, JobRecord};
use std::path::{Path, PathBuf};

/// Returns the record of a picture with 100 bytes.
pub(super) fn done_record(output: &str, key: &str) -> JobRecord {
    JobRecord {
        input: format!("models/{output}.glb"),
        output: output.to_owned(),
        status: DONE.to_owned(),
        key: key.to_owned(),
        seconds: 0.25,
        warnings: 0,
        message: String::new(),
        bytes: 100,
        sha256: "5d".repeat(32),
        tar: None,
    }
}

/// Returns the record of a failed job.
pub(super) fn failed_record(output: &str, key: &str) -> JobRecord {
    JobRecord {
        status: FAILED.to_owned(),
        message: "it is broken".to_owned(),
        bytes: 0,
        sha256: String::new(),
        ..done_record(output, key)
    }
}

/// An output folder, removed on drop.
pub(super) struct ReportFolder(PathBuf);

impl ReportFolder {
    /// Creates an empty folder named after the test.
    pub(super) fn new(name: &str) -> Self {
        let name = format!("alberti-batch-{name}-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(folder.join("reports")).expect("a folder");
        Self(folder)
    }

    pub(super) fn path(&self) -> &Path {
        &self.0
    }

    /// Writes a file.
    pub(super) fn add_text(&self, name: &str, content: &[u8]) {
        std::fs::write(self.0.join(name), content).expect("a file");
    }

    /// Writes a report.
    pub(super) fn add_report(&self, name: &str, records: &[JobRecord]) {
        let text: String = records.iter().map(JobRecord::to_line).collect();
        self.add_text(name, text.as_bytes());
    }

    /// Returns the content of a file.
    pub(super) fn read_text(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).expect("a file")
    }
}

impl Drop for ReportFolder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
