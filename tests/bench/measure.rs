//! Measures times in turns and reports them as ratios.

use std::fmt;
use std::time::Instant;

/// One way to do a job.
pub struct Variant {
    name: &'static str,
    run: Box<dyn FnMut()>,
}

impl Variant {
    pub fn new(name: &'static str, run: impl FnMut() + 'static) -> Self {
        Self { name, run: Box::new(run) }
    }
}

/// The time of a variant as a multiple of the first variant's time.
pub struct TimeRatio {
    name: &'static str,
    median: f64,
    low: f64,
    high: f64,
}

/// Warm-up turns for caches and branch predictors.
const WARM_UP: usize = 3;
const ROUNDS: usize = 101;

/// Runs all variants in turns and compares each with the first.
pub fn compare_variants(mut ways: Vec<Variant>) -> Vec<TimeRatio> {
    let mut ratios = vec![Vec::with_capacity(ROUNDS); ways.len()];
    for turn in 0..WARM_UP + ROUNDS {
        let seconds = time_round(&mut ways, turn);
        if turn >= WARM_UP {
            for (ratios, time) in ratios.iter_mut().zip(&seconds) {
                ratios.push(time / seconds[0]);
            }
        }
    }
    ways.iter().zip(ratios).map(|(way, ratios)| TimeRatio::from_samples(way.name, ratios)).collect()
}

/// Measures one turn. Each turn begins with a different variant, so that no variant always runs
/// after the same other variant.
fn time_round(ways: &mut [Variant], turn: usize) -> Vec<f64> {
    let mut seconds = vec![0.0; ways.len()];
    for i in 0..ways.len() {
        let next = (turn + i) % ways.len();
        let start = Instant::now();
        (ways[next].run)();
        seconds[next] = start.elapsed().as_secs_f64();
    }
    seconds
}

impl TimeRatio {
    fn from_samples(name: &'static str, mut ratios: Vec<f64>) -> Self {
        ratios.sort_by(f64::total_cmp);
        let at = |tenths: usize| ratios[(ratios.len() - 1) * tenths / 10];
        Self { name, median: at(5), low: at(1), high: at(9) }
    }
}

impl fmt::Display for TimeRatio {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, median, low, high } = self;
        write!(f, "  {median:5.2}  ({low:4.2} to {high:4.2})  {name}")
    }
}
