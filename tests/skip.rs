//! What a test could not do here, reported where nobody can miss it.

use std::fs::OpenOptions;
use std::io::Write;

/// Reports a part of a test that cannot run here.
///
/// The line goes to the standard error stream and, if the environment variable `SKIP_LOG` names a
/// file, to its end: `cargo xtask test` repeats those lines in its summary, even where a harness
/// captures what a test prints.
pub fn report_skip(name: &str, reason: &str) {
    // A reason may be the output of another program: its first line must do.
    let reason = reason.lines().next().unwrap_or_default();
    let line = format!("SKIPPED {name}: {reason}\n");
    // Not `eprint!`, which the harness of Rust's tests captures.
    let _ = std::io::stderr().write_all(line.as_bytes());
    let Some(path) = std::env::var_os("SKIP_LOG") else { return };
    let log = OpenOptions::new().create(true).append(true).open(path);
    // One call, so that lines of other processes do not come between.
    let _ = log.and_then(|mut log| log.write_all(line.as_bytes()));
}
