//! `check` against the Khronos validator: every file of the shared corpus, the two verdicts side by side.
//!
//! The folder is `$ASSETS`, or `shared/assets` beside the project; the column `validator_error_codes` of its `MANIFEST.tsv` has the
//! errors that the validator finds. Broken files are loaded leniently as well. Where it finds none, neither may the check; where it finds some, the check must find
//! an error at a place, and the same kinds of errors. What differs stands in [`expected`] with the reason. Arguments that
//! are not flags choose files by a part of their path, as in `cargo test`; `--all` prints what is found in each file.

#![allow(clippy::print_stdout, reason = "a test program speaks on its standard output")]
#![allow(missing_docs, unreachable_pub, reason = "the modules of a program have no other outside")]

mod expected;
mod lenient;
#[path = "../corpus/manifest.rs"]
#[allow(dead_code, reason = "the corpus test needs the rest")]
mod manifest;
mod tally;

use manifest::Row;
use model::Severity;
use model::import::{CheckReport, ImportOptions, check_file};
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use tally::CodeTally;

fn main() -> ExitCode {
    let chosen = std::env::var_os("ASSETS").map(PathBuf::from);
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/assets");
    let folder = chosen.as_deref().unwrap_or(&beside);
    if chosen.is_none() && !folder.is_dir() {
        println!("SKIPPED check: the folder {} was not found", folder.display());
        println!("0 passed, 0 failed, 1 skipped");
        return ExitCode::SUCCESS;
    }
    let failures = match check_corpus(folder) {
        Ok((passed, failures)) => {
            failures.iter().for_each(|failure| println!("FAILED {failure}"));
            println!("{passed} passed, {} failed, 0 skipped", failures.len());
            failures.len()
        }
        Err(error) => {
            println!("FAILED check: {error}");
            println!("0 passed, 1 failed, 0 skipped");
            1
        }
    };
    if failures == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Checks the files of a folder; gives the number of those that are as expected, and what is wrong with the others.
fn check_corpus(folder: &Path) -> Result<(usize, Vec<String>), String> {
    let filters: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let prints = std::env::args().any(|argument| argument == "--all");
    let mut rows = manifest::read_manifest(folder)?;
    rows.retain(|row| filters.is_empty() || filters.iter().any(|f| row.path.contains(f.as_str())));
    let start = Instant::now();
    let reports = check_all(folder, &rows);
    println!("{} files in {:.1} s", rows.len(), start.elapsed().as_secs_f64());
    let (mut passed, mut failures, mut tally) = (0, Vec::new(), CodeTally::default());
    for (row, report) in rows.iter().zip(&reports) {
        let Some(report) = report else {
            failures.push(format!("{}: panic", row.path));
            continue;
        };
        let actual = error_codes(report);
        if prints {
            println!("{}: {}", row.path, report.summary());
            report.diagnostics.iter().for_each(|problem| println!("    {problem}"));
        }
        tally.add_file(row, &actual);
        match expected::difference_from_validator(row, report, &actual) {
            Some(difference) => failures.push(format!("{}: {difference}", row.path)),
            None => passed += 1,
        }
    }
    tally.print_table();
    failures.extend(lenient::check_lenient_loading(folder, &rows));
    Ok((passed, failures))
}

/// The names of all kinds of errors in a report.
fn error_codes(report: &CheckReport) -> BTreeSet<&'static str> {
    let errors = report.diagnostics.iter().filter(|problem| problem.severity == Severity::Error);
    errors.map(|problem| problem.code).collect()
}

/// Checks all files, two at a time; `None` where there was a panic.
fn check_all(folder: &Path, rows: &[Row]) -> Vec<Option<CheckReport>> {
    let reports: Vec<Mutex<Option<CheckReport>>> = rows.iter().map(|_| Mutex::new(None)).collect();
    let next = AtomicUsize::new(0);
    let work = || {
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(row) = rows.get(at) else { break };
            let path = folder.join(&row.path);
            let work = AssertUnwindSafe(|| check_file(&path, &ImportOptions::default()));
            if let (Ok(report), Ok(mut slot)) = (catch_unwind(work), reports[at].lock()) {
                *slot = Some(report);
            }
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(work);
        work();
    });
    reports.into_iter().map(|slot| slot.into_inner().ok().flatten()).collect()
}
