//! The shared test vectors: one JSON file a topic, computed elsewhere with exact or 50-digit arithmetic.
//!
//! The folder is `$VECTORS`, or `shared/vectors` beside the project. Every file of it is listed: with what its runner
//! found, or as pending with the reason, and a file nobody knows is a failure, so that none is left out in silence.
//! Arguments that are not flags choose files by a part of their name, as in `cargo test`.
//!
//! A runner judges one case: `fn(in, out) -> Result<(), String>`, where the error says what differs. Cases whose
//! exact answer rests on a tie are marked `"fragile": true` in the files; they are run, for they must not panic, but
//! not judged.

#![allow(clippy::print_stdout, reason = "a test program speaks on its standard output")]
#![allow(unreachable_pub, reason = "the modules of a program have no other outside")]

mod chain;
mod clipping;
mod explained;
mod lessons;
mod lines;
mod numbers;
mod points;
mod projection;
mod raster;
mod windows;

use serde_json::Value;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

type Runner = fn(&Value, &Value) -> Result<(), String>;

/// The runners, by the name of their file.
const RUNNERS: &[&[(&str, Runner)]] = &[
    chain::RUNNERS,
    clipping::RUNNERS,
    lessons::RUNNERS,
    lines::RUNNERS,
    points::RUNNERS,
    projection::RUNNERS,
    raster::RUNNERS,
    windows::RUNNERS,
];

/// Files whose subject is not built yet, and why.
const PENDING: &[(&str, &str)] = &[];

/// How many failing cases of a file are printed in full.
const MAX_PRINTED_FAILURES: usize = 5;

#[derive(Default)]
struct Tally {
    passed: usize,
    failed: usize,
    fragile: usize,
    pending: usize,
}

fn main() -> ExitCode {
    let chosen = std::env::var_os("VECTORS").map(PathBuf::from);
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/vectors");
    let folder = chosen.as_deref().unwrap_or(&beside);
    let files = match vector_files(folder) {
        Ok(files) => files,
        Err(_) if chosen.is_none() => {
            println!("SKIPPED vectors: the folder {} was not found", folder.display());
            println!("0 passed, 0 failed, 0 skipped");
            return ExitCode::SUCCESS;
        }
        Err(error) => {
            println!("FAILED vectors: VECTORS names {}: {error}", folder.display());
            return ExitCode::FAILURE;
        }
    };
    // A filter may be meant for another test program.
    if files.is_empty() && name_filters().is_empty() {
        println!("FAILED vectors: there are no such files in {}", folder.display());
        return ExitCode::FAILURE;
    }
    run_files(&files)
}

/// The arguments that choose files.
fn name_filters() -> Vec<String> {
    std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect()
}

/// The JSON files of the folder that the arguments choose, in order.
fn vector_files(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let filters = name_filters();
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let name = file_stem(&path);
        let wanted = filters.is_empty() || filters.iter().any(|filter| name.contains(filter));
        if wanted && path.extension().is_some_and(|extension| extension == "json") {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

fn file_stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

fn run_files(files: &[PathBuf]) -> ExitCode {
    let mut total = Tally::default();
    for path in files {
        let name = file_stem(path);
        let tally = run_file(path, &name);
        total.passed += tally.passed;
        total.failed += tally.failed;
        total.fragile += tally.fragile;
        total.pending += tally.pending;
    }
    println!(
        "{} files: {} cases passed, {} failed, {} fragile, {} pending",
        files.len(),
        total.passed,
        total.failed,
        total.fragile,
        total.pending
    );
    let skipped = total.fragile + total.pending;
    println!("{} passed, {} failed, {skipped} skipped", total.passed, total.failed);
    if total.failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Runs the cases of one file and prints its line.
fn run_file(path: &Path, name: &str) -> Tally {
    let cases = match parse_cases(path) {
        Ok(cases) => cases,
        Err(error) => return broken_file(name, &error),
    };
    let runner = RUNNERS.iter().copied().flatten().find(|(topic, _)| *topic == name);
    if let Some((_, runner)) = runner {
        return run_cases(name, &cases, *runner);
    }
    if let Some((_, reason)) = PENDING.iter().find(|(topic, _)| *topic == name) {
        println!("{name:26} {:4} cases   pending: {reason}", cases.len());
        return Tally { pending: cases.len(), ..Tally::default() };
    }
    broken_file(name, "there is no runner for this file")
}

fn broken_file(name: &str, error: &str) -> Tally {
    println!("{name:26} FAILED: {error}");
    Tally { failed: 1, ..Tally::default() }
}

fn parse_cases(path: &Path) -> Result<Vec<Value>, String> {
    let text = std::fs::read_to_string(path).map_err(|error| error.to_string())?;
    let mut file: Value = serde_json::from_str(&text).map_err(|error| error.to_string())?;
    match file["cases"].take() {
        Value::Array(cases) if !cases.is_empty() => Ok(cases),
        _ => Err("there is no list of cases in it".into()),
    }
}

fn run_cases(name: &str, cases: &[Value], runner: Runner) -> Tally {
    let mut tally = Tally::default();
    let mut failures = Vec::new();
    for (index, case) in cases.iter().enumerate() {
        let fragile = [case, &case["in"], &case["out"]].iter().any(|part| part["fragile"] == true);
        match judge_case(case, runner) {
            Ok(Ok(())) if !fragile => tally.passed += 1,
            Ok(_) if fragile => tally.fragile += 1,
            Ok(Ok(())) => {}
            Ok(Err(difference)) | Err(difference) => {
                tally.failed += 1;
                failures.push(format!("  {name} case {index}{}: {difference}", case_note(case)));
            }
        }
    }
    let Tally { passed, failed, fragile, .. } = tally;
    println!("{name:26} {passed:4} passed {failed:4} failed {fragile:4} fragile");
    for failure in failures.iter().take(MAX_PRINTED_FAILURES) {
        println!("{failure}");
    }
    if failures.len() > MAX_PRINTED_FAILURES {
        println!("  {name}: and {} more", failures.len() - MAX_PRINTED_FAILURES);
    }
    tally
}

/// The runner's judgement; the outer error is a panic, which is a failure even where the answer is not judged.
fn judge_case(case: &Value, runner: Runner) -> Result<Result<(), String>, String> {
    catch_unwind(AssertUnwindSafe(|| runner(&case["in"], &case["out"])))
        .map_err(|_| "it panicked, see above".to_owned())
}

fn case_note(case: &Value) -> String {
    case["note"].as_str().map(|note| format!(" ({note})")).unwrap_or_default()
}
