//! The clocks: CPU time of this process, and the cost of other programs.
//!
//! Other work on the machine stretches wall time and leaves CPU time nearly alone, so figures are
//! CPU time.

use nix::sys::resource::{UsageWho, getrusage};
use nix::time::{ClockId, clock_gettime};
use std::time::{Duration, Instant};

/// What a piece of work took.
#[derive(Clone, Copy, Debug)]
pub struct Took {
    /// CPU time of all threads.
    pub cpu: Duration,
    /// Time on the wall.
    pub wall: Duration,
}

/// The CPU time this process has used so far.
fn cpu() -> Duration {
    clock_gettime(ClockId::CLOCK_PROCESS_CPUTIME_ID).map_or(Duration::ZERO, Duration::from)
}

/// Does some work and says what it took.
pub fn timed(work: impl FnOnce()) -> Took {
    let (wall, start) = (Instant::now(), cpu());
    work();
    Took { cpu: cpu().saturating_sub(start), wall: wall.elapsed() }
}

/// What a program took from start to end.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// CPU time of all its threads, its own and the kernel's on its behalf.
    pub cpu: Duration,
    /// Time on the wall.
    pub wall: Duration,
    /// The most memory it held at once, in bytes.
    pub peak: u64,
}

/// What the programs took that this process has started and that have ended. Start one only, for
/// the peak is that of the largest.
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
