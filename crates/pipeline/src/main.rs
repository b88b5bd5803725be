//! The program `alberti`: pictures of glTF models, without a GPU, a display or a browser.

mod cli;

use clap::Parser;
use std::process::ExitCode;

/// Exit codes: 0 done, 1 the input or the work failed, or a check has found errors, 2 wrong usage (by clap).
fn main() -> ExitCode {
    match cli::run(cli::Args::parse()) {
        Ok(code) => code,
        Err(failure) => {
            cli::complain("error", &failure.told());
            ExitCode::FAILURE
        }
    }
}
