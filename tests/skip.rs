//! Reports the parts of tests that cannot run here, so that nobody overlooks them.

use std::fs::OpenOptions;
use std::io::Write;

/// Reports a part of a test that cannot run here.
///
/// The report is written to standard error and, if the environment variable `SKIP_LOG` names a
/// file, appended to that file. `cargo xtask test` repeats the reports in its summary, even if a
/// harness captures the output of a test.
pub fn report_skip(name: &str, reason: &str) {
    // A reason may be the output of another program, of which the first line is enough.
    let reason = reason.lines().next().unwrap_or_default();
    let line = format!("SKIPPED {name}: {reason}\n");
    // Rust's test harness would capture `eprint!`.
    let _ = std::io::stderr().write_all(line.as_bytes());
    let Some(path) = std::env::var_os("SKIP_LOG") else { return };
    let log = OpenOptions::new().create(true).append(true).open(path);
    // A single call prevents interleaving with lines from other processes.
    let _ = log.and_then(|mut log| log.write_all(line.as_bytes()));
}
