//! Measures CPU time and the speed of this machine.

use std::collections::BTreeSet;
use std::hint::black_box;
use std::thread;

/// The clock ticks per second in the times that Linux reports to programs.
const TICKS_PER_SECOND: f64 = 100.0;

/// The number of values that each of two threads sorts.
const NUMBERS: usize = 1_000_000;

/// The CPU seconds that [`machine_slowness`] takes on the reference machine of the budget: half of
/// its time on a machine where a build took 302 s instead of 151 s.
const REFERENCE_SECONDS: f64 = 1.5;

/// Returns the CPU seconds of this process and of all processes that it has started and waited for,
/// or 0 if there is no `/proc`.
pub fn process_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // The program name is in parentheses and may contain spaces.
    let fields = stat.rsplit_once(')').map_or("", |(_, rest)| rest);
    let times = fields.split_whitespace().skip(11).take(4);
    times.map(|ticks| ticks.parse().unwrap_or(0.0)).sum::<f64>() / TICKS_PER_SECOND
}

/// Measures how much slower this machine is than the reference machine of the budget, with two
/// cores busy.
///
/// Without this factor, a budget in CPU seconds would depend more on the machine than on the tests:
/// the same step takes twice as long on some machines as on others.
pub fn machine_slowness() -> f64 {
    let before = process_seconds();
    thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                // Comparisons and random memory accesses, as in a compiler.
                let next =
                    |x: &u64| Some(x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1));
                let numbers = std::iter::successors(Some(1), next).take(NUMBERS);
                let sorted: BTreeSet<u64> = numbers.collect();
                black_box(sorted.iter().fold(0_u64, |sum, number| sum.wrapping_add(*number)))
            });
        }
    });
    (process_seconds() - before) / REFERENCE_SECONDS
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(target_os = "linux")]
    #[test]
    fn work_takes_cpu_time() {
        let before = process_seconds();
        let slowness = machine_slowness();
        println!("this machine's slowness is {slowness}");
        assert!(process_seconds() > before && slowness.is_finite() && slowness > 0.0);
    }
}
