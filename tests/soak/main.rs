//! Makes millions of random calls to every fallible function: nothing may panic, and finite input
//! must give finite output.
//!
//! `cargo xtask soak [--calls N] [--seed S] [NAME…]` runs it in release mode; arguments select
//! functions whose names contain them. `cargo xtask soak --scenes MINUTES [--seed S]` renders
//! random scenes instead. A call draws its arguments from a generator whose entire state is one
//! number. A failed call is repeated from that number to print its arguments.

#![allow(clippy::print_stdout, reason = "a program writes to standard output")]
#![allow(unreachable_pub, reason = "modules of a program cannot be used elsewhere")]

mod bits;
mod camera;
mod clip;
mod finite;
mod homog;
mod projection;
mod random;
mod scene_text;
mod scenes;
mod subject;
mod viewport;

use std::num::NonZeroUsize;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use subject::{Report, Subject};

/// All functions by crate.
const SUBJECTS: [&[Subject]; 5] =
    [homog::SUBJECTS, camera::SUBJECTS, projection::SUBJECTS, clip::SUBJECTS, viewport::SUBJECTS];

/// The parsed command line.
struct Order {
    calls: u64,
    seed: u64,
    /// The number of minutes for which random scenes are rendered instead, if requested.
    scenes: Option<u64>,
    names: Vec<String>,
}

fn main() -> ExitCode {
    let order = match order(std::env::args().skip(1)) {
        Ok(order) => order,
        Err(message) => {
            println!("{message}");
            return ExitCode::from(2);
        }
    };
    subject::catch_panics_quietly();
    if let Some(minutes) = order.scenes {
        return match scenes::soak_scenes(minutes, order.seed) {
            Ok(true) => ExitCode::SUCCESS,
            Ok(false) => ExitCode::FAILURE,
            Err(message) => {
                println!("{message}");
                ExitCode::FAILURE
            }
        };
    }
    let chosen = |(name, _): &&Subject| {
        order.names.is_empty() || order.names.iter().any(|part| name.contains(part.as_str()))
    };
    let subjects: Vec<&Subject> = SUBJECTS.into_iter().flatten().filter(chosen).collect();
    let start = Instant::now();
    let reports = run(&subjects, &order);
    let calls: u64 = reports.iter().map(|report| report.calls).sum();
    let failed = reports.iter().filter(|report| report.fault.is_some()).count();
    println!(
        "{} functions, {calls} calls in {:.0} s, seed {}: {} passed, {failed} failed",
        reports.len(),
        start.elapsed().as_secs_f64(),
        order.seed,
        reports.len() - failed,
    );
    // A filter that selects nothing is probably a typo.
    if failed == 0 && !reports.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn order(mut arguments: impl Iterator<Item = String>) -> Result<Order, String> {
    let mut order = Order { calls: 10_000_000, seed: 1, scenes: None, names: Vec::new() };
    while let Some(argument) = arguments.next() {
        let mut number = || {
            let text = arguments.next().unwrap_or_default();
            let digits = text.replace('_', "");
            digits.parse().map_err(|_| format!("{argument} needs a number, not `{text}`"))
        };
        match argument.as_str() {
            "--calls" => order.calls = number()?,
            "--seed" => order.seed = number()?,
            "--scenes" => order.scenes = Some(number()?),
            // Cargo passes this to every benchmark.
            "--bench" => {}
            flag if flag.starts_with('-') => return Err(format!("unknown flag `{flag}`")),
            _ => order.names.push(argument),
        }
    }
    Ok(order)
}

/// Runs the functions on all cores, with one function per core, and prints a line for each when it
/// is done.
fn run(subjects: &[&Subject], order: &Order) -> Vec<Report> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut reports = Vec::new();
        while let Some(subject) = subjects.get(next.fetch_add(1, Ordering::Relaxed)) {
            let report = subject::run(subject, order.calls, order.seed);
            println!("{report}");
            reports.push(report);
        }
        reports
    };
    let cores = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        workers.into_iter().filter_map(|worker| worker.join().ok()).flatten().collect()
    })
}
