//! Runs the steps in order, one or two at a time.

use super::step::{RunningStep, Sharing, Step, StepReport};
use std::thread;
use std::time::{Duration, Instant};

/// The maximum number of steps that run at the same time.
const AT_ONCE: usize = 2;

/// The interval between checks for finished steps.
const POLL: Duration = Duration::from_millis(20);

/// The conditions under which no more steps start.
pub struct Limits {
    /// Whether steps still start after a step has failed.
    pub keep_going: bool,
    /// The time within which steps may start.
    pub time: Option<Duration>,
}

/// The steps that ran and the steps that did not.
pub struct Run {
    /// The reports, in the order in which the steps ended.
    pub reports: Vec<StepReport>,
    /// The steps that did not start in time, by name.
    pub left_out: Vec<String>,
    /// The wall-clock time in seconds.
    pub seconds: f64,
}

/// Runs steps in order. Steps that share the machine may finish in a different order.
pub fn run_steps(steps: &[&Step], limits: &Limits) -> Result<Run, String> {
    let start = Instant::now();
    // Read the path now: after a build replaces this program, the path would refer to a deleted
    // file.
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let mut run = Run { reports: Vec::new(), left_out: Vec::new(), seconds: 0.0 };
    let mut running: Vec<RunningStep> = Vec::new();
    // The output of a single step is shown; with several steps, only failures show their output.
    let is_watched = steps.len() == 1;
    let has_failed = |run: &Run| run.reports.iter().any(|report| report.failure.is_some());
    for step in steps {
        let room = if step.sharing == Sharing::Alone { 0 } else { AT_ONCE - 1 };
        wait_until(&mut running, room, &mut run)?;
        if has_failed(&run) && !limits.keep_going {
            break;
        }
        if limits.time.is_some_and(|time| start.elapsed() > time) {
            run.left_out.push(step.name.clone());
            continue;
        }
        println!("── {}: {}", step.name, step.about);
        running.push(step.start(&program, is_watched)?);
        if step.sharing == Sharing::Alone {
            wait_until(&mut running, 0, &mut run)?;
        }
    }
    wait_until(&mut running, 0, &mut run)?;
    run.seconds = start.elapsed().as_secs_f64();
    Ok(run)
}

/// Waits until at most `room` steps are running, and prints the results of the steps that ended.
fn wait_until(running: &mut Vec<RunningStep>, room: usize, run: &mut Run) -> Result<(), String> {
    while running.len() > room {
        let mut index = 0;
        while index < running.len() {
            let Some(report) = running[index].poll()? else {
                index += 1;
                continue;
            };
            running.remove(index);
            print_end(&report);
            run.reports.push(report);
        }
        thread::sleep(POLL);
    }
    Ok(())
}

fn print_end(report: &StepReport) {
    let StepReport { name, seconds, cpu_seconds, .. } = report;
    match &report.failure {
        None => println!("   {name} passed: {seconds:.1} s, {cpu_seconds:.1} s of CPU time"),
        Some(output) => println!("{output}\n   {name} FAILED after {seconds:.1} s"),
    }
}
