//! One function under test: called repeatedly, with the results counted.

use crate::bits::Bits;
use crate::random::Random;
use std::cell::RefCell;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// A name, and one call with random arguments. The call returns whether all numbers in its result
/// are finite, or `None` if the arguments are rejected or there is no result.
pub type Subject = (&'static str, fn(&mut Random) -> Option<bool>);

/// The results of the calls.
pub struct Report {
    name: &'static str,
    pub calls: u64,
    made: u64,
    time: Duration,
    pub fault: Option<String>,
}

/// Calls the function until it fails or the number of calls is reached.
pub fn run(&(name, call): &Subject, calls: u64, seed: u64) -> Report {
    let start = Instant::now();
    let mut random = Random::new(Bits::new(seed));
    let mut report = Report { name, calls: 0, made: 0, time: Duration::ZERO, fault: None };
    while report.calls < calls && report.fault.is_none() {
        report.calls += 1;
        let bits = random.begin();
        match catch_unwind(AssertUnwindSafe(|| call(&mut random))) {
            Ok(None) => {}
            Ok(Some(finite)) if finite || !random.drew_only_finite() => report.made += 1,
            Ok(Some(_)) => {
                report.fault = Some(format!("not finite for {}", arguments(call, bits)));
            }
            Err(_) => {
                let message = last_panic();
                report.fault = Some(format!("{message} for {}", arguments(call, bits)));
            }
        }
    }
    report.time = start.elapsed();
    report
}

/// Returns the values that the call drew from these bits, in order.
fn arguments(call: fn(&mut Random) -> Option<bool>, bits: Bits) -> String {
    let mut random = Random::recording(bits);
    let _ = catch_unwind(AssertUnwindSafe(|| call(&mut random)));
    format!("{:?}", random.drawn())
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, calls, made, time, fault } = self;
        let refused = calls - made;
        let seconds = time.as_secs_f64();
        write!(f, "{name:44} {calls:9} calls {made:9} made {refused:9} rejected {seconds:6.1} s")?;
        fault.iter().try_for_each(|fault| write!(f, "\n  FAILED {fault}"))
    }
}

thread_local! {
    static LAST_PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Returns the message of this thread's last panic.
pub fn last_panic() -> String {
    format!("panicked {}", LAST_PANIC.take())
}

/// Stores a panic message for the report instead of printing it.
pub fn catch_panics_quietly() {
    std::panic::set_hook(Box::new(|panic| LAST_PANIC.set(format!("({panic})"))));
}
