//! The summary of a run: costs and skips, and whether they are allowed.

use super::cpu_time::machine_slowness;
use super::schedule::Run;
use crate::Outcome;
use crate::workspace::{project_root, read_text};

/// The budget of the first tier, in CPU seconds, on a machine where [`machine_slowness`] is 1.
const FIRST_TIER_CPU_SECONDS: f64 = 1100.0;

/// The factor by which a tier may exceed its budget before it fails.
const BUDGET_EXCESS: f64 = 4.0 / 3.0;

/// The file with the prefixes of the skips that are allowed in CI.
const ALLOWED_SKIPS: &str = ".ci/allowed-skips";

/// Prints each step with its costs, the slowest first, then the skips and the counts.
pub fn print_summary(run: &Run, is_first_tier: bool) -> Outcome {
    let mut reports: Vec<_> = run.reports.iter().collect();
    reports.sort_by(|a, b| b.cpu_seconds.total_cmp(&a.cpu_seconds));
    println!("\n── summary: wall-clock time, CPU time, and the share spent in compilers");
    for report in &reports {
        let verdict = if report.failure.is_some() { "FAILED" } else { "passed" };
        let compiling = 100.0 * report.compile_seconds / report.cpu_seconds.max(0.01);
        let (seconds, cpu_seconds) = (report.seconds, report.cpu_seconds);
        println!(
            "  {verdict} {:14}{seconds:7.1} s{cpu_seconds:8.1} s{compiling:5.0} %",
            report.name
        );
    }
    let cpu_seconds: f64 = reports.iter().map(|report| report.cpu_seconds).sum();
    println!("  total {:23.1} s{cpu_seconds:8.1} s", run.seconds);
    let skipped: Vec<&String> = reports.iter().flat_map(|report| &report.skipped).collect();
    for (line, count) in count_lines(&skipped) {
        let times = if count > 1 { format!(" ({count} times)") } else { String::new() };
        println!("  {line}{times}");
    }
    if !run.left_out.is_empty() {
        println!("  NOT RUN for lack of time: {}", run.left_out.join(", "));
    }
    let failures: Vec<&str> = reports
        .iter()
        .filter_map(|report| report.failure.as_ref().map(|_| report.name.as_str()))
        .collect();
    println!(
        "steps: {} passed, {} failed, {} skipped",
        reports.len() - failures.len(),
        failures.len(),
        skipped.len()
    );
    if !failures.is_empty() {
        return Err(format!("failed: {}", failures.join(", ")));
    }
    // Only CI is sure to have every tool and an idle machine.
    if std::env::var_os("CI").is_none() {
        return Ok(());
    }
    check_skips(&skipped, &read_text(&project_root().join(ALLOWED_SKIPS))?)?;
    if is_first_tier { check_budget(cpu_seconds, machine_slowness()) } else { Ok(()) }
}

/// Returns each line once, in the order of first occurrence, with its count.
fn count_lines<'a>(lines: &[&'a String]) -> Vec<(&'a str, usize)> {
    let mut counted: Vec<(&str, usize)> = Vec::new();
    for line in lines {
        match counted.iter_mut().find(|(known, _)| *known == line.as_str()) {
            Some((_, count)) => *count += 1,
            None => counted.push((line, 1)),
        }
    }
    counted
}

/// Fails if there is a skip that is not allowed in CI.
fn check_skips(skipped: &[&String], allowed: &str) -> Outcome {
    let allowed: Vec<&str> =
        allowed.lines().filter(|line| !line.is_empty() && !line.starts_with('#')).collect();
    let is_unexpected = |line: &&&String| {
        let what = line.trim_start_matches("SKIPPED ");
        !allowed.iter().any(|beginning| what.starts_with(beginning))
    };
    let unexpected: Vec<&str> =
        skipped.iter().filter(is_unexpected).map(|line| line.as_str()).collect();
    if unexpected.is_empty() {
        return Ok(());
    }
    Err(format!(
        "CI must not skip these:\n  {}\n  = help: install what is missing in .ci/run, or add a line \
         to {ALLOWED_SKIPS} with the reason",
        unexpected.join("\n  ")
    ))
}

/// Fails if the first tier has become much slower.
fn check_budget(cpu_seconds: f64, slowness: f64) -> Outcome {
    let budget = FIRST_TIER_CPU_SECONDS * slowness;
    println!(
        "the first tier took {cpu_seconds:.0} s of CPU time; its budget here is {budget:.0} s \
         ({FIRST_TIER_CPU_SECONDS} s times {slowness:.2}, the slowness of this machine)"
    );
    if cpu_seconds <= budget * BUDGET_EXCESS {
        return Ok(());
    }
    Err("the budget is exceeded by more than a third: move something to the second tier".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unexpected_skip_fails_in_ci() {
        let skip = |what: &str| format!("SKIPPED {what}");
        let lines = [skip("cluster: there is no slurmd"), skip("viewers: chromium is missing")];
        let lines: Vec<&String> = lines.iter().collect();
        assert!(check_skips(&lines, "# none\ncluster:\nviewers: chromium\n").is_ok());
        let fault = check_skips(&lines, "cluster:\n").unwrap_err();
        assert!(fault.contains("viewers: chromium") && !fault.contains("slurmd"), "{fault}");
    }

    #[test]
    fn a_repeated_skip_is_printed_once() {
        let lines = ["SKIPPED a", "SKIPPED b", "SKIPPED a"].map(str::to_owned);
        let lines: Vec<&String> = lines.iter().collect();
        assert_eq!(count_lines(&lines), [("SKIPPED a", 2), ("SKIPPED b", 1)]);
    }

    #[test]
    fn the_budget_depends_on_the_machine() {
        assert!(check_budget(FIRST_TIER_CPU_SECONDS, 1.0).is_ok());
        assert!(check_budget(1.4 * FIRST_TIER_CPU_SECONDS, 1.0).is_err());
        assert!(check_budget(1.4 * FIRST_TIER_CPU_SECONDS, 2.0).is_ok());
    }
}
