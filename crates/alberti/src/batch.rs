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
mod shard;
mod work;

use super::Failure;
use super::loading::LoadArgs;
use super::look::LookArgs;
use jobs::Job;
use report::{Record, Report};
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
    look: LookArgs,
    #[command(flatten)]
    load: LoadArgs,
}

/// Does the jobs; the exit code is 1 if one has failed.
pub(crate) fn run(args: &BatchArgs) -> Result<ExitCode, Failure> {
    let all = jobs::find(&args.inputs)?;
    let shard = args.shard.unwrap_or(Shard::WHOLE);
    let mine: Vec<&Job> =
        all.iter().enumerate().filter(|(at, _)| shard.has(*at)).map(|(_, job)| job).collect();
    let cannot =
        |cause| Failure::Usage(format!("cannot make the folder {}: {cause}", args.out.display()));
    std::fs::create_dir_all(&args.out).map_err(cannot)?;
    let settings = format!("{:?} {:?}", args.look, args.load);
    let done = if args.again { Vec::new() } else { report::read_all(&args.out) };
    let report = Report::open(&args.out, shard)?;
    let threads = super::render::threads(args.threads);
    let order = work::Order { args, settings: &settings, done: &done, threads };
    let records = order.work(&mine, &report);
    report.finish(&records)?;
    if shard.is_whole() {
        let sheet = contact_sheet::html(&records);
        pipeline::write_file(&args.out.join("index.html"), sheet.as_bytes())?;
    }
    conclude(&records)
}

/// A sentence on the standard output, and the exit code.
fn conclude(records: &[Record]) -> Result<ExitCode, Failure> {
    let count = |status| records.iter().filter(|record| record.status == status).count();
    let (done, before, failed) = (count(report::DONE), count(report::KEPT), count(report::FAILED));
    for record in records.iter().filter(|record| record.status == report::FAILED) {
        super::complain("failed", &format!("{}: {}", record.input, record.message));
    }
    writeln!(std::io::stdout(), "{done} done, {before} done before, {failed} failed")?;
    Ok(if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
