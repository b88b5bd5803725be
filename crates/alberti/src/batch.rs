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

mod contact_sheet;
mod jobs;
mod key;
mod report;
mod runner;
mod shard;

use super::CliError;
use super::load_options::LoadArgs;
use super::scene_overrides::SceneOverrideArgs;
use jobs::BatchJob;
use report::{BatchReport, JobRecord};
use shard::Shard;
use std::io::Write as _;
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

/// Runs the jobs of this shard; the exit code is 1 if one has failed.
///
/// The reports of all shards in the folder count as earlier work, so a run may resume with another
/// number of shards. They are read before this run's report is opened for appending.
///
/// # Errors
/// If an input cannot be listed, or the folder or its report cannot be written. A job that fails is
/// not an error of the run: it is a record of the report, and changes the exit code only.
pub(crate) fn run(args: &BatchArgs) -> Result<ExitCode, CliError> {
    let all = jobs::find_jobs(&args.inputs)?;
    let shard = args.shard.unwrap_or(Shard::ALL_JOBS);
    let mine: Vec<&BatchJob> =
        all.iter().enumerate().filter(|(at, _)| shard.has_job(*at)).map(|(_, job)| job).collect();
    let create_error = |cause| {
        CliError::Usage(format!("cannot create the folder {}: {cause}", args.out_dir.display()))
    };
    std::fs::create_dir_all(&args.out_dir).map_err(create_error)?;
    let settings = format!("{:?} {:?}", args.overrides, args.load_options);
    let done = if args.force { Vec::new() } else { report::read_reports(&args.out_dir) };
    let report = BatchReport::open_report(&args.out_dir, shard)?;
    let threads = super::render::thread_count(args.threads);
    let order = runner::BatchRun { args, settings: &settings, earlier: &done, threads };
    let records = order.run_jobs(&mine, &report);
    report.finish_report(&records)?;
    if shard.has_all_jobs() {
        let sheet = contact_sheet::contact_sheet_html(&records);
        pipeline::write_file(&args.out_dir.join("index.html"), sheet.as_bytes())?;
    }
    print_summary(&records)
}

/// Prints the failures and the counts; returns the exit code.
///
/// Failures go to the standard error stream, in the order of the jobs; the counts go to the
/// standard output:
///
/// ```text
/// failed: models/broken.glb: …
/// 118 rendered, 40 up to date, 1 failed
/// ```
fn print_summary(records: &[JobRecord]) -> Result<ExitCode, CliError> {
    let count = |status| records.iter().filter(|record| record.status == status).count();
    let (done, before, failed) =
        (count(report::DONE), count(report::DONE_BEFORE), count(report::FAILED));
    for record in records.iter().filter(|record| record.status == report::FAILED) {
        super::print_message("failed", &format!("{}: {}", record.input, record.message));
    }
    writeln!(std::io::stdout(), "{done} rendered, {before} up to date, {failed} failed")?;
    Ok(if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
