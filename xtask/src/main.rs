//! `cargo xtask`: one program for everything a developer does to the workspace besides editing it.
//!
//! Each command is a file with a `run`; this one is the table. Nothing here depends on the crates
//! it drives, so that `cargo xtask` builds in seconds and still works when they do not compile.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program speaks to its person")]
#![allow(unreachable_pub, reason = "in a program `pub` means: used by another file")]

mod bench;
mod conformance;
mod determinism;
mod fuzz;
mod gallery;
mod golden;
mod metadata;
mod models;
mod program;
mod soak;
mod test;
mod tidy;
mod workspace;

use std::process::ExitCode;

/// What a command gives back: nothing, or a sentence for the person.
type Outcome = Result<(), String>;

/// A command of `cargo xtask`.
struct Command {
    name: &'static str,
    arguments: &'static str,
    about: &'static str,
    run: fn(&[String]) -> Outcome,
}

const COMMANDS: &[Command] = &[
    Command {
        name: "test",
        arguments: "[--keep-going] [STEP…]",
        about: "All of the tests, or only the named steps; `test --list` shows them",
        run: test::run_tests,
    },
    Command {
        name: "tidy",
        arguments: "",
        about: "The rules of the house that no lint can check",
        run: tidy::run_tidy,
    },
    Command {
        name: "conformance",
        arguments: "[--check]",
        about: "Write tests/CONFORMANCE.md, which test proves which item, or only check it",
        run: conformance::run_conformance,
    },
    Command {
        name: "golden",
        arguments: "[NAME…] [--bless NAME…|--all]",
        about: "Compare each scene with its golden image, or make new goldens after looking",
        run: golden::run_golden,
    },
    Command {
        name: "determinism",
        arguments: "[--threads N] [--wide]",
        about: "Render every scene in debug and release, twice each, and compare the bytes",
        run: determinism::run_determinism,
    },
    Command {
        name: "gallery",
        arguments: "",
        about: "Render every scene onto one page, target/gallery/index.html",
        run: gallery::run_gallery,
    },
    Command {
        name: "soak",
        arguments: "[--calls N] [--seed S] [NAME…]",
        about: "Millions of random calls: nothing panics, finite numbers give finite ones",
        run: soak::run_soak,
    },
    Command {
        name: "fuzz",
        arguments: "[TARGET…] [--minutes N] [--jobs N]",
        about: "Bytes made up to break what reads them; `fuzz --help` lists the targets",
        run: fuzz::run_fuzz,
    },
    Command {
        name: "bench",
        arguments: "[maths|raster] [NAME…] | --instructions",
        about: "How fast it is, as ratios to others; or how many instructions it takes",
        run: bench::run_bench,
    },
    Command {
        name: "models",
        arguments: "[--check]",
        about: "Write scenes/models anew, or only say which files would change",
        run: models::run_models,
    },
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some(name) = arguments.first() else {
        return usage_error("cargo xtask needs a command");
    };
    if matches!(name.as_str(), "help" | "--help" | "-h") {
        println!("{}", help());
        return ExitCode::SUCCESS;
    }
    let Some(command) = COMMANDS.iter().find(|command| command.name == name) else {
        return usage_error(&format!("there is no command `{name}`"));
    };
    match (command.run)(&arguments[1..]) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask {name}: {message}");
            ExitCode::FAILURE
        }
    }
}

fn usage_error(message: &str) -> ExitCode {
    eprintln!("{message}\n\n{}", help());
    ExitCode::from(2)
}

fn help() -> String {
    let mut text = String::from("Usage: cargo xtask COMMAND\n");
    for Command { name, arguments, about, .. } in COMMANDS {
        text += &format!("\n  {:44} {about}", format!("{name} {arguments}"));
    }
    text
}
