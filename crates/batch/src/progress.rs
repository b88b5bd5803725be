//! Batch progress: a status line on a terminal, one line per minute in a log, and the `--metrics`
//! file.
//!
//! ```text
//! 1204 jobs, 58.3/s, 2 failed, 12 min left
//! ```
//! One thread writes all three, because a job may take minutes during which nothing is counted.

use super::metrics::{MetricsFile, RunCounts};
use super::report::JobRecord;
use crate::BatchError;
use std::fmt::Write as _;
use std::io::Write;
use std::path::Path;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// The interval between two updates on a terminal.
const TERMINAL_INTERVAL: Duration = Duration::from_millis(250);
/// The interval between two lines of a log.
const LOG_INTERVAL: Duration = Duration::from_mins(1);
/// The interval between two updates of the `--metrics` file.
const METRICS_INTERVAL: Duration = Duration::from_secs(1);

/// The destination of the progress display.
pub struct ProgressDisplay {
    /// The stream, such as the standard error stream.
    pub stream: Box<dyn Write + Send>,
    /// Whether the stream is a terminal, where one line is rewritten; a log gets one line per
    /// minute.
    pub is_terminal: bool,
}

impl std::fmt::Debug for ProgressDisplay {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ProgressDisplay")
            .field("is_terminal", &self.is_terminal)
            .finish_non_exhaustive()
    }
}

/// Counts the jobs of a run and shows its progress; the threads share one instance.
///
/// Finish it before printing messages, which would otherwise be appended to the line.
pub(super) struct RunProgress {
    state: Arc<Mutex<ProgressState>>,
    begin: Instant,
    /// The `--metrics` file.
    metrics: Option<Arc<MetricsFile>>,
    /// The thread that writes, and the channel that ends it.
    display: Option<(Sender<()>, JoinHandle<()>)>,
}

/// The counts of the run.
#[derive(Clone, Copy, Default)]
struct ProgressState {
    counts: RunCounts,
    /// The fraction of the inputs read so far, from 0 to 1; unknown for a pipe.
    fraction: Option<f64>,
}

impl RunProgress {
    /// Starts counting and starts the display thread.
    ///
    /// # Errors
    /// Returns an error before any work is done if the `--metrics` file cannot be written.
    pub(super) fn start(
        metrics: Option<&Path>,
        display: ProgressDisplay,
    ) -> Result<Self, BatchError> {
        let metrics = metrics.map(|path| Arc::new(MetricsFile::new(path)));
        if let Some(file) = &metrics {
            file.write_counts(RunCounts::default(), 0.0)?;
        }
        let (state, begin) = (Arc::new(Mutex::default()), Instant::now());
        let display = DisplayLoop {
            state: Arc::clone(&state),
            begin,
            metrics: metrics.clone(),
            shown: display,
        };
        let (sender, receiver) = channel();
        let thread = std::thread::Builder::new().name("progress".to_owned());
        let thread = thread.spawn(move || display.run(|time| receiver.recv_timeout(time)));
        // Without a thread nothing is shown, but the run continues.
        let display = thread.ok().map(|thread| (sender, thread));
        Ok(Self { state, begin, metrics, display })
    }

    /// Sets the fraction of the inputs read so far, from 0 to 1.
    pub(super) fn set_fraction(&self, fraction: f64) {
        lock(&self.state).fraction = Some(fraction.clamp(0.0, 1.0));
    }

    /// Counts a job of this run.
    pub(super) fn count_record(&self, record: &JobRecord) {
        lock(&self.state).counts.count_record(record);
    }

    /// Counts a job of an earlier run.
    pub(super) fn count_earlier(&self, failed: bool) {
        let counts = &mut lock(&self.state).counts;
        *(if failed { &mut counts.failed_before } else { &mut counts.up_to_date }) += 1;
    }

    /// Counts a worker that was replaced.
    pub(super) fn count_restart(&self) {
        lock(&self.state).counts.restarts += 1;
    }

    /// Removes the line from the terminal and writes the metrics one last time.
    ///
    /// # Errors
    /// Returns an error if the `--metrics` file cannot be written.
    pub(super) fn finish(mut self) -> Result<RunCounts, BatchError> {
        self.end_display();
        let counts = lock(&self.state).counts;
        if let Some(file) = &self.metrics {
            file.write_counts(counts, self.begin.elapsed().as_secs_f64())?;
        }
        Ok(counts)
    }

    fn end_display(&mut self) {
        if let Some((sender, thread)) = self.display.take() {
            drop(sender);
            let _ = thread.join();
        }
    }
}

/// Removes the line from the terminal even if the run ends early.
impl Drop for RunProgress {
    fn drop(&mut self) {
        self.end_display();
    }
}

/// Locks the state, whose numbers stay valid even if another thread panicked.
fn lock(state: &Mutex<ProgressState>) -> MutexGuard<'_, ProgressState> {
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The thread that shows the progress.
struct DisplayLoop {
    state: Arc<Mutex<ProgressState>>,
    begin: Instant,
    metrics: Option<Arc<MetricsFile>>,
    shown: ProgressDisplay,
}

impl DisplayLoop {
    /// Writes until the channel is closed.
    ///
    /// Errors are ignored here: a display that cannot be drawn should not stop the run, and metrics
    /// that cannot be written are an error at the end.
    fn run(mut self, wait: impl Fn(Duration) -> Result<(), RecvTimeoutError>) {
        let is_terminal = self.shown.is_terminal;
        let interval = if is_terminal { TERMINAL_INTERVAL } else { METRICS_INTERVAL };
        let interval = if is_terminal || self.metrics.is_some() { interval } else { LOG_INTERVAL };
        let (mut rate, mut logged, mut measured) = (JobRate::default(), self.begin, self.begin);
        while wait(interval) == Err(RecvTimeoutError::Timeout) {
            let (state, elapsed) = (*lock(&self.state), self.begin.elapsed().as_secs_f64());
            if let Some(file) = &self.metrics
                && measured.elapsed() >= METRICS_INTERVAL
            {
                let _ = file.write_counts(state.counts, elapsed);
                measured = Instant::now();
            }
            if is_terminal {
                let line = progress_line(&state, &mut rate, elapsed);
                // Returns to the start of the line and clears it.
                let _ = write!(self.shown.stream, "\r\x1b[K{line}");
            } else if logged.elapsed() >= LOG_INTERVAL {
                let line = progress_line(&state, &mut rate, elapsed);
                let _ = writeln!(self.shown.stream, "{line}");
                logged = Instant::now();
            }
        }
        if is_terminal {
            let _ = write!(self.shown.stream, "\r\x1b[K");
        }
    }
}

/// The number of jobs per second over the last one or two minutes.
///
/// The period is short so that a large first model does not dominate the rate for long. Jobs that
/// were up to date do not count.
#[derive(Default)]
struct JobRate {
    /// For each of the last two marks, the time in seconds and the number of jobs run until then.
    marks: [(f64, u64); 2],
}

impl JobRate {
    /// The time between two marks in seconds.
    const MARK_SECONDS: f64 = 60.0;

    /// Returns the current rate, or `None` if nothing is done yet.
    fn measure(&mut self, elapsed: f64, worked: u64) -> Option<f64> {
        if elapsed - self.marks[1].0 >= Self::MARK_SECONDS {
            self.marks = [self.marks[1], (elapsed, worked)];
        }
        let (since, before) = self.marks[0];
        let (jobs, seconds) = (worked.saturating_sub(before), elapsed - since);
        (jobs > 0 && seconds > 0.0).then(|| jobs as f64 / seconds)
    }
}

/// Returns the progress line; `elapsed` is the time since the start of the run, in seconds.
///
/// The remaining time follows from the fraction of the inputs read so far. All remaining jobs count
/// as jobs to render, though some may turn out to be up to date.
fn progress_line(state: &ProgressState, rate: &mut JobRate, elapsed: f64) -> String {
    let ProgressState { counts, fraction } = state;
    let mut line = format!("{} jobs", counts.settled());
    let rate = rate.measure(elapsed, counts.worked());
    if let Some(rate) = rate {
        let _ = write!(line, ", {rate:.1}/s");
    }
    let failed = counts.failed + counts.failed_before;
    if failed > 0 {
        let _ = write!(line, ", {failed} failed");
    }
    if let (Some(rate), Some(fraction)) = (rate, fraction.filter(|fraction| *fraction > 0.0)) {
        let total = counts.settled() as f64 / fraction;
        let left = (total - counts.settled() as f64) / rate;
        let _ = write!(line, ", {} left", duration_words(left));
    }
    line
}

/// Returns a duration in words, from seconds to days.
fn duration_words(seconds: f64) -> String {
    match seconds {
        s if s < 100.0 => format!("{s:.0} s"),
        s if s < 6000.0 => format!("{:.0} min", s / 60.0),
        s if s < 360_000.0 => format!("{:.1} h", s / 3600.0),
        s => format!("{:.1} days", s / 86_400.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_records::{ReportFolder, done_record, failed_record};

    #[test]
    fn the_line_shows_count_rate_failures_and_remaining_time() {
        let counts =
            RunCounts { rendered: 90, failed: 10, up_to_date: 100, ..RunCounts::default() };
        let mut state = ProgressState { counts, fraction: Some(0.25) };
        // 200 of 800 jobs; 100 of them took 20 s.
        let line = progress_line(&state, &mut JobRate::default(), 20.0);
        assert_eq!(line, "200 jobs, 5.0/s, 10 failed, 2 min left");
        state.fraction = None;
        let line = progress_line(&state, &mut JobRate::default(), 20.0);
        assert_eq!(line, "200 jobs, 5.0/s, 10 failed");
        let line = progress_line(&ProgressState::default(), &mut JobRate::default(), 20.0);
        assert_eq!(line, "0 jobs");
    }

    #[test]
    fn the_rate_covers_only_the_last_two_minutes() {
        let mut rate = JobRate::default();
        // One job per second for 5 minutes, then ten per second.
        for second in 1..=300_u32 {
            rate.measure(f64::from(second), second.into());
        }
        let mut last = None;
        for second in 301..=480_u32 {
            last = rate.measure(f64::from(second), (300 + (second - 300) * 10).into());
        }
        assert_eq!(last, Some(10.0));
    }

    #[test]
    fn durations_use_a_suitable_unit() {
        let words = [0.4, 99.0, 100.0, 7200.0, 400_000.0].map(duration_words);
        assert_eq!(words, ["0 s", "99 s", "2 min", "2.0 h", "4.6 days"]);
    }

    fn nowhere() -> ProgressDisplay {
        ProgressDisplay { stream: Box::new(std::io::sink()), is_terminal: false }
    }

    #[test]
    fn jobs_are_counted_and_written_at_the_end() {
        let folder = ReportFolder::new("progress");
        let path = folder.path().join("batch.prom");
        let progress = RunProgress::start(Some(&path), nowhere()).unwrap();
        progress.set_fraction(0.5);
        progress.count_record(&done_record("a.png", "k"));
        progress.count_record(&failed_record("b.png", "k"));
        [true, false, false].into_iter().for_each(|failed| progress.count_earlier(failed));
        progress.count_restart();
        let counts = progress.finish().unwrap();
        assert_eq!((counts.rendered, counts.failed, counts.restarts), (1, 1, 1));
        assert_eq!((counts.up_to_date, counts.failed_before), (2, 1));
        assert!(folder.read_text("batch.prom").contains("{status=\"rendered\"} 1\n"));
        let path = folder.path().join("no/batch.prom");
        assert!(RunProgress::start(Some(&path), nowhere()).is_err());
    }
}
