//! `alberti scene`: creates, validates, formats and documents scene files.
//!
//! `check` exits with 1 if there are errors, and `fmt --check` exits with 1 if a file is not
//! formatted. `init` and `doc` fail only if they cannot do their work.

mod fmt;
mod init;

use super::reference::{self, ReferenceArgs};
use super::{CliError, check};
use clap::Subcommand;
use std::process::ExitCode;

/// Arguments of `alberti scene`.
#[derive(Debug, clap::Args)]
pub(crate) struct SceneArgs {
    #[command(subcommand)]
    command: SceneCommand,
}

/// The subcommands of `alberti scene`.
#[derive(Debug, Subcommand)]
enum SceneCommand {
    /// Validate scenes and their models, and warn about values that are probably unintended
    Check(check::CheckScenesArgs),
    /// Create a commented scene file for a model
    Init(init::InitArgs),
    /// Format scene files, keeping comments
    Fmt(fmt::FmtArgs),
    /// Print the reference for scene fields
    Doc(ReferenceArgs),
}

/// Runs a subcommand.
pub(crate) fn run(args: &SceneArgs) -> Result<ExitCode, CliError> {
    match &args.command {
        SceneCommand::Check(args) => return check::run_scenes(args),
        SceneCommand::Fmt(args) => return fmt::run(args),
        SceneCommand::Init(args) => init::run(args)?,
        SceneCommand::Doc(args) => reference::run_fields(args)?,
    }
    Ok(ExitCode::SUCCESS)
}
