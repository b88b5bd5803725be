//! Exact vectors: one JSON file per topic, computed elsewhere with rational or 50-digit arithmetic.
//!
//! The files and a description of their format are in `tests/vectors/data`; `$VECTORS` selects
//! another folder. A file without a runner is a failure, so that no file is skipped silently.
//! Arguments that are not flags select files whose names contain them.
//!
//! A runner tests one case: `fn(in, out) -> Result<(), String>`, where the error describes the
//! difference. Cases whose exact answer depends on a tie are marked `"fragile": true`: they run,
//! because they must not panic, but are not compared.

mod chain;
mod classical;
mod clipping;
mod explained;
mod lessons;
mod lines;
mod numbers;
mod points;
mod projection;
mod raster;
mod windows;

use alberti_tests::harness::{Arguments, Tally, run_program};
use alberti_tests::project_root;
use serde_json::Value;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// A function that tests the output of one case, given its input.
type Runner = fn(&Value, &Value) -> Result<(), String>;

/// The runners, by file name.
const RUNNERS: &[&[(&str, Runner)]] = &[
    chain::RUNNERS,
    classical::RUNNERS,
    clipping::RUNNERS,
    lessons::RUNNERS,
    lines::RUNNERS,
    points::RUNNERS,
    projection::RUNNERS,
    raster::RUNNERS,
    windows::RUNNERS,
];

/// The maximum number of failing cases per file that are printed in full.
const MAX_PRINTED_FAILURES: usize = 5;

pub fn run() -> ExitCode {
    run_program("vectors", run_files)
}

fn run_files(arguments: &Arguments) -> Result<Tally, String> {
    let named = std::env::var_os("VECTORS").map(PathBuf::from);
    let folder = named.unwrap_or_else(|| project_root().join("tests/vectors/data"));
    let files = vector_files(&folder)?;
    if files.is_empty() {
        return Err(format!("no vectors found in {}", folder.display()));
    }
    let mut tally = Tally::default();
    for path in &files {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        if !arguments.select(&name) {
            continue;
        }
        let runner = RUNNERS.iter().copied().flatten().find(|(topic, _)| *topic == name);
        match (parse_cases(path), runner) {
            (Ok(cases), Some((_, runner))) => run_cases(&name, &cases, *runner, &mut tally),
            (Ok(_), None) => tally.fail(&name, "no runner exists for this file"),
            (Err(error), _) => tally.fail(&name, &error),
        }
    }
    Ok(tally)
}

/// Returns the JSON files in a folder, sorted by name.
fn vector_files(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let entries =
        std::fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let is_json = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "json");
    let mut files: Vec<PathBuf> = paths.filter(is_json).collect();
    files.sort();
    Ok(files)
}

fn parse_cases(path: &Path) -> Result<Vec<Value>, String> {
    let text = std::fs::read_to_string(path).map_err(|error| error.to_string())?;
    let mut file: Value = serde_json::from_str(&text).map_err(|error| error.to_string())?;
    match file["cases"].take() {
        Value::Array(cases) if !cases.is_empty() => Ok(cases),
        _ => Err("the list of cases is missing".into()),
    }
}

/// Runs the cases of one file and prints a line of counts, then the first failures.
fn run_cases(name: &str, cases: &[Value], runner: Runner, tally: &mut Tally) {
    let (mut passed, mut fragile, mut failures) = (0, 0, Vec::new());
    for (index, case) in cases.iter().enumerate() {
        let is_fragile =
            [case, &case["in"], &case["out"]].iter().any(|part| part["fragile"] == true);
        match run_case(case, runner) {
            Ok(_) if is_fragile => fragile += 1,
            Ok(Ok(())) => passed += 1,
            Ok(Err(difference)) | Err(difference) => {
                failures.push((format!("{name} case {index}{}", case_note(case)), difference));
            }
        }
    }
    println!("{name:26} {passed:4} passed {:4} failed {fragile:4} fragile", failures.len());
    tally.pass(passed);
    for (case, difference) in failures.iter().take(MAX_PRINTED_FAILURES) {
        tally.fail(case, difference);
    }
    if failures.len() > MAX_PRINTED_FAILURES {
        tally.fail(name, &format!("{} more cases", failures.len() - MAX_PRINTED_FAILURES));
    }
}

/// Returns the result of the runner. The outer error is a panic, which is a failure even in a
/// fragile case.
fn run_case(case: &Value, runner: Runner) -> Result<Result<(), String>, String> {
    catch_unwind(AssertUnwindSafe(|| runner(&case["in"], &case["out"])))
        .map_err(|_| "panicked, see above".to_owned())
}

fn case_note(case: &Value) -> String {
    case["note"].as_str().map(|note| format!(" ({note})")).unwrap_or_default()
}
