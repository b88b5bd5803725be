//! Parallel map over index ranges, with results in index order.
//!
//! ```text
//!   next ──► 0..512    thread A ─► results   ╮
//!            512..1024 thread B ─► results   ├─ sorted by start, concatenated
//!            …                               ╯
//! ```
//!
//! Threads take chunks from an atomic counter, which balances uneven work. Results are then sorted
//! by the start of their chunk, so they do not depend on the number of threads or on timing.

use raster::Workers;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The number of items that a thread takes at a time: enough to avoid contention on the counter.
const CHUNK_SIZE: usize = 512;

/// Processes `count` items with several workers, and concatenates the pushed results in the order
/// of the items.
///
/// Each thread has its own scratch memory `M`, created when it starts. The calling thread also
/// works, so a thread count of 1 spawns no thread; 0 counts as 1. On cancellation, each thread
/// stops after its current chunk, and the result is incomplete. A panic in `work` is resumed in the
/// caller.
pub(super) fn map_in_order<M: Default, T: Send>(
    count: usize,
    workers: Workers<'_>,
    work: impl Fn(Range<usize>, &mut M, &mut Vec<T>) + Sync,
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let take = || {
        let (mut memory, mut done) = (M::default(), Vec::new());
        loop {
            let start = next.fetch_add(CHUNK_SIZE, Ordering::Relaxed);
            if start >= count || workers.is_canceled() {
                return done;
            }
            let mut results = Vec::new();
            work(start..count.min(start + CHUNK_SIZE), &mut memory, &mut results);
            done.push((start, results));
        }
    };
    let threads = workers.threads.min(count.div_ceil(CHUNK_SIZE));
    // WebAssembly has no threads, so the code to spawn them would be dead weight.
    if threads <= 1 || cfg!(target_family = "wasm") {
        return take().into_iter().flat_map(|(_, results)| results).collect();
    }
    let mut done: Vec<(usize, Vec<T>)> = std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map(|_| scope.spawn(take)).collect();
        let mut done = take();
        for other in others {
            match other.join() {
                Ok(results) => done.extend(results),
                Err(cause) => std::panic::resume_unwind(cause),
            }
        }
        done
    });
    done.sort_unstable_by_key(|(start, _)| *start);
    done.into_iter().flat_map(|(_, results)| results).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_number_of_threads_gives_the_same_order() {
        let count = 3 * CHUNK_SIZE + 7;
        for threads in [0, 1, 2, 5, 64] {
            let work = |range: Range<usize>, (): &mut (), out: &mut Vec<usize>| out.extend(range);
            assert!(map_in_order(count, threads.into(), work).into_iter().eq(0..count));
        }
        assert!(map_in_order(0, 4.into(), |_, (): &mut (), _: &mut Vec<()>| panic!()).is_empty());
    }
}
