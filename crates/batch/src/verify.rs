//! `batch --verify`: checks that every job has a record with its key and an intact picture.

use super::earlier_records::record_hash;
use super::job::{BatchJob, JobGroup};
use super::key::KeyMaker;
use super::report_reader::{RecordLine, read_reports};
use super::tar_format::read_archive;
use super::tar_output::sample_name;
use crate::BatchError;
use crate::content_digest::{ContentDigest, parse_sha256};
use files::visible_text;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufReader, ErrorKind};
use std::path::Path;

/// The size of the buffer in which tar files are read.
const BUFFER_BYTES: usize = 1 << 16;

/// Verifies the jobs and reports the problems, one line per picture, then the counts; returns true
/// if there are no problems.
///
/// ```text
/// more/fox.png: missing: the picture does not exist
/// 117 intact, 1 missing, 0 wrong, 0 failed
/// ```
/// The models are hashed as for a run, and the pictures are read completely.
///
/// # Errors
/// Returns an error if a list or a report cannot be read, or if `tell` fails.
pub(super) fn verify_jobs<E: From<BatchError>>(
    groups: impl Iterator<Item = Result<JobGroup, BatchError>>,
    keys: &KeyMaker,
    out_dir: &Path,
    mut tell: impl FnMut(&str) -> Result<(), E>,
) -> Result<bool, E> {
    let mut verifier = Verifier::read(out_dir)?;
    let mut counts = VerdictCounts::default();
    for group in groups {
        for job in group?.jobs {
            let verdict = verifier.verify_job(&job, &keys.job_key(&job));
            if let Some(problem) = counts.count_verdict(&verdict) {
                tell(&format!("{}: {problem}\n", visible_text(&job.output)))?;
            }
        }
    }
    tell(&format!("{}\n", counts.summary()))?;
    Ok(counts.is_all_whole())
}

/// The state of a job's picture.
#[derive(Clone, PartialEq, Eq, Debug)]
enum Verdict {
    /// The picture exists and has the recorded bytes.
    Whole,
    /// The record or the picture is missing, for this reason.
    Missing(&'static str),
    /// The picture does not match its record, for this reason.
    Wrong(String),
    /// The job failed.
    Failed,
}

/// The number of verdicts of each kind.
#[derive(Clone, Copy, Default)]
struct VerdictCounts {
    whole: u64,
    missing: u64,
    wrong: u64,
    failed: u64,
}

impl VerdictCounts {
    /// Counts a verdict; returns its text, unless the picture is intact.
    fn count_verdict(&mut self, verdict: &Verdict) -> Option<String> {
        let (count, words) = match verdict {
            Verdict::Whole => (&mut self.whole, None),
            Verdict::Missing(why) => (&mut self.missing, Some(format!("missing: {why}"))),
            Verdict::Wrong(why) => (&mut self.wrong, Some(format!("wrong: {why}"))),
            Verdict::Failed => {
                let words =
                    "failed: see the report for the message; use --retry-failed to retry it";
                (&mut self.failed, Some(words.to_owned()))
            }
        };
        *count += 1;
        words
    }

    fn summary(self) -> String {
        let Self { whole, missing, wrong, failed } = self;
        format!("{whole} intact, {missing} missing, {wrong} wrong, {failed} failed")
    }

    const fn is_all_whole(self) -> bool {
        self.missing + self.wrong + self.failed == 0
    }
}

/// The records of all runs, and the tar file contents read so far.
struct Verifier<'a> {
    out_dir: &'a Path,
    /// The hash of each output and key, with the picture; sorted.
    records: Vec<(u64, RecordedPicture)>,
    /// The tar file names.
    tars: Vec<String>,
    /// The samples of the tar files read so far.
    contents: BTreeMap<u32, TarContent>,
}

/// The pictures in a tar file by the hashes of their names, or the reason why it cannot be read.
type TarContent = Result<BTreeMap<u64, ContentDigest>, String>;

/// A picture as recorded. Rendered pictures sort first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum RecordedPicture {
    /// The picture was rendered, and is in the tar file with this index, if any.
    Done(ContentDigest, Option<u32>),
    Failed,
}

impl<'a> Verifier<'a> {
    /// Reads all reports of an output folder.
    fn read(out_dir: &'a Path) -> Result<Self, BatchError> {
        let (mut records, mut tars) = (Vec::new(), BTreeMap::<String, u32>::new());
        read_reports(out_dir, |record, _| {
            let tar = record.tar.clone().map(|tar| {
                let next = tars.len() as u32;
                *tars.entry(tar).or_insert(next)
            });
            if let Some(picture) = RecordedPicture::from_line(record, tar) {
                records.push((record_hash(&record.output, &record.key), picture));
            }
            Ok(())
        })?;
        records.sort_unstable();
        records.dedup();
        let mut names = vec![String::new(); tars.len()];
        tars.into_iter().for_each(|(tar, at)| names[at as usize] = tar);
        Ok(Self { out_dir, records, tars: names, contents: BTreeMap::new() })
    }

    /// Returns the verdict on a job's picture, which is intact if any of its records matches;
    /// otherwise the verdict is the problem with its last record.
    fn verify_job(&mut self, job: &BatchJob, key: &str) -> Verdict {
        let hash = record_hash(&job.output, key);
        let begin = self.records.partition_point(|(other, _)| *other < hash);
        let mut verdict = Verdict::Missing("no run has recorded it with these flags and files");
        let mut at = begin;
        while let Some((_, picture)) = self.records.get(at).filter(|(other, _)| *other == hash) {
            match *picture {
                RecordedPicture::Failed if at > begin => break,
                RecordedPicture::Failed => return Verdict::Failed,
                RecordedPicture::Done(picture, tar) => {
                    verdict = self.verify_picture(&job.output, picture, tar);
                }
            }
            if verdict == Verdict::Whole {
                break;
            }
            at += 1;
        }
        verdict
    }

    /// Compares a picture with its record.
    fn verify_picture(
        &mut self,
        output: &str,
        recorded: ContentDigest,
        tar: Option<u32>,
    ) -> Verdict {
        let found = match tar {
            Some(tar) => self.picture_in_tar(output, tar),
            None => match open_file(&self.out_dir.join(output)) {
                Err(_) => return Verdict::Missing("the picture does not exist"),
                // The size is compared first, because that reads nothing.
                Ok(file) if file.metadata().is_ok_and(|data| data.len() != recorded.bytes) => {
                    return Verdict::Wrong(format!(
                        "its size is not the recorded {} bytes",
                        recorded.bytes
                    ));
                }
                Ok(mut file) => {
                    ContentDigest::of_reader(&mut file).map_err(|cause| cause.to_string())
                }
            },
        };
        match found {
            Ok(found) if found == recorded => Verdict::Whole,
            Ok(_) => Verdict::Wrong("its SHA-256 does not match the record".to_owned()),
            Err(fault) => Verdict::Wrong(fault),
        }
    }

    /// Returns the picture in a tar file; each tar file is read only once.
    fn picture_in_tar(&mut self, output: &str, tar: u32) -> Result<ContentDigest, String> {
        let (name, out_dir) = (&self.tars[tar as usize], self.out_dir);
        let content = self.contents.entry(tar).or_insert_with(|| read_tar(&out_dir.join(name)));
        let pictures = content.as_ref().map_err(|fault| format!("{name}: {fault}"))?;
        let found = pictures.get(&record_hash(&sample_name(output), ""));
        found.copied().ok_or_else(|| format!("it is not in {name}"))
    }
}

/// Opens a regular file; a pipe would block.
fn open_file(path: &Path) -> std::io::Result<File> {
    if path.metadata()?.is_file() { File::open(path) } else { Err(ErrorKind::NotFound.into()) }
}

/// Returns the size and SHA-256 of each picture in a tar file.
fn read_tar(path: &Path) -> TarContent {
    let mut pictures = BTreeMap::new();
    let file = open_file(path).map_err(|cause| cause.to_string())?;
    let read = read_archive(&mut BufReader::with_capacity(BUFFER_BYTES, file), |name, content| {
        pictures.insert(record_hash(name, ""), ContentDigest::of_reader(content)?);
        Ok(())
    });
    read.map(|()| pictures).map_err(|cause| cause.to_string())
}

impl RecordedPicture {
    /// Returns the picture of a record, or `None` if its SHA-256 is invalid.
    fn from_line(record: &RecordLine<'_>, tar: Option<u32>) -> Option<Self> {
        if !record.is_done() {
            return Some(Self::Failed);
        }
        let sha256 = parse_sha256(&record.sha256)?;
        Some(Self::Done(ContentDigest { bytes: record.bytes, sha256 }, tar))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Shard;
    use crate::content_digest::hexadecimal_sha256;
    use crate::report::{JobRecord, ReportWriter};
    use crate::tar_output::TarOutput;
    use crate::test_records::{ReportFolder, done_record, failed_record};
    use std::path::PathBuf;

    /// Returns the record of a picture with these bytes.
    fn record_of(output: &str, picture: &[u8]) -> JobRecord {
        let sha256 = hexadecimal_sha256(picture);
        JobRecord { bytes: picture.len() as u64, sha256, ..done_record(output, "k") }
    }

    /// Returns the verdict on an output with the key `k`.
    fn verdict(folder: &ReportFolder, output: &str) -> Verdict {
        let (input, output) = (PathBuf::from("a.glb"), output.to_owned());
        let job =
            BatchJob { input, output, scene: None, flags: Vec::new(), line: None, fault: None };
        Verifier::read(folder.path()).unwrap().verify_job(&job, "k")
    }

    #[test]
    fn pictures_are_intact_missing_wrong_or_failed() {
        let folder = ReportFolder::new("verify");
        let mut other_key = record_of("old.png", b"1");
        other_key.key = "k0".to_owned();
        let records = [
            record_of("whole.png", b"12"),
            record_of("gone.png", b"12"),
            record_of("short.png", b"12"),
            record_of("changed.png", b"12"),
            failed_record("failed.png", "k"),
            failed_record("repaired.png", "k"),
            record_of("repaired.png", b"34"),
            failed_record("lost.png", "k"),
            record_of("lost.png", b"5"),
            other_key,
        ];
        folder.add_report("reports/1-of-1.a.1.1.jsonl", &records);
        let pictures =
            [("whole", "12"), ("short", "1"), ("changed", "13"), ("repaired", "34"), ("old", "1")];
        for (name, content) in pictures {
            folder.add_text(&format!("{name}.png"), content.as_bytes());
        }
        let of = |name: &str| verdict(&folder, &format!("{name}.png"));
        assert_eq!([of("whole"), of("repaired")], [Verdict::Whole, Verdict::Whole]);
        for name in ["gone", "old", "lost", "unknown"] {
            assert!(matches!(of(name), Verdict::Missing(_)), "{name}");
        }
        for name in ["short", "changed"] {
            assert!(matches!(of(name), Verdict::Wrong(_)), "{name}");
        }
        assert_eq!(of("failed"), Verdict::Failed);
    }

    #[test]
    fn pictures_in_tar_files_are_read() {
        let folder = ReportFolder::new("verify-tar");
        let report = ReportWriter::create(folder.path(), Shard::ALL_JOBS).unwrap();
        let tars = TarOutput::new(folder.path(), report.run_name(), 2);
        let pictures = [("a.png", b"1"), ("b.c.png", b"2"), ("d.png", b"3"), ("e.png", b"4")];
        for (name, content) in pictures {
            let record = record_of(name, content);
            let record = if name == "d.png" { record_of(name, b"x") } else { record };
            tars.add_sample(record, content, &report).unwrap();
        }
        assert_eq!(
            [verdict(&folder, "a.png"), verdict(&folder, "b.c.png")],
            [Verdict::Whole, Verdict::Whole]
        );
        assert!(matches!(verdict(&folder, "d.png"), Verdict::Wrong(_)));
        let last = folder.path().join("shard-1-of-1-000001.tar");
        let bytes = std::fs::read(&last).unwrap();
        std::fs::write(&last, &bytes[..600]).unwrap();
        assert!(
            matches!(verdict(&folder, "e.png"), Verdict::Wrong(fault) if fault.contains("000001"))
        );
    }

    #[test]
    fn counts_show_whether_every_picture_is_intact() {
        let mut counts = VerdictCounts::default();
        assert_eq!(counts.count_verdict(&Verdict::Whole), None);
        assert!(counts.is_all_whole());
        assert!(counts.count_verdict(&Verdict::Failed).is_some());
        assert!(!counts.is_all_whole());
        assert_eq!(counts.summary(), "1 intact, 0 missing, 0 wrong, 1 failed");
    }
}
