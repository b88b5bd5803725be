//! `cargo xtask bench raster`: compares the rasterizer with its peers and with the limits of the
//! machine.
//!
//! The measurements are in a separate package, `tests/peers`, which only this command builds. The
//! command prints tables and writes `raster.json` and `raster.svg` to `target/bench`; it never
//! fails because of a time.

use crate::Outcome;
use crate::program::{Build, Program, cargo_command, run_command, run_visibly};
use crate::workspace::{create_folder, target_folder};
use std::process::Command;

/// Measures the contestants whose names contain one of the arguments. `--rounds N` sets the number
/// of rounds.
pub fn bench_raster(arguments: &[String]) -> Outcome {
    run_peers(&Program::build(Build::Release)?, arguments)
}

/// Builds the program of `tests/peers`.
pub fn build_peers() -> Outcome {
    run_command(&mut peers_command("build"))
}

/// Runs the measurements with the given program.
pub fn run_peers(program: &Program, arguments: &[String]) -> Outcome {
    let out = target_folder().join("bench");
    create_folder(&out)?;
    let mut peers = peers_command("run");
    peers.args(["--", "--out"]).arg(&out).arg("--alberti").arg(program.path()).args(arguments);
    // Makes Mesa draw only with the calling thread, so that CPU times can be compared.
    run_visibly(peers.env("LP_NUM_THREADS", "0"))?;
    println!("{} and raster.svg contain the same figures", out.join("raster.json").display());
    Ok(())
}

fn peers_command(action: &str) -> Command {
    cargo_command(&[action, "--quiet", "--release", "--package", "alberti-peers"])
}
