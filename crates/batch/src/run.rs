//! A batch from its options to its result: rendered, verified, or merged.

use super::contact_sheet;
use super::earlier_records::EarlierRecords;
use super::error::BatchError;
use super::flag_table::FlagTable;
use super::job_stream::{JobSource, JobStream};
use super::key::KeyMaker;
use super::merge::{self, CurrentJobs, MergeCounts};
use super::metrics::RunCounts;
use super::outcome::RunStop;
use super::picture_name::PictureName;
use super::pool::{BatchRun, JobPolicy};
use super::progress::{ProgressDisplay, RunProgress};
use super::report::ReportWriter;
use super::shard::Shard;
use super::tar_output::TarOutput;
use super::verify;
use super::worker_process::WorkerProgram;
use files::visible_path;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// The jobs of a batch, and how they are run.
#[derive(Clone, Debug)]
pub struct BatchOptions {
    /// Models, scenes, folders, and lists of names.
    pub inputs: Vec<PathBuf>,
    /// A list of jobs, JSON lines or CSV; `-` is the standard input.
    pub list: Option<PathBuf>,
    /// The scene that inputs are put into.
    pub scene: Option<PathBuf>,
    /// The template of the names of pictures.
    pub picture_name: Option<PictureName>,
    /// The output folder.
    pub out_dir: PathBuf,
    /// The part of the jobs that is run.
    pub shard: Shard,
    /// The flags of all pictures, as words such as `--size=64x64`.
    pub flags: Vec<String>,
    /// The flags that lines of a list may have, and which exclude each other.
    pub flag_table: FlagTable,
    /// Folders outside of those of the scenes that files may lie in, and files that flags name.
    pub allowed: Vec<PathBuf>,
    /// The time of one picture.
    pub job_time: Option<Duration>,
    /// The memory of a worker in bytes.
    pub job_memory: Option<u64>,
    /// Whether everything is rendered again.
    pub is_forced: bool,
    /// Whether jobs that failed in an earlier run are run again.
    pub retries_failed: bool,
    /// The number of pictures in each tar file, if they go to tar files.
    pub tar: Option<u32>,
    /// The file of counts and times for Prometheus.
    pub metrics: Option<PathBuf>,
    /// The number of workers at a time.
    pub threads: usize,
}

impl BatchOptions {
    /// Finds the inputs and opens the list: the jobs of this shard.
    ///
    /// # Errors
    /// If a folder or the list cannot be read.
    pub fn open_jobs(&self) -> Result<ShardJobs, BatchError> {
        let source = JobSource {
            inputs: &self.inputs,
            list: self.list.as_deref(),
            scene: self.scene.as_deref(),
            picture_name: self.picture_name.as_ref(),
            flags: &self.flag_table,
        };
        JobStream::open(&source, self.shard).map(ShardJobs)
    }

    /// The maker of the keys by which jobs are known to be done.
    fn keys(&self) -> KeyMaker {
        KeyMaker::new(&format!("{:?}", self.flags), self.allowed.clone())
    }
}

/// The jobs of a shard: found, and not run yet.
pub struct ShardJobs(JobStream);

impl std::fmt::Debug for ShardJobs {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ShardJobs").finish_non_exhaustive()
    }
}

/// How a run ended.
#[derive(Clone, Copy, Debug)]
pub enum RunEnd {
    /// All jobs were run, and came to this.
    Finished(RunCounts),
    /// It was interrupted by this signal; the next run goes on.
    Interrupted(i32),
}

/// Merges the reports of all runs, and writes the contact sheet.
///
/// # Errors
/// If a report cannot be read, or the results cannot be written.
pub fn merge_reports(out_dir: &Path) -> Result<MergeCounts, BatchError> {
    let counts = merge::merge_reports(out_dir, None)?;
    contact_sheet::write_contact_sheet(out_dir, &counts)?;
    Ok(counts)
}

/// Checks that every job has a record and every picture is whole; `tell` gets what is wrong, one
/// picture a line, then the counts. Whether nothing is wrong.
///
/// # Errors
/// If a list or a report cannot be read, or `tell` fails.
pub fn verify_jobs<E: From<BatchError>>(
    options: &BatchOptions,
    jobs: ShardJobs,
    tell: impl FnMut(&str) -> Result<(), E>,
) -> Result<bool, E> {
    verify::verify_jobs(jobs.0, &options.keys(), &options.out_dir, tell)
}

/// Runs the jobs; `tell_failure` gets the messages of those that failed, at the end.
///
/// The reports of all shards in the folder count as earlier work, so a run may resume with another
/// number of shards.
///
/// # Errors
/// If a list cannot be read, or the output folder cannot be written. A job that fails is no error:
/// it is a record of the report.
pub fn run_jobs(
    options: &BatchOptions,
    jobs: ShardJobs,
    program: WorkerProgram<'_>,
    display: ProgressDisplay,
    tell_failure: impl FnMut(&str),
) -> Result<RunEnd, BatchError> {
    let (shard, out_dir) = (options.shard, &options.out_dir);
    std::fs::create_dir_all(out_dir).map_err(|cause| {
        let folder = visible_path(out_dir);
        BatchError::Unusable(format!("cannot create the folder {folder}: {cause}"))
    })?;
    let earlier = if options.is_forced { None } else { Some(EarlierRecords::read(out_dir)?) };
    let report = ReportWriter::create(out_dir, shard)?;
    let tar = options.tar.map(|count| TarOutput::new(out_dir, report.run_name(), count));
    let progress = RunProgress::start(options.metrics.as_deref(), display)?;
    let keys = options.keys();
    let run = BatchRun {
        jobs: Mutex::new(jobs.0),
        keys: &keys,
        flags: &options.flags,
        flag_table: &options.flag_table,
        program,
        earlier,
        report: &report,
        tar: tar.as_ref(),
        progress: &progress,
        out_dir,
        policy: JobPolicy {
            limit: options.job_time,
            memory: options.job_memory,
            retries_failed: options.retries_failed,
        },
        failures: Mutex::default(),
        // A list may be too long to be kept.
        current: (shard.has_all_jobs() && options.list.is_none())
            .then(Mutex::<CurrentJobs>::default),
        stop: Mutex::new(None),
    };
    run.run_jobs(options.threads);
    let stop = run.stop.into_inner().unwrap_or_else(PoisonError::into_inner);
    let current = run.current.map(|jobs| jobs.into_inner().unwrap_or_else(PoisonError::into_inner));
    let failures = run.failures.into_inner().unwrap_or_else(PoisonError::into_inner);
    // What was rendered is kept, whatever has stopped the run.
    let tar = tar.map_or(Ok(()), |tar| tar.finish(&report));
    let closed = tar.and_then(|()| report.finish());
    let counts = progress.finish()?;
    failures.tell(tell_failure);
    match stop {
        Some(RunStop::Signal(signal)) => return Ok(RunEnd::Interrupted(signal)),
        Some(RunStop::Fault(error)) => return Err(error),
        None => closed?,
    }
    if shard.has_all_jobs() {
        let counts = merge::merge_reports(out_dir, current)?;
        contact_sheet::write_contact_sheet(out_dir, &counts)?;
    }
    Ok(RunEnd::Finished(counts))
}
