//! `cargo xtask bench`: how fast it is, as ratios to others in the same process; and how many instructions it takes.
//!
//! ```text
//! bench                 both of the following
//! bench maths [NAME…]   what is used in bulk against plain loops: `tests/bench`; `bench NAME…` does it too
//! bench raster [NAME…]  the rasteriser against its peers and the machine: `tests/peers`
//! bench --instructions  counts of small fixed pieces of work, compared with those that are stored
//! ```
//!
//! The first two print; they judge nothing, for times are no fact about the code alone. Counts are.

mod instructions;
mod raster;

use crate::Outcome;
use crate::program::{cargo, watch};

pub fn run(arguments: &[String]) -> Outcome {
    match arguments.split_first() {
        None => maths(&[]).and_then(|()| raster::run(&[])),
        Some((part, rest)) if part == "maths" => maths(rest),
        Some((part, rest)) if part == "raster" => raster::run(rest),
        Some((part, rest)) if part == "--instructions" => instructions::run(rest),
        Some((flag, _)) if flag.starts_with('-') => Err(format!("unknown flag `{flag}`")),
        Some(_) => maths(arguments),
    }
}

fn maths(names: &[String]) -> Outcome {
    let call = ["bench", "--quiet", "--package", "alberti-tests", "--bench", "bench", "--"];
    watch(cargo(&call).args(names))
}
