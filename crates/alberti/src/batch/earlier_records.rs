//! What earlier runs have done, in a form of 16 bytes for each record.

use super::report_reader::{RecordLine, read_reports};
use crate::CliError;
use std::collections::BTreeMap;
use std::path::Path;

/// What became of a job in an earlier run.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum EarlierRecord {
    /// Its picture was made.
    Done {
        /// The size of the picture.
        bytes: u64,
        /// Whether the picture is in a tar file, which exists.
        is_in_tar: bool,
    },
    /// It failed.
    Failed,
}

/// The records of earlier runs, by output and key.
///
/// A record is found by a hash of 64 bits. Two of ten million different ones have the same with a
/// probability of 1 to 400,000, and their pictures would have to have the same size as well.
pub(super) struct EarlierRecords {
    /// The hash of output and key, and what became of it; sorted, without duplicates.
    entries: Vec<(u64, PackedRecord)>,
}

/// What became of a job in 8 bytes: the size of the picture and two flags.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct PackedRecord(u64);

impl PackedRecord {
    /// Set if the job failed. Failures are the greatest and thereby the last of a job.
    const FAILED: u64 = 1 << 63;
    /// Set if the picture is a file of its own. One in a tar file, which is known to be there, comes
    /// first.
    const IN_FILE: u64 = 1 << 62;

    fn of_line(record: &RecordLine<'_>) -> Self {
        let flag = match &record.tar {
            _ if !record.is_done() => return Self(Self::FAILED),
            Some(_) => 0,
            None => Self::IN_FILE,
        };
        Self(flag | record.bytes.min(Self::IN_FILE - 1))
    }

    const fn unpack(self) -> EarlierRecord {
        if self.0 & Self::FAILED != 0 {
            return EarlierRecord::Failed;
        }
        let is_in_tar = self.0 & Self::IN_FILE == 0;
        EarlierRecord::Done { bytes: self.0 & !Self::IN_FILE, is_in_tar }
    }
}

impl EarlierRecords {
    /// Reads all reports of an output folder.
    ///
    /// Records of pictures in tar files that are gone are left out.
    ///
    /// # Errors
    /// If a report cannot be read.
    pub(super) fn read(out_dir: &Path) -> Result<Self, CliError> {
        let mut records = Self { entries: Vec::new() };
        let mut tars: BTreeMap<String, bool> = BTreeMap::new();
        read_reports(out_dir, |record, _| {
            if let Some(tar) = &record.tar {
                let is_there = match tars.get(tar) {
                    Some(is_there) => *is_there,
                    None => {
                        let is_there = out_dir.join(tar).is_file();
                        tars.insert(tar.clone(), is_there);
                        is_there
                    }
                };
                if !is_there {
                    return Ok(());
                }
            }
            let hash = record_hash(&record.output, &record.key);
            records.add_entry(hash, PackedRecord::of_line(record));
            Ok(())
        })?;
        records.remove_duplicates();
        Ok(records)
    }

    /// The record of a job with this output and key; a picture counts more than a failure.
    pub(super) fn find(&self, output: &str, key: &str) -> Option<EarlierRecord> {
        let hash = record_hash(output, key);
        let at = self.entries.partition_point(|(other, _)| *other < hash);
        self.entries.get(at).filter(|(other, _)| *other == hash).map(|(_, packed)| packed.unpack())
    }

    /// Adds a record. Before the memory grows, duplicates are removed: a merged report has all
    /// records of the others once more.
    fn add_entry(&mut self, hash: u64, packed: PackedRecord) {
        if self.entries.len() == self.entries.capacity() {
            self.remove_duplicates();
            let length = self.entries.len();
            if length >= self.entries.capacity() / 4 * 3 {
                self.entries.reserve_exact((length / 2).max(1024));
            }
        }
        self.entries.push((hash, packed));
    }

    fn remove_duplicates(&mut self) {
        self.entries.sort_unstable();
        self.entries.dedup();
    }
}

/// The hash of an output and a key: FNV-1a, mixed once more so that all of its bits are good.
pub(super) fn record_hash(output: &str, key: &str) -> u64 {
    let bytes = output.bytes().chain([0]).chain(key.bytes());
    let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    });
    let mixed = (hash ^ (hash >> 32)).wrapping_mul(0xd6e8_feb8_6659_fd93);
    mixed ^ (mixed >> 32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::batch::test_records::{ReportFolder, done_record, failed_record};

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
        assert_eq!(earlier.find("0000.png", "k2"), None, "the key is another one");
        assert_eq!(earlier.find("3000.png", "k1"), None);
    }

    #[test]
    fn a_picture_counts_more_than_a_failure_of_the_same_key() {
        let folder = ReportFolder::new("earlier-failed");
        folder.add_report("reports/1-of-1.a.1.1.jsonl", &[done_record("a.png", "k")]);
        let failed = [failed_record("a.png", "k"), failed_record("b.png", "k")];
        folder.add_report("reports/1-of-1.a.1.2.jsonl", &failed);
        let earlier = EarlierRecords::read(folder.path()).unwrap();
        assert_eq!(earlier.find("a.png", "k"), DONE);
        assert_eq!(earlier.find("b.png", "k"), Some(EarlierRecord::Failed));
    }

    #[test]
    fn pictures_in_tar_files_are_there_if_the_file_is() {
        let folder = ReportFolder::new("earlier-tar");
        let in_tar = |output: &str, tar: &str| {
            let mut record = done_record(output, "k");
            record.tar = Some(tar.to_owned());
            record
        };
        let records = [in_tar("a.png", "0.tar"), in_tar("b.png", "1.tar")];
        folder.add_report("reports/1-of-1.a.1.1.jsonl", &records);
        folder.add_text("0.tar", b"");
        let earlier = EarlierRecords::read(folder.path()).unwrap();
        let found = Some(EarlierRecord::Done { bytes: 100, is_in_tar: true });
        assert_eq!(earlier.find("a.png", "k"), found);
        assert_eq!(earlier.find("b.png", "k"), None);
    }

    #[test]
    fn outputs_and_keys_are_not_confused() {
        assert_ne!(record_hash("a", "bc"), record_hash("ab", "c"));
        assert_ne!(record_hash("a.png", "k"), record_hash("a.png", "l"));
    }
}
