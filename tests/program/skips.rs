//! Tests that lack a tool or a folder report this in the log that `cargo xtask test` reads.
//!
//! This program runs each such test without the tool or folder that the test needs, because a test
//! that returned silently would pass forever.

use std::path::Path;
use std::process::Command;

/// Runs tests by name with a changed environment variable, and returns their reports.
fn skips_of(test: &str, (name, value): (&str, &str)) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let log = folder.join(format!("skips-{test}"));
    let _ = std::fs::remove_file(&log);
    // Interrupts are ignored, so that the test that needs them cannot run.
    let script = "trap '' INT; exec \"$TESTS\" \"$TEST\"";
    let mut shell = Command::new("/bin/sh");
    shell.args(["-c", script]).env("TESTS", std::env::current_exe().expect("this program"));
    shell.env("ALBERTI", alberti_tests::program_path().expect("the program"));
    // The same tests also run normally at the same time, in folders with the same names.
    shell.env("SANDBOX_SUFFIX", "-skips");
    let run = shell.env("TEST", test).env("SKIP_LOG", &log).env(name, value).output();
    let run = run.expect("a shell");
    assert!(run.status.success(), "{test}: {}", String::from_utf8_lossy(&run.stdout));
    std::fs::read_to_string(log).unwrap_or_default()
}

#[cfg(unix)]
#[test]
fn tests_without_their_tool_are_reported() {
    let nothing = ("PATH", "/nowhere");
    for (test, variable, skip) in [
        ("poppler_matches_the_png", nothing, "SKIPPED viewers: pdftoppm"),
        ("cesium_man_walks", ("ASSETS", "/nowhere"), "SKIPPED cesium-man"),
        ("pdf_text_is_found_by_another_reader", nothing, "SKIPPED PDF text: pdftotext"),
        ("a_full_or_read_only_disk", nothing, "SKIPPED a_full_or_read_only_disk"),
        ("an_interrupt_stops", ("NOTHING", ""), "SKIPPED an_interrupt_stops_the_server"),
    ] {
        let reported = skips_of(test, variable);
        assert!(reported.starts_with(skip), "{test} reported `{reported}`");
    }
}
