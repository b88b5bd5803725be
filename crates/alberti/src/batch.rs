//! `alberti batch`: renders many models and scenes, each to a picture of its own.
//!
//! ```text
//!  folders, lists ─► stream of jobs ─► this shard ─► not done yet ─► workers ─► pictures, tars
//!                                                         ▲             │
//!                                     records of earlier runs ◄── report ◄── counts, metrics
//! ```
//! A job is done if a report has it with the same content and settings and its picture has the
//! recorded size. A run that was stopped or killed therefore resumes where it was. A model that is
//! broken, hangs, crashes or takes all memory is one line of the report and does not stop the
//! others.
//!
//! The output folder holds, besides the pictures:
//!
//! - `reports/`: the reports of all runs, one JSON object per job;
//! - `report.jsonl`: the reports merged, and `index.html`, the contact sheet, both written by a run
//!   without shards and by `--merge`.
//!
//! Names of pictures and the shards of jobs depend on the inputs alone, so that neither threads nor
//! shards change them.

mod contact_sheet;
mod csv;
mod earlier_records;
mod inputs;
mod job;
mod job_list;
mod job_stream;
mod key;
mod left_over;
mod list_line;
mod merge;
mod metrics;
mod outcome;
mod output_names;
mod picture_name;
mod pool;
mod progress;
mod protocol;
mod render_flags;
mod report;
mod report_reader;
mod shard;
mod tar_format;
mod tar_output;
#[cfg(test)]
mod test_records;
mod verify;
mod worker;
mod worker_process;
mod worker_scene;

pub(crate) use worker::{WorkerArgs, run as run_worker};

use super::CliError;
use super::memory_limit::parse_memory_size;
use super::messages::{print_message, print_text};
use earlier_records::EarlierRecords;
use files::{visible_path, visible_text};
use job_stream::{JobSource, JobStream};
use key::KeyMaker;
use merge::{CurrentJobs, MergeCounts};
use metrics::RunCounts;
use outcome::RunStop;
use picture_name::PictureName;
use pool::{BatchRun, JobPolicy};
use progress::RunProgress;
use render_flags::{FlagTable, GivenFlags};
use report::ReportWriter;
use shard::Shard;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use tar_output::TarOutput;

/// Arguments of `alberti batch`.
#[derive(Debug, clap::Args)]
pub(crate) struct BatchArgs {
    /// Models (.gltf, .glb, .stl, .obj, .ply, .3mf), scenes (.ron), folders, or lists of names
    /// (.txt)
    ///
    /// A list has one file per line; `-` reads a list from the standard input.
    #[arg(required_unless_present_any = ["list", "merge"])]
    inputs: Vec<PathBuf>,
    /// List of jobs, one a line: JSON (.jsonl) or CSV (.csv); `-` is the standard input
    ///
    /// {"input": "fox.glb", "output": "a.png", "size": "64x64"}: input is relative to the list,
    /// output to the output folder, other members are flags of a picture by their names, which come
    /// on top of those of the command. "pictures" is a list of such objects, for several pictures
    /// of one input. The columns of a CSV file have the same names. The list is read as it is
    /// needed and may have any length.
    #[arg(long, value_name = "FILE")]
    list: Option<PathBuf>,
    /// Output folder for the pictures, the reports and the contact sheet
    #[arg(long, value_name = "DIR")]
    out_dir: PathBuf,
    /// Names of the pictures, such as {prefix}/{stem}.png
    ///
    /// {stem} and {name} are the input's name without and with its extension, {folder} its folder
    /// below the one that was searched, {line} the number of its line or of the input, {picture}
    /// that of the picture within its line, both from 1; {line:08} has eight digits. {prefix} are
    /// two hexadecimal digits of a hash of the name, which spread many pictures over 256 folders.
    #[arg(long, value_name = "TEMPLATE", value_parser = PictureName::parse)]
    name: Option<PictureName>,
    /// Process part I of N; `auto` takes both from the environment variables of an array job
    #[arg(long, value_name = "I/N|auto", value_parser = shard::parse_shard)]
    shard: Option<Shard>,
    /// Time of one picture, after which its job has failed; 0 is none
    #[arg(long, value_name = "N", default_value = "600", value_parser = clap::value_parser!(u32).range(0..=604_800))]
    job_seconds: u32,
    /// Memory of one job, at least 64MiB, beyond which it has failed (Linux only)
    ///
    /// It limits the sizes of files, arrays and images as well.
    #[arg(long, value_name = "SIZE", value_parser = parse_job_memory)]
    job_memory: Option<u64>,
    /// Render everything again, even if it is up to date
    #[arg(long)]
    force: bool,
    /// Run jobs again that have failed in an earlier run and have not changed since
    #[arg(long)]
    retry_failed: bool,
    /// Check that every job has a record, and every picture is there and whole; render nothing
    ///
    /// Whatever is missing or wrong is printed one a line, and the exit code is 1.
    #[arg(long, conflicts_with_all = ["force", "retry_failed"])]
    verify: bool,
    /// Merge the reports of all runs to report.jsonl and write the contact sheet; render nothing
    #[arg(long, conflicts_with_all = ["force", "retry_failed", "verify"])]
    merge: bool,
    /// Write the pictures to tar files of N pictures each, as WebDataset reads them
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    tar: Option<u32>,
    /// Write counts and times to this file once a second, as text for Prometheus
    #[arg(long, value_name = "FILE")]
    metrics: Option<PathBuf>,
    /// Number of models to render at a time [default: one per core]
    #[arg(long, value_name = "N", value_parser = crate::options::parse_thread_count)]
    threads: Option<u16>,
    #[command(flatten)]
    flags: GivenFlags,
}

/// The exit code of a run in which jobs have failed.
const SOME_FAILED: u8 = 1;
/// The exit code of wrong usage: inputs that cannot be listed.
const WRONG_USAGE: u8 = 2;
/// The exit code of a run that could not go on.
const STOPPED: u8 = 3;

/// Runs the jobs of this shard; returns the exit code.
///
/// A job that fails is not an error of the run: it is a record of the report, and changes the exit
/// code only. What is wrong with the inputs or with the output folder is printed here, as each has
/// an exit code of its own.
///
/// # Errors
/// If the standard output cannot be written.
pub(crate) fn run(mut args: BatchArgs) -> Result<u8, CliError> {
    let scene = args.flags.take_scene_file();
    let flags = args.flags.to_words();
    let source = JobSource {
        inputs: &args.inputs,
        list: args.list.as_deref(),
        scene: scene.as_deref(),
        picture_name: args.name.as_ref(),
    };
    if args.merge {
        return Ok(merge_reports(&args).unwrap_or_else(|error| print_fault(&error, STOPPED)));
    }
    let jobs = match JobStream::open(&source, args.shard.unwrap_or(Shard::ALL_JOBS)) {
        Ok(jobs) => jobs,
        Err(error) => return Ok(print_fault(&error, WRONG_USAGE)),
    };
    let keys = KeyMaker::new(&format!("{flags:?}"), args.flags.allowed.clone());
    let code = if args.verify {
        let is_whole = verify::verify_jobs(jobs, &keys, &args.out_dir);
        is_whole.map(|is_whole| if is_whole { 0 } else { SOME_FAILED })
    } else {
        run_jobs(&args, jobs, &keys, &flags)
    };
    Ok(code.unwrap_or_else(|error| print_fault(&error, STOPPED)))
}

/// Prints an error; returns the exit code.
fn print_fault(error: &CliError, code: u8) -> u8 {
    print_message("error", &error.to_message());
    code
}

/// Merges the reports; the exit code says whether one of the jobs has failed.
fn merge_reports(args: &BatchArgs) -> Result<u8, CliError> {
    let counts = merge::merge_reports(&args.out_dir, None)?;
    contact_sheet::write_contact_sheet(&args.out_dir, &counts)?;
    print_statistics(&counts)?;
    Ok(if counts.failed == 0 { 0 } else { SOME_FAILED })
}

/// Prints what a merged report says of all pictures.
///
/// ```text
/// 990 pictures of 20.5 MB in all, 10 failed
/// 0.3 s of work a job, 61.2 s for models/engine.glb
/// ```
fn print_statistics(counts: &MergeCounts) -> Result<(), CliError> {
    let MergeCounts { done, failed, bytes, seconds, longest } = counts;
    let megabytes = *bytes as f64 / 1e6;
    let mut text = format!("{done} pictures of {megabytes:.1} MB in all, {failed} failed\n");
    if let Some((longest, input)) = longest {
        let mean = seconds / (done + failed) as f64;
        let input = visible_text(input);
        text += &format!("{mean:.2} s of work a job, {longest:.2} s for {input}\n");
    }
    print_text(&text)
}

/// Runs the jobs, and prints what came of them.
///
/// The reports of all shards in the folder count as earlier work, so a run may resume with another
/// number of shards.
fn run_jobs(
    args: &BatchArgs,
    jobs: JobStream,
    keys: &KeyMaker,
    flags: &[String],
) -> Result<u8, CliError> {
    let shard = args.shard.unwrap_or(Shard::ALL_JOBS);
    std::fs::create_dir_all(&args.out_dir).map_err(|cause| {
        CliError::Usage(format!(
            "cannot create the folder {}: {cause}",
            visible_path(&args.out_dir)
        ))
    })?;
    let earlier = if args.force { None } else { Some(EarlierRecords::read(&args.out_dir)?) };
    let report = ReportWriter::create(&args.out_dir, shard)?;
    let tar = args.tar.map(|count| TarOutput::new(&args.out_dir, report.run_name(), count));
    let progress = RunProgress::start(args.metrics.as_deref())?;
    let run = BatchRun {
        jobs: Mutex::new(jobs),
        keys,
        flags,
        flag_table: FlagTable::new(),
        earlier,
        report: &report,
        tar: tar.as_ref(),
        progress: &progress,
        out_dir: &args.out_dir,
        policy: JobPolicy {
            limit: (args.job_seconds > 0).then(|| Duration::from_secs(args.job_seconds.into())),
            memory: args.job_memory,
            retries_failed: args.retry_failed,
        },
        failures: Mutex::default(),
        // A list may be too long to be kept.
        current: (shard.has_all_jobs() && args.list.is_none()).then(Mutex::<CurrentJobs>::default),
        stop: Mutex::new(None),
    };
    run.run_jobs(super::render::thread_count(args.threads));
    let stop = run.stop.into_inner().unwrap_or_else(PoisonError::into_inner);
    let current = run.current.map(|jobs| jobs.into_inner().unwrap_or_else(PoisonError::into_inner));
    let failures = run.failures.into_inner().unwrap_or_else(PoisonError::into_inner);
    // What was rendered is kept, whatever has stopped the run.
    let tar = tar.map_or(Ok(()), |tar| tar.finish(&report));
    let closed = tar.and_then(|()| report.finish());
    let counts = progress.finish()?;
    failures.print();
    match stop {
        Some(RunStop::Signal(signal)) => {
            print_message("error", "interrupted: run the command again to go on");
            return Ok(u8::try_from(128 + signal).unwrap_or(STOPPED));
        }
        Some(RunStop::Fault(error)) => return Err(error),
        None => closed?,
    }
    if shard.has_all_jobs() {
        let counts = merge::merge_reports(&args.out_dir, current)?;
        contact_sheet::write_contact_sheet(&args.out_dir, &counts)?;
    }
    print_summary(counts)
}

/// Prints the counts; returns the exit code.
///
/// ```text
/// 118 rendered, 40 up to date, 1 failed
/// ```
fn print_summary(counts: RunCounts) -> Result<u8, CliError> {
    let RunCounts { rendered, up_to_date, failed, failed_before, .. } = counts;
    if failed_before > 0 {
        let text = format!("{failed_before} in an earlier run; --retry-failed runs them again");
        print_message("failed", &text);
    }
    let failed = failed + failed_before;
    let text = format!("{rendered} rendered, {up_to_date} up to date, {failed} failed\n");
    print_text(&text)?;
    Ok(if failed == 0 { 0 } else { SOME_FAILED })
}

/// Parses the memory of a job, which only Linux can hold it to.
fn parse_job_memory(text: &str) -> Result<u64, String> {
    if cfg!(target_os = "linux") {
        parse_memory_size(text)
    } else {
        Err("only Linux holds a job to a number of bytes: leave the flag out, and limit what a \
             model may demand by the flags --max-…"
            .to_owned())
    }
}
