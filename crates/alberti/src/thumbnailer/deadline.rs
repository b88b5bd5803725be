//! The time limit for a thumbnail: cancels rendering, then ends the process.

use crate::CliError;
use crate::messages::print_message;
use pipeline::CancelToken;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// The time that a canceled rendering has to end by itself.
const GRACE: Duration = Duration::from_millis(250);

/// A time limit: a thread that cancels the rendering and then ends the process.
///
/// Decoders, mesh assembly and line drawings cannot be canceled, so the process must end while they
/// run. Nothing needs cleaning up: the only file is written at the very end, when the limit no
/// longer applies.
pub(super) struct Deadline {
    /// Canceled when time is up.
    cancel: CancelToken,
    /// Whether the work is done. The holder of the lock decides how the process ends.
    is_done: Arc<Mutex<bool>>,
}

impl Deadline {
    /// Starts the timer.
    ///
    /// # Errors
    /// Returns an error if the system cannot create the timer thread.
    pub(super) fn start(seconds: u32) -> Result<Self, CliError> {
        let deadline = Self { cancel: CancelToken::default(), is_done: Arc::default() };
        let (cancel, is_done) = (deadline.cancel.clone(), Arc::clone(&deadline.is_done));
        let watch = move || {
            std::thread::sleep(Duration::from_secs(seconds.into()));
            cancel.cancel();
            std::thread::sleep(GRACE);
            let is_done = is_done.lock().unwrap_or_else(PoisonError::into_inner);
            if !*is_done {
                end_process(seconds);
            }
        };
        let started = std::thread::Builder::new().name("deadline".to_owned()).spawn(watch);
        started.map(|_| deadline).map_err(|cause| {
            CliError::Usage(format!("cannot start the thread for --max-seconds: {cause}"))
        })
    }

    /// Returns the token that is canceled when time is up.
    pub(super) const fn cancel_token(&self) -> &CancelToken {
        &self.cancel
    }

    /// Does the final work without interruption: a file is written completely or not at all.
    pub(super) fn finish<T>(&self, work: impl FnOnce() -> T) -> T {
        let mut is_done = self.is_done.lock().unwrap_or_else(PoisonError::into_inner);
        *is_done = true;
        work()
    }
}

/// Returns the error for a thumbnail that took too long.
pub(super) fn timeout(seconds: u32) -> CliError {
    CliError::Usage(format!("timed out after {seconds} s; raise --max-seconds"))
}

/// Ends the process without waiting for its other threads.
#[expect(clippy::exit, reason = "decoders cannot be canceled")]
fn end_process(seconds: u32) {
    print_message("error", &timeout(seconds).to_message());
    std::process::exit(1);
}
