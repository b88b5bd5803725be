//! `alberti scene`: begins, checks and lays out scene files, and tells what they may say.

mod fmt;
mod init;

use super::reference::{self, ReferenceArgs};
use super::{CliError, check};
use clap::Subcommand;
use std::process::ExitCode;

#[derive(Debug, clap::Args)]
pub(crate) struct SceneArgs {
    #[command(subcommand)]
    command: SceneCommand,
}

#[derive(Debug, Subcommand)]
enum SceneCommand {
    /// Tell everything that is wrong with scenes and their models, and what is probably not meant
    Check(check::CheckScenesArgs),
    /// Write a scene file for a model, with comments, to go on from
    Init(init::InitArgs),
    /// Lay out scene files alike; comments stay
    Fmt(fmt::FmtArgs),
    /// Tell what each field of a scene file means
    Doc(ReferenceArgs),
}

pub(crate) fn run(args: &SceneArgs) -> Result<ExitCode, CliError> {
    match &args.command {
        SceneCommand::Check(args) => return check::run_scenes(args),
        SceneCommand::Fmt(args) => return fmt::run(args),
        SceneCommand::Init(args) => init::run(args)?,
        SceneCommand::Doc(args) => reference::run_fields(args)?,
    }
    Ok(ExitCode::SUCCESS)
}
