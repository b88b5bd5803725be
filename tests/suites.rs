//! The table-driven test suites in one program: `suites NAME [FILTER…]` runs one of them.
//!
//! Their cases are files found at run time, so they do not use Rust's test harness but share
//! `harness.rs`. They are one program because each separate program would link the whole engine.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a test program prints its results")]
#![allow(missing_docs, unreachable_pub, reason = "in a program, `pub` means used by another file")]
#![allow(dead_code, reason = "only some helpers from another crate's tests are used")]

mod assemblies;
mod check;
mod cluster;
mod corpus;
mod drawing;
mod goldens;
mod growth;
mod hostile;
mod looks;
mod meshes;
mod references;
mod schemas;
mod thumbnails;
mod vectors;

use std::process::ExitCode;

/// The `run` function of a suite.
type Suite = fn() -> ExitCode;

/// The suites by name.
const SUITES: &[(&str, Suite)] = &[
    ("assemblies", assemblies::run),
    ("check", check::run),
    ("cluster", cluster::run),
    ("corpus", corpus::run),
    ("drawing", drawing::run),
    ("goldens", goldens::run),
    ("growth", growth::run),
    ("hostile", hostile::run),
    ("looks", looks::run),
    ("meshes", meshes::run),
    ("references", references::run),
    ("schemas", schemas::run),
    ("thumbnails", thumbnails::run),
    ("vectors", vectors::run),
];

fn main() -> ExitCode {
    let name = std::env::args().nth(1);
    let suite = SUITES.iter().find(|(suite, _)| name.as_deref() == Some(*suite));
    if let Some((_, run)) = suite {
        return run();
    }
    let names: Vec<&str> = SUITES.iter().map(|(name, _)| *name).collect();
    eprintln!("usage: suites NAME [FILTER…], where NAME is one of {}", names.join(", "));
    // `cargo test` without arguments runs every program, but these suites are steps of `cargo xtask
    // test`.
    ExitCode::from(if name.is_some() { 2 } else { 0 })
}
