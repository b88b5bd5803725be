//! Progress display on a terminal: current stage and elapsed time, or jobs done and remaining.
//!
//! It is shown only if the standard error stream is a terminal, and only for work that takes longer
//! than [`DISPLAY_DELAY`].
//!
//! The line is redrawn in place: `\r` returns to its first column and `\x1b[K` erases it. Stream
//! errors are ignored, because a display that cannot be drawn should not make a run fail. Drop the
//! display before printing a message, which would otherwise be appended to the line.

use pipeline::Monitor;
use std::fmt::{Display, Formatter};
use std::io::{IsTerminal, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Work that finishes within this time shows no progress.
///
/// Most renderings finish sooner, and a line that only flashes is distracting.
const DISPLAY_DELAY: Duration = Duration::from_millis(400);
/// The interval between two updates of the elapsed time.
const REFRESH_INTERVAL: Duration = Duration::from_millis(100);

/// A terminal line with the current stage, its percentage and the elapsed time, removed on drop.
#[derive(Debug)]
pub(crate) struct Progress {
    /// The channel to the thread that draws the line, and its handle; `None` without a terminal.
    stages: Option<(Sender<&'static str>, JoinHandle<()>)>,
    /// The completed percentage of the current stage.
    done: Arc<Percentage>,
}

/// The completed percentage of a stage; 0 if the stage does not report its progress.
#[derive(Debug, Default)]
struct Percentage(AtomicU64);

impl Monitor for Percentage {
    fn report_progress(&self, done: u64, total: u64) {
        self.0.fetch_max(done.min(total) * 100 / total, Ordering::Relaxed);
    }
}

impl Display for Percentage {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match self.0.load(Ordering::Relaxed) {
            0 | 100 => Ok(()),
            percent => write!(f, ", {percent} %"),
        }
    }
}

impl Progress {
    /// Starts the display, if the standard error stream is a terminal.
    ///
    /// Without a terminal nothing is written, so that log files stay clean.
    ///
    /// ```text
    /// rendering … 2.4 s
    /// rendering … 51.0 s, 34 %
    /// ```
    pub(crate) fn start(stage: &'static str) -> Self {
        let done = Arc::<Percentage>::default();
        if !std::io::stderr().is_terminal() {
            return Self { stages: None, done };
        }
        let (sender, receiver) = channel();
        let percentage = Arc::clone(&done);
        let watcher = std::thread::spawn(move || {
            let (mut stage, begin) = (stage, Instant::now());
            loop {
                match receiver.recv_timeout(REFRESH_INTERVAL) {
                    Ok(next) => stage = next,
                    Err(RecvTimeoutError::Timeout) if begin.elapsed() > DISPLAY_DELAY => {
                        let line =
                            format!("{stage} … {:.1} s{percentage}", begin.elapsed().as_secs_f32());
                        let _ = write!(std::io::stderr(), "\r\x1b[K{line}");
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => break,
                }
            }
            if begin.elapsed() > DISPLAY_DELAY {
                let _ = write!(std::io::stderr(), "\r\x1b[K");
            }
        });
        Self { stages: Some((sender, watcher)), done }
    }

    /// Switches the display to another stage.
    pub(crate) fn enter_stage(&self, stage: &'static str) {
        self.done.0.store(0, Ordering::Relaxed);
        if let Some((sender, _)) = &self.stages {
            let _ = sender.send(stage);
        }
    }

    /// Returns the monitor whose progress the line shows.
    pub(crate) fn monitor(&self) -> Arc<dyn Monitor> {
        Arc::<Percentage>::clone(&self.done)
    }
}

/// Closes the channel and waits for the thread, which erases the line: after the drop the cursor is
/// at the start of an empty line.
impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((sender, watcher)) = self.stages.take() {
            drop(sender);
            let _ = watcher.join();
        }
    }
}

/// A terminal line with the number of finished jobs and an estimate of the time left.
#[derive(Debug)]
pub(crate) struct ProgressCounter {
    /// The number of jobs.
    total: usize,
    /// The number of finished jobs.
    done: AtomicUsize,
    /// The time at which counting started.
    begin: Instant,
    /// Whether the line is shown.
    is_visible: bool,
}

impl ProgressCounter {
    /// Starts counting; the line is shown if the standard error stream is a terminal.
    pub(crate) fn start(total: usize) -> Self {
        let is_visible = std::io::stderr().is_terminal();
        Self { total, done: AtomicUsize::new(0), begin: Instant::now(), is_visible }
    }

    /// Counts one finished job; can be called from any thread.
    ///
    /// The last job erases the line. Two threads may write at once. Each line is written in one
    /// call, so lines never mix; at worst, an outdated count stays until the next job finishes.
    pub(crate) fn increment(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        if !self.is_visible {
            return;
        }
        let each = self.begin.elapsed().as_secs_f64() / done as f64;
        let left = each * self.total.saturating_sub(done) as f64;
        let end = if done == self.total { "\r\x1b[K" } else { "" };
        let all = self.total;
        let _ = write!(std::io::stderr(), "\r\x1b[K{done} of {all}, {left:.0} s left{end}");
    }
}
