//! `cargo xtask bench raster`: the rasterizer against its peers and the limits of the machine.
//!
//! The contest is a separate package, `tests/peers`, built only here. It prints tables and writes
//! `raster.json` and `raster.svg` to `target/bench`; it judges nothing.

use crate::Outcome;
use crate::program::{Build, Program, cargo_command, run_command, run_visibly};
use crate::workspace::{create_folder, target_folder};
use std::process::Command;

/// The arguments are parts of the names to measure, and `--rounds N`.
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
    // Mesa then draws with only the calling thread, so that CPU times can be compared.
    run_visibly(peers.env("LP_NUM_THREADS", "0"))?;
    println!("{} and raster.svg hold the same figures", out.join("raster.json").display());
    Ok(())
}

fn peers_command(action: &str) -> Command {
    cargo_command(&[action, "--quiet", "--release", "--package", "alberti-peers"])
}
