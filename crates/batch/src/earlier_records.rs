//! Records of earlier runs, packed into 24 bytes each.

use super::report_reader::{RecordLine, read_report, report_paths};
use crate::BatchError;
use std::collections::BTreeMap;
use std::path::Path;

/// The maximum number of tar files whose existence is remembered.
const MAX_TARS: usize = 1 << 16;

/// The result of a job in an earlier run.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum EarlierRecord {
    /// The picture was rendered.
    Done {
        /// The size of the picture.
        bytes: u64,
        /// Whether the picture is in an existing tar file.
        is_in_tar: bool,
    },
    /// The job failed.
    Failed,
}

/// The records of earlier runs, by output and key.
///
/// A picture is either a separate file or part of a tar file. An output file holds the picture of
/// its last record, regardless of the key. An older record with another key, for example from other
/// flags, is superseded and no longer counts, even if both pictures have the same size. Tar files
/// are never rewritten, and each picture in them counts.
///
/// Records are found by 64-bit hashes. Among ten million outputs, the probability that two share a
/// hash is 1 in 400,000; those two would be rendered again.
pub(super) struct EarlierRecords {
    /// Sorted by output, then by run; see [`remove_superseded`](Self::remove_superseded).
    entries: Vec<PackedRecord>,
}

/// A record in 24 bytes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct PackedRecord {
    /// The hash of the output.
    output: u64,
    /// The report number, the record kind, and the picture size.
    bits: u64,
    /// The hash of the key.
    key: u64,
}

/// The kind of a record. Among records of one run, pictures sort last.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum RecordKind {
    Failed = 0,
    InFile = 1,
    InTar = 2,
}

impl PackedRecord {
    /// The number of bits for the size; larger sizes are recorded as the maximum.
    const SIZE_BITS: u32 = 40;
    /// The number of bits for size and kind; the report number is above them.
    const KIND_BITS: u32 = Self::SIZE_BITS + 2;
    /// The largest report number; all later reports share it.
    const LAST_REPORT: u64 = (1 << (u64::BITS - Self::KIND_BITS)) - 1;

    fn of_line(record: &RecordLine<'_>, report: u64) -> Self {
        let kind = match &record.tar {
            _ if !record.is_done() => RecordKind::Failed,
            Some(_) => RecordKind::InTar,
            None => RecordKind::InFile,
        };
        let bits = report.min(Self::LAST_REPORT) << Self::KIND_BITS
            | (kind as u64) << Self::SIZE_BITS
            | record.bytes.min((1 << Self::SIZE_BITS) - 1);
        Self { output: text_hash(&record.output), bits, key: text_hash(&record.key) }
    }

    const fn kind(self) -> RecordKind {
        match self.bits >> Self::SIZE_BITS & 3 {
            0 => RecordKind::Failed,
            1 => RecordKind::InFile,
            _ => RecordKind::InTar,
        }
    }

    const fn unpack(self) -> EarlierRecord {
        let bytes = self.bits & ((1 << Self::SIZE_BITS) - 1);
        match self.kind() {
            RecordKind::Failed => EarlierRecord::Failed,
            RecordKind::InFile => EarlierRecord::Done { bytes, is_in_tar: false },
            RecordKind::InTar => EarlierRecord::Done { bytes, is_in_tar: true },
        }
    }
}

impl EarlierRecords {
    /// Reads all reports of an output folder.
    ///
    /// Records of pictures in tar files that no longer exist are skipped.
    ///
    /// # Errors
    /// Returns an error if a report cannot be read.
    pub(super) fn read(out_dir: &Path) -> Result<Self, BatchError> {
        let mut records = Self { entries: Vec::new() };
        let mut tars: BTreeMap<String, bool> = BTreeMap::new();
        for (report, path) in (0..).zip(report_paths(out_dir)?) {
            read_report(&path, |record, _| {
                if let Some(tar) = &record.tar {
                    let is_there = tars.get(tar).copied();
                    let is_there = is_there.unwrap_or_else(|| out_dir.join(tar).is_file());
                    if tars.len() < MAX_TARS {
                        tars.entry(tar.clone()).or_insert(is_there);
                    }
                    if !is_there {
                        return Ok(());
                    }
                }
                records.add_entry(PackedRecord::of_line(record, report));
                Ok(())
            })?;
        }
        records.remove_superseded();
        Ok(records)
    }

    /// Returns the record of a job with this output and key; a picture takes precedence over a
    /// failure.
    pub(super) fn find(&self, output: &str, key: &str) -> Option<EarlierRecord> {
        let (output, key) = (text_hash(output), text_hash(key));
        let begin = self.entries.partition_point(|entry| entry.output < output);
        let of_output = self.entries[begin..].iter().take_while(|entry| entry.output == output);
        let of_key = of_output.filter(|entry| entry.key == key);
        of_key.max_by_key(|entry| entry.kind() as u8).map(|entry| entry.unpack())
    }

    /// Adds a record. Superseded records are removed before the list grows, because a merged report
    /// repeats all records of the other reports.
    fn add_entry(&mut self, entry: PackedRecord) {
        if self.entries.len() == self.entries.capacity() {
            self.remove_superseded();
            let length = self.entries.len();
            if length >= self.entries.capacity() / 5 * 4 {
                self.entries.reserve_exact((length / 4).max(1024));
            }
        }
        self.entries.push(entry);
    }

    /// Sorts the records and removes those that no longer count.
    ///
    /// For each output, it keeps the last file, all pictures in tar files, and one failure for each
    /// key without a picture.
    fn remove_superseded(&mut self) {
        self.entries.sort_unstable();
        let (mut kept, mut begin, mut group) = (0, 0, Vec::new());
        while begin < self.entries.len() {
            let output = self.entries[begin].output;
            let rest = self.entries[begin..].iter();
            group.clear();
            group.extend(rest.take_while(|entry| entry.output == output).copied());
            for entry in (0..group.len()).filter(|at| still_counts(&group, *at)) {
                self.entries[kept] = group[entry];
                kept += 1;
            }
            begin += group.len();
        }
        self.entries.truncate(kept);
    }
}

/// Returns whether a record counts among all records of its output, which are in run order.
fn still_counts(group: &[PackedRecord], at: usize) -> bool {
    let (entry, before) = (group[at], &group[..at]);
    let is_of_key = |other: &&PackedRecord| other.key == entry.key;
    match entry.kind() {
        RecordKind::InFile => group[at + 1..].iter().all(|e| e.kind() != RecordKind::InFile),
        RecordKind::InTar => {
            before.iter().filter(is_of_key).all(|other| other.kind() != RecordKind::InTar)
        }
        RecordKind::Failed => {
            !before.iter().any(|other| is_of_key(&other))
                && group.iter().filter(is_of_key).all(|e| e.kind() == RecordKind::Failed)
        }
    }
}

/// Returns the hash of an output and a key.
pub(super) fn record_hash(output: &str, key: &str) -> u64 {
    bytes_hash(output.bytes().chain([0]).chain(key.bytes()))
}

/// Returns the hash of an output or a key.
fn text_hash(text: &str) -> u64 {
    bytes_hash(text.bytes())
}

/// Computes FNV-1a with a final mix, so that all bits are well distributed.
fn bytes_hash(bytes: impl Iterator<Item = u8>) -> u64 {
    let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    });
    let mixed = (hash ^ (hash >> 32)).wrapping_mul(0xd6e8_feb8_6659_fd93);
    mixed ^ (mixed >> 32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_records::{ReportFolder, done_record, failed_record};

    const DONE: Option<EarlierRecord> = Some(EarlierRecord::Done { bytes: 100, is_in_tar: false });

    #[test]
    fn jobs_are_found_by_output_and_key() {
        let folder = ReportFolder::new("earlier");
        let names: Vec<String> = (0..3000).map(|at| format!("{at:04}.png")).collect();
        let records: Vec<_> = names.iter().map(|name| done_record(name, "k1")).collect();
        folder.add_report("reports/1-of-1.a.1.1.jsonl", &records);
        folder.add_report("report.jsonl", &records);
        let earlier = EarlierRecords::read(folder.path()).unwrap();
        assert_eq!(earlier.entries.len(), 3000, "the merged report has the same records");
        assert!(names.iter().all(|name| earlier.find(name, "k1") == DONE));
        assert_eq!(earlier.find("0000.png", "k2"), None, "a different key");
        assert_eq!(earlier.find("3000.png", "k1"), None);
    }

    #[test]
    fn a_picture_takes_precedence_over_a_failure_with_the_same_key() {
        let folder = ReportFolder::new("earlier-failed");
        folder.add_report("reports/1-of-1.a.1.1.jsonl", &[done_record("a.png", "k")]);
        let failed = [failed_record("a.png", "k"), failed_record("b.png", "k")];
        folder.add_report("reports/1-of-1.a.1.2.jsonl", &failed);
        let earlier = EarlierRecords::read(folder.path()).unwrap();
        assert_eq!(earlier.find("a.png", "k"), DONE);
        assert_eq!(earlier.find("b.png", "k"), Some(EarlierRecord::Failed));
    }

    #[test]
    fn an_overwritten_picture_does_not_count_even_at_the_same_size() {
        let folder = ReportFolder::new("earlier-overwritten");
        let report = |run: u32, record| {
            folder.add_report(&format!("reports/1-of-1.a.1.{run}.jsonl"), &[record]);
            EarlierRecords::read(folder.path()).unwrap()
        };
        report(9, done_record("a.png", "blue"));
        let earlier = report(10, done_record("a.png", "red"));
        assert_eq!((earlier.find("a.png", "red"), earlier.find("a.png", "blue")), (DONE, None));
        let earlier = report(11, failed_record("a.png", "green"));
        assert_eq!(earlier.find("a.png", "red"), DONE, "a failure leaves the picture unchanged");
        let earlier = report(12, done_record("a.png", "blue"));
        assert_eq!((earlier.find("a.png", "red"), earlier.find("a.png", "blue")), (None, DONE));
        assert_eq!(earlier.find("a.png", "green"), Some(EarlierRecord::Failed));
    }

    #[test]
    fn pictures_in_tar_files_exist_if_the_tar_file_does() {
        let folder = ReportFolder::new("earlier-tar");
        let in_tar = |output: &str, key: &str, tar: &str| {
            let mut record = done_record(output, key);
            record.tar = Some(tar.to_owned());
            record
        };
        let records = [
            in_tar("a.png", "k1", "0.tar"),
            in_tar("a.png", "k2", "0.tar"),
            in_tar("b.png", "k1", "1.tar"),
        ];
        folder.add_report("reports/1-of-1.a.1.1.jsonl", &records);
        folder.add_report("reports/1-of-1.a.1.2.jsonl", &[done_record("a.png", "k3")]);
        folder.add_text("0.tar", b"");
        let earlier = EarlierRecords::read(folder.path()).unwrap();
        let found = Some(EarlierRecord::Done { bytes: 100, is_in_tar: true });
        assert_eq!((earlier.find("a.png", "k1"), earlier.find("a.png", "k2")), (found, found));
        assert_eq!((earlier.find("a.png", "k3"), earlier.find("b.png", "k1")), (DONE, None));
    }

    #[test]
    fn the_result_does_not_depend_on_when_superseded_records_are_removed() {
        let folder = ReportFolder::new("earlier-growth");
        let keys = ["k0", "k1", "k2"];
        let mut last = BTreeMap::new();
        let mut state = 1_u32;
        for run in 1..=20 {
            let outputs: Vec<String> = (0..400).map(|at| format!("{at}.png")).collect();
            let records: Vec<_> = outputs
                .iter()
                .map(|output| {
                    state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    let key = keys[(state >> 16) as usize % 3];
                    last.insert(output.clone(), key);
                    done_record(output, key)
                })
                .collect();
            folder.add_report(&format!("reports/1-of-1.a.1.{run}.jsonl"), &records);
        }
        let earlier = EarlierRecords::read(folder.path()).unwrap();
        assert_eq!(earlier.entries.len(), 400);
        for (output, last) in last {
            for key in keys {
                let expected = if key == last { DONE } else { None };
                assert_eq!(earlier.find(&output, key), expected, "{output} {key}");
            }
        }
    }

    #[test]
    fn outputs_and_keys_are_not_confused() {
        assert_ne!(record_hash("a", "bc"), record_hash("ab", "c"));
        assert_ne!(record_hash("a.png", "k"), record_hash("a.png", "l"));
    }
}
