//! Limits of a thumbnail: time by a cancelled rendering and the end of the process, memory by the
//! limits of the importer and of the system.

use crate::CliError;
use crate::messages::print_message;
use model::Limits;
use pipeline::CancelToken;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Time for the rendering to end by itself after it was cancelled.
const GRACE: Duration = Duration::from_millis(250);

/// A time limit: a thread that cancels the rendering, and then ends the process.
///
/// Decoders, the assembly of meshes and line drawings cannot be cancelled, so that the process has
/// to end under them. It holds nothing that would have to be put in order: the only file is written
/// at the very end, when the limit is no longer in force.
pub(super) struct Deadline {
    /// Cancelled when the time is over.
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

    /// The token that is cancelled when the time is over.
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
#[expect(clippy::exit, reason = "decoders cannot be cancelled")]
fn end_process(seconds: u32) {
    print_message("error", &timeout(seconds).to_message());
    std::process::exit(1);
}

/// The limits of the importer for a program of this much memory.
///
/// | part | what it is for |
/// | --- | --- |
/// | 1/4 | files, as they are |
/// | 1/2 | arrays: vertices, indices, what 3MF archives hold |
/// | 1/3 | texels of 4 bytes; their mip levels, at a third more, take the next 1/9 |
///
/// The numbers of nodes, JSON values and triangles follow by what one of each takes at most:
/// 2,048, 256 and 64 bytes. All together are more than the whole, as no model needs the most of
/// everything; one that is made to is stopped by the system.
pub(super) fn import_limits(memory: u64) -> Limits {
    let usual = Limits::default();
    let count = |usual: usize, bytes: u64| {
        usize::try_from(memory / bytes).map_or(usual, |most| usual.min(most))
    };
    Limits {
        file_bytes: usual.file_bytes.min(memory / 4),
        total_bytes: usual.total_bytes.min(memory / 4),
        array_bytes: usual.array_bytes.min(memory / 2),
        image_texels: usual.image_texels.min(memory / 12),
        json_values: count(usual.json_values, 256),
        nodes: count(usual.nodes, 2_048),
        scene_items: usual.scene_items.min(memory / 64),
        ..usual
    }
}

/// Holds the process to this much memory of its own (heap, stacks; not the program itself): what
/// asks for more is ended by an abort.
#[cfg(target_os = "linux")]
pub(super) fn limit_process_memory(memory: u64) {
    use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
    let maximum = getrlimit(Resource::Data).maximum;
    let current = Some(maximum.map_or(memory, |most| most.min(memory)));
    // Where it is forbidden, the limits of the importer hold all the same.
    let _ = setrlimit(Resource::Data, Rlimit { current, maximum });
}

/// Other systems have no such limit: that of the importer has to do.
#[cfg(not(target_os = "linux"))]
pub(super) fn limit_process_memory(_memory: u64) {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_shrink_with_the_memory_and_never_exceed_the_usual_ones() {
        let usual = Limits::default();
        assert_eq!(import_limits(u64::MAX), usual);
        let small = import_limits(64 << 20);
        assert_eq!((small.file_bytes, small.array_bytes), (16 << 20, 32 << 20));
        assert_eq!((small.json_values, small.nodes), (1 << 18, 1 << 15));
        assert_eq!(small.image_side, usual.image_side);
        assert!(small.total_bytes + small.array_bytes < 64 << 20);
    }
}
