//! Monitors: progress of long work, and its end before the time.

use std::fmt::Debug;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// An observer of long work: it is told how far the work is, and may ask for its end.
///
/// Both methods are called from any thread that works, often, so that they should be quick. An
/// [`AtomicBool`] is a monitor that asks for the end once it is true.
///
/// ```
/// use raster::Monitor;
/// use std::sync::atomic::{AtomicU64, Ordering};
///
/// /// Shows the percentage, and never ends anything.
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
    /// Whether the work shall end early. Its result is then incomplete.
    fn is_canceled(&self) -> bool {
        false
    }

    /// Takes note that `done` of `total` equal parts of the work are done; `total` is not 0. Calls
    /// of several threads may arrive out of order.
    fn report_progress(&self, done: u64, total: u64) {
        let _ = (done, total);
    }
}

impl Monitor for AtomicBool {
    /// The load is relaxed: nothing else is ordered by the flag, and a late look costs little.
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

/// The threads of a piece of work and its monitor, if there is one: a number of threads is enough
/// where this is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Workers<'a> {
    /// The most threads to use, at least 1. Results do not depend on their number.
    pub threads: usize,
    /// Who is told, and may end the work.
    pub monitor: Option<&'a dyn Monitor>,
}

impl<'a> Workers<'a> {
    /// So many threads, observed by a monitor.
    #[must_use]
    pub const fn monitored(threads: usize, monitor: &'a dyn Monitor) -> Self {
        Self { threads, monitor: Some(monitor) }
    }

    /// Whether the work shall end early.
    #[must_use]
    pub fn is_canceled(&self) -> bool {
        self.monitor.is_some_and(Monitor::is_canceled)
    }

    /// Reports that `done` of `total` parts are done.
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
