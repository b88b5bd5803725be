//! Work shared among threads.
//!
//! Threads are started for each piece of work and end with it: that takes some 30 µs a thread, where a frame worth more than one
//! takes milliseconds, and needs neither a pool that outlives the frame nor a dependency.

use std::sync::{Mutex, PoisonError};

/// Does the work for each item, by up to so many threads, each of which takes the next item when it is done with one: as frames
/// are drawn, for whoever prepares or finishes them.
pub fn for_each_parallel<T, I>(threads: usize, items: I, work: impl Fn(T) + Sync)
where
    T: Send,
    I: ExactSizeIterator<Item = T> + Send,
{
    let mut nothing = vec![(); threads.max(1)];
    for_each_with_workers(&mut nothing, items, |(), item| work(item));
}

/// As [`for_each_parallel`], by up to a thread for each of the workers (one at least), which keep what they need from item to item.
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
    if others.is_empty() {
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
