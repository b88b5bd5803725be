//! `cargo xtask soak`: millions of random calls of every builder and clip function, in release mode.
//!
//! What it calls, and with which numbers, is in `tests/soak`. Nothing may panic, and no finite input may
//! give an answer that is not finite.

use crate::Outcome;
use crate::program::{cargo, watch};

pub fn run(arguments: &[String]) -> Outcome {
    let call = ["bench", "--quiet", "--package", "alberti-tests", "--bench", "soak", "--"];
    watch(cargo(&call).args(arguments))
}
