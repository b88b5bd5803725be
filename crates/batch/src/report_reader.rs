//! Reads the reports of an output folder line by line, without keeping them in memory.
//!
//! A report of a million records is read in a second or two, with memory for only one line.

use super::report::{DONE, FAILED, REPORTS_FOLDER, run_number};
use crate::BatchError;
use files::visible_path;
use std::borrow::Cow;
use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind, Read as _};
use std::path::{Path, PathBuf};

/// The merged report, below the output folder.
pub(super) const MERGED_REPORT: &str = "report.jsonl";
/// The maximum length of a line in bytes; longer lines are not batch records.
const MAX_LINE_BYTES: u64 = 1 << 20;
/// The size of the read buffer for a report.
const BUFFER_BYTES: usize = 1 << 18;

/// A record as parsed from a line. All members except `tar` are required.
///
/// Unknown members are ignored, so that reports from newer versions can be read. A line from an
/// older version that lacks a member is skipped, and its job is run again.
#[derive(Debug, serde::Deserialize)]
pub(super) struct RecordLine<'a> {
    /// The path of the input, as specified.
    #[serde(borrow)]
    pub(super) input: Cow<'a, str>,
    /// The path of the picture below the output folder.
    #[serde(borrow)]
    pub(super) output: Cow<'a, str>,
    /// `done` or `failed`.
    #[serde(borrow)]
    pub(super) status: Cow<'a, str>,
    /// The content key.
    #[serde(borrow)]
    pub(super) key: Cow<'a, str>,
    /// The time of the job.
    pub(super) seconds: f64,
    /// The error, or the first warning.
    #[serde(borrow)]
    pub(super) message: Cow<'a, str>,
    /// The size of the picture in bytes.
    pub(super) bytes: u64,
    /// The SHA-256 of the picture in hexadecimal.
    #[serde(borrow)]
    pub(super) sha256: Cow<'a, str>,
    /// The tar file that contains the picture.
    #[serde(default)]
    pub(super) tar: Option<String>,
}

impl<'a> RecordLine<'a> {
    /// Parses a line; returns `None` if it is truncated or has another schema.
    pub(super) fn parse(line: &'a [u8]) -> Option<Self> {
        let record: Self = serde_json::from_slice(line).ok()?;
        matches!(&*record.status, DONE | FAILED).then_some(record)
    }

    /// Returns whether the picture was rendered.
    pub(super) fn is_done(&self) -> bool {
        self.status == DONE
    }
}

/// Reads all reports of an output folder: first the merged report, then the runs, oldest first.
///
/// Calls `visit` for each record with its line, which has no line break.
///
/// # Errors
/// Returns an error if a report cannot be read, or if `visit` fails. An unreadable report is not
/// skipped: its pictures would be rendered again or be missing. A folder that does not exist yet
/// has no reports.
pub(super) fn read_reports(
    out_dir: &Path,
    mut visit: impl FnMut(&RecordLine<'_>, &[u8]) -> Result<(), BatchError>,
) -> Result<(), BatchError> {
    for path in report_paths(out_dir)? {
        read_report(&path, &mut visit)?;
    }
    Ok(())
}

/// Reads one report, if it exists and is a file; see [`read_reports`].
///
/// # Errors
/// Returns an error if the report cannot be read, or if `visit` fails.
pub(super) fn read_report(
    path: &Path,
    mut visit: impl FnMut(&RecordLine<'_>, &[u8]) -> Result<(), BatchError>,
) -> Result<(), BatchError> {
    // A pipe would block, and a folder cannot be read.
    if path.metadata().is_ok_and(|metadata| !metadata.is_file()) {
        return Ok(());
    }
    let file = match File::open(path) {
        Ok(file) => file,
        // A run may have just removed its empty report.
        Err(cause) if cause.kind() == ErrorKind::NotFound => return Ok(()),
        Err(cause) => return Err(read_error(path, &cause)),
    };
    let mut reader = BufReader::with_capacity(BUFFER_BYTES, file);
    let mut line = Vec::new();
    loop {
        line.clear();
        // A damaged report may have no line breaks, so the length of a line is limited.
        let read = (&mut reader).take(MAX_LINE_BYTES).read_until(b'\n', &mut line);
        if read.map_err(|cause| read_error(path, &cause))? == 0 {
            return Ok(());
        }
        let line = line.strip_suffix(b"\n").unwrap_or(&line);
        // A crash may leave an incomplete line; its job is not recorded and runs again.
        if let Some(record) = RecordLine::parse(line) {
            visit(&record, line)?;
        }
    }
}

/// Returns the paths of all reports: the merged one, then the runs by number and name.
///
/// # Errors
/// Returns an error if the folder cannot be read.
pub(super) fn report_paths(out_dir: &Path) -> Result<Vec<PathBuf>, BatchError> {
    let folder = out_dir.join(REPORTS_FOLDER);
    let mut paths = Vec::new();
    match std::fs::read_dir(&folder) {
        Ok(entries) => {
            for entry in entries {
                let path = entry.map_err(|cause| read_error(&folder, &cause))?.path();
                if path.extension().is_some_and(|extension| extension == "jsonl") {
                    paths.push(path);
                }
            }
        }
        Err(cause) if cause.kind() == ErrorKind::NotFound => {}
        Err(cause) => return Err(read_error(&folder, &cause)),
    }
    paths.sort_by_cached_key(|path| (run_number(path), path.clone()));
    paths.insert(0, out_dir.join(MERGED_REPORT));
    Ok(paths)
}

/// Returns the error for a report that cannot be read.
fn read_error(path: &Path, cause: &std::io::Error) -> BatchError {
    BatchError::Unusable(format!("cannot read {}: {cause}", visible_path(path)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_records::{ReportFolder, done_record, failed_record};

    /// Returns the outputs of all records, in reading order.
    fn outputs(folder: &ReportFolder) -> Vec<String> {
        let mut outputs = Vec::new();
        let visited = read_reports(folder.path(), |record, _| {
            outputs.push(record.output.clone().into_owned());
            Ok(())
        });
        visited.unwrap();
        outputs
    }

    #[test]
    fn runs_are_read_in_numeric_order() {
        let folder = ReportFolder::new("reader");
        assert!(outputs(&folder).is_empty(), "a folder without reports has no records");
        folder.add_report("reports/2-of-2.a.9.10.jsonl", &[done_record("c.png", "k")]);
        folder.add_report("reports/1-of-2.b.7.9.jsonl", &[failed_record("b.png", "k")]);
        folder.add_report("report.jsonl", &[done_record("a.png", "k")]);
        assert_eq!(outputs(&folder), ["a.png", "b.png", "c.png"]);
    }

    #[test]
    fn truncated_lines_are_skipped() {
        let folder = ReportFolder::new("truncated");
        let whole = done_record("first.png", "k").to_line();
        for cut in 0..whole.len() {
            let text = format!("{whole}{}", &whole.replace("first", "second")[..cut]);
            folder.add_text("reports/1-of-1.a.1.1.jsonl", text.as_bytes());
            let read = outputs(&folder);
            // A line without its line break is also complete; `second` is one character longer.
            assert_eq!(read.len(), 1, "{cut}: {read:?}");
        }
        let torn = format!("{}{whole}\0\0\0\n{{}}\nno JSON\n[1]\n{whole}", &whole[..40]);
        folder.add_text("reports/1-of-1.a.1.1.jsonl", torn.as_bytes());
        assert_eq!(
            outputs(&folder),
            ["first.png"],
            "bytes that were never written are not a record"
        );
    }

    #[test]
    fn strings_with_escapes_are_read() {
        let folder = ReportFolder::new("escapes");
        folder.add_report("report.jsonl", &[failed_record("ä \"b\" \\ \u{1}.png", "k")]);
        assert_eq!(outputs(&folder), ["ä \"b\" \\ \u{1}.png"]);
    }
}
