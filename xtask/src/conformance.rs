//! `cargo xtask conformance`: writes the table of the sources' topics and their tests.
//!
//! The table, `tests/CONFORMANCE.md`, is generated from the source text of the tests, and
//! `docs/topics.md`, the topics by id, from the book. With `--check` they are compared instead of
//! written. In both modes, the command fails if a math crate
//! has no test for an item it is responsible for, or if a test names an unknown item. The book
//! marks every topic on the page that covers it, and its pages are the evidence for topics outside
//! mathematics.

mod book;
mod items;
mod scan;
mod table;
mod topics;
mod vectors;

use crate::Outcome;
use crate::skip::report_skip;
use crate::tidy::{Source, rust_files};
use crate::workspace::{project_root, read_text};
use book::BookMarks;
use scan::Test;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use topics::Chapters;
use vectors::VECTORS;

const TABLE_PATH: &str = "tests/CONFORMANCE.md";
const TOPICS_PATH: &str = "docs/topics.md";
const BOOK_PATH: &str = "book/src";
/// The path of the sources' inventory, relative to the root; `INVENTORY` overrides it.
const INVENTORY_PATH: &str = "../shared/inventory.md";

/// Writes the table, or compares it with `--check`; fails if a topic has no test.
pub fn run_conformance(arguments: &[String]) -> Outcome {
    let check = match arguments {
        [] => false,
        [flag] if flag == "--check" => true,
        _ => return Err(format!("unknown arguments `{}`", arguments.join(" "))),
    };
    let sources = rust_files()?;
    // The tests of this tool prove nothing about the mathematics, and some contain sample tests.
    let of_crates = sources.iter().filter(|source| !source.path.starts_with("xtask/"));
    let tests: Vec<Test> =
        of_crates.flat_map(|source| scan::scan_tests(&source.path, &source.text)).collect();
    let marks = BookMarks::read(&project_root().join(BOOK_PATH))?;
    let document = table::conformance_document(&tests, marks.as_ref());
    let mut faults = [
        missing_items(&tests),
        unknown_items(&tests),
        vectors_without_runner(&sources),
        differing_lists(&document, marks.as_ref())?,
    ]
    .concat();
    let mut documents = vec![(TABLE_PATH, document)];
    if let Some(marks) = &marks {
        documents.push((TOPICS_PATH, topics::topics_document(&Chapters::read()?, marks)));
    }
    for (path, document) in documents {
        let file = project_root().join(path);
        if !check {
            fs::write(&file, &document).map_err(|error| format!("{path}: {error}"))?;
        } else if read_text(&file).ok() != Some(document) {
            faults.push(format!("{path} is stale: run `cargo xtask conformance`"));
        }
    }
    if faults.is_empty() {
        println!("{}", coverage_summary(&tests, marks.as_ref()));
        return Ok(());
    }
    Err(format!("{} problems\n  {}", faults.len(), faults.join("\n  ")))
}

/// Finds items without a test in a math crate that is responsible for them.
fn missing_items(tests: &[Test]) -> Vec<String> {
    let lines = items::all_items().flat_map(|item| {
        let missing = item.complete_owners().filter(|owner| !table::has_test(item, owner, tests));
        missing.map(|owner| format!("{owner} has no test for {}: {}", item.id, item.title))
    });
    lines.collect()
}

/// Finds tests that name unknown items.
fn unknown_items(tests: &[Test]) -> Vec<String> {
    let lines = tests.iter().flat_map(|test| {
        let strange = test.ids.iter().filter(|id| items::all_items().all(|item| item.id != **id));
        strange.map(|id| format!("{}: `{}` names {id}, which is not an item", test.path, test.name))
    });
    lines.collect()
}

/// Finds topics that the inventory, the table or the marks in the book lack or have in addition.
fn differing_lists(document: &str, marks: Option<&BookMarks>) -> Result<Vec<String>, String> {
    let topics: BTreeSet<String> =
        items::ITEMS.iter().chain(items::MISPRINTS.iter()).map(|item| item.id.clone()).collect();
    let mut faults = Vec::new();
    faults
        .extend(book::compare_topics(TABLE_PATH, &book::inventory_topics(document), &topics).err());
    let named = std::env::var_os("INVENTORY").unwrap_or_else(|| INVENTORY_PATH.into());
    let inventory = project_root().join(Path::new(&named));
    if inventory.is_file() {
        let found = book::inventory_topics(&read_text(&inventory)?);
        faults.extend(book::compare_topics("the inventory", &found, &topics).err());
    } else {
        report_skip("the inventory of the sources", &format!("{} is missing", inventory.display()));
    }
    match marks {
        Some(marks) => faults.extend(marks.faults(&topics)),
        None => report_skip("the marks of the book", &format!("there is no {BOOK_PATH}")),
    }
    Ok(faults)
}

/// Finds vector files without a runner. Runners name their files as `("file", function)`.
fn vectors_without_runner(sources: &[Source]) -> Vec<String> {
    let runners = sources.iter().filter(|source| source.path.starts_with("tests/vectors/"));
    let runners: String = runners.map(|source| source.text.as_str()).collect();
    let strange = VECTORS.iter().filter(|(name, _)| !runners.contains(&format!("(\"{name}\", ")));
    strange.map(|(name, _)| format!("no runner in tests/vectors reads {name}")).collect()
}

fn coverage_summary(tests: &[Test], marks: Option<&BookMarks>) -> String {
    let naming = tests.iter().filter(|test| !test.ids.is_empty()).count();
    let all = items::all_items().count();
    let proved = |item: &&items::Item| {
        item.owners.iter().all(|owner| table::has_evidence(item, owner, tests, marks))
    };
    let proved = items::all_items().filter(proved).count();
    format!(
        "{naming} tests name topics; {proved} of {all} topics have a test in every crate that implements them"
    )
}
