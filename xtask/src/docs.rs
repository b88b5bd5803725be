//! `cargo xtask docs [OUT]`: the documentation as static pages, target/site if no folder is named.
//!
//! The generator is a package of its own, `xtask/site`: it reads Markdown with a crate that nobody
//! else needs. What it writes and checks stands in its `main.rs`.

use crate::Outcome;
use crate::program::{Build, Program, cargo_command, run_visibly};
use crate::workspace::{project_root, target_folder};

/// The generator, which says what it has written.
const GENERATOR: &str = "xtask/site/Cargo.toml";

/// Builds the program and the generator, and runs the one with the other.
pub fn run_docs(arguments: &[String]) -> Outcome {
    let here = std::env::current_dir().map_err(|error| error.to_string())?;
    let out = match arguments {
        [] => target_folder().join("site"),
        [folder] if !folder.starts_with('-') => here.join(folder),
        _ => return Err("docs [OUT]: OUT is a folder".into()),
    };
    let program = Program::build(Build::Release)?;
    let mut site =
        cargo_command(&["run", "--quiet", "--locked", "--manifest-path", GENERATOR, "--"]);
    site.env("CARGO_TARGET_DIR", target_folder().join("site-build"));
    run_visibly(site.arg(project_root()).arg(program.path()).arg(out))
}

/// Tests the generator, then builds the pages: commands of guides and all links are checked.
pub fn check_docs() -> Outcome {
    let mut tests = cargo_command(&["test", "--quiet", "--locked", "--manifest-path", GENERATOR]);
    run_visibly(tests.env("CARGO_TARGET_DIR", target_folder().join("site-build")))?;
    run_docs(&[])
}
