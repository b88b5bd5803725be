//! Runs a batch from options to result: renders, verifies or merges.

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

/// The jobs of a batch, and the options for running them.
#[derive(Clone, Debug)]
pub struct BatchOptions {
    /// Models, scenes, folders, and lists of names.
    pub inputs: Vec<PathBuf>,
    /// A list of jobs, JSON lines or CSV; `-` is the standard input.
    pub list: Option<PathBuf>,
    /// The scene into which inputs are inserted.
    pub scene: Option<PathBuf>,
    /// The template for picture names.
    pub picture_name: Option<PictureName>,
    /// The output folder.
    pub out_dir: PathBuf,
    /// The shard to run.
    pub shard: Shard,
    /// The flags of all pictures, as words such as `--size=64x64`.
    pub flags: Vec<String>,
    /// The flags that list lines may set, and their conflicts.
    pub flag_table: FlagTable,
    /// Allowed folders outside the scenes' own folders, and files named by flags.
    pub allowed: Vec<PathBuf>,
    /// The time limit for one picture.
    pub job_time: Option<Duration>,
    /// The memory limit of a worker in bytes.
    pub job_memory: Option<u64>,
    /// Whether everything is rendered again.
    pub is_forced: bool,
    /// Whether jobs that failed in an earlier run are run again.
    pub retries_failed: bool,
    /// The number of pictures per tar file, if tar files are written.
    pub tar: Option<u32>,
    /// The file with counts and times for Prometheus.
    pub metrics: Option<PathBuf>,
    /// The number of concurrent workers.
    pub threads: usize,
}

impl BatchOptions {
    /// Finds the inputs and opens the list; returns the jobs of this shard.
    ///
    /// # Errors
    /// Returns an error if a folder or the list cannot be read.
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

    /// Returns the key maker, whose keys identify finished jobs.
    fn keys(&self) -> KeyMaker {
        KeyMaker::new(&format!("{:?}", self.flags), self.allowed.clone())
    }
}

/// The jobs of a shard, found but not run yet.
pub struct ShardJobs(JobStream);

impl std::fmt::Debug for ShardJobs {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ShardJobs").finish_non_exhaustive()
    }
}

/// The result of a run.
#[derive(Clone, Copy, Debug)]
pub enum RunEnd {
    /// All jobs were run, with these counts.
    Finished(RunCounts),
    /// This signal interrupted the run; the next run resumes it.
    Interrupted(i32),
}

/// Merges the reports of all runs, and writes the contact sheet.
///
/// # Errors
/// Returns an error if a report cannot be read, or if the results cannot be written.
pub fn merge_reports(out_dir: &Path) -> Result<MergeCounts, BatchError> {
    let counts = merge::merge_reports(out_dir, None)?;
    contact_sheet::write_contact_sheet(out_dir, &counts)?;
    Ok(counts)
}

/// Checks that every job has a record and every picture is intact; `tell` receives the problems,
/// one line per picture, and then the counts. Returns true if there are no problems.
///
/// # Errors
/// Returns an error if a list or a report cannot be read, or if `tell` fails.
pub fn verify_jobs<E: From<BatchError>>(
    options: &BatchOptions,
    jobs: ShardJobs,
    tell: impl FnMut(&str) -> Result<(), E>,
) -> Result<bool, E> {
    verify::verify_jobs(jobs.0, &options.keys(), &options.out_dir, tell)
}

/// Runs the jobs; `tell_failure` receives the messages of failed jobs at the end.
///
/// The reports of all shards in the folder count as earlier work, so a run may resume with a
/// different number of shards.
///
/// # Errors
/// Returns an error if a list cannot be read, or if the output folder cannot be written. A job that
/// fails is not an error: it is a record in the report.
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
        // A list may be too long to keep in memory.
        current: (shard.has_all_jobs() && options.list.is_none())
            .then(Mutex::<CurrentJobs>::default),
        stop: Mutex::new(None),
    };
    run.run_jobs(options.threads);
    let stop = run.stop.into_inner().unwrap_or_else(PoisonError::into_inner);
    let current = run.current.map(|jobs| jobs.into_inner().unwrap_or_else(PoisonError::into_inner));
    let failures = run.failures.into_inner().unwrap_or_else(PoisonError::into_inner);
    // Finished pictures are kept, regardless of what stopped the run.
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
