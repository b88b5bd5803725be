//! `alberti batch`: renders many models and scenes, each to a picture of its own.
//!
//! ```text
//!  folders, lists, files ─► jobs ─► this shard ─► not done yet ─► pictures, report, contact sheet
//! ```
//! A job is done if a report has it with the same content and settings and its picture exists. A
//! run that was stopped or killed therefore resumes where it was. A broken model is one line of the
//! report and does not stop the others.
//!
//! The output folder holds, besides the pictures:
//!
//! - `report.jsonl`, or `report-I-of-N.jsonl` for a shard: one JSON object per job;
//! - `index.html`, the contact sheet, written only by a run without shards.
//!
//! Jobs are sorted and named before the first one starts, so that neither threads nor shards change
//! the name of a picture.

#![allow(dead_code, reason = "until the workers are there")]

mod contact_sheet;
mod job;
mod jobs;
mod key;
mod merge;
mod progress;
mod report;
mod shard;

use super::CliError;
use super::load_options::LoadArgs;
use super::scene_overrides::SceneOverrideArgs;
use shard::Shard;
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `alberti batch`.
#[derive(Debug, clap::Args)]
pub(crate) struct BatchArgs {
    /// Models (.gltf, .glb, .stl, .obj, .ply, .3mf), scenes (.ron), folders, or lists (.txt)
    ///
    /// A list has one file per line; `-` reads a list from the standard input.
    #[arg(required = true)]
    inputs: Vec<PathBuf>,
    /// Output folder for the pictures, the report and the contact sheet
    #[arg(long, value_name = "DIR")]
    out_dir: PathBuf,
    /// Process part I of N; `auto` takes both from the environment variables of an array job
    #[arg(long, value_name = "I/N|auto", value_parser = shard::parse_shard)]
    shard: Option<Shard>,
    /// Render everything again, even if it is up to date
    #[arg(long)]
    force: bool,
    /// Number of models to render at a time [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,
    #[command(flatten)]
    overrides: SceneOverrideArgs,
    #[command(flatten)]
    load_options: LoadArgs,
}

/// Runs the jobs of this shard.
///
/// # Errors
/// If an input cannot be listed, or the folder or its report cannot be written.
pub(crate) fn run(args: &BatchArgs) -> Result<ExitCode, CliError> {
    jobs::find_jobs(&args.inputs)?;
    Ok(ExitCode::FAILURE)
}
