//! The worker pool: each worker has a thread that sends it jobs and records the results.
//!
//! One worker per core is faster for many small pictures than all cores on one picture: loading,
//! decoding and encoding are serial and dominate the time of a thumbnail.

use super::earlier_records::{EarlierRecord, EarlierRecords};
use super::job::{BatchJob, JobGroup};
use super::job_stream::JobStream;
use super::key::KeyMaker;
use super::merge::CurrentJobs;
use super::outcome::{FailureList, Outcome, RunStop, failed_record, worker_end_message};
use super::progress::RunProgress;
use super::protocol::{PictureRequest, PictureTarget, WorkAnswer, WorkRequest};
use super::report::{DONE, JobRecord, ReportWriter};
use super::tar_output::TarOutput;
use super::worker_process::{WorkerEnd, WorkerProcess, WorkerProgram};
use crate::BatchError;
use crate::flag_table::FlagTable;
use files::register_partial_file;
use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The limits of one job, and which jobs to run again.
#[derive(Clone, Copy, Debug)]
pub(super) struct JobPolicy {
    /// The time limit for one picture.
    pub(super) limit: Option<Duration>,
    /// The memory limit of a worker in bytes.
    pub(super) memory: Option<u64>,
    /// Whether jobs that failed in an earlier run are run again.
    pub(super) retries_failed: bool,
}

/// A run, with the source of its jobs and the destinations of their results.
pub(super) struct BatchRun<'a> {
    /// The jobs of this shard, which the threads share.
    pub(super) jobs: Mutex<JobStream>,
    /// The keys of the jobs.
    pub(super) keys: &'a KeyMaker,
    /// The flags of the command.
    pub(super) flags: &'a [String],
    /// The flags, with their conflicts.
    pub(super) flag_table: &'a FlagTable,
    /// The program that workers run.
    pub(super) program: WorkerProgram<'a>,
    /// The records of earlier runs; `None` if all jobs are run again.
    pub(super) earlier: Option<EarlierRecords>,
    /// The report of this run.
    pub(super) report: &'a ReportWriter,
    /// The tar files that receive the pictures.
    pub(super) tar: Option<&'a TarOutput>,
    /// The job counter.
    pub(super) progress: &'a RunProgress,
    /// The output folder.
    pub(super) out_dir: &'a Path,
    /// The limits of the jobs.
    pub(super) policy: JobPolicy,
    /// The failures of this run, to print at the end.
    pub(super) failures: Mutex<FailureList>,
    /// All jobs, to restrict the merged report to them; `None` for a shard and for a list.
    pub(super) current: Option<Mutex<CurrentJobs>>,
    /// The reason why no further job is started.
    pub(super) stop: Mutex<Option<RunStop>>,
}

/// A job to run, with its key.
struct OpenJob {
    job: BatchJob,
    key: String,
}

impl BatchRun<'_> {
    /// Runs the jobs that are not up to date, with this many workers at a time.
    ///
    /// Threads take the next jobs from the stream as they become free, so that large models do not
    /// leave workers idle. The calling thread also runs jobs. A worker is started when its thread
    /// has its first job, so none is started if everything is up to date.
    pub(super) fn run_jobs(&self, threads: usize) {
        std::thread::scope(|scope| {
            for slot in 1..threads {
                scope.spawn(move || self.work(slot));
            }
            self.work(0);
        });
    }

    /// Runs jobs until there are no more, or until the run is stopped.
    fn work(&self, slot: usize) {
        let mut worker = None;
        while let Some(group) = self.next_group() {
            let done = group.and_then(|group| self.run_group(slot, group, &mut worker));
            if let Err(stop) = done {
                self.stop.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(stop);
                return;
            }
        }
    }

    /// Returns the next jobs, or `None` at the end or once the run is stopped.
    fn next_group(&self) -> Option<Result<JobGroup, RunStop>> {
        if self.stop.lock().unwrap_or_else(PoisonError::into_inner).is_some() {
            return None;
        }
        let mut jobs = self.jobs.lock().unwrap_or_else(PoisonError::into_inner);
        let next = jobs.next();
        if let Some(fraction) = jobs.fraction() {
            self.progress.set_fraction(fraction);
        }
        Some(next?.map_err(RunStop::Fault))
    }

    /// Runs those jobs of a group that are not up to date.
    ///
    /// The key is computed before rendering: if the model changes in the meantime, the record has
    /// the old key, and the next run renders the picture again.
    fn run_group(
        &self,
        slot: usize,
        group: JobGroup,
        worker: &mut Option<WorkerProcess>,
    ) -> Result<(), RunStop> {
        let mut open = VecDeque::new();
        for job in group.jobs {
            let key = self.keys.job_key(&job);
            if let Some(current) = &self.current {
                let mut current = current.lock().unwrap_or_else(PoisonError::into_inner);
                current.add_job(&job.output, &key);
            }
            match self.settled(&job, &key) {
                Some(failed) => self.progress.count_earlier(failed),
                None => match job.fault.clone() {
                    Some(fault) => self.keep(failed_record(&job, key, 0.0, fault), &[])?,
                    None => open.push_back(OpenJob { job, key }),
                },
            }
        }
        // The number of open jobs when a worker last ended for a reason that may not concern the
        // first job.
        let mut doubted = None;
        while !open.is_empty() {
            let running = match worker {
                Some(running) => running,
                None => worker.insert(WorkerProcess::start(self.program, self.policy.memory)?),
            };
            let begin = Instant::now();
            let Err(end) = self.ask_worker(slot, &mut open, running)? else { break };
            let is_fresh = running.is_fresh();
            let text = worker.take().map(WorkerProcess::into_error_text).unwrap_or_default();
            self.progress.count_restart();
            if let Some(signal) = end.interruption() {
                return Err(RunStop::Signal(signal));
            }
            // The job may not be at fault: an earlier job may have corrupted the worker, or the
            // system may be killing all processes.
            let is_doubtful = (!is_fresh && end != WorkerEnd::TimedOut) || end.is_killed();
            if is_doubtful && doubted != Some(open.len()) {
                doubted = Some(open.len());
                continue;
            }
            if let Some(OpenJob { job, key }) = open.pop_front() {
                let message = worker_end_message(&end, &text, self.policy);
                let seconds = begin.elapsed().as_secs_f64();
                self.keep(failed_record(&job, key, seconds, message), &[])?;
            }
        }
        Ok(())
    }

    /// Returns whether a job that already ran failed, or `None` if it must be run.
    fn settled(&self, job: &BatchJob, key: &str) -> Option<bool> {
        match self.earlier.as_ref()?.find(&job.output, key)? {
            EarlierRecord::Failed => (!self.policy.retries_failed).then_some(true),
            EarlierRecord::Done { is_in_tar: true, .. } => Some(false),
            EarlierRecord::Done { bytes, .. } => {
                let file = self.out_dir.join(&job.output).metadata().ok()?;
                (file.is_file() && file.len() == bytes).then_some(false)
            }
        }
    }

    /// Sends jobs to a worker; answered jobs are recorded and removed from the list.
    ///
    /// The inner error describes how the worker ended while it ran the first job left in the list.
    fn ask_worker(
        &self,
        slot: usize,
        open: &mut VecDeque<OpenJob>,
        worker: &mut WorkerProcess,
    ) -> Result<Result<(), WorkerEnd>, RunStop> {
        let Some(first) = open.front() else { return Ok(Ok(())) };
        let pictures = open.iter().map(|open| self.picture_request(slot, &open.job)).collect();
        worker.send(&WorkRequest { input: first.job.input.clone(), pictures })?;
        while !open.is_empty() {
            let (answer, picture) = match worker.next_answer(self.policy.limit) {
                Ok(answered) => answered,
                Err(end) => return Ok(Err(end)),
            };
            let Some(OpenJob { job, key }) = open.pop_front() else { break };
            self.keep(answered_record(&job, key, answer)?, &picture)?;
        }
        Ok(Ok(()))
    }

    /// Returns the request for a picture.
    fn picture_request(&self, slot: usize, job: &BatchJob) -> PictureRequest {
        let target = if self.tar.is_some() {
            PictureTarget::Pipe
        } else {
            let name = format!("{}.{slot}.part", self.report.run_name());
            let partial: PathBuf =
                [self.out_dir, "reports".as_ref(), name.as_ref()].iter().collect();
            // The worker may be killed before it can remove this file.
            register_partial_file(partial.clone());
            PictureTarget::File { path: self.out_dir.join(&job.output), partial }
        };
        let flags = self.flag_table.merge(self.flags, &job.flags);
        PictureRequest { scene: job.scene.clone(), flags, target }
    }

    /// Records the result of a job.
    fn keep(&self, record: JobRecord, picture: &[u8]) -> Outcome {
        self.progress.count_record(&record);
        if record.status == DONE {
            if let Some(tar) = self.tar {
                return Ok(tar.add_sample(record, picture, self.report)?);
            }
        } else {
            let mut failures = self.failures.lock().unwrap_or_else(PoisonError::into_inner);
            failures.add(&record);
        }
        Ok(self.report.append_record(&record)?)
    }
}

/// Creates the record for an answer.
///
/// # Errors
/// Returns an error if the output folder cannot be written, which is not the job's fault.
fn answered_record(job: &BatchJob, key: String, answer: WorkAnswer) -> Result<JobRecord, RunStop> {
    match answer {
        WorkAnswer::Done { seconds, warnings, message, bytes, sha256 } => Ok(JobRecord {
            input: job.input.to_string_lossy().into_owned(),
            output: job.output.clone(),
            status: DONE.to_owned(),
            key,
            seconds,
            warnings,
            message,
            bytes,
            sha256,
            tar: None,
        }),
        WorkAnswer::Failed { seconds, message } => {
            let message = match &job.line {
                Some(line) => format!("{line}: {message}"),
                None => message,
            };
            Ok(failed_record(job, key, seconds, message))
        }
        WorkAnswer::Stopped { message } => Err(BatchError::Unusable(message).into()),
    }
}
