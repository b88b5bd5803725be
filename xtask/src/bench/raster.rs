//! `cargo xtask bench raster`: the rasteriser beside its peers and the limits of the machine.
//!
//! The contest is a package of its own, `tests/peers`, built here and nowhere else. It prints
//! tables and leaves `raster.json` and `raster.svg` in `target/bench`; it judges nothing.

use crate::Outcome;
use crate::program::{Build, Program, cargo_command, run_command, run_visibly};
use crate::workspace::{create_folder, target_folder};
use std::process::Command;

/// The arguments are parts of the names of what is to be measured, and `--rounds N`.
pub fn bench_raster(arguments: &[String]) -> Outcome {
    run_peers(&Program::build(Build::Release)?, arguments)
}

/// Builds the contest.
pub fn build_peers() -> Outcome {
    run_command(&mut peers_command("build"))
}

/// Runs the contest, built or not.
pub fn run_peers(program: &Program, arguments: &[String]) -> Outcome {
    let out = target_folder().join("bench");
    create_folder(&out)?;
    let mut peers = peers_command("run");
    peers.args(["--", "--out"]).arg(&out).arg("--alberti").arg(program.path()).args(arguments);
    // Mesa draws with the calling thread alone: CPU times can then be compared.
    run_visibly(peers.env("LP_NUM_THREADS", "0"))?;
    println!("{} and raster.svg hold the same figures", out.join("raster.json").display());
    Ok(())
}

fn peers_command(action: &str) -> Command {
    cargo_command(&[action, "--quiet", "--release", "--package", "alberti-peers"])
}
