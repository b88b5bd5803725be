//! Stage timings: a stopwatch to pass through loading and rendering.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Stage names with the total time and number of runs.
type StageTimes = Vec<(&'static str, Duration, usize)>;

/// A stopwatch for processing stages. Clones add to the same measurement. The default does not
/// measure anything.
///
/// ```
/// use model::Timings;
/// let timings = Timings::enabled();
/// let sum: u32 = timings.measure("add", || (1..=10).sum());
/// assert_eq!(sum, 55);
/// assert_eq!((timings.stages()[0].0, timings.count("add")), ("add", 1));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Timings {
    stage_times: Option<Arc<Mutex<StageTimes>>>,
}

impl Timings {
    /// Creates a stopwatch that measures.
    #[must_use]
    pub fn enabled() -> Self {
        Self { stage_times: Some(Arc::default()) }
    }

    /// Runs `work` and adds its time to the stage's total.
    pub fn measure<T>(&self, stage: &'static str, work: impl FnOnce() -> T) -> T {
        let Some(spans) = &self.stage_times else { return work() };
        let begin = Instant::now();
        let result = work();
        let took = begin.elapsed();
        let mut spans = spans.lock().unwrap_or_else(PoisonError::into_inner);
        match spans.iter_mut().find(|(name, ..)| *name == stage) {
            Some((_, sum, count)) => (*sum, *count) = (*sum + took, *count + 1),
            None => spans.push((stage, took, 1)),
        }
        result
    }

    /// Returns the stages with their total times, in the order in which they first ended.
    #[must_use]
    pub fn stages(&self) -> Vec<(&'static str, Duration)> {
        self.stage_times().into_iter().map(|(stage, time, _)| (stage, time)).collect()
    }

    /// Returns how often a stage ran, or 0 if nothing is measured.
    #[must_use]
    pub fn count(&self, stage: &str) -> usize {
        let times = self.stage_times();
        times.iter().find(|(name, ..)| *name == stage).map_or(0, |(.., count)| *count)
    }

    fn stage_times(&self) -> StageTimes {
        let times = |times: &Arc<Mutex<StageTimes>>| {
            times.lock().unwrap_or_else(PoisonError::into_inner).clone()
        };
        self.stage_times.as_ref().map(times).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeated_stages_are_summed_and_the_default_measures_nothing() {
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
