//! `cargo xtask`: the developer commands of the workspace, from tests to benchmarks.
//!
//! Each command is a module; this file is the table of commands. The program does not depend on the
//! crates that it builds and tests, so that `cargo xtask` builds in seconds and works even when
//! they do not compile.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program prints")]
#![allow(unreachable_pub, reason = "in a program, `pub` means used by another file")]

mod api;
mod bench;
mod book;
mod browser;
mod conformance;
mod deny;
mod determinism;
mod docs;
mod dxf;
mod farm;
mod fuzz;
mod gallery;
mod golden;
mod metadata;
mod models;
mod program;
mod python;
mod release;
#[path = "../../tests/skip.rs"]
mod skip;
mod soak;
mod strangers;
mod test;
mod tidy;
mod tool_chain;
mod web;
mod workspace;

use std::process::ExitCode;

/// The result of a command: nothing, or an error message.
type Outcome = Result<(), String>;

/// A command of `cargo xtask`.
struct Command {
    name: &'static str,
    /// Its arguments, as printed in the help.
    arguments: &'static str,
    /// Its description in the help.
    about: &'static str,
    run: fn(&[String]) -> Outcome,
}

const COMMANDS: &[Command] = &[
    Command {
        name: "test",
        arguments: "[--keep-going] [STEP…]",
        about: "Run all tests or the named steps; `test --list` lists the steps",
        run: test::run_tests,
    },
    Command {
        name: "tidy",
        arguments: "[--bless]",
        about: "Check the project rules that no lint covers; --bless updates the crate map",
        run: tidy::run_tidy,
    },
    Command {
        name: "conformance",
        arguments: "[--check]",
        about: "Write or check tests/CONFORMANCE.md, the table of topics and their tests",
        run: conformance::run_conformance,
    },
    Command {
        name: "deny",
        arguments: "",
        about: "Check licenses, sources and versions of the dependencies against deny.toml",
        run: deny::run_deny,
    },
    Command {
        name: "api",
        arguments: "[--bless]",
        about: "Compare the public interfaces with docs/api, or write these listings",
        run: api::run_api,
    },
    Command {
        name: "golden",
        arguments: "[NAME…] [--bless NAME…|--all]",
        about: "Compare every scene with its golden image, or replace goldens",
        run: golden::run_golden,
    },
    Command {
        name: "determinism",
        arguments: "[--threads N] [--wide] [--targets[=NAME,…]]",
        about: "Render every scene with several builds, or on other targets, and compare the bytes",
        run: determinism::run_determinism,
    },
    Command {
        name: "browser",
        arguments: "",
        about: "Test the explorer's page in Chromium",
        run: browser::run_browser,
    },
    Command {
        name: "web",
        arguments: "[--out DIR] [--skip-without-tools]",
        about: "Build the explorer for browsers, as a folder of static files and as one HTML file",
        run: web::run_web,
    },
    Command {
        name: "docs",
        arguments: "[OUT]",
        about: "Write the documentation as static pages and check its commands and links",
        run: docs::run_docs,
    },
    Command {
        name: "book",
        arguments: "[--check|--pdf|--pot|--update|…]",
        about: "Build the book in English and Chinese, check it, print it, or update its catalogs",
        run: book::run_book,
    },
    Command {
        name: "gallery",
        arguments: "[--models DIR]",
        about: "Render every scene, or every model in a folder in every style, to one HTML page",
        run: gallery::run_gallery,
    },
    Command {
        name: "strangers",
        arguments: "[--time]",
        about: "Build the programs in tests/strangers against packed crates and run them; --time compares with peers",
        run: strangers::run_strangers,
    },
    Command {
        name: "soak",
        arguments: "[--calls N] [--seed S] [NAME…]",
        about: "Call every builder and clipper with millions of random inputs",
        run: soak::run_soak,
    },
    Command {
        name: "fuzz",
        arguments: "[TARGET…] [--minutes N] [--jobs N]",
        about: "Fuzz the file readers; `fuzz --help` lists the targets",
        run: fuzz::run_fuzz,
    },
    Command {
        name: "python",
        arguments: "[--release]",
        about: "Build the Python wheel and run its tests",
        run: python::run_python,
    },
    Command {
        name: "dxf",
        arguments: "",
        about: "Read DXF files of scenes, models and parts back with ezdxf",
        run: dxf::run_dxf,
    },
    Command {
        name: "bench",
        arguments: "maths|raster|compare|--page|--instructions …",
        about: "Measure speed relative to other programs or commits, or count instructions",
        run: bench::run_bench,
    },
    Command {
        name: "release",
        arguments: "OUT|--check|--crates|--deb",
        about: "Build the release files, or check that they work and are reproducible",
        run: release::run_release,
    },
    Command {
        name: "simulate-farm",
        arguments: "[REPORT]",
        about: "Simulate a batch on up to 1,000 cores, with measured times or times from a report",
        run: farm::run_simulation,
    },
    Command {
        name: "models",
        arguments: "[--check]",
        about: "Write the scene models, or list the files that would change",
        run: models::run_models,
    },
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some(name) = arguments.first() else {
        return usage_error("missing command");
    };
    if matches!(name.as_str(), "help" | "--help" | "-h") {
        println!("{}", help());
        return ExitCode::SUCCESS;
    }
    let Some(command) = COMMANDS.iter().find(|command| command.name == name) else {
        return usage_error(&format!("no such command: `{name}`"));
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
