//! `cargo xtask test`: all tests, for a newcomer and for CI alike.
//!
//! A step is a name and a command. Each integration test of `tests/` is a step of its own, so that
//! `cargo xtask test vectors` runs just that one, with its environment (`VECTORS=DIR`,
//! `ASSETS=DIR`) passed through. Steps select targets of the whole workspace, not packages: Cargo
//! unifies features over the selected packages, and would compile most crates again for every other
//! selection. Lines that begin with `SKIPPED` in the output of a step are repeated at the end.

mod no_std;
mod step;

use crate::Outcome;
use crate::metadata::{Metadata, short_name};
use crate::tidy::NO_STD;
use crate::workspace::read_text;
use std::path::PathBuf;
use std::time::Duration;
use step::{Action, Step, StepReport};

/// Runs all steps or the named ones; stops at the first failure unless `--keep-going` is given.
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
        return Err(format!("no such step: `{unknown}`; the steps are:\n{}", list_steps(&steps)));
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

/// All steps in the order in which they run.
fn all_steps() -> Result<Vec<Step>, String> {
    let maths: String = NO_STD.iter().map(|name| format!(" --package alberti-{name}")).collect();
    let without_maths: String =
        NO_STD.iter().map(|name| format!(" --exclude alberti-{name}")).collect();
    let metadata = Metadata::load()?;
    let unit_tests = tests_of_crates(&metadata);
    let mut steps = vec![
        Step::cargo(
            "fmt",
            "rustfmt would change nothing",
            &[
                "fmt --all --check",
                "fmt --manifest-path crates/python/Cargo.toml --check",
                "fmt --manifest-path xtask/site/Cargo.toml --check",
                "fmt --manifest-path book/mdbook-alberti/Cargo.toml --check",
            ],
        ),
        Step::built_in("tidy", "project rules that no lint covers", || crate::tidy::run_tidy(&[])),
        Step::built_in(
            "models",
            "the committed models of the scenes are what the code generates",
            || crate::models::run_models(&["--check".into()]),
        ),
        Step::built_in("conformance", "every topic has a test, and the table lists it", || {
            crate::conformance::run_conformance(&["--check".into()])
        }),
        Step::cargo(
            "deny",
            "dependencies have the licenses, sources and versions that deny.toml allows",
            &["xtask deny"],
        ),
        Step::cargo(
            "clippy",
            "no warning from clippy",
            &["clippy --quiet --workspace --all-targets -- -D warnings"],
        ),
        Step::built_in(
            "no-std",
            "the five crates of mathematics build without std",
            no_std::check_no_std,
        ),
        Step::cargo(
            "maths",
            "unit tests and doctests of those five, built by themselves",
            &[&format!("test{maths}")],
        ),
        Step::cargo(
            "units",
            "unit tests and doctests of the other crates",
            &[
                &format!("test --workspace{without_maths} --lib --bins --examples{unit_tests}"),
                &format!("test --workspace{without_maths} --doc -- --skip book_pages"),
            ],
        ),
    ];
    steps.extend(integration_tests(&metadata)?);
    steps.extend(later_steps());
    Ok(steps)
}

/// The steps after the integration tests.
fn later_steps() -> impl Iterator<Item = Step> {
    build_steps().into_iter().chain(document_and_package_steps()).chain(interface_steps())
}

/// The steps of builds for others: documentation, browsers, other machines.
fn build_steps() -> [Step; 4] {
    [
        Step {
            name: "docs".into(),
            about: "the documentation builds without warnings".into(),
            action: Action::Documentation,
        },
        Step::cargo(
            "api",
            "the public interfaces are as docs/api lists them, and as the version promises",
            &["xtask api"],
        ),
        // As processes, so that their SKIPPED lines are repeated at the end.
        Step::cargo(
            "web",
            "the explorer builds for browsers, and its files are no larger than they may be",
            &["xtask web --skip-without-tools"],
        ),
        Step::cargo(
            "determinism",
            "debug, release, WebAssembly and AArch64 give the same bytes, with every number of threads",
            &["xtask determinism", "xtask determinism --targets=aarch64"],
        ),
    ]
}

/// The steps of what is handed out: after those that build the release program, with which they
/// render.
fn document_and_package_steps() -> [Step; 4] {
    [
        Step::built_in(
            "site",
            "the documentation becomes pages: the guides' commands work, and links lead somewhere",
            crate::docs::check_docs,
        ),
        Step::cargo(
            "book",
            "the book's code, figures and numbers work, its links lead somewhere, both editions are whole",
            &["xtask book --test", "test --workspace --doc book_pages"],
        ),
        Step::cargo(
            "crates",
            "every crate can be packed for the registry, with what its manifest has to say",
            &["xtask release --crates"],
        ),
        Step::cargo(
            "package",
            "the Debian package works in an empty Debian, and its removal leaves nothing there",
            &["xtask release --deb"],
        ),
    ]
}

/// The steps of the interfaces that have tool chains of their own, and what everything costs.
fn interface_steps() -> [Step; 4] {
    [
        Step::cargo(
            "browser",
            "the explorer's lessons hold in a browser, by mouse and by keyboard",
            &["xtask browser"],
        ),
        Step::cargo(
            "python",
            "the wheel makes pictures in an empty environment, and its tests pass",
            &["xtask python"],
        ),
        Step::cargo("dxf", "DXF files pass the audit of another program", &["xtask dxf"]),
        Step::cargo(
            "instructions",
            "fixed workloads take no more instructions than are recorded",
            &["xtask bench --instructions"],
        ),
    ]
}

/// A step for each integration test of `alberti-tests`, described by the first sentence of its
/// file.
fn integration_tests(metadata: &Metadata) -> Result<Vec<Step>, String> {
    let package = metadata.package("alberti-tests").ok_or("there is no package alberti-tests")?;
    let step = |(name, path): &(String, PathBuf)| {
        let call = format!("test --workspace --test {name}");
        Ok(Step::cargo(name, &first_sentence(&read_text(path)?), &[&call]))
    };
    package.tests.iter().map(step).collect()
}

/// Flags for the integration tests of the crates, besides those of mathematics.
fn tests_of_crates(metadata: &Metadata) -> String {
    let others = metadata.packages.iter().filter(|package| {
        package.name != "alberti-tests" && !NO_STD.contains(&short_name(&package.name))
    });
    others.flat_map(|package| &package.tests).map(|(name, _)| format!(" --test {name}")).collect()
}

/// The first sentence of a file's documentation.
fn first_sentence(source: &str) -> String {
    let lines = source.lines().map_while(|line| line.strip_prefix("//!"));
    let text =
        lines.map(str::trim).take_while(|line| !line.is_empty()).collect::<Vec<_>>().join(" ");
    text.split_once(". ")
        .map_or(text.as_str(), |(sentence, _)| sentence)
        .trim_end_matches('.')
        .to_owned()
}

/// A line per step: its name and what it tests.
fn list_steps(steps: &[Step]) -> String {
    let lines: Vec<String> =
        steps.iter().map(|step| format!("  {:12} {}", step.name, step.about)).collect();
    lines.join("\n")
}

/// Prints each step with its time, then the skipped parts, then the counts.
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
    println!("  {:.0} s in total", time.as_secs_f64());
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
