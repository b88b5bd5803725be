//! `alberti batch` and its worker: arguments, messages, exit codes, and rendering.
//!
//! The [`batch`](../batch/index.html) crate manages the jobs, their progress and their results. A
//! worker is a separate process of this program that renders pictures for the coordinator.

mod render_flags;
mod worker;
mod worker_scene;

pub(crate) use worker::{WorkerArgs, run as run_worker};

use super::CliError;
use super::memory_limit::parse_memory_size;
use super::messages::{print_message, print_text};
use super::program::program_command;
use batch::{
    BatchOptions, MergeCounts, PictureName, ProgressDisplay, RunCounts, RunEnd, Shard, ShardJobs,
    merge_reports, parse_shard, run_jobs, verify_jobs,
};
use files::{counted, visible_text};
use render_flags::{GivenFlags, flag_table};
use std::io::IsTerminal as _;
use std::path::PathBuf;
use std::time::Duration;

/// Arguments of `alberti batch`.
#[derive(Debug, clap::Args)]
pub(crate) struct BatchArgs {
    /// Models (.gltf, .glb, .stl, .obj, .ply, .3mf), scenes (.ron), folders, or lists of file names
    /// (.txt)
    ///
    /// A list has one file per line; `-` reads a list from the standard input.
    #[arg(required_unless_present_any = ["list", "merge"])]
    inputs: Vec<PathBuf>,
    /// List of jobs, one per line: JSON (.jsonl) or CSV (.csv); `-` is the standard input
    ///
    /// In `{"input": "fox.glb", "output": "a.png", "size": "64x64"}`, input is relative to the
    /// list, and output to the output folder. Other members are named after picture flags and
    /// override the command's flags. The member "pictures" is a list of such objects, for several
    /// pictures of one input. The columns of a CSV file have the same names. The list is read as
    /// needed and may have any length.
    #[arg(long, value_name = "FILE")]
    list: Option<PathBuf>,
    /// Output folder for the pictures, the reports and the contact sheet
    #[arg(long, value_name = "DIR")]
    out_dir: PathBuf,
    /// Picture names, such as {prefix}/{stem}.png
    ///
    /// {stem} is the input's name without its extension, and {name} is the name with it. {folder}
    /// is the input's folder, relative to the folder that was searched. {line} is the number of the
    /// line or input, and {picture} the picture's number within the line, both counted from 1;
    /// {line:08} has eight digits. {prefix}, two hexadecimal digits of a hash of the name, spreads
    /// the pictures over 256 folders.
    #[arg(long, value_name = "TEMPLATE", value_parser = PictureName::parse)]
    name: Option<PictureName>,
    /// Process part I of N; `auto` takes both from the environment variables of an array job
    #[arg(long, value_name = "I/N|auto", value_parser = parse_shard)]
    shard: Option<Shard>,
    /// Time limit per picture in seconds; 0 means none
    #[arg(long, value_name = "N", default_value = "600", value_parser = clap::value_parser!(u32).range(0..=604_800))]
    job_seconds: u32,
    /// Memory limit per job, at least 64MiB (Linux only)
    ///
    /// It also limits the sizes of files, arrays and images.
    #[arg(long, value_name = "SIZE", value_parser = parse_job_memory)]
    job_memory: Option<u64>,
    /// Render everything again, even if it is up to date
    #[arg(long)]
    force: bool,
    /// Retry jobs that failed in an earlier run and have not changed since
    #[arg(long)]
    retry_failed: bool,
    /// Check that every job has a record and an intact picture; render nothing
    ///
    /// Missing and wrong pictures are listed, one per line; the exit code is then 1.
    #[arg(long, conflicts_with_all = ["force", "retry_failed"])]
    verify: bool,
    /// Merge the reports of all runs into report.jsonl and write the contact sheet; render nothing
    #[arg(long, conflicts_with_all = ["force", "retry_failed", "verify"])]
    merge: bool,
    /// Write the pictures to tar files with N pictures each, for WebDataset
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    tar: Option<u32>,
    /// Write counts and times to this file once a second, in the Prometheus text format
    #[arg(long, value_name = "FILE")]
    metrics: Option<PathBuf>,
    /// Number of models to render at a time [default: one per core]
    #[arg(long, value_name = "N", value_parser = crate::options::parse_thread_count)]
    threads: Option<u16>,
    #[command(flatten)]
    flags: GivenFlags,
}

/// The exit code of a run in which jobs failed.
const SOME_FAILED: u8 = 1;
/// The exit code for wrong usage: inputs that cannot be listed.
const WRONG_USAGE: u8 = 2;
/// The exit code of a run that had to stop.
const STOPPED: u8 = 3;

/// Runs the jobs of this shard; returns the exit code.
///
/// A failed job does not fail the run: it becomes a record in the report and changes only the exit
/// code. Problems with the inputs or the output folder are printed here, since their exit codes
/// differ.
///
/// # Errors
/// Returns an error if writing to standard output fails.
pub(crate) fn run(args: BatchArgs) -> Result<u8, CliError> {
    let (is_merge, is_verification) = (args.merge, args.verify);
    let options = args.into_options();
    if is_merge {
        let code = merge_to_code(&options);
        return Ok(code.unwrap_or_else(|error| print_fault(&error, STOPPED)));
    }
    let jobs = match options.open_jobs() {
        Ok(jobs) => jobs,
        Err(error) => return Ok(print_fault(&error.into(), WRONG_USAGE)),
    };
    let code = if is_verification {
        let is_whole = verify_jobs(&options, jobs, print_text);
        is_whole.map(|is_whole| if is_whole { 0 } else { SOME_FAILED })
    } else {
        run_to_code(&options, jobs)
    };
    Ok(code.unwrap_or_else(|error| print_fault(&error, STOPPED)))
}

impl BatchArgs {
    /// Returns the options of the run.
    fn into_options(mut self) -> BatchOptions {
        let scene = self.flags.take_scene_file();
        BatchOptions {
            inputs: self.inputs,
            list: self.list,
            scene,
            picture_name: self.name,
            out_dir: self.out_dir,
            shard: self.shard.unwrap_or(Shard::ALL_JOBS),
            flags: self.flags.to_words(),
            flag_table: flag_table(),
            allowed: self.flags.allowed,
            job_time: (self.job_seconds > 0).then(|| Duration::from_secs(self.job_seconds.into())),
            job_memory: self.job_memory,
            is_forced: self.force,
            retries_failed: self.retry_failed,
            tar: self.tar,
            metrics: self.metrics,
            threads: super::render::thread_count(self.threads),
        }
    }
}

/// Prints an error; returns the exit code.
fn print_fault(error: &CliError, code: u8) -> u8 {
    print_message("error", &error.to_message());
    code
}

/// Merges the reports; the exit code indicates whether any job failed.
fn merge_to_code(options: &BatchOptions) -> Result<u8, CliError> {
    let counts = merge_reports(&options.out_dir)?;
    print_statistics(&counts)?;
    Ok(if counts.failed == 0 { 0 } else { SOME_FAILED })
}

/// Prints a summary of a merged report.
///
/// ```text
/// 990 pictures, 20.5 MB in total, 10 failed
/// 0.30 s per job on average, 61.20 s for models/engine.glb
/// ```
fn print_statistics(counts: &MergeCounts) -> Result<(), CliError> {
    let MergeCounts { done, failed, bytes, seconds, longest } = counts;
    let megabytes = *bytes as f64 / 1e6;
    let pictures = counted(*done, "picture", "pictures");
    let mut text = format!("{pictures}, {megabytes:.1} MB in total, {failed} failed\n");
    if let Some((longest, input)) = longest {
        let mean = seconds / (done + failed) as f64;
        let input = visible_text(input);
        text += &format!("{mean:.2} s per job on average, {longest:.2} s for {input}\n");
    }
    print_text(&text)
}

/// Runs the jobs and prints a summary; returns the exit code.
fn run_to_code(options: &BatchOptions, jobs: ShardJobs) -> Result<u8, CliError> {
    let stream = std::io::stderr();
    let display = ProgressDisplay { is_terminal: stream.is_terminal(), stream: Box::new(stream) };
    let tell_failure = |text: &str| print_message("failed", text);
    match run_jobs(options, jobs, &program_command, display, tell_failure)? {
        RunEnd::Finished(counts) => print_summary(counts),
        RunEnd::Interrupted(signal) => {
            print_message("error", "interrupted; run the same command to continue");
            Ok(u8::try_from(128 + signal).unwrap_or(STOPPED))
        }
    }
}

/// Prints the counts; returns the exit code.
///
/// ```text
/// 118 rendered, 40 up to date, 1 failed
/// ```
fn print_summary(counts: RunCounts) -> Result<u8, CliError> {
    let RunCounts { rendered, up_to_date, failed, failed_before, .. } = counts;
    if failed_before > 0 {
        let text = format!("{failed_before} in an earlier run; use --retry-failed to try again");
        print_message("failed", &text);
    }
    let failed = failed + failed_before;
    if rendered + up_to_date + failed == 0 {
        print_message("warning", "nothing to draw: the inputs contain no models or scenes");
    }
    let text = format!("{rendered} rendered, {up_to_date} up to date, {failed} failed\n");
    print_text(&text)?;
    Ok(if failed == 0 { 0 } else { SOME_FAILED })
}

/// Parses a job's memory limit, which only Linux can enforce.
fn parse_job_memory(text: &str) -> Result<u64, String> {
    if cfg!(target_os = "linux") {
        parse_memory_size(text)
    } else {
        Err("a memory limit per job is supported only on Linux; omit the flag and use the --max-… \
             limits"
            .to_owned())
    }
}
