//! Merges the reports of all runs and shards into one, sorted by output, with one record per
//! output.
//!
//! ```text
//!  reports/1-of-2.….jsonl ─┐
//!  reports/2-of-2.….jsonl ─┼─► sorted chunks ─► one record per output ─► report.jsonl
//!  report.jsonl ───────────┘   (in a temporary file, if there are many)
//! ```
//!
//! Merging needs memory for only one chunk, regardless of the number of records. No report is
//! removed, because an unfinished run may still append to it.

mod sorted_chunks;

use super::earlier_records::record_hash;
use super::report::write_error;
use super::report_reader::{MERGED_REPORT, RecordLine, read_reports};
use crate::BatchError;
use files::AtomicFile;
use sorted_chunks::{Chunks, SortedLine};
use std::io::Write as _;
use std::path::Path;

/// The size of a chunk of records, which is sorted in memory.
const CHUNK_BYTES: usize = 8 << 20;

/// The counts of a merged report.
#[derive(Clone, PartialEq, Default, Debug)]
pub struct MergeCounts {
    /// The number of pictures.
    pub done: u64,
    /// The number of jobs that failed.
    pub failed: u64,
    /// The size of all pictures in bytes.
    pub bytes: u64,
    /// The time of all jobs in seconds, as if one worker ran them all.
    pub seconds: f64,
    /// The longest job time in seconds, and the job's input.
    pub longest: Option<(f64, String)>,
}

/// The jobs of a run, used to restrict a merged report to these jobs.
///
/// The set needs only eight bytes per job, because a folder may have millions of jobs.
#[derive(Clone, Default, Debug)]
pub(super) struct CurrentJobs {
    /// The hashes of outputs and keys.
    hashes: Vec<u64>,
}

impl CurrentJobs {
    /// Adds a job.
    pub(super) fn add_job(&mut self, output: &str, key: &str) {
        self.hashes.push(record_hash(output, key));
    }

    /// Sorts the hashes, so that they can be searched.
    fn sort(&mut self) {
        self.hashes.sort_unstable();
    }

    fn contains(&self, record: &RecordLine<'_>) -> bool {
        self.hashes.binary_search(&record_hash(&record.output, &record.key)).is_ok()
    }
}

/// Merges all reports of an output folder into `report.jsonl`, which is replaced atomically.
///
/// The last record of each output counts, but a picture always takes precedence over a failure with
/// the same key. With `current`, records of other jobs and keys are omitted.
///
/// # Errors
/// Returns an error if a report cannot be read, or if the merged report cannot be written; the old
/// merged report is then unchanged.
pub(super) fn merge_reports(
    out_dir: &Path,
    current: Option<CurrentJobs>,
) -> Result<MergeCounts, BatchError> {
    merge_in_chunks(out_dir, current, CHUNK_BYTES)
}

/// Merges reports like [`merge_reports`], with this chunk size.
fn merge_in_chunks(
    out_dir: &Path,
    mut current: Option<CurrentJobs>,
    chunk_bytes: usize,
) -> Result<MergeCounts, BatchError> {
    if let Some(jobs) = &mut current {
        jobs.sort();
    }
    let path = out_dir.join(MERGED_REPORT);
    let fault = |cause: std::io::Error| write_error(&path, &cause);
    // An external sort, because the records of a large run do not fit in memory.
    let mut chunks = Chunks::new(out_dir, chunk_bytes);
    read_reports(out_dir, |record, line| {
        if current.as_ref().is_none_or(|jobs| jobs.contains(record)) {
            chunks.add_line(&record.output, line).map_err(fault)?;
        }
        Ok(())
    })?;
    // This set may be large and is no longer needed.
    drop(current);
    let mut merged = MergedReport::create(&path)?;
    let mut group = OutputGroup::default();
    let mut lines = chunks.into_sorted().map_err(fault)?;
    while let Some(line) = lines.next_line().map_err(fault)? {
        if let Some(finished) = group.add_line(line) {
            merged.append_line(&finished).map_err(fault)?;
        }
    }
    if let Some(finished) = group.into_record() {
        merged.append_line(&finished).map_err(fault)?;
    }
    merged.finish()
}

/// The records of one output, in run order.
#[derive(Default)]
struct OutputGroup {
    /// The last record.
    last: Option<SortedLine>,
    /// The last record of a picture, if a failure came after it.
    picture: Option<SortedLine>,
}

impl OutputGroup {
    /// Adds a line. If the line starts a new output, returns the record of the previous output.
    fn add_line(&mut self, line: SortedLine) -> Option<Vec<u8>> {
        let Some(last) = &mut self.last else {
            self.last = Some(line);
            return None;
        };
        if last.output != line.output {
            let finished = std::mem::take(self).into_record();
            self.last = Some(line);
            return finished;
        }
        let last = std::mem::replace(last, line);
        if RecordLine::parse(&last.line).is_some_and(|record| record.is_done()) {
            self.picture = Some(last);
        }
        None
    }

    /// Returns the record that counts.
    fn into_record(self) -> Option<Vec<u8>> {
        let last = self.last?;
        let Some(picture) = self.picture else { return Some(last.line) };
        let supersedes = match (RecordLine::parse(&picture.line), RecordLine::parse(&last.line)) {
            (Some(picture), Some(last)) => !last.is_done() && picture.key == last.key,
            _ => false,
        };
        Some(if supersedes { picture.line } else { last.line })
    }
}

/// The merged report that is being written.
struct MergedReport {
    file: std::io::BufWriter<AtomicFile>,
    counts: MergeCounts,
}

impl MergedReport {
    fn create(path: &Path) -> Result<Self, BatchError> {
        let file = std::io::BufWriter::with_capacity(1 << 18, AtomicFile::create(path)?);
        Ok(Self { file, counts: MergeCounts::default() })
    }

    fn append_line(&mut self, line: &[u8]) -> std::io::Result<()> {
        if let Some(record) = RecordLine::parse(line) {
            self.counts.count_record(&record);
        }
        self.file.write_all(line)?;
        self.file.write_all(b"\n")
    }

    fn finish(self) -> Result<MergeCounts, BatchError> {
        let file = self.file.into_inner().map_err(std::io::IntoInnerError::into_error)?;
        file.finish()?;
        Ok(self.counts)
    }
}

impl MergeCounts {
    fn count_record(&mut self, record: &RecordLine<'_>) {
        *(if record.is_done() { &mut self.done } else { &mut self.failed }) += 1;
        self.bytes = self.bytes.saturating_add(record.bytes);
        self.seconds += record.seconds;
        if self.longest.as_ref().is_none_or(|(longest, _)| record.seconds > *longest) {
            self.longest = Some((record.seconds, record.input.clone().into_owned()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::JobRecord;
    use crate::test_records::{ReportFolder, done_record, failed_record};

    /// Returns the output, key and status of each merged record.
    fn merged(folder: &ReportFolder) -> Vec<(String, String, String)> {
        let text = folder.read_text(MERGED_REPORT);
        let parse = |line: &str| {
            let record = RecordLine::parse(line.as_bytes()).unwrap();
            (record.output.into_owned(), record.key.into_owned(), record.status.into_owned())
        };
        text.lines().map(parse).collect()
    }

    fn row(output: &str, key: &str, status: &str) -> (String, String, String) {
        (output.to_owned(), key.to_owned(), status.to_owned())
    }

    /// Returns three runs of four models: one changed, one failed and then succeeded, one did the
    /// opposite, and one failed after it changed.
    fn three_runs(name: &str) -> ReportFolder {
        let folder = ReportFolder::new(name);
        let first = [
            done_record("changed.png", "k1"),
            failed_record("repaired.png", "k"),
            done_record("lost.png", "k"),
            done_record("broken.png", "k1"),
        ];
        folder.add_report("reports/1-of-2.b.1.1.jsonl", &first);
        let second = [done_record("repaired.png", "k"), failed_record("lost.png", "k")];
        folder.add_report("reports/2-of-2.a.1.2.jsonl", &second);
        let third = [failed_record("broken.png", "k2"), done_record("changed.png", "k2")];
        folder.add_report("reports/1-of-2.a.1.10.jsonl", &third);
        folder
    }

    #[test]
    fn each_output_keeps_its_last_record_and_pictures_take_precedence_over_failures() {
        let folder = three_runs("merge");
        let expected = [
            row("broken.png", "k2", "failed"),
            row("changed.png", "k2", "done"),
            row("lost.png", "k", "done"),
            row("repaired.png", "k", "done"),
        ];
        for _ in 0..2 {
            let counts = merge_reports(folder.path(), None).unwrap();
            assert_eq!((counts.done, counts.failed, counts.bytes), (3, 1, 300));
            assert_eq!(counts.seconds, 1.0);
            assert_eq!(merged(&folder), expected, "merging again changes nothing");
        }
    }

    #[test]
    fn records_of_other_jobs_are_omitted() {
        let folder = three_runs("merge-current");
        let mut current = CurrentJobs::default();
        [("repaired.png", "k"), ("changed.png", "k1")]
            .iter()
            .for_each(|(output, key)| current.add_job(output, key));
        merge_reports(folder.path(), Some(current)).unwrap();
        let expected = [row("changed.png", "k1", "done"), row("repaired.png", "k", "done")];
        assert_eq!(merged(&folder), expected, "an older picture is current again");
    }

    #[test]
    fn chunks_of_any_size_give_the_same_report() {
        let folder = ReportFolder::new("merge-chunks");
        let mut state = 7_u32;
        for run in 1..=5 {
            let records: Vec<JobRecord> = (0..200)
                .map(|_| {
                    state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    let output = format!("{}.png", (state >> 16) % 300);
                    let key = format!("k{}", (state >> 8) % 3);
                    let is_done = state >> 31 == 0;
                    let make = if is_done { done_record } else { failed_record };
                    make(&output, &key)
                })
                .collect();
            folder.add_report(&format!("reports/1-of-1.a.1.{run}.jsonl"), &records);
        }
        let of = |chunk_bytes| {
            let _ = std::fs::remove_file(folder.path().join(MERGED_REPORT));
            let counts = merge_in_chunks(folder.path(), None, chunk_bytes).unwrap();
            (counts, merged(&folder))
        };
        let whole = of(CHUNK_BYTES);
        let mut outputs: Vec<&String> = whole.1.iter().map(|(output, ..)| output).collect();
        outputs.sort();
        outputs.dedup();
        assert_eq!(outputs.len(), whole.1.len(), "one record for each output");
        assert!(whole.1.is_sorted());
        assert_eq!((of(1), of(1000), of(50_000)), (whole.clone(), whole.clone(), whole));
        let names: Vec<_> = std::fs::read_dir(folder.path()).unwrap().collect();
        assert_eq!(names.len(), 2, "no temporary file is left: {names:?}");
    }

    #[test]
    fn without_reports_the_merged_report_is_empty() {
        let folder = ReportFolder::new("merge-empty");
        assert_eq!(merge_reports(folder.path(), None).unwrap(), MergeCounts::default());
        assert_eq!(folder.read_text(MERGED_REPORT), "");
    }
}
