//! The time limit of a thumbnail: a canceled rendering, and then the end of the process.

use crate::CliError;
use crate::messages::print_message;
use pipeline::CancelToken;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Time for the rendering to end by itself after it was canceled.
const GRACE: Duration = Duration::from_millis(250);

/// A time limit: a thread that cancels the rendering, and then ends the process.
///
/// Decoders, the assembly of meshes and line drawings cannot be canceled, so that the process has
/// to end under them. It holds nothing that would have to be put in order: the only file is written
/// at the very end, when the limit is no longer in force.
pub(super) struct Deadline {
    /// Canceled when the time is over.
    cancel: CancelToken,
    /// Whether the work is done. Whoever holds the lock decides how the process ends.
    is_done: Arc<Mutex<bool>>,
}

impl Deadline {
    /// Starts the time.
    ///
    /// # Errors
    /// If there is no thread for the watch.
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
            CliError::Usage(format!("cannot start the thread of --max-seconds: {cause}"))
        })
    }

    /// The token that is canceled when the time is over.
    pub(super) const fn cancel_token(&self) -> &CancelToken {
        &self.cancel
    }

    /// Does the last of the work, which is not interrupted once it has begun: a file is written
    /// whole or not at all.
    pub(super) fn finish<T>(&self, work: impl FnOnce() -> T) -> T {
        let mut is_done = self.is_done.lock().unwrap_or_else(PoisonError::into_inner);
        *is_done = true;
        work()
    }
}

/// The error of a thumbnail that took too long.
pub(super) fn timeout(seconds: u32) -> CliError {
    CliError::Usage(format!("no picture after {seconds} s; --max-seconds allows more"))
}

/// Ends the process, whatever its other threads are doing.
#[expect(clippy::exit, reason = "decoders cannot be canceled")]
fn end_process(seconds: u32) {
    print_message("error", &timeout(seconds).to_message());
    std::process::exit(1);
}
