//! `cargo xtask bench raster`: the rasteriser beside its peers and the limits of the machine.
//!
//! The contest is a package of its own, `tests/peers`, built here and nowhere else. It prints tables
//! and leaves `raster.json` and `raster.svg` in `target/bench`; it judges nothing.

use crate::Outcome;
use crate::program::{Build, Program, cargo, watch};
use crate::workspace::{make_folder, target};

/// The arguments are parts of the names of what is to be measured, and `--rounds N`.
pub fn run(arguments: &[String]) -> Outcome {
    let program = Program::built(Build::Release)?;
    let out = target().join("bench");
    make_folder(&out)?;
    let call = ["run", "--quiet", "--release", "--manifest-path", "tests/peers/Cargo.toml", "--"];
    let mut peers = cargo(&call);
    peers.arg("--out").arg(&out).arg("--alberti").arg(program.path()).args(arguments);
    // Mesa draws with the calling thread alone: CPU times can then be compared.
    peers.env("LP_NUM_THREADS", "0").env("CARGO_TARGET_DIR", target().join("peers"));
    watch(&mut peers)?;
    println!("{} and raster.svg hold the same figures", out.join("raster.json").display());
    Ok(())
}
