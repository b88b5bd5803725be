//! `cargo xtask soak`: millions of random calls of every builder and clip function, in release mode.
//!
//! What it calls, and with which numbers, is in `tests/soak`. Nothing may panic, and no finite input may
//! give an answer that is not finite.

use crate::Outcome;
use crate::program::{cargo_command, run_visibly};

pub fn run_soak(arguments: &[String]) -> Outcome {
    let call = ["bench", "--quiet", "--package", "alberti-tests", "--bench", "soak", "--"];
    run_visibly(cargo_command(&call).args(arguments))
}
