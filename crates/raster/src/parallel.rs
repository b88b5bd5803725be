//! Data-parallel loops over scoped threads.
//!
//! Threads are started for each loop and end with it. Starting a thread takes about 30 µs, while
//! loops with more than one thread run for milliseconds. In return, no thread pool outlives the
//! frame, and no dependency is needed.

use std::sync::{Mutex, PoisonError};

/// Calls `work` with each item, on up to `threads` threads (at least one).
///
/// Each thread takes the next item when it finishes one, which balances items of uneven cost. The
/// order in which items finish is not defined: each call of `work` should write only to its own
/// memory.
pub fn for_each_parallel<T, I>(threads: usize, items: I, work: impl Fn(T) + Sync)
where
    T: Send,
    I: ExactSizeIterator<Item = T> + Send,
{
    let mut nothing = vec![(); threads.max(1)];
    for_each_with_workers(&mut nothing, items, |(), item| work(item));
}

/// Calls `work` with each item and the state of the thread that processes it.
///
/// There is one thread per worker, but at most one per item. The calling thread is the first of
/// them; a single worker starts no thread.
pub(crate) fn for_each_with_workers<W, T, I>(
    workers: &mut [W],
    items: I,
    work: impl Fn(&mut W, T) + Sync,
) where
    W: Send,
    T: Send,
    I: ExactSizeIterator<Item = T> + Send,
{
    let count = workers.len().min(items.len()).max(1);
    let Some((first, others)) = workers[..count].split_first_mut() else { return };
    let items = Mutex::new(items);
    let next = || items.lock().unwrap_or_else(PoisonError::into_inner).next();
    let run = |worker: &mut W| {
        while let Some(item) = next() {
            work(worker, item);
        }
    };
    // WebAssembly has no threads here, so code for them would be dead weight.
    if others.is_empty() || cfg!(target_family = "wasm") {
        return run(first);
    }
    let run = &run;
    std::thread::scope(|scope| {
        for worker in others {
            scope.spawn(move || run(worker));
        }
        run(first);
    });
}
