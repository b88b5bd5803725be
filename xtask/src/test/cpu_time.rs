//! Seconds of the processor, and how fast this machine's are.

use sha2::{Digest, Sha256};
use std::hint::black_box;
use std::thread;

/// Ticks of the kernel's clock in a second, as Linux reports times to programs.
const TICKS_PER_SECOND: f64 = 100.0;

/// What [`machine_slowness`] took where the budget was measured, in seconds of both cores.
const REFERENCE_SECONDS: f64 = 1.0;

/// The processor's seconds of this process and of everything that it has started and waited for; 0
/// where there is no `/proc`.
pub fn process_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // The name of the program is in parentheses and may contain spaces.
    let fields = stat.rsplit_once(')').map_or("", |(_, rest)| rest);
    let times = fields.split_whitespace().skip(11).take(4);
    times.map(|ticks| ticks.parse().unwrap_or(0.0)).sum::<f64>() / TICKS_PER_SECOND
}

/// How many times slower than the machine of the budget this one computes, with two cores busy.
///
/// A budget in seconds of the processor would otherwise say more about the machine than about the
/// tests: the same step takes half the time on another one.
pub fn machine_slowness() -> f64 {
    let before = process_seconds();
    thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                let mut hash = Sha256::new();
                for _ in 0..96 {
                    hash.update(black_box([0x5A; 1 << 20].as_slice()));
                }
                black_box(hash.finalize())
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
    fn work_takes_time_of_the_processor() {
        let before = process_seconds();
        let slowness = machine_slowness();
        assert!(process_seconds() > before && slowness.is_finite() && slowness > 0.0);
    }
}
