//! Every file of the shared corpus, drawn by the real program: rendered, or refused with a reason.
//!
//! The folder is `$ASSETS`, or `shared/assets` beside the project; its `MANIFEST.tsv` lists the files. Each is drawn in a
//! process of its own, two at a time, with thirty seconds to do it. Allowed are two outcomes: exit code 0 and a PNG of the right
//! size, or exit code 1, a message that names the file and says why, and no PNG. The files under `models` are held to
//! [`expected`]: what is refused there stands in a table, and the numbers of triangles are those of the manifest.
//! Arguments that are not flags choose files by a part of their path, as in `cargo test`.

#![allow(clippy::print_stdout, reason = "a test program speaks on its standard output")]
#![allow(missing_docs, unreachable_pub, reason = "the modules of a program have no other outside")]

mod expected;
#[allow(dead_code, reason = "the test of `check` needs the rest")]
mod manifest;
mod program;
mod triangles;
mod verdict;

use manifest::Row;
use program::Program;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use verdict::Verdict;

/// The size of the pictures.
const PICTURE_SIZE: (u32, u32) = (64, 48);

/// The groups of files that are drawn.
const GROUPS: [&str; 3] = ["models", "validator-valid", "bad"];

#[derive(Default)]
struct Tally {
    drawn: usize,
    blank: usize,
    refused: usize,
    failed: usize,
}

fn main() -> ExitCode {
    let chosen = std::env::var_os("ASSETS").map(PathBuf::from);
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/assets");
    let folder = chosen.as_deref().unwrap_or(&beside);
    if chosen.is_none() && !folder.is_dir() {
        println!("SKIPPED corpus: the folder {} was not found", folder.display());
        println!("0 passed, 0 failed, 1 skipped");
        return ExitCode::SUCCESS;
    }
    match draw_corpus(folder, chosen.is_none()) {
        Ok((passed, failed)) => {
            println!("{passed} passed, {failed} failed, 0 skipped");
            if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
        }
        Err(error) => {
            println!("FAILED corpus: {error}");
            println!("0 passed, 1 failed, 0 skipped");
            ExitCode::FAILURE
        }
    }
}

/// Draws the files of a folder and prints what became of them. `known` says that it is the folder the tables are about.
fn draw_corpus(folder: &Path, known: bool) -> Result<(usize, usize), String> {
    let filters: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let mut rows = manifest::read_manifest(folder)?;
    rows.retain(|row| filters.is_empty() || filters.iter().any(|f| row.path.contains(f.as_str())));
    rows.retain(|row| GROUPS.contains(&row.group()));
    let program = Program::build()?;
    let verdicts = draw_all(&program, folder, &rows)?;
    let mut failures = Vec::new();
    let mut tallies: BTreeMap<&str, Tally> = BTreeMap::new();
    for (row, verdict) in rows.iter().zip(&verdicts) {
        let tally = tallies.entry(row.group()).or_default();
        if let Some(failure) = failure_message(row, verdict, known) {
            failures.push(format!("{}: {failure}", row.path));
            tally.failed += 1;
            continue;
        }
        match verdict {
            Verdict::Drawn => tally.drawn += 1,
            Verdict::Blank => tally.blank += 1,
            Verdict::Refused(_) | Verdict::Broken(_) => tally.refused += 1,
        }
    }
    print_refusals(&rows, &verdicts);
    let counted = triangles::check_triangle_counts(folder, &rows, known, &mut failures);
    for (group, Tally { drawn, blank, refused, failed }) in &tallies {
        println!("{group}: {drawn} drawn, {blank} drawn blank, {refused} refused, {failed} failed");
    }
    println!("triangles: {counted} files as in the manifest");
    for failure in &failures {
        println!("FAILED {failure}");
    }
    let drawn_or_refused = tallies.values().map(|t| t.drawn + t.blank + t.refused).sum::<usize>();
    Ok((drawn_or_refused + counted, failures.len()))
}

fn failure_message(row: &Row, verdict: &Verdict, known: bool) -> Option<String> {
    match verdict {
        Verdict::Broken(problem) => Some(problem.clone()),
        verdict if known => expected::difference_from_expected(row, verdict),
        _ => None,
    }
}

/// The reasons of all refusals, each with its files; then the files whose pictures show nothing.
fn print_refusals(rows: &[Row], verdicts: &[Verdict]) {
    let mut files: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (row, verdict) in rows.iter().zip(verdicts) {
        match verdict {
            Verdict::Refused(reason) => files.entry(reason).or_default().push(&row.path),
            Verdict::Blank => files.entry("(drawn blank)").or_default().push(&row.path),
            Verdict::Drawn | Verdict::Broken(_) => {}
        }
    }
    for (reason, files) in files {
        println!("{reason}");
        files.iter().for_each(|file| println!("    {file}"));
    }
}

/// Draws all files, two at a time; the verdicts are in the order of the files.
fn draw_all(program: &Program, folder: &Path, rows: &[Row]) -> Result<Vec<Verdict>, String> {
    let pictures = std::env::temp_dir().join(format!("alberti-corpus-{}", std::process::id()));
    std::fs::create_dir_all(&pictures).map_err(|error| error.to_string())?;
    let verdicts: Vec<Mutex<Option<Verdict>>> = rows.iter().map(|_| Mutex::new(None)).collect();
    let next = AtomicUsize::new(0);
    let work = || {
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(row) = rows.get(at) else { break };
            let picture = pictures.join(format!("{at}.png"));
            let run = program.render(&folder.join(&row.path), &picture, PICTURE_SIZE);
            let verdict = run.map_or_else(Verdict::Broken, |run| {
                verdict::judge_run(row, &run, &picture, PICTURE_SIZE)
            });
            if let Ok(mut slot) = verdicts[at].lock() {
                *slot = Some(verdict);
            }
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(work);
        work();
    });
    let _ = std::fs::remove_dir_all(&pictures);
    let unjudged = || Verdict::Broken("it was not judged".to_owned());
    Ok(verdicts
        .into_iter()
        .map(|v| v.into_inner().ok().flatten().unwrap_or_else(unjudged))
        .collect())
}
