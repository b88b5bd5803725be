//! Records of failed jobs, and the reasons why runs end early.

use super::job::BatchJob;
use super::pool::JobPolicy;
use super::report::{FAILED, JobRecord};
use super::worker_process::WorkerEnd;
use crate::BatchError;
use files::visible_text;

/// The outcome of a step of a run.
pub(super) type Outcome = Result<(), RunStop>;

/// The reason why a run ends before all jobs are done.
#[derive(Debug)]
pub(super) enum RunStop {
    /// An error outside the jobs: a list cannot be read, or the output folder cannot be written.
    Fault(BatchError),
    /// This signal interrupted a worker and the run with it.
    Signal(i32),
}

impl From<BatchError> for RunStop {
    fn from(error: BatchError) -> Self {
        Self::Fault(error)
    }
}

/// The maximum number of failures printed at the end of a run; the report lists them all.
const MAX_TOLD: usize = 20;

/// The failures that are printed at the end of a run: the first few by picture name.
#[derive(Debug, Default)]
pub(super) struct FailureList {
    /// The picture name and the message; sorted.
    first: Vec<(String, String)>,
    /// The total number.
    count: usize,
}

impl FailureList {
    /// Adds a failure.
    pub(super) fn add(&mut self, record: &JobRecord) {
        self.count += 1;
        let at = self.first.partition_point(|(output, _)| *output < record.output);
        // The message for an invalid line names the line, and the message for a model often names
        // its file.
        let name = format!("{}: ", visible_text(&record.input));
        let text = if record.input.is_empty() || record.message.starts_with(&name) {
            record.message.clone()
        } else {
            format!("{name}{}", record.message)
        };
        self.first.insert(at, (record.output.clone(), text));
        self.first.truncate(MAX_TOLD);
    }

    /// Passes the failures to `tell`, one by one:
    ///
    /// ```text
    /// failed: models/broken.glb: …
    /// failed: 17 more; see the report
    /// ```
    pub(super) fn tell(&self, mut tell: impl FnMut(&str)) {
        for (_, text) in &self.first {
            tell(text);
        }
        let rest = self.count - self.first.len();
        if rest > 0 {
            tell(&format!("{rest} more; see the report"));
        }
    }
}

/// Returns the record of a job that failed.
pub(super) fn failed_record(
    job: &BatchJob,
    key: String,
    seconds: f64,
    message: String,
) -> JobRecord {
    JobRecord {
        input: job.input.to_string_lossy().into_owned(),
        output: job.output.clone(),
        status: FAILED.to_owned(),
        key,
        seconds,
        warnings: 0,
        message,
        bytes: 0,
        sha256: String::new(),
        tar: None,
    }
}

/// Signals by number; the numbers are the same on all systems that have them.
const SIGNALS: [(i32, &str); 9] = [
    (1, "SIGHUP"),
    (2, "SIGINT"),
    (4, "SIGILL"),
    (6, "SIGABRT"),
    (8, "SIGFPE"),
    (9, "SIGKILL"),
    (11, "SIGSEGV"),
    (13, "SIGPIPE"),
    (15, "SIGTERM"),
];

impl WorkerEnd {
    /// Returns the signal, if it requests termination and says nothing about the job.
    pub(super) fn interruption(&self) -> Option<i32> {
        match self {
            Self::Signal(signal @ (1 | 2 | 15)) => Some(*signal),
            _ => None,
        }
    }

    /// Returns whether the worker was killed, either by a system that is out of memory or by
    /// someone who kills all processes.
    pub(super) fn is_killed(&self) -> bool {
        *self == Self::Signal(9)
    }
}

/// Returns the message for a job whose worker ended: the reason, and the end of its standard error
/// output.
pub(super) fn worker_end_message(end: &WorkerEnd, text: &str, policy: JobPolicy) -> String {
    let what = match end {
        WorkerEnd::TimedOut => {
            let seconds = policy.limit.unwrap_or_default().as_secs();
            return format!("timed out after {seconds} s\n  = help: raise --job-seconds");
        }
        WorkerEnd::Signal(9) => {
            "the worker was killed twice (SIGKILL), probably because the system was out of memory"
                .to_owned()
        }
        WorkerEnd::Signal(signal) => {
            let name = SIGNALS.iter().find(|(number, _)| number == signal);
            let name =
                name.map_or_else(|| format!("signal {signal}"), |(_, name)| (*name).to_owned());
            format!("the worker crashed ({name})")
        }
        WorkerEnd::Exit(code) => {
            let code = code.map_or_else(|| "none".to_owned(), |code| code.to_string());
            format!("the worker exited without an answer (exit code {code})")
        }
    };
    // Rust's allocator prints this before it aborts.
    if text.contains("memory allocation of") {
        return format!("the worker ran out of memory: {text}\n  = help: raise --job-memory");
    }
    if text.is_empty() { what } else { format!("{what}: {text}") }
}
