//! `cargo xtask bench`: how fast what is used in bulk is, as ratios to plain loops in the same process.
//!
//! The benchmarks are in `tests/bench`. They print; they judge nothing, for times are no fact about
//! the code alone.

use crate::Outcome;
use crate::program::{cargo, watch};

pub fn run(arguments: &[String]) -> Outcome {
    let call = ["bench", "--quiet", "--package", "alberti-tests", "--bench", "bench", "--"];
    watch(cargo(&call).args(arguments))
}
