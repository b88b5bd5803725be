//! Conditions that must hold after a run.

use crate::cluster::batch_run::BatchRun;
use crate::cluster::models::Jobs;
use crate::cluster::slurm::NODE_LOSS;
use crate::cluster::watcher::{Pictures, Seen};
use serde_json::Value;
use std::collections::BTreeMap;
use std::os::unix::fs::MetadataExt as _;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The expected results of a run of all jobs.
pub struct Expected {
    /// The pictures by name.
    pub pictures: Pictures,
    /// The output names for the jobs that fail, with part of their messages.
    pub failed: BTreeMap<String, &'static str>,
}

/// Returns the pictures from the single-process run. There must be one for every good job, and no
/// others.
pub fn read_pictures(run: &BatchRun, jobs: &Jobs) -> Result<Expected, String> {
    let read = |name: &String| {
        let path = run.out_dir().join(name);
        let bytes = std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        alberti_tests::read_png(&path)?;
        Ok((name.clone(), bytes))
    };
    let pictures = jobs.good.iter().map(read).collect::<Result<Pictures, String>>()?;
    let expected = Expected { pictures, failed: jobs.bad.clone() };
    check_pictures(run, &expected)?;
    Ok(expected)
}

/// Checks that the pictures match the bytes of the single-process run, and that there are no
/// others.
pub fn check_pictures(run: &BatchRun, expected: &Expected) -> Result<(), String> {
    let mut found = Snapshot::of(run)?.pictures;
    for (name, bytes) in &expected.pictures {
        let path = run.out_dir().join(name);
        let content =
            std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        if content != *bytes {
            return Err(format!("{name} differs from the single-process picture"));
        }
        found.remove(&path);
    }
    match found.keys().next() {
        None => Ok(()),
        Some(path) => Err(format!("{} does not belong to any good model", path.display())),
    }
}

/// Checks that no picture was drawn more than twice or ever seen incomplete.
pub fn check_draws(seen: &Seen, run: &BatchRun) -> Result<(), String> {
    if let Some(fault) = seen.faults.first() {
        return Err(format!("{fault}, and {} more errors", seen.faults.len() - 1));
    }
    let twice = seen.draws.values().filter(|draws| **draws == 2).count();
    println!("{} pictures were drawn, {twice} of them twice", seen.draws.len());
    let mut draws = seen.draws.clone();
    let mut recorded: BTreeMap<String, usize> = BTreeMap::new();
    for path in files_below(&run.out_dir().join("reports"), "jsonl")? {
        for record in read_records(&path)?.iter().filter(|record| record["status"] == "done") {
            *recorded.entry(text_of(record, "output")).or_default() += 1;
        }
    }
    for (name, count) in recorded {
        let seen = draws.entry(name).or_default();
        *seen = count.max(*seen);
    }
    match draws.iter().find(|(_, count)| **count > 2) {
        None => Ok(()),
        Some((name, count)) => Err(format!("{name} was drawn {count} times")),
    }
}

/// Checks that the merged report has one record for each job.
pub fn check_records(run: &BatchRun, expected: &Expected) -> Result<(), String> {
    let mut done = 0;
    let mut failed = expected.failed.clone();
    for record in read_records(&run.out_dir().join("report.jsonl"))? {
        let output = text_of(&record, "output");
        let is_done = record["status"] == "done";
        let reason = failed.remove(&output);
        match (is_done, reason) {
            (true, None) if expected.pictures.contains_key(&output) => done += 1,
            (false, Some(reason)) if text_of(&record, "message").contains(reason) => {}
            _ => return Err(format!("unexpected or duplicate record: {record}")),
        }
    }
    if done == expected.pictures.len() && failed.is_empty() {
        return Ok(());
    }
    let missing = expected.pictures.len() - done;
    Err(format!("{missing} good jobs have no record; failed jobs without a record: {failed:?}"))
}

/// Checks that `--verify` names exactly the failed jobs.
pub fn check_verdict((code, text): &(i32, String), expected: &Expected) -> Result<(), String> {
    println!("{}", text.trim_end());
    let named = |name: &String| text.lines().filter(|line| line.contains(name.as_str())).count();
    let good = expected.pictures.keys().map(named).sum::<usize>();
    let bad = expected.failed.keys().map(named).sum::<usize>();
    if *code == 1 && good == 0 && bad == expected.failed.len() {
        return Ok(());
    }
    Err(format!("--verify exited with {code} and names {good} good and {bad} bad jobs"))
}

/// Checks that the disturbed run took only a little longer than the undisturbed run.
///
/// All nodes share this machine's processors, so the remaining nodes can do all the work just as
/// fast.
pub fn check_time(time: Duration, undisturbed: Duration) -> Result<(), String> {
    let limit = undisturbed.mul_f64(1.15) + NODE_LOSS;
    let (time, limit) = (time.as_secs_f64(), limit.as_secs_f64());
    println!("{time:.1} s; at most {limit:.1} s are allowed");
    if time <= limit {
        return Ok(());
    }
    let without = undisturbed.as_secs_f64();
    Err(format!(
        "the run took {time:.1} s; at most {limit:.1} s are allowed (undisturbed: {without:.1} s)"
    ))
}

/// The pictures and records of a run at one moment.
pub struct Snapshot {
    /// The inode and modification time of each picture.
    pictures: BTreeMap<PathBuf, (u64, i64, i64)>,
    /// The number of records.
    records: usize,
}

impl Snapshot {
    /// Returns the current state.
    pub fn of(run: &BatchRun) -> Result<Self, String> {
        let state = |path: PathBuf| {
            let data = path.metadata().map_err(|error| format!("{}: {error}", path.display()))?;
            Ok((path, (data.ino(), data.mtime(), data.mtime_nsec())))
        };
        let pictures = files_below(&run.out_dir(), "png")?;
        let pictures = pictures.into_iter().map(state).collect::<Result<_, String>>()?;
        let mut records = 0;
        for path in files_below(&run.out_dir().join("reports"), "jsonl")? {
            records += read_records(&path)?.len();
        }
        Ok(Self { pictures, records })
    }

    /// Checks that nothing has been drawn or recorded since.
    pub fn check_unchanged(&self, run: &BatchRun) -> Result<(), String> {
        let now = Self::of(run)?;
        let redrawn = now
            .pictures
            .iter()
            .filter(|(path, state)| self.pictures.get(*path) != Some(state))
            .count();
        if redrawn == 0 && now.records == self.records && now.pictures.len() == self.pictures.len()
        {
            return Ok(());
        }
        let new = now.records.abs_diff(self.records);
        Err(format!("a second submission drew {redrawn} pictures and wrote {new} records"))
    }
}

/// Returns the files in a folder that have an extension, or none if the folder does not exist.
fn files_below(folder: &Path, extension: &str) -> Result<Vec<PathBuf>, String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let paths: Result<Vec<PathBuf>, _> = entries.map(|entry| Ok(entry?.path())).collect();
    let mut paths =
        paths.map_err(|error: std::io::Error| format!("{}: {error}", folder.display()))?;
    paths.retain(|path| path.extension().is_some_and(|found| found == extension));
    paths.sort();
    Ok(paths)
}

/// Returns the records of a report. A killed process may leave an incomplete last line.
fn read_records(path: &Path) -> Result<Vec<Value>, String> {
    let text = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let lines = text.split(|byte| *byte == b'\n');
    Ok(lines.filter_map(|line| serde_json::from_slice(line).ok()).collect())
}

fn text_of(record: &Value, member: &str) -> String {
    record[member].as_str().unwrap_or_default().to_owned()
}
