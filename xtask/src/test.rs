//! `cargo xtask test`: all of the tests, for a newcomer and for CI alike.
//!
//! A step is a name and what it runs. The integration tests of `tests/` are steps of their own, one
//! for each `[[test]]` of its manifest, so that `cargo xtask test vectors` runs just that one, with
//! its environment (`VECTORS=DIR`, `ASSETS=DIR`) passed through. All steps but the last two build
//! with one profile and one set of features, so that nothing is compiled twice. A line that begins with
//! `SKIPPED` in what a step prints is repeated at the end.

mod no_std;
mod step;

use crate::Outcome;
use crate::tidy::NO_STD;
use crate::workspace::{project_root, read_text};
use std::time::Duration;
use step::{Action, Step, StepReport};

pub fn run_tests(arguments: &[String]) -> Outcome {
    let steps = all_steps()?;
    let keep_going = arguments.iter().any(|argument| argument == "--keep-going");
    if arguments.iter().any(|argument| argument == "--list") {
        println!("{}", list_steps(&steps));
        return Ok(());
    }
    let names: Vec<&String> =
        arguments.iter().filter(|argument| *argument != "--keep-going").collect();
    if let Some(unknown) = names.iter().find(|name| !steps.iter().any(|step| step.name == ***name))
    {
        return Err(format!(
            "there is no step `{unknown}`; these are the steps:\n{}",
            list_steps(&steps)
        ));
    }
    let chosen = steps.iter().filter(|step| names.is_empty() || names.contains(&&step.name));
    let mut reports = Vec::new();
    for step in chosen {
        let report = step.run_step();
        let failed = report.failure.is_some();
        reports.push(report);
        if failed && !keep_going {
            break;
        }
    }
    print_summary(&reports)
}

fn all_steps() -> Result<Vec<Step>, String> {
    let maths: String = NO_STD.iter().map(|name| format!(" --package {name}")).collect();
    let without_maths: String = NO_STD.iter().map(|name| format!(" --exclude {name}")).collect();
    let mut steps = vec![
        Step::cargo("fmt", "the code is laid out as rustfmt does it", &["fmt --all --check"]),
        Step::built_in("tidy", "the rules of the house", || crate::tidy::run_tidy(&[])),
        Step::built_in("models", "the models are what the code makes", || {
            crate::models::run_models(&["--check".into()])
        }),
        Step::built_in(
            "conformance",
            "each item is proved by a test, and the table says which",
            || crate::conformance::run_conformance(&["--check".into()]),
        ),
        Step::cargo(
            "clippy",
            "no lint has anything to say",
            &["clippy --quiet --workspace --all-targets -- -D warnings"],
        ),
        Step::built_in(
            "no-std",
            "the five crates of mathematics do without std",
            no_std::check_no_std,
        ),
        Step::cargo(
            "maths",
            "the tests and examples of those five, by themselves",
            &[&format!("test{maths}")],
        ),
        Step::cargo(
            "units",
            "the tests and doc-tests of the other crates",
            &[
                &format!("test --workspace{without_maths} --exclude alberti-tests"),
                "test --package alberti-tests --lib",
                "test --package alberti-tests --doc",
            ],
        ),
    ];
    steps.extend(integration_tests()?);
    steps.push(Step {
        name: "docs".into(),
        about: "the documentation builds without a warning".into(),
        action: Action::Documentation,
    });
    steps.push(Step::built_in(
        "determinism",
        "debug and release draw the same bytes, twice",
        || crate::determinism::run_determinism(&[]),
    ));
    // As a command of its own, so that what it has to skip is repeated at the end.
    steps.push(Step::cargo(
        "instructions",
        "fixed pieces of work take no more instructions than is stored",
        &["xtask bench --instructions"],
    ));
    Ok(steps)
}

/// A step for each `[[test]]` of `tests/Cargo.toml`, described by the first sentence of its file.
fn integration_tests() -> Result<Vec<Step>, String> {
    let folder = project_root().join("tests");
    let manifest = read_text(&folder.join("Cargo.toml"))?;
    let step = |(name, path): (String, String)| {
        let source = read_text(&folder.join(path))?;
        let call = format!("test --package alberti-tests --test {name}");
        Ok(Step::cargo(&name, &first_sentence(&source), &[&call]))
    };
    test_targets(&manifest).into_iter().map(step).collect()
}

/// Name and path of each `[[test]]` of a manifest.
fn test_targets(manifest: &str) -> Vec<(String, String)> {
    let value = |table: &str, key: &str| {
        let line = table.lines().find_map(|line| line.trim().strip_prefix(key))?;
        Some(line.trim_start().strip_prefix('=')?.trim().trim_matches('"').to_owned())
    };
    let tables = manifest.split("[[test]]").skip(1);
    // A table ends where the next one begins.
    let tables = tables.map(|table| table.split("\n[").next().unwrap_or(table));
    tables.filter_map(|table| Some((value(table, "name")?, value(table, "path")?))).collect()
}

fn first_sentence(source: &str) -> String {
    let lines = source.lines().map_while(|line| line.strip_prefix("//!"));
    let text =
        lines.map(str::trim).take_while(|line| !line.is_empty()).collect::<Vec<_>>().join(" ");
    text.split_once(". ")
        .map_or(text.as_str(), |(sentence, _)| sentence)
        .trim_end_matches('.')
        .to_owned()
}

fn list_steps(steps: &[Step]) -> String {
    let lines: Vec<String> =
        steps.iter().map(|step| format!("  {:12} {}", step.name, step.about)).collect();
    lines.join("\n")
}

/// The table at the end: each step with its time, then what was skipped, then the verdict.
fn print_summary(reports: &[StepReport]) -> Outcome {
    println!("\n── summary");
    for report in reports {
        let verdict = if report.failure.is_some() { "FAILED" } else { "passed" };
        println!("  {verdict} {:12} {:6.1} s", report.name, report.time.as_secs_f64());
    }
    let skipped: Vec<&String> = reports.iter().flat_map(|report| &report.skipped).collect();
    for line in &skipped {
        println!("  {line}");
    }
    let failures: Vec<String> = reports
        .iter()
        .filter_map(|report| Some(format!("{}: {}", report.name, report.failure.as_ref()?)))
        .collect();
    let time: Duration = reports.iter().map(|report| report.time).sum();
    println!("  {:.0} s in all", time.as_secs_f64());
    println!(
        "steps: {} passed, {} failed, {} skipped",
        reports.len() - failures.len(),
        failures.len(),
        skipped.len()
    );
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tests_are_read_from_the_manifest() {
        let manifest = r#"
[lib]
path = "lib.rs"

[[test]]
name = "a"
path = "a/main.rs"
harness = false

[[test]]
name = "b"
path = "b.rs"

[dependencies]
name = "c"
"#;
        let expected =
            [("a", "a/main.rs"), ("b", "b.rs")].map(|(a, b)| (a.to_owned(), b.to_owned()));
        assert_eq!(test_targets(manifest), expected);
    }

    #[test]
    fn a_step_is_described_by_the_first_sentence() {
        let source = "//! The goldens: all\n//! of them. More.\n//!\n//! Else.\n";
        assert_eq!(first_sentence(source), "The goldens: all of them");
        assert_eq!(first_sentence("//! One.\n"), "One");
    }

    #[test]
    fn every_step_has_its_own_name_and_says_what_it_is_for() {
        let steps = all_steps().unwrap();
        for (i, step) in steps.iter().enumerate() {
            assert!(!step.about.is_empty(), "{}", step.name);
            assert!(steps[..i].iter().all(|other| other.name != step.name), "{}", step.name);
        }
    }
}
