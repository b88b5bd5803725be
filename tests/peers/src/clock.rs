//! Clocks: the CPU time of this process, and the cost of other programs.
//!
//! Other work on the machine stretches wall time but hardly affects CPU time, so the figures are
//! CPU times.

use nix::sys::resource::{UsageWho, getrusage};
use nix::time::{ClockId, clock_gettime};
use std::time::{Duration, Instant};

/// The cost of a piece of work.
#[derive(Clone, Copy, Debug)]
pub struct Took {
    /// The CPU time of all threads.
    pub cpu: Duration,
    /// The wall time.
    pub wall: Duration,
}

/// Returns the CPU time this process has used so far.
fn cpu() -> Duration {
    clock_gettime(ClockId::CLOCK_PROCESS_CPUTIME_ID).map_or(Duration::ZERO, Duration::from)
}

/// Runs some work and returns its cost.
pub fn timed(work: impl FnOnce()) -> Took {
    let (wall, start) = (Instant::now(), cpu());
    work();
    Took { cpu: cpu().saturating_sub(start), wall: wall.elapsed() }
}

/// The cost of a program from start to end.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// The CPU time of all its threads, including kernel time on its behalf.
    pub cpu: Duration,
    /// The wall time.
    pub wall: Duration,
    /// The peak memory in bytes.
    pub peak: u64,
}

/// Returns the cost of the programs that this process started and that have ended. Start only one
/// program, because the peak is the maximum over all of them.
pub fn children(wall: Duration) -> Option<Cost> {
    let usage = getrusage(UsageWho::RUSAGE_CHILDREN).ok()?;
    let time = |t: nix::sys::time::TimeVal| {
        Duration::new(t.tv_sec().unsigned_abs(), t.tv_usec().unsigned_abs() as u32 * 1000)
    };
    Some(Cost {
        cpu: time(usage.user_time()) + time(usage.system_time()),
        wall,
        peak: usage.max_rss().unsigned_abs() * 1024,
    })
}
