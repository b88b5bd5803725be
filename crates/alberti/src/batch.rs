//! `alberti batch`: pictures of many models and scenes, each for itself.
//!
//! ```text
//!  folders, lists, files ─► jobs ─► this shard's ─► those not done yet ─► pictures, report, contact sheet
//! ```
//! A job is done if the report says so of the same content and the same settings, and its picture is there. A run that was
//! stopped, or killed, therefore goes on where it was. One broken model is a line of the report and no more.

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

#[derive(Debug, clap::Args)]
pub(crate) struct BatchArgs {
    /// Models (.gltf, .glb), scenes (.ron), folders that are searched for models, or text files (.txt) that list them line by
    /// line; `-` reads such a list from the standard input
    #[arg(required = true)]
    inputs: Vec<PathBuf>,
    /// The folder that the pictures, the report and the contact sheet go to
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Do part I of N, from 1/N to N/N; `auto` takes both from the variables of an array job
    #[arg(long, value_name = "I/N|auto", value_parser = shard::parse)]
    shard: Option<Shard>,
    /// Do also what is done already
    #[arg(long)]
    again: bool,
    /// Models to work on at a time [default: as many as there are cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,
    #[command(flatten)]
    overrides: SceneOverrideArgs,
    #[command(flatten)]
    load_options: LoadArgs,
}

/// Does the jobs; the exit code is 1 if one has failed.
pub(crate) fn run(args: &BatchArgs) -> Result<ExitCode, CliError> {
    let all = jobs::find_jobs(&args.inputs)?;
    let shard = args.shard.unwrap_or(Shard::ALL_JOBS);
    let mine: Vec<&BatchJob> =
        all.iter().enumerate().filter(|(at, _)| shard.has_job(*at)).map(|(_, job)| job).collect();
    let create_error =
        |cause| CliError::Usage(format!("cannot make the folder {}: {cause}", args.out.display()));
    std::fs::create_dir_all(&args.out).map_err(create_error)?;
    let settings = format!("{:?} {:?}", args.overrides, args.load_options);
    let done = if args.again { Vec::new() } else { report::read_reports(&args.out) };
    let report = BatchReport::open_report(&args.out, shard)?;
    let threads = super::render::thread_count(args.threads);
    let order = runner::BatchRun { args, settings: &settings, earlier: &done, threads };
    let records = order.run_jobs(&mine, &report);
    report.finish_report(&records)?;
    if shard.has_all_jobs() {
        let sheet = contact_sheet::contact_sheet_html(&records);
        pipeline::write_file(&args.out.join("index.html"), sheet.as_bytes())?;
    }
    print_summary(&records)
}

/// A sentence on the standard output, and the exit code.
fn print_summary(records: &[JobRecord]) -> Result<ExitCode, CliError> {
    let count = |status| records.iter().filter(|record| record.status == status).count();
    let (done, before, failed) =
        (count(report::DONE), count(report::DONE_BEFORE), count(report::FAILED));
    for record in records.iter().filter(|record| record.status == report::FAILED) {
        super::print_message("failed", &format!("{}: {}", record.input, record.message));
    }
    writeln!(std::io::stdout(), "{done} done, {before} done before, {failed} failed")?;
    Ok(if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
