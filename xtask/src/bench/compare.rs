//! `cargo xtask bench compare REV`: compares the current program with the program of another
//! commit.
//!
//! ```text
//! cargo xtask bench compare main~20 --quick
//! cargo xtask bench compare v0.1 --models flight-helmet cave --runs 9 --out target/bench/v0.1
//! cargo xtask bench compare HEAD~1 --models ../models
//! ```
//!
//! Both programs render the same models in turn: old, new, old, new. The output consists of ratios
//! of times from the same round, because a machine that is slow for a second slows both programs.
//! Each ratio is a median with its minimum and maximum: new/old for each stage of `--timings`, and
//! on/off for features, styles and threads in either program. Peak memory and wall time are listed
//! too. A variant that a program refuses, for example because it lacks a flag, is shown as a dash,
//! and the reason is listed below the table.
//!
//! By default, six of the shared models are rendered, which takes half an hour; `--models` selects
//! other shared models, scene models or a folder. `--quick` runs fewer rounds and renders fewer
//! frames. `--out` writes `compare.json`, with every figure of every run, and the chart
//! `compare.svg`.
//!
//! | module | contents |
//! | --- | --- |
//! | `revision` | the program of another commit |
//! | `models` | the models to render |
//! | `variants` | the settings, features, styles and commands to measure |
//! | `patched_model` | models with a material extension or a light added |
//! | `run` | one run of a program and its figures |
//! | `measurement` | rounds of runs, and ratios between them |
//! | `spread` | median, minimum and maximum |
//! | `summary` | the figures that the report and the chart show |
//! | `table` `chart` `json` | text, SVG and JSON |
//! | `machine` | the machine and the time |
//!
//! It never fails because of a time, since times depend on more than the code.

mod chart;
mod json;
pub mod machine;
mod measurement;
mod models;
mod patched_model;
pub mod revision;
mod run;
mod spread;
mod summary;
mod table;
mod variants;

use crate::Outcome;
use crate::program::{Build, Program};
use crate::workspace::{create_folder, target_folder};
use machine::Machine;
use measurement::{Measurement, Measurer};
use models::ModelSelection;
use revision::Commit;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

const USAGE: &str = "bench compare REV [--models DIR|NAME…] [--runs N] [--quick] [--out FOLDER]";

/// The number of rounds.
const RUNS: usize = 5;
/// The number of frames in the turntable.
const FRAMES: usize = 120;
/// [`RUNS`] with `--quick`.
const QUICK_RUNS: usize = 3;
/// [`FRAMES`] with `--quick`.
const QUICK_FRAMES: usize = 12;

/// The parsed command line.
#[derive(Clone, PartialEq, Eq, Debug)]
struct Request {
    revision: String,
    models: ModelSelection,
    runs: usize,
    frames: usize,
    out: Option<PathBuf>,
}

impl Request {
    fn parse_request(arguments: &[String]) -> Result<Self, String> {
        let mut words = arguments.iter().peekable();
        let (mut revision, mut names) = (None, Vec::new());
        let (mut runs, mut quick, mut out) = (None, false, None);
        while let Some(word) = words.next() {
            match word.as_str() {
                "--models" => {
                    while let Some(name) = words.next_if(|word| !word.starts_with('-')) {
                        names.push(name.clone());
                    }
                    if names.is_empty() {
                        return Err("--models needs a folder or model names".into());
                    }
                }
                "--runs" => {
                    let count = words.next().and_then(|count| count.parse().ok());
                    runs = Some(count.filter(|count| *count > 0).ok_or("--runs needs a number")?);
                }
                "--quick" => quick = true,
                "--out" => out = Some(words.next().ok_or("--out needs a folder")?.into()),
                flag if flag.starts_with('-') => {
                    return Err(format!("unknown flag `{flag}`: {USAGE}"));
                }
                name if revision.is_none() => revision = Some(name.to_owned()),
                other => return Err(format!("unexpected argument `{other}`: {USAGE}")),
            }
        }
        Ok(Self {
            revision: revision.ok_or(format!("name a commit to compare with: {USAGE}"))?,
            models: ModelSelection::parse_words(names),
            runs: runs.unwrap_or(if quick { QUICK_RUNS } else { RUNS }),
            frames: if quick { QUICK_FRAMES } else { FRAMES },
            out,
        })
    }
}

/// Builds both programs, measures them, prints the tables and writes the `--out` files.
pub fn bench_compare(arguments: &[String]) -> Outcome {
    if arguments.iter().any(|word| word == "--help" || word == "-h") {
        println!("{USAGE}");
        return Ok(());
    }
    let request = Request::parse_request(arguments)?;
    let measured = measure(&request);
    // End the progress line, so that the next output begins on a new line.
    show_progress("");
    let (machine, measurements) = measured?;
    println!("{}", table::report(&machine, &measurements));
    match &request.out {
        Some(out) => write_files(out, &machine, &measurements),
        None => Ok(()),
    }
}

fn measure(request: &Request) -> Result<(Machine, Vec<Measurement>), String> {
    let old_commit = Commit::resolve(&request.revision)?;
    let models = request.models.list_models()?;
    show_progress(&format!("building {}", old_commit.short()));
    let old = old_commit.build_program()?;
    show_progress("building this commit");
    let new = Program::build(Build::Release)?;
    let machine = Machine::describe(&old_commit)?;
    let folder = target_folder().join("bench/compare");
    let measurer = Measurer::new([old.path(), new.path()], &folder, request.runs);
    Ok((machine, measurer.measure_all(&models, request.frames)?))
}

fn write_files(out: &Path, machine: &Machine, measurements: &[Measurement]) -> Outcome {
    create_folder(out)?;
    let write = |name: &str, text: String| {
        let path = out.join(name);
        std::fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))
    };
    write("compare.json", format!("{:#}\n", json::to_json(machine, measurements)))?;
    write("compare.svg", chart::to_svg(machine, measurements))?;
    println!("{} and compare.svg contain the same figures", out.join("compare.json").display());
    Ok(())
}

/// Replaces the progress line on a terminal; prints nothing elsewhere.
fn show_progress(message: &str) {
    if std::io::stderr().is_terminal() {
        eprint!("\r\x1b[K{message}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str) -> Result<Request, String> {
        Request::parse_request(&line.split(' ').map(str::to_owned).collect::<Vec<_>>())
    }

    #[test]
    fn arguments_may_be_in_any_order() {
        let request = parsed("main --models no_such_folder b --quick --out o").unwrap();
        assert_eq!(request, parsed("--quick main --out o --models no_such_folder b").unwrap());
        assert_eq!((request.runs, request.frames), (QUICK_RUNS, QUICK_FRAMES));
        assert_eq!(request.out, Some("o".into()));
        let names = vec!["no_such_folder".to_owned(), "b".to_owned()];
        assert_eq!(request.models, ModelSelection::Names(names));
        assert_eq!(parsed("main --quick --runs 7").unwrap().runs, 7);
    }

    #[test]
    fn a_commit_is_required_and_numbers_are_checked() {
        assert!(parsed("--quick").unwrap_err().contains("a commit"));
        assert!(parsed("main --runs 0").unwrap_err().contains("--runs"));
        assert!(parsed("main --models --quick").unwrap_err().contains("--models"));
        assert!(parsed("main other").unwrap_err().contains("`other`"));
        assert!(parsed("main --fast").unwrap_err().contains("`--fast`"));
    }
}
