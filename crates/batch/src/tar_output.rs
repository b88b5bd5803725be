//! Writes pictures and their records to tar files for WebDataset.
//!
//! ```text
//! shard-1-of-8-000000.tar:  fox.png fox.json  more/lamp.png more/lamp.json  …
//! ```
//! A tar file is written under a temporary name, flushed to disk, and then renamed; only then are
//! its pictures recorded. After a crash it is complete or absent, and pictures that are not in a
//! tar file are rendered again.

use super::report::{JobRecord, REPORTS_FOLDER, ReportWriter, write_error};
use super::tar_format::{append_file, finish_archive};
use crate::BatchError;
use files::{create_partial_file, forget_partial_file};
use std::fs::File;
use std::io::{BufWriter, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The size of a tar file's buffer.
const BUFFER_BYTES: usize = 1 << 18;

/// A run's tar files, written one after the other; the threads share them.
pub(super) struct TarOutput {
    out_dir: PathBuf,
    /// The temporary file, which no other run uses.
    partial: PathBuf,
    /// The prefix of tar file names, up to the number: `shard-1-of-8`.
    prefix: String,
    /// The number of samples per tar file.
    samples: usize,
    state: Mutex<TarState>,
}

/// The tar file that is being written.
#[derive(Default)]
struct TarState {
    open: Option<OpenTar>,
    /// The number from which to search for the next tar file name.
    next: u32,
}

/// A tar file under its temporary name, and the records of its samples.
struct OpenTar {
    writer: BufWriter<File>,
    records: Vec<JobRecord>,
}

impl TarOutput {
    /// Creates an output that has no tar file yet. `run_name` is the name of the run, such as
    /// `1-of-8.HOST.PID.RUN`.
    pub(super) fn new(out_dir: &Path, run_name: &str, samples: u32) -> Self {
        let shard = run_name.split('.').next().unwrap_or(run_name);
        Self {
            out_dir: out_dir.to_owned(),
            partial: out_dir.join(REPORTS_FOLDER).join(format!("{run_name}.tar.part")),
            prefix: format!("shard-{shard}"),
            samples: usize::try_from(samples).unwrap_or(usize::MAX).max(1),
            state: Mutex::default(),
        }
    }

    /// Adds a picture and its record.
    ///
    /// Once the tar file is full, it is renamed, and its records are appended to the report.
    ///
    /// # Errors
    /// Returns an error if a file cannot be written.
    pub(super) fn add_sample(
        &self,
        record: JobRecord,
        png: &[u8],
        report: &ReportWriter,
    ) -> Result<(), BatchError> {
        let mut state = self.lock();
        let mut open = match state.open.take() {
            Some(open) => open,
            None => self.create_tar()?,
        };
        let line = record.to_line();
        let written =
            append_file(&mut open.writer, &sample_name(&record.output), png).and_then(|()| {
                let json = sample_name(&with_extension_json(&record.output));
                append_file(&mut open.writer, &json, line.as_bytes())
            });
        written.map_err(|cause| write_error(&self.partial, &cause))?;
        open.records.push(record);
        if open.records.len() < self.samples {
            state.open = Some(open);
            return Ok(());
        }
        self.finish_tar(open, &mut state.next, report)
    }

    /// Finishes the last tar file, which may have fewer samples.
    ///
    /// # Errors
    /// Returns an error if a file cannot be written.
    pub(super) fn finish(self, report: &ReportWriter) -> Result<(), BatchError> {
        let mut state = self.lock();
        let last = state.open.take();
        last.map_or(Ok(()), |open| self.finish_tar(open, &mut state.next, report))
    }

    /// Locks the state. If another thread panicked, the open tar file may contain half a sample and
    /// is dropped.
    fn lock(&self) -> MutexGuard<'_, TarState> {
        self.state.lock().unwrap_or_else(|poison| {
            let mut state = PoisonError::into_inner(poison);
            state.open = None;
            state
        })
    }

    fn create_tar(&self) -> Result<OpenTar, BatchError> {
        let file = create_partial_file(&self.partial)
            .map_err(|cause| write_error(&self.partial, &cause))?;
        Ok(OpenTar { writer: BufWriter::with_capacity(BUFFER_BYTES, file), records: Vec::new() })
    }

    /// Flushes a tar file to disk, names it, and appends its records to the report.
    fn finish_tar(
        &self,
        open: OpenTar,
        next: &mut u32,
        report: &ReportWriter,
    ) -> Result<(), BatchError> {
        let OpenTar { mut writer, mut records } = open;
        let written = finish_archive(&mut writer)
            .and_then(|()| writer.into_inner().map_err(std::io::IntoInnerError::into_error))
            .and_then(|file| file.sync_all());
        written.map_err(|cause| write_error(&self.partial, &cause))?;
        let name = self.name_tar(next)?;
        records.iter_mut().for_each(|record| record.tar = Some(name.clone()));
        report.append_records(&records)
    }

    /// Renames the temporary file to the first free name, and returns the name.
    ///
    /// A hard link fails if another run has just taken the name; renaming would replace its file.
    fn name_tar(&self, next: &mut u32) -> Result<String, BatchError> {
        loop {
            let name = format!("{}-{:06}.tar", self.prefix, *next);
            let path = self.out_dir.join(&name);
            *next += 1;
            let named = match std::fs::hard_link(&self.partial, &path) {
                Err(cause) if cause.kind() == ErrorKind::AlreadyExists => continue,
                Ok(()) => std::fs::remove_file(&self.partial),
                Err(_) if path.exists() => continue,
                // This file system has no hard links.
                Err(_) => std::fs::rename(&self.partial, &path),
            };
            named.map_err(|cause| write_error(&path, &cause))?;
            forget_partial_file(&self.partial);
            return Ok(name);
        }
    }
}

/// Removes the temporary file if the run ends early.
impl Drop for TarOutput {
    fn drop(&mut self) {
        if self.lock().open.take().is_some() {
            let _ = std::fs::remove_file(&self.partial);
        }
    }
}

/// Returns the name of an output in a tar file.
///
/// Readers take the part of a file name before the first dot as the sample's key. Dots before the
/// last dot are therefore written as `%2E`, and `%` as `%25`, so that different outputs have
/// different keys:
///
/// ```text
/// more/fox.glb.png  ─►  more/fox%2Eglb.png
/// ```
pub(super) fn sample_name(output: &str) -> String {
    let (folder, name) = match output.rfind('/') {
        Some(slash) => output.split_at(slash + 1),
        None => ("", output),
    };
    let (stem, extension) = name.rsplit_once('.').unwrap_or((name, ""));
    let stem = stem.replace('%', "%25").replace('.', "%2E");
    format!("{folder}{stem}.{extension}")
}

/// Returns an output with its extension replaced by `.json`.
fn with_extension_json(output: &str) -> String {
    let stem = output.rsplit_once('.').filter(|(_, extension)| !extension.contains('/'));
    format!("{}.json", stem.map_or(output, |(stem, _)| stem))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Shard;
    use crate::report_reader::read_reports;
    use crate::tar_format::read_archive;
    use crate::test_records::{ReportFolder, done_record};

    /// Returns the file names in a tar file.
    fn names_in(folder: &ReportFolder, tar: &str) -> Vec<String> {
        let mut names = Vec::new();
        let mut file = File::open(folder.path().join(tar)).unwrap();
        read_archive(&mut file, |name, _| {
            names.push(name.to_owned());
            Ok(())
        })
        .unwrap();
        names
    }

    /// Returns the output and tar file of each record.
    fn records_in(folder: &ReportFolder) -> Vec<(String, String)> {
        let mut records = Vec::new();
        read_reports(folder.path(), |record, _| {
            records.push((record.output.to_string(), record.tar.clone().unwrap_or_default()));
            Ok(())
        })
        .unwrap();
        records
    }

    #[test]
    fn pictures_are_recorded_once_their_tar_file_has_its_name() {
        let folder = ReportFolder::new("tar");
        let report = ReportWriter::create(folder.path(), Shard::ALL_JOBS).unwrap();
        let tars = TarOutput::new(folder.path(), report.run_name(), 2);
        tars.add_sample(done_record("a.png", "k"), b"1", &report).unwrap();
        assert!(records_in(&folder).is_empty(), "the tar file is not full");
        for name in ["more/b.glb.png", "c.png"] {
            tars.add_sample(done_record(name, "k"), b"2", &report).unwrap();
        }
        assert_eq!(records_in(&folder).len(), 2);
        tars.finish(&report).unwrap();
        let [first, second] = [0, 1].map(|at| format!("shard-1-of-1-{at:06}.tar"));
        let names = ["a.png", "a.json", "more/b%2Eglb.png", "more/b%2Eglb.json"];
        assert_eq!(names_in(&folder, &first), names);
        assert_eq!(names_in(&folder, &second), ["c.png", "c.json"]);
        let expected = [("a.png", &first), ("more/b.glb.png", &first), ("c.png", &second)];
        assert_eq!(records_in(&folder), expected.map(|(name, tar)| (name.to_owned(), tar.clone())));
        let left = std::fs::read_dir(folder.path().join("reports")).unwrap().count();
        assert_eq!(left, 1, "no temporary file is left");
    }

    #[test]
    fn runs_of_the_same_shard_use_different_names() {
        let folder = ReportFolder::new("tar-names");
        let runs = [0, 1].map(|_| {
            let report = ReportWriter::create(folder.path(), Shard::ALL_JOBS).unwrap();
            let tars = TarOutput::new(folder.path(), report.run_name(), 1);
            (report, tars)
        });
        for name in ["a.png", "b.png"] {
            for (report, tars) in &runs {
                tars.add_sample(done_record(name, "k"), b"1", report).unwrap();
            }
        }
        let mut tars: Vec<String> = records_in(&folder).into_iter().map(|(_, tar)| tar).collect();
        tars.sort();
        tars.dedup();
        assert_eq!(tars.len(), 4, "{tars:?}");
        assert!(tars.iter().all(|tar| names_in(&folder, tar).len() == 2));
    }

    #[test]
    fn a_run_that_ends_early_leaves_no_files() {
        let folder = ReportFolder::new("tar-early");
        let report = ReportWriter::create(folder.path(), Shard::ALL_JOBS).unwrap();
        let tars = TarOutput::new(folder.path(), report.run_name(), 10);
        tars.add_sample(done_record("a.png", "k"), b"1", &report).unwrap();
        drop(tars);
        report.finish().unwrap();
        assert_eq!(std::fs::read_dir(folder.path().join("reports")).unwrap().count(), 0);
    }

    #[test]
    fn sample_names_have_one_dot_and_stay_distinct() {
        let outputs = ["a.b.png", "a%2Eb.png", "a_b.png", "x.y/a.png", "a", "..png"];
        let names = outputs.map(sample_name);
        let expected = ["a%2Eb.png", "a%252Eb.png", "a_b.png", "x.y/a.png", "a.", "%2E.png"];
        assert_eq!(names, expected);
        assert_eq!(with_extension_json("x.y/a"), "x.y/a.json");
        assert_eq!(sample_name(&with_extension_json("a.b.png")), "a%2Eb.json");
    }
}
