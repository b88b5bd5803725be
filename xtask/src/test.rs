//! `cargo xtask test`: runs the tests, both locally and in CI.
//!
//! ```text
//! test                      the first tier, for every change
//! test --all                the first and the second tier, before a release
//! test --second             only the second tier; with --minutes N, no step starts after that time
//! test STEP…                the named steps
//! ```
//! One Cargo call builds the test programs, which then run directly (`artifacts.rs`). Each step is
//! a separate process, so that its cost and its skips can be measured (`step.rs`). Steps that use
//! one core run in pairs (`schedule.rs`). The summary lists costs and skips (`summary.rs`).

mod artifacts;
mod cpu_time;
mod no_std;
mod oldest_rust;
mod schedule;
mod step;
mod steps;
mod summary;

pub use cpu_time::process_seconds;

use crate::Outcome;
use schedule::Limits;
use std::time::Duration;
use step::{Step, Tier};

/// The argument that makes a process run a single step.
const RUN_ONE: &str = "--run-one";

/// The parsed command line.
#[derive(Default)]
struct Options {
    tiers: Vec<Tier>,
    names: Vec<String>,
    keep_going: bool,
    /// The time within which steps may start.
    minutes: Option<u64>,
}

/// Runs the selected steps. Stops at the first failure unless `--keep-going` is given.
pub fn run_tests(arguments: &[String]) -> Outcome {
    let steps = steps::all_steps()?;
    match arguments {
        [flag] if flag == "--list" => {
            println!("{}", list_steps(&steps));
            return Ok(());
        }
        [flag, name] if flag == RUN_ONE => return find_step(&steps, name)?.run_here(),
        _ => {}
    }
    let options = Options::parse(arguments)?;
    let mut chosen = Vec::new();
    for name in &options.names {
        chosen.push(find_step(&steps, name)?);
    }
    if options.names.is_empty() {
        chosen.extend(steps.iter().filter(|step| options.tiers.contains(&step.tier)));
    }
    let limits = Limits {
        keep_going: options.keep_going,
        time: options.minutes.map(|minutes| Duration::from_secs(60 * minutes)),
    };
    let run = schedule::run_steps(&chosen, &limits)?;
    let is_first_tier = options.names.is_empty() && options.tiers == [Tier::First];
    summary::print_summary(&run, is_first_tier)
}

impl Options {
    fn parse(arguments: &[String]) -> Result<Self, String> {
        let mut options = Self { tiers: vec![Tier::First], ..Self::default() };
        let mut words = arguments.iter();
        while let Some(word) = words.next() {
            match word.as_str() {
                "--all" => options.tiers = vec![Tier::First, Tier::Second],
                "--second" => options.tiers = vec![Tier::Second],
                "--keep-going" => options.keep_going = true,
                "--minutes" => {
                    let minutes = words.next().and_then(|minutes| minutes.parse().ok());
                    options.minutes = Some(minutes.ok_or("--minutes needs a whole number")?);
                }
                flag if flag.starts_with('-') => return Err(format!("unknown flag `{flag}`")),
                name => options.names.push(name.to_owned()),
            }
        }
        Ok(options)
    }
}

fn find_step<'a>(steps: &'a [Step], name: &str) -> Result<&'a Step, String> {
    let found = steps.iter().find(|step| step.name == name);
    found.ok_or_else(|| format!("no such step: `{name}`; the steps are:\n{}", list_steps(steps)))
}

/// Returns a line for each step, with its name and what it tests.
fn list_steps(steps: &[Step]) -> String {
    let list = |tier| {
        let those = steps.iter().filter(move |step| step.tier == tier);
        let lines = those.map(|step| format!("  {:12} {}", step.name, step.about));
        lines.collect::<Vec<_>>().join("\n")
    };
    format!(
        "first tier, for every change:\n{}\nsecond tier, with --all:\n{}",
        list(Tier::First),
        list(Tier::Second)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(line: &str) -> Result<Options, String> {
        let words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
        Options::parse(&words)
    }

    #[test]
    fn every_step_has_a_unique_name_and_a_description() {
        let steps = steps::all_steps().unwrap();
        for (i, step) in steps.iter().enumerate() {
            assert!(!step.about.is_empty(), "{}", step.name);
            assert!(steps[..i].iter().all(|other| other.name != step.name), "{}", step.name);
        }
    }

    #[test]
    fn flags_select_tiers() {
        assert_eq!(options("").unwrap().tiers, [Tier::First]);
        assert_eq!(options("--all").unwrap().tiers, [Tier::First, Tier::Second]);
        let second = options("--second --minutes 20 --keep-going").unwrap();
        assert_eq!((second.tiers, second.minutes), (vec![Tier::Second], Some(20)));
        assert!(options("--minutes soon").is_err() && options("--every").is_err());
    }
}
