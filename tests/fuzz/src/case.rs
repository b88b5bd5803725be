//! Runs one case, which must finish quickly, use little memory and not panic.

use nix::sys::resource::{UsageWho, getrusage};
use peak_alloc::PeakAlloc;
use std::time::{Duration, Instant};

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// The memory that a case may use in addition to the fuzzer's own.
const MOST_BYTES: usize = 200 << 20;

/// The processor time that a case may use.
const LONGEST: Duration = Duration::from_secs(1);

/// Runs the work of a case.
///
/// # Panics
/// Panics if the case uses too much memory or takes too long. Only processor time counts, so that a
/// busy machine does not fail a case. Slow work is run again to measure it.
pub fn run(work: impl Fn()) {
    MEMORY.reset_peak_usage();
    let before = MEMORY.current_usage();
    let start = Instant::now();
    work();
    let taken = MEMORY.peak_usage().saturating_sub(before);
    assert!(taken <= MOST_BYTES, "the case took {taken} bytes of memory");
    if start.elapsed() > LONGEST {
        let before = processor_time();
        work();
        let taken = processor_time().saturating_sub(before);
        assert!(taken <= LONGEST, "the case took {taken:?} of processor time");
    }
}

/// Returns the processor time that all threads of this process have used.
fn processor_time() -> Duration {
    let Ok(usage) = getrusage(UsageWho::RUSAGE_SELF) else { return Duration::ZERO };
    let micros = |time: nix::sys::time::TimeVal| {
        Duration::from_micros(time.tv_sec() as u64 * 1_000_000 + time.tv_usec() as u64)
    };
    micros(usage.user_time()) + micros(usage.system_time())
}
