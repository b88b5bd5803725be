//! Compares the errors that `check` and the Khronos glTF validator report for every file in a
//! corpus.
//!
//! Two corpora are checked: the one that [`alberti_tests::samples`] generates and, if it exists,
//! the folder `$ASSETS` or `shared/assets` next to the repository. The manifest column
//! `validator_error_codes` lists the codes of the validator's errors. If it is empty, the check
//! must find no errors; otherwise it must find these errors and locate each by a JSON pointer.
//! [`expected`] lists intended differences. Broken files are also loaded leniently. Arguments that
//! are not flags select files whose paths contain them; `--all` prints every diagnostic.

mod expected;
mod lenient;
mod tally;

use alberti_tests::harness::{Arguments, Tally, data_folder, map_parallel, run_program};
use alberti_tests::manifest::{Row, read_manifest};
use alberti_tests::samples::write_samples;
use gltf_check::{CheckReport, check_file};
use import::ImportOptions;
use model::Severity;
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;
use tally::CodeTally;

pub fn run() -> ExitCode {
    run_program("check", |arguments| {
        let samples = Path::new(env!("CARGO_TARGET_TMPDIR")).join("check");
        write_samples(&samples)?;
        let mut tally = check_corpus(&samples, arguments)?;
        if let Some(assets) = data_folder("ASSETS", "assets")? {
            tally += check_corpus(&assets, arguments)?;
        }
        Ok(tally)
    })
}

/// Checks the files in a folder and loads its broken files leniently.
fn check_corpus(folder: &Path, arguments: &Arguments) -> Result<Tally, String> {
    println!("{}", folder.display());
    let mut rows = read_manifest(folder)?;
    rows.retain(|row| arguments.select(&row.path));
    let start = Instant::now();
    let reports = check_files(folder, &rows);
    println!("{} files in {:.1} s", rows.len(), start.elapsed().as_secs_f64());
    let (mut tally, mut codes) = (Tally::default(), CodeTally::default());
    for (row, report) in rows.iter().zip(&reports) {
        let Some(report) = report else {
            tally.fail(&row.path, "panic");
            continue;
        };
        let actual = error_codes(report);
        if arguments.has_flag("--all") {
            println!("{}: {}", row.path, report.summary());
            report.diagnostics.iter().for_each(|diagnostic| println!("    {diagnostic}"));
        }
        codes.add_file(row, &actual);
        let difference = expected::difference_from_validator(row, report, &actual);
        tally.record(&row.path, difference.map_or(Ok(()), Err));
    }
    codes.print_table();
    lenient::check_lenient_loading(folder, &rows, &mut tally);
    Ok(tally)
}

/// Returns the codes of all errors in a report.
fn error_codes(report: &CheckReport) -> BTreeSet<&'static str> {
    let errors =
        report.diagnostics.iter().filter(|diagnostic| diagnostic.severity == Severity::Error);
    errors.map(|diagnostic| diagnostic.code).collect()
}

/// Checks all files, two at a time; a file that causes a panic gives `None`.
fn check_files(folder: &Path, rows: &[Row]) -> Vec<Option<CheckReport>> {
    map_parallel(rows, |_, row| {
        let path = folder.join(&row.path);
        catch_unwind(AssertUnwindSafe(|| check_file(&path, &ImportOptions::default()))).ok()
    })
}
