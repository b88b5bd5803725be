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
use crate::workspace::{read, root};
use std::time::Duration;
use step::{Action, Report, Step};

pub fn run(arguments: &[String]) -> Outcome {
    let steps = steps()?;
    let keep_going = arguments.iter().any(|argument| argument == "--keep-going");
    if arguments.iter().any(|argument| argument == "--list") {
        println!("{}", list(&steps));
        return Ok(());
    }
    let names: Vec<&String> =
        arguments.iter().filter(|argument| *argument != "--keep-going").collect();
    if let Some(unknown) = names.iter().find(|name| !steps.iter().any(|step| step.name == ***name))
    {
        return Err(format!(
            "there is no step `{unknown}`; these are the steps:\n{}",
            list(&steps)
        ));
    }
    let chosen = steps.iter().filter(|step| names.is_empty() || names.contains(&&step.name));
    let mut reports = Vec::new();
    for step in chosen {
        let report = step.run();
        let failed = report.failure.is_some();
        reports.push(report);
        if failed && !keep_going {
            break;
        }
    }
    summary(&reports)
}

fn steps() -> Result<Vec<Step>, String> {
    let maths: String = NO_STD.iter().map(|name| format!(" --package {name}")).collect();
    let without_maths: String = NO_STD.iter().map(|name| format!(" --exclude {name}")).collect();
    let mut steps = vec![
        Step::cargo("fmt", "the code is laid out as rustfmt does it", &["fmt --all --check"]),
        Step::own("tidy", "the rules of the house", || crate::tidy::run(&[])),
        Step::own("models", "the models are what the code makes", || {
            crate::models::run(&["--check".into()])
        }),
        Step::own("conformance", "each item is proved by a test, and the table says which", || {
            crate::conformance::run(&["--check".into()])
        }),
        Step::cargo(
            "clippy",
            "no lint has anything to say",
            &["clippy --quiet --workspace --all-targets -- -D warnings"],
        ),
        Step::own("no-std", "the five crates of mathematics do without std", no_std::run),
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
    steps.push(Step::own("determinism", "debug and release draw the same bytes, twice", || {
        crate::determinism::run(&[])
    }));
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
    let folder = root().join("tests");
    let manifest = read(&folder.join("Cargo.toml"))?;
    let step = |(name, path): (String, String)| {
        let source = read(&folder.join(path))?;
        let call = format!("test --package alberti-tests --test {name}");
        Ok(Step::cargo(&name, &first_sentence(&source), &[&call]))
    };
    tests_of(&manifest).into_iter().map(step).collect()
}

/// Name and path of each `[[test]]` of a manifest.
fn tests_of(manifest: &str) -> Vec<(String, String)> {
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

fn list(steps: &[Step]) -> String {
    let lines: Vec<String> =
        steps.iter().map(|step| format!("  {:12} {}", step.name, step.about)).collect();
    lines.join("\n")
}

/// The table at the end: each step with its time, then what was skipped, then the verdict.
fn summary(reports: &[Report]) -> Outcome {
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
        assert_eq!(tests_of(manifest), expected);
    }

    #[test]
    fn a_step_is_described_by_the_first_sentence() {
        let source = "//! The goldens: all\n//! of them. More.\n//!\n//! Else.\n";
        assert_eq!(first_sentence(source), "The goldens: all of them");
        assert_eq!(first_sentence("//! One.\n"), "One");
    }

    #[test]
    fn every_step_has_its_own_name_and_says_what_it_is_for() {
        let steps = steps().unwrap();
        for (i, step) in steps.iter().enumerate() {
            assert!(!step.about.is_empty(), "{}", step.name);
            assert!(steps[..i].iter().all(|other| other.name != step.name), "{}", step.name);
        }
    }
}
