//! Side-by-side measurement: runs every contestant once per round, and compares only times from the
//! same round.
//!
//! If the machine is slow for a second, it is slow for all, so ratios vary less than times. The
//! order rotates from round to round, so that no contestant always follows the same neighbor.

use crate::clock::timed;
use std::time::Duration;

/// A contestant that runs in each round.
pub struct Contestant<'a> {
    /// The name in reports.
    pub name: String,
    /// The work to measure.
    pub work: Box<dyn FnMut() + 'a>,
}

/// The CPU times of one contestant in seconds, by round; `None` for rounds that it skipped.
#[derive(Clone, Debug)]
pub struct Series {
    /// The contestant's name.
    pub name: String,
    /// The times.
    pub times: Vec<Option<f64>>,
}

/// The median and spread of a list of figures.
#[derive(Clone, Copy, Debug)]
pub struct Spread {
    /// The minimum.
    pub low: f64,
    /// The median.
    pub median: f64,
    /// The maximum.
    pub high: f64,
}

/// The time limit for slow contestants. They run in as many rounds as it allows, but in at least
/// three.
const PATIENCE: Duration = Duration::from_secs(6);

/// Runs every contestant `rounds` times, after one warm-up round.
pub fn rounds(contestants: &mut [Contestant<'_>], rounds: usize) -> Vec<Series> {
    let warm: Vec<Duration> = contestants.iter_mut().map(|c| timed(&mut c.work).cpu).collect();
    let mut series: Vec<Series> = contestants
        .iter()
        .map(|c| Series { name: c.name.clone(), times: vec![None; rounds] })
        .collect();
    for round in 0..rounds {
        for turn in 0..contestants.len() {
            let at = (turn + round) % contestants.len();
            if takes_part(warm[at], round, rounds) {
                let took = timed(&mut contestants[at].work).cpu;
                series[at].times[round] = Some(took.as_secs_f64());
            }
        }
    }
    series
}

/// Returns whether a contestant that took `warm` to warm up runs in this round. Its rounds are
/// spread evenly over all rounds.
fn takes_part(warm: Duration, round: usize, rounds: usize) -> bool {
    let affordable = PATIENCE.as_secs_f64() / warm.as_secs_f64().max(1e-9);
    let runs = (affordable as usize).clamp(3.min(rounds), rounds);
    round * runs / rounds != (round + 1) * runs / rounds
}

impl Series {
    /// Returns the spread of its times in seconds.
    pub fn spread(&self) -> Option<Spread> {
        Spread::of(self.times.iter().flatten().copied())
    }

    /// Returns the spread of its times relative to `other`, round by round.
    pub fn over(&self, other: &Self) -> Option<Spread> {
        let both = self.times.iter().zip(&other.times);
        Spread::of(both.filter_map(|(mine, its)| Some((*mine)? / (*its)?)))
    }
}

impl Spread {
    /// Returns the spread of these figures, or `None` if there are none.
    pub fn of(figures: impl Iterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = figures.collect();
        sorted.sort_by(f64::total_cmp);
        let (low, high) = (*sorted.first()?, *sorted.last()?);
        let middle = sorted.len() / 2;
        let even = sorted.len().is_multiple_of(2);
        let median =
            if even { (sorted[middle - 1] + sorted[middle]) / 2.0 } else { sorted[middle] };
        Some(Self { low, median, high })
    }

    /// Creates a copy with every figure multiplied.
    pub fn times(self, factor: f64) -> Self {
        Self { low: self.low * factor, median: self.median * factor, high: self.high * factor }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_in_the_middle() {
        let spread = Spread::of([3.0, 1.0, 2.0].into_iter()).unwrap();
        assert_eq!((spread.low, spread.median, spread.high), (1.0, 2.0, 3.0));
        assert_eq!(Spread::of([4.0, 1.0].into_iter()).unwrap().median, 2.5);
        assert!(Spread::of(std::iter::empty()).is_none());
    }

    #[test]
    fn slow_contestants_run_three_times_and_quick_contestants_in_every_round() {
        let runs = |millis| {
            let warm = Duration::from_millis(millis);
            (0..11).filter(|&round| takes_part(warm, round, 11)).count()
        };
        assert_eq!((runs(10_000), runs(1_000), runs(1)), (3, 6, 11));
    }

    #[test]
    fn ratios_are_computed_within_a_round() {
        let series = |times| Series { name: String::new(), times };
        let a = series(vec![Some(2.0), Some(8.0), None]);
        let b = series(vec![Some(1.0), Some(2.0), Some(1.0)]);
        let ratio = a.over(&b).unwrap();
        assert_eq!((ratio.low, ratio.high), (2.0, 4.0));
    }
}
