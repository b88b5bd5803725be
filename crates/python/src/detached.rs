//! Runs work without Python's lock: other Python threads continue, Ctrl+C cancels a picture, and a
//! panic becomes an exception.
//!
//! ```text
//!  calling thread   waits and checks for signals 20 times a second ─► CancelToken
//!  worker           renders ────────────────────────────────────────────┘
//! ```
//! Python delivers signals only to its main thread, and only while that thread holds the lock, so a
//! worker does the rendering. Work of a few milliseconds stays in the calling thread, because a new
//! thread would take a good part of that time.

use crate::failure::Failure;
use pipeline::CancelToken;
use pyo3::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread::{self, Builder};
use std::time::Duration;

/// The maximum delay before Ctrl+C takes effect.
const SIGNAL_INTERVAL: Duration = Duration::from_millis(50);
/// The stack size of a worker in bytes, the same as for the main thread of a program.
const STACK_BYTES: usize = 8 << 20;

/// Runs `work` of a few milliseconds in this thread, without the lock.
///
/// # Errors
/// Returns the error that `work` returns, or an error for a panic.
pub(crate) fn run_briefly<T, E>(
    py: Python<'_>,
    work: impl FnOnce(&CancelToken) -> Result<T, E> + Send,
) -> PyResult<T>
where
    T: Send,
    E: Into<PyErr> + Send,
{
    // After a panic, `work` and what it borrows are not used again.
    let work = AssertUnwindSafe(work);
    match py.detach(|| catch_unwind(|| { work }.0(&CancelToken::default()))) {
        Ok(result) => result.map_err(Into::into),
        Err(panic) => Err(Failure::internal(&*panic).into()),
    }
}

/// Runs `work` in another thread without the lock, and waits for it.
///
/// # Errors
/// Returns the exception of a signal handler (`KeyboardInterrupt`) after `work` has ended, the
/// error that `work` returns, or an error for a panic.
pub(crate) fn run_detached<T, E>(
    py: Python<'_>,
    work: impl FnOnce(&CancelToken) -> Result<T, E> + Send,
) -> PyResult<T>
where
    T: Send,
    E: Into<PyErr> + Send,
{
    let cancel = CancelToken::default();
    let (result, interruption) = py.detach(|| {
        thread::scope(|scope| {
            let (done, finished) = mpsc::channel::<()>();
            let token = &cancel;
            let worker = Builder::new().stack_size(STACK_BYTES).spawn_scoped(scope, move || {
                // Dropping this at the end, even after a panic, wakes the receiver.
                let _done = done;
                work(token)
            });
            let worker = match worker {
                Ok(worker) => worker,
                Err(cause) => {
                    let message = format!("cannot start a thread: {cause}");
                    return (Ok(Err(Failure::argument("threads", message).into())), None);
                }
            };
            let mut interruption = None;
            while finished.recv_timeout(SIGNAL_INTERVAL) == Err(RecvTimeoutError::Timeout) {
                if interruption.is_none()
                    && let Err(raised) = Python::attach(|py| py.check_signals())
                {
                    cancel.cancel();
                    interruption = Some(raised);
                }
            }
            (worker.join().map(|result| result.map_err(Into::into)), interruption)
        })
    });
    match (interruption, result) {
        (Some(raised), _) => Err(raised),
        (None, Ok(result)) => result,
        (None, Err(panic)) => Err(Failure::internal(&*panic).into()),
    }
}
