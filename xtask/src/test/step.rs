//! Steps of the tests: a command, its output, its result.

use crate::Outcome;
use crate::program::{cargo_command, command_line};
use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// One step.
pub struct Step {
    /// The name by which the command line selects it.
    pub name: String,
    /// The line in the list of steps.
    pub about: String,
    /// The command.
    pub action: Action,
}

/// The command of a step.
pub enum Action {
    /// Cargo with these arguments, one call after the other.
    Cargo(Vec<Vec<String>>),
    /// Cargo's documentation with warnings as errors.
    Documentation,
    /// A command of this program.
    Own(fn() -> Outcome),
}

/// The result of a step.
pub struct StepReport {
    /// The name by which the command line selects it.
    pub name: String,
    /// Wall-clock time.
    pub time: Duration,
    /// Why it failed.
    pub failure: Option<String>,
    /// The lines of its output that begin with `SKIPPED`.
    pub skipped: Vec<String>,
}

impl Step {
    /// A step of one or more calls of Cargo, each written as on the command line.
    pub fn cargo(name: &str, about: &str, calls: &[&str]) -> Self {
        let words = |call: &&str| call.split_whitespace().map(str::to_owned).collect();
        let action = Action::Cargo(calls.iter().map(words).collect());
        Self { name: name.into(), about: about.into(), action }
    }

    /// A step that is a command of this program.
    pub fn built_in(name: &str, about: &str, run: fn() -> Outcome) -> Self {
        Self { name: name.into(), about: about.into(), action: Action::Own(run) }
    }

    /// Runs the step, with a heading before it.
    pub fn run_step(&self) -> StepReport {
        println!("\n── {}: {}", self.name, self.about);
        let start = Instant::now();
        let mut skipped = Vec::new();
        let outcome = match &self.action {
            Action::Own(run) => run(),
            Action::Cargo(calls) => calls.iter().try_for_each(|call| {
                let words: Vec<&str> = call.iter().map(String::as_str).collect();
                follow_output(cargo_command(&words).envs(named_folders()), &mut skipped)
            }),
            Action::Documentation => {
                let mut cargo = cargo_command(&["doc", "--quiet", "--workspace", "--no-deps"]);
                follow_output(cargo.env("RUSTDOCFLAGS", "-D warnings"), &mut skipped)
            }
        };
        StepReport {
            name: self.name.clone(),
            time: start.elapsed(),
            failure: outcome.err(),
            skipped,
        }
    }
}

/// The folders of test data that environment variables name, made absolute: a test runs in another
/// current folder.
fn named_folders() -> Vec<(&'static str, PathBuf)> {
    let here = std::env::current_dir().unwrap_or_default();
    let named = |name| Some((name, here.join(std::env::var_os(name)?)));
    ["VECTORS", "ASSETS", "REFERENCES"].into_iter().filter_map(named).collect()
}

/// Runs a command, forwards its output line by line, and collects the lines that begin with
/// `SKIPPED`.
fn follow_output(command: &mut Command, skipped: &mut Vec<String>) -> Outcome {
    let name = command_line(command);
    let with_name = |error: std::io::Error| format!("{name}: {error}");
    let mut child = command.stdout(Stdio::piped()).spawn().map_err(with_name)?;
    if let Some(output) = child.stdout.take() {
        for line in BufReader::new(output).split(b'\n') {
            let line = String::from_utf8_lossy(&line.map_err(with_name)?).into_owned();
            // A closed terminal is no reason to stop testing.
            let _ = writeln!(std::io::stdout(), "{line}");
            if line.starts_with("SKIPPED") {
                skipped.push(line);
            }
        }
    }
    let status = child.wait().map_err(with_name)?;
    if status.success() { Ok(()) } else { Err(format!("`{name}` failed ({status})")) }
}
