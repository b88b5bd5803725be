//! Test steps: commands, with their costs and results.

use super::artifacts::TestPrograms;
use super::cpu_time::process_seconds;
use crate::Outcome;
use crate::program::{cargo_command, compile_seconds, run_visibly};
use crate::workspace::{create_folder, read_text, target_folder};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::time::Instant;

/// A test step.
pub struct Step {
    /// The name that selects the step on the command line.
    pub name: String,
    /// The description in the list of steps.
    pub about: String,
    /// The tier in which it runs.
    pub tier: Tier,
    /// Whether other steps may run at the same time.
    pub sharing: Sharing,
    /// The command to run.
    pub action: Action,
}

/// The tier in which a step runs.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Tier {
    /// For every change: `cargo xtask test`.
    First,
    /// Before a release: `cargo xtask test --all`. CI runs as many of these steps as time allows.
    Second,
}

/// Whether other steps may run at the same time.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sharing {
    /// No: the step uses all cores, mostly for Cargo builds.
    Alone,
    /// Yes: another step may run at the same time.
    Shared,
}

/// The command of a step.
pub enum Action {
    /// Cargo calls with these arguments, one after the other.
    Cargo(Vec<Vec<String>>),
    /// A suite of `tests/suites.rs`.
    Suite(&'static str),
    /// The tests in `tests/program` whose names contain the first string but not the second.
    Program(&'static str, Option<&'static str>),
    /// The unit and integration tests of the crates.
    CrateTests,
    /// A command of this program.
    Own(fn() -> Outcome),
}

/// The result of a step.
pub struct StepReport {
    /// The name that selects the step on the command line.
    pub name: String,
    /// The wall-clock time in seconds.
    pub seconds: f64,
    /// The CPU time of the step and of everything it started, in seconds.
    pub cpu_seconds: f64,
    /// The part of the CPU time spent in compilers.
    pub compile_seconds: f64,
    /// The reason why the step failed, if it did.
    pub failure: Option<String>,
    /// The skips: lines that begin with `SKIPPED`.
    pub skipped: Vec<String>,
}

/// A step that runs in a separate process, so that its cost and its skips can be measured.
pub struct RunningStep {
    name: String,
    child: Child,
    start: Instant,
    /// The file for the output, or `None` if the output is visible.
    log: Option<PathBuf>,
}

impl Step {
    /// Creates a step of one or more Cargo calls, each written as on the command line.
    pub fn cargo(name: &str, about: &str, calls: &[&str]) -> Self {
        let words = |call: &&str| call.split_whitespace().map(str::to_owned).collect();
        Self::new(name, about, Action::Cargo(calls.iter().map(words).collect()))
    }

    /// Creates a step that runs a command of this program.
    pub fn built_in(name: &str, about: &str, run: fn() -> Outcome) -> Self {
        Self::new(name, about, Action::Own(run))
    }

    /// Creates a step of the first tier that runs alone.
    pub fn new(name: &str, about: &str, action: Action) -> Self {
        Self {
            name: name.into(),
            about: about.into(),
            tier: Tier::First,
            sharing: Sharing::Alone,
            action,
        }
    }

    /// Lets other steps run at the same time.
    pub fn shared(self) -> Self {
        Self { sharing: Sharing::Shared, ..self }
    }

    /// Moves the step to the second tier.
    pub fn second(self) -> Self {
        Self { tier: Tier::Second, ..self }
    }

    /// Returns the environment variables that make tests run all of their cases.
    fn variables(&self) -> &'static [(&'static str, &'static str)] {
        if self.tier == Tier::Second { &[("THOROUGH", "1")] } else { &[] }
    }

    /// Runs the step in this process, and writes its costs to a file.
    pub fn run_here(&self) -> Outcome {
        let outcome = match &self.action {
            Action::Own(run) => run(),
            Action::Cargo(calls) => calls.iter().try_for_each(|call| {
                let words: Vec<&str> = call.iter().map(String::as_str).collect();
                crate::program::compile(|| run_visibly(&mut cargo_command(&words)))
            }),
            Action::Suite(name) => {
                TestPrograms::build().and_then(|tests| tests.run_suite(name, self.variables()))
            }
            Action::Program(part, without) => TestPrograms::build()
                .and_then(|tests| tests.run_program_tests(part, *without, self.variables())),
            Action::CrateTests => {
                TestPrograms::build().and_then(|tests| tests.run_crate_tests(self.variables()))
            }
        };
        let costs = format!("{} {}", process_seconds(), compile_seconds());
        let written = fs::write(costs_path(&self.name), costs);
        outcome.and(written.map_err(|error| error.to_string()))
    }

    /// Starts the step in a new process of this program. The output is written to a file unless the
    /// step is watched.
    pub fn start(&self, program: &Path, is_watched: bool) -> Result<RunningStep, String> {
        create_folder(&steps_folder())?;
        let with_name = |error: std::io::Error| format!("{}: {error}", self.name);
        let [costs, skips] = [costs_path(&self.name), skips_path(&self.name)];
        for old in [&costs, &skips] {
            let _ = fs::remove_file(old);
        }
        let mut command = Command::new(program);
        command.args(["test", super::RUN_ONE, &self.name]).env("SKIP_LOG", &skips);
        let mut log = None;
        if !is_watched {
            let path = steps_folder().join(format!("{}.log", self.name));
            let file = File::create(&path).map_err(with_name)?;
            let copy = file.try_clone().map_err(with_name)?;
            command.stdin(std::process::Stdio::null()).stdout(file).stderr(copy);
            log = Some(path);
        }
        let child = command.spawn().map_err(with_name)?;
        Ok(RunningStep { name: self.name.clone(), child, start: Instant::now(), log })
    }
}

impl RunningStep {
    /// Returns the report if the step has ended.
    pub fn poll(&mut self) -> Result<Option<StepReport>, String> {
        let status = self.child.try_wait().map_err(|error| format!("{}: {error}", self.name))?;
        let Some(status) = status else { return Ok(None) };
        let costs = read_text(&costs_path(&self.name)).unwrap_or_default();
        let mut costs = costs.split_whitespace().map(|word| word.parse().unwrap_or(0.0));
        let skipped = read_text(&skips_path(&self.name)).unwrap_or_default();
        let failure = (!status.success()).then(|| match &self.log {
            Some(log) => read_text(log).unwrap_or_default(),
            None => format!("{status}"),
        });
        Ok(Some(StepReport {
            name: self.name.clone(),
            seconds: self.start.elapsed().as_secs_f64(),
            cpu_seconds: costs.next().unwrap_or(0.0),
            compile_seconds: costs.next().unwrap_or(0.0),
            failure,
            skipped: skipped.lines().map(str::to_owned).collect(),
        }))
    }
}

fn steps_folder() -> PathBuf {
    target_folder().join("steps")
}

fn costs_path(name: &str) -> PathBuf {
    steps_folder().join(format!("{name}.costs"))
}

fn skips_path(name: &str) -> PathBuf {
    steps_folder().join(format!("{name}.skips"))
}
