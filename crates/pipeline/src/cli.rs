//! The command line: what may be asked for, and who does it.

mod animate;
mod args;
mod batch;
mod check;
mod compare;
mod explain;
mod failure;
mod format;
mod info;
mod loading;
mod look;
mod matrix;
mod paint;
mod part;
mod passes;
mod pick;
mod progress;
mod render;
mod report;
mod sheet;
mod show;

pub(crate) use args::Args;
pub(crate) use failure::Failure;

use args::Command;
use std::io::Write;
use std::process::ExitCode;

/// Does what was asked for.
pub(crate) fn run(args: Args) -> Result<ExitCode, Failure> {
    match args.command {
        Command::Render(args) => return render::run(&args),
        Command::Sheet(args) => sheet::run(&args)?,
        Command::Info(args) => info::run(&args)?,
        Command::Check(args) => return check::run(&args),
        Command::Matrix(args) => matrix::run(&args)?,
        Command::Explain(args) => explain::run(&args)?,
        Command::Animate(args) => animate::run(&args)?,
        Command::Batch(args) => return batch::run(&args),
    }
    Ok(ExitCode::SUCCESS)
}

/// Tells the person something on the standard error stream. That the stream may be closed is no reason to fail.
pub(crate) fn complain(level: &str, message: &str) {
    let _ = writeln!(std::io::stderr(), "{level}: {message}");
}
