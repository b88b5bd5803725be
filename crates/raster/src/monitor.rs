//! Monitors: progress reports and cancellation for long-running work.

use std::fmt::Debug;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// An observer of long-running work: it receives progress reports and may request cancellation.
///
/// Both methods are called often, from any worker thread, and should return quickly. An
/// [`AtomicBool`] is a monitor that requests cancellation once it is true.
///
/// ```
/// use raster::Monitor;
/// use std::sync::atomic::{AtomicU64, Ordering};
///
/// /// Prints the percentage and never cancels.
/// #[derive(Debug, Default)]
/// struct Percentage(AtomicU64);
///
/// impl Monitor for Percentage {
///     fn report_progress(&self, done: u64, total: u64) {
///         self.0.fetch_max(100 * done / total, Ordering::Relaxed);
///     }
/// }
/// ```
pub trait Monitor: Debug + Send + Sync {
    /// Returns whether the work should stop early. The result is then incomplete.
    fn is_canceled(&self) -> bool {
        false
    }

    /// Reports that `done` of `total` equal parts of the work are complete; `total` is never 0.
    /// Calls from several threads may arrive out of order.
    fn report_progress(&self, done: u64, total: u64) {
        let _ = (done, total);
    }
}

impl Monitor for AtomicBool {
    /// Loads the flag with relaxed ordering: it guards no other data, and noticing it late costs
    /// little.
    fn is_canceled(&self) -> bool {
        self.load(Ordering::Relaxed)
    }
}

impl<M: Monitor + ?Sized> Monitor for Arc<M> {
    fn is_canceled(&self) -> bool {
        (**self).is_canceled()
    }

    fn report_progress(&self, done: u64, total: u64) {
        (**self).report_progress(done, total);
    }
}

/// The number of threads for a piece of work, with an optional monitor. Functions that accept this
/// type also accept a plain number of threads.
#[derive(Clone, Copy, Debug)]
pub struct Workers<'a> {
    /// The maximum number of threads, at least 1. Results do not depend on it.
    pub threads: usize,
    /// The monitor, which is notified and may cancel the work.
    pub monitor: Option<&'a dyn Monitor>,
}

impl<'a> Workers<'a> {
    /// Combines a number of threads with a monitor.
    #[must_use]
    pub const fn monitored(threads: usize, monitor: &'a dyn Monitor) -> Self {
        Self { threads, monitor: Some(monitor) }
    }

    /// Returns whether the work should stop early.
    #[must_use]
    pub fn is_canceled(&self) -> bool {
        self.monitor.is_some_and(Monitor::is_canceled)
    }

    /// Reports that `done` of `total` parts are complete.
    pub fn report_progress(&self, done: u64, total: u64) {
        if let Some(monitor) = self.monitor {
            monitor.report_progress(done, total.max(1));
        }
    }
}

impl From<usize> for Workers<'_> {
    fn from(threads: usize) -> Self {
        Self { threads, monitor: None }
    }
}
