//! `cargo xtask bench`: speed relative to other code in the same process or to another commit, and
//! instruction counts.
//!
//! ```text
//! bench                 the next two
//! bench maths [NAME…]   bulk operations against plain loops (tests/bench); or `bench NAME…`
//! bench raster [NAME…]  the rasterizer against other rasterizers (tests/peers)
//! bench compare REV     this program against another commit's: stages, features, memory
//! bench --page          `bench raster` as a page, docs/benchmarks.md, with the losses
//! bench --instructions  instruction counts of fixed workloads against the recorded ones
//! ```
//!
//! Only the last one can fail, because instruction counts depend only on the code. The others just
//! print, because times depend on more than the code.

mod compare;
mod instructions;
mod page;
mod raster;

use crate::Outcome;
use crate::program::{cargo_command, run_visibly};

/// Runs the named benchmarks, or all benchmarks that measure time.
pub fn run_bench(arguments: &[String]) -> Outcome {
    match arguments.split_first() {
        None => bench_maths(&[]).and_then(|()| raster::bench_raster(&[])),
        Some((part, rest)) if part == "maths" => bench_maths(rest),
        Some((part, rest)) if part == "raster" => raster::bench_raster(rest),
        Some((part, rest)) if part == "compare" => compare::bench_compare(rest),
        Some((part, rest)) if part == "--page" => page::run_page(rest),
        Some((part, rest)) if part == "--instructions" => instructions::run_instructions(rest),
        Some((flag, _)) if flag.starts_with('-') => Err(format!("unknown flag `{flag}`")),
        Some(_) => bench_maths(arguments),
    }
}

fn bench_maths(names: &[String]) -> Outcome {
    let call = ["bench", "--quiet", "--package", "alberti-tests", "--bench", "bench", "--"];
    run_visibly(cargo_command(&call).args(names))
}
