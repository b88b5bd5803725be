//! Data-parallel loops over scoped threads.
//!
//! Threads are started for each loop and end with it. Starting one takes some 30 µs; loops that are
//! given more than one thread run for milliseconds. In return there is no pool that outlives the
//! frame, and no dependency.

use std::sync::{Mutex, PoisonError};

/// Calls `work` with each item, on up to `threads` threads (one at least).
///
/// Each thread takes the next item when it has finished one, so that items of uneven cost are
/// balanced. The order in which items finish is not defined: `work` should write to places of its
/// own only.
pub fn for_each_parallel<T, I>(threads: usize, items: I, work: impl Fn(T) + Sync)
where
    T: Send,
    I: ExactSizeIterator<Item = T> + Send,
{
    let mut nothing = vec![(); threads.max(1)];
    for_each_with_workers(&mut nothing, items, |(), item| work(item));
}

/// Calls `work` with each item and the state of the thread that takes it.
///
/// There is one thread for each of the `workers`, but no more than there are items. The calling
/// thread is the first of them: with a single worker no thread is started.
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
    // WebAssembly has no threads: their code would be dead weight.
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
