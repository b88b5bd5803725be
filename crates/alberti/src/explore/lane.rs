//! Lanes: threads that answer one query at a time. Queries from disconnected clients are canceled.
//!
//! ```text
//!  thread of a connection ─► queue ─► thread of the lane: its explorer computes
//!  waits, and checks that the client is still connected ──► CancelToken
//! ```
//! Small queries have a separate lane, so that they never wait for a large picture.

use explorer::{Answer, Explorer, ExplorerError};
use pipeline::CancelToken;
use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

/// Maximum number of queries waiting in a lane.
const MAX_WAITING: usize = 16;

/// Interval between checks that the client is still connected.
const LOOK: Duration = Duration::from_millis(50);

/// Number of times a full lane is checked before it counts as busy.
const MAX_LOOKS: u32 = 40;

/// The explorer's answer or error.
type Computed = Result<Answer, ExplorerError>;

/// A query waiting for its turn.
#[derive(Debug)]
struct Job {
    query: String,
    cancel: CancelToken,
    reply: Sender<Computed>,
}

/// The queries in a lane, oldest first.
#[derive(Debug, Default)]
struct Queue {
    jobs: Mutex<VecDeque<Job>>,
    has_job: Condvar,
}

/// A thread that answers one query at a time.
#[derive(Debug)]
pub(super) struct Lane {
    queue: Arc<Queue>,
}

/// The reason a query was not answered.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Unanswered {
    /// Too many other queries are waiting.
    Busy,
    /// The client has disconnected.
    Abandoned,
    /// The computation failed unexpectedly.
    Failed,
}

impl Lane {
    /// Starts a lane.
    ///
    /// # Errors
    /// Returns an error if the system cannot create a thread.
    pub(super) fn start(explorer: Explorer) -> std::io::Result<Self> {
        let queue = Arc::new(Queue::default());
        let own = Arc::clone(&queue);
        std::thread::Builder::new().spawn(move || own.work(explorer))?;
        Ok(Self { queue })
    }

    /// Answers a query; polls `is_wanted` to check that the client is still waiting.
    ///
    /// # Errors
    /// Returns an error if the query cannot be answered.
    pub(super) fn ask(
        &self,
        query: &str,
        mut is_wanted: impl FnMut() -> bool,
    ) -> Result<Computed, Unanswered> {
        let cancel = CancelToken::default();
        let mut looks = 0;
        let answer = loop {
            match self.queue.push(query, &cancel) {
                // Queries of disconnected clients leave the queue as soon as the disconnection is
                // noticed.
                Err(Unanswered::Busy) if looks < MAX_LOOKS => {
                    looks += 1;
                    std::thread::sleep(LOOK);
                    if !is_wanted() {
                        return Err(Unanswered::Abandoned);
                    }
                }
                pushed => break pushed?,
            }
        };
        loop {
            match answer.recv_timeout(LOOK) {
                Ok(outcome) => return Ok(outcome),
                Err(RecvTimeoutError::Disconnected) => return Err(Unanswered::Failed),
                Err(RecvTimeoutError::Timeout) if is_wanted() => {}
                Err(RecvTimeoutError::Timeout) => {
                    cancel.cancel();
                    return Err(Unanswered::Abandoned);
                }
            }
        }
    }
}

impl Queue {
    fn push(&self, query: &str, cancel: &CancelToken) -> Result<Receiver<Computed>, Unanswered> {
        let (reply, answer) = channel();
        let mut jobs = self.jobs.lock().unwrap_or_else(PoisonError::into_inner);
        jobs.retain(|job| !job.cancel.is_canceled());
        if jobs.len() >= MAX_WAITING {
            return Err(Unanswered::Busy);
        }
        jobs.push_back(Job { query: query.to_owned(), cancel: cancel.clone(), reply });
        drop(jobs);
        self.has_job.notify_one();
        Ok(answer)
    }

    fn next(&self) -> Job {
        let mut jobs = self.jobs.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            match jobs.pop_front() {
                Some(job) if job.cancel.is_canceled() => {}
                Some(job) => return job,
                None => {
                    jobs = self.has_job.wait(jobs).unwrap_or_else(PoisonError::into_inner);
                }
            }
        }
    }

    /// Answers queries until the program ends.
    fn work(&self, mut explorer: Explorer) {
        loop {
            let Job { query, cancel, reply } = self.next();
            // Runs in a separate thread, so that a panic ends that thread and not the lane.
            let computed = std::thread::scope(|scope| {
                scope.spawn(|| explorer.answer_unless_canceled(&query, &cancel)).join()
            });
            if let Ok(outcome) = computed {
                // The client may have disconnected.
                let _ = reply.send(outcome);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::embedded::embedded_files;
    use super::*;

    const SLOW: &str = "v=1&what=picture&lesson=frustum&size=8192x8192";

    #[test]
    fn abandoned_queries_are_not_computed() {
        let mut explorer = Explorer::new();
        let house = embedded_files().remove("models/house.glb").expect("a model");
        explorer.add_file("models/house.glb", house).expect("a model");
        let lane = Lane::start(explorer).expect("a thread");
        for _ in 0..MAX_WAITING + 2 {
            assert_eq!(lane.ask(SLOW, || false).err(), Some(Unanswered::Abandoned));
        }
        let lessons = lane.ask("v=1&what=lessons", || true).expect("an answer");
        assert_eq!(lessons.expect("the lessons").content_type, "application/json");
    }

    #[test]
    fn a_full_queue_is_reported_as_busy() {
        let queue = Queue::default();
        let cancel = CancelToken::default();
        let answers: Vec<_> = (0..MAX_WAITING).map(|_| queue.push(SLOW, &cancel)).collect();
        assert!(answers.iter().all(Result::is_ok));
        assert_eq!(queue.push(SLOW, &cancel).err(), Some(Unanswered::Busy));
        cancel.cancel();
        assert!(queue.push(SLOW, &CancelToken::default()).is_ok());
    }
}
