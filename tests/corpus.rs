//! Renders every file of a corpus with the real program: each gives a picture or is rejected with a
//! reason.
//!
//! Two corpora are rendered. [`alberti_tests::samples`] generates one, and its manifest states the
//! outcome of each file. The other, if it exists, is the folder `$ASSETS` or `shared/assets` next
//! to the repository; the tables of [`expected`] state its outcomes. Each file is rendered in a
//! separate process, two at a time, within thirty seconds. Two outcomes are allowed: exit code 0
//! and a PNG of the right size, or exit code 1, a message that names the file and the reason, and
//! no PNG. Triangle counts of files under `models` must match the manifest. Arguments that are not
//! flags select files whose paths contain them.

mod expected;
mod program;
mod triangles;
mod verdict;

use alberti_tests::harness::{
    Arguments, Tally, TemporaryFolder, data_folder, map_parallel, run_program,
};
use alberti_tests::manifest::{Row, read_manifest};
use alberti_tests::samples::write_samples;
use program::Program;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::ExitCode;
use verdict::Verdict;

/// The width and height of the pictures.
const PICTURE_SIZE: (u32, u32) = (64, 48);

/// The groups of files that are rendered.
const GROUPS: [&str; 3] = ["models", "validator-valid", "bad"];

/// The outcomes of one group.
#[derive(Default)]
struct GroupTally {
    drawn: usize,
    blank: usize,
    refused: usize,
}

pub fn run() -> ExitCode {
    run_program("corpus", |arguments| {
        let program = Program::build()?;
        let samples = Path::new(env!("CARGO_TARGET_TMPDIR")).join("corpus");
        write_samples(&samples)?;
        let mut tally = render_corpus(&program, &samples, false, arguments)?;
        if let Some(assets) = data_folder("ASSETS", "assets")? {
            let known = std::env::var_os("ASSETS").is_none();
            tally += render_corpus(&program, &assets, known, arguments)?;
        }
        Ok(tally)
    })
}

/// Renders the files in a folder and prints the outcomes. `known` is true for the folder described
/// by the tables.
fn render_corpus(
    program: &Program,
    folder: &Path,
    known: bool,
    arguments: &Arguments,
) -> Result<Tally, String> {
    println!("{}", folder.display());
    let mut rows = read_manifest(folder)?;
    rows.retain(|row| GROUPS.contains(&row.group()) && arguments.select(&row.path));
    let verdicts = render_files(program, folder, &rows)?;
    let mut tally = Tally::default();
    let mut groups: BTreeMap<&str, GroupTally> = BTreeMap::new();
    for (row, verdict) in rows.iter().zip(&verdicts) {
        if let Some(failure) = failure_message(row, verdict, known) {
            tally.fail(&row.path, &failure);
            continue;
        }
        tally.pass(1);
        let group = groups.entry(row.group()).or_default();
        match verdict {
            Verdict::Drawn => group.drawn += 1,
            Verdict::Blank => group.blank += 1,
            Verdict::Refused(_) | Verdict::Broken(_) => group.refused += 1,
        }
    }
    print_refusals(&rows, &verdicts);
    triangles::check_triangle_counts(folder, &rows, known, &mut tally);
    for (group, GroupTally { drawn, blank, refused }) in &groups {
        println!("{group}: {drawn} drawn, {blank} drawn blank, {refused} rejected");
    }
    Ok(tally)
}

/// Returns the reason why an outcome is wrong, according to the manifest if it states one,
/// otherwise according to the tables of a known folder.
fn failure_message(row: &Row, verdict: &Verdict, known: bool) -> Option<String> {
    match verdict {
        Verdict::Broken(problem) => Some(problem.clone()),
        verdict if row.expected.is_some() => expected::difference_from_manifest(row, verdict),
        verdict if known => expected::difference_from_tables(row, verdict),
        _ => None,
    }
}

/// Prints the reasons for all rejections with their files, and the files with blank pictures.
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

/// Renders all files, two at a time; the verdicts are in the order of the rows.
fn render_files(program: &Program, folder: &Path, rows: &[Row]) -> Result<Vec<Verdict>, String> {
    let pictures = TemporaryFolder::create("corpus")?;
    Ok(map_parallel(rows, |index, row| {
        let picture = pictures.path().join(format!("{index}.png"));
        let run = program.render(&folder.join(&row.path), &picture, PICTURE_SIZE);
        run.map_or_else(Verdict::Broken, |run| {
            verdict::judge_run(row, &run, &picture, PICTURE_SIZE)
        })
    }))
}
