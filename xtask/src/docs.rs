//! `cargo xtask docs [OUT]`: writes the documentation as static pages, to target/site by default.
//!
//! The generator is a separate package, `xtask/site`, because it needs a Markdown parser that
//! nothing else uses. Its `main.rs` describes the output and the checks.

use crate::Outcome;
use crate::program::{Build, Program, cargo_command, compile, run_command, run_visibly};
use crate::workspace::{project_root, target_folder};
use std::process::Command;

/// Builds the program and the generator, and runs the generator with the program.
pub fn run_docs(arguments: &[String]) -> Outcome {
    let here = std::env::current_dir().map_err(|error| error.to_string())?;
    let out = match arguments {
        [] => target_folder().join("site"),
        [folder] if !folder.starts_with('-') => here.join(folder),
        _ => return Err("docs [OUT]: OUT is a folder".into()),
    };
    let program = Program::build(Build::Release)?;
    // As in the tests, build with the features of the whole workspace, so that nothing is compiled
    // twice.
    let mut build = cargo_command(&["build", "--quiet", "--workspace", "--bin", "alberti-site"]);
    compile(|| run_command(&mut build))?;
    let mut site = Command::new(target_folder().join("debug/alberti-site"));
    run_visibly(site.arg(project_root()).arg(program.path()).arg(out))
}
