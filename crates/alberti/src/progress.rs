//! Progress on a terminal: what is being done, once it takes longer than a moment. Silent in a pipe.

use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How long work may take before anything is said.
const DISPLAY_DELAY: Duration = Duration::from_millis(400);
/// How often the time is told.
const REFRESH_INTERVAL: Duration = Duration::from_millis(100);

/// A line on the terminal that says what is being done and since when; it is gone when the work is.
#[derive(Debug)]
pub(crate) struct Progress {
    stages: Option<(Sender<&'static str>, JoinHandle<()>)>,
}

impl Progress {
    /// Starts to watch the work, if there is a terminal to show it on.
    pub(crate) fn start(stage: &'static str) -> Self {
        if !std::io::stderr().is_terminal() {
            return Self { stages: None };
        }
        let (sender, receiver) = channel();
        let watcher = std::thread::spawn(move || {
            let (mut stage, begin) = (stage, Instant::now());
            loop {
                match receiver.recv_timeout(REFRESH_INTERVAL) {
                    Ok(next) => stage = next,
                    Err(RecvTimeoutError::Timeout) if begin.elapsed() > DISPLAY_DELAY => {
                        let seconds = begin.elapsed().as_secs_f32();
                        let _ = write!(std::io::stderr(), "\r\x1b[K{stage} … {seconds:.1} s");
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => break,
                }
            }
            if begin.elapsed() > DISPLAY_DELAY {
                let _ = write!(std::io::stderr(), "\r\x1b[K");
            }
        });
        Self { stages: Some((sender, watcher)) }
    }

    /// The work has come to another stage.
    pub(crate) fn enter_stage(&self, stage: &'static str) {
        if let Some((sender, _)) = &self.stages {
            let _ = sender.send(stage);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((sender, watcher)) = self.stages.take() {
            drop(sender);
            let _ = watcher.join();
        }
    }
}

/// How many of many jobs are done, and how long the rest may take.
#[derive(Debug)]
pub(crate) struct ProgressCounter {
    total: usize,
    done: AtomicUsize,
    begin: Instant,
    is_visible: bool,
}

impl ProgressCounter {
    /// Starts to count, aloud if there is a terminal.
    pub(crate) fn start(total: usize) -> Self {
        let is_visible = std::io::stderr().is_terminal();
        Self { total, done: AtomicUsize::new(0), begin: Instant::now(), is_visible }
    }

    /// One more is done.
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
