//! `cargo xtask soak`: calls every builder and clip function millions of times with random input,
//! in release mode.
//!
//! The calls and their inputs are in `tests/soak`. No call may panic, and finite input must give
//! finite output. `cargo xtask soak --scenes MINUTES` instead renders random scenes that use all
//! features of scene files: nothing may panic, no pass may contain NaN, and one thread must produce
//! the same bytes as two.

use crate::Outcome;
use crate::program::{cargo_command, run_visibly};

/// Builds and runs `tests/soak` with the given arguments.
pub fn run_soak(arguments: &[String]) -> Outcome {
    let call = ["bench", "--quiet", "--package", "alberti-tests", "--bench", "soak", "--"];
    run_visibly(cargo_command(&call).args(arguments))
}
