//! Stage timings: a stopwatch that is handed through loading and rendering.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Names of stages and the time each took.
type StageTimes = Vec<(&'static str, Duration)>;

/// A stopwatch for the stages of a run. Clones add to one measurement; the default measures
/// nothing.
///
/// ```
/// use model::Timings;
/// let timings = Timings::enabled();
/// let sum: u32 = timings.measure("add", || (1..=10).sum());
/// assert_eq!(sum, 55);
/// assert_eq!(timings.stages()[0].0, "add");
/// ```
#[derive(Clone, Debug, Default)]
pub struct Timings {
    stage_times: Option<Arc<Mutex<StageTimes>>>,
}

impl Timings {
    /// A stopwatch that measures.
    #[must_use]
    pub fn enabled() -> Self {
        Self { stage_times: Some(Arc::default()) }
    }

    /// Runs `work` and adds the time it takes to that of the stage.
    pub fn measure<T>(&self, stage: &'static str, work: impl FnOnce() -> T) -> T {
        let Some(spans) = &self.stage_times else { return work() };
        let begin = Instant::now();
        let result = work();
        let took = begin.elapsed();
        let mut spans = spans.lock().unwrap_or_else(PoisonError::into_inner);
        match spans.iter_mut().find(|(name, _)| *name == stage) {
            Some((_, sum)) => *sum += took,
            None => spans.push((stage, took)),
        }
        result
    }

    /// Stages and the time each took, in the order in which they first ended.
    #[must_use]
    pub fn stages(&self) -> Vec<(&'static str, Duration)> {
        let spans = |spans: &Arc<Mutex<StageTimes>>| {
            spans.lock().unwrap_or_else(PoisonError::into_inner).clone()
        };
        self.stage_times.as_ref().map(spans).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stage_that_comes_twice_is_one_entry_and_the_default_measures_nothing() {
        let timings = Timings::enabled();
        assert_eq!(timings.measure("a", || 1), 1);
        timings.clone().measure("b", || ());
        timings.measure("a", || ());
        assert_eq!(timings.stages().iter().map(|(name, _)| *name).collect::<Vec<_>>(), ["a", "b"]);
        let silent = Timings::default();
        silent.measure("a", || ());
        assert!(silent.stages().is_empty());
    }
}
