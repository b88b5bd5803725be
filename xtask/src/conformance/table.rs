//! Writes the Markdown document `tests/CONFORMANCE.md`.

use super::book::BookMarks;
use super::items::{EXERCISES, ITEMS, Item, MISPRINTS};
use super::scan::Test;
use super::vectors::VECTORS;
use std::collections::BTreeMap;

/// The owner of topics outside mathematics.
const DOCUMENTS: &str = "documents";

const OPENING: &str = "\
# Conformance

This page lists the topics that the sources of this project teach, the exercises of the textbook's chapter, and the misprints found in
the sources, each with its tests. [docs/formulas.md](../docs/formulas.md) lists the sources and the formulas.

`cargo xtask conformance` generates this file from the tests: from their names (`c16_…`, `misprint_m11_…`, `exercise_3_…`) and
from the doc comments above them. `cargo xtask test conformance` fails if the file is out of date, or if one of the math
crates has no test for a topic that it implements.

“Not yet” marks a crate that implements a topic but has no test that cites it. The
[exact vectors](vectors/data/README.md) are a second, independent test. Topics outside mathematics are covered by a page of the book.
";

/// Writes the whole document.
pub fn conformance_document(tests: &[Test], marks: Option<&BookMarks>) -> String {
    let mut text = OPENING.to_owned();
    let sections: [(&str, &[Item]); 3] =
        [("Items", &ITEMS), ("Exercises", &EXERCISES), ("Misprints", &MISPRINTS)];
    for (heading, items) in sections {
        text += &format!("\n## {heading}\n\n| id | topic | tests |\n| --- | --- | --- |\n");
        for item in items {
            let proofs = item_proofs(item, tests, marks).join("<br>");
            text += &format!("| {} | {} | {proofs} |\n", item.id, item.title);
        }
    }
    text
}

/// Writes a line for each file with a test of the item, and lines for vectors and missing tests.
fn item_proofs(item: &Item, tests: &[Test], marks: Option<&BookMarks>) -> Vec<String> {
    let mut files: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for test in tests.iter().filter(|test| test.ids.contains(&item.id)) {
        files.entry(&test.path).or_default().push(&test.name);
    }
    let mut lines: Vec<String> =
        files.into_iter().map(|(path, names)| file_entry(path, &names)).collect();
    let vectors = VECTORS.iter().filter(|(_, ids)| ids.contains(&item.id.as_str()));
    let vectors: Vec<String> = vectors.map(|(name, _)| format!("`{name}`")).collect();
    if !vectors.is_empty() {
        lines.push(format!("vectors: {}", vectors.join(", ")));
    }
    if item.owners.contains(&DOCUMENTS) {
        let pages = marks.into_iter().flat_map(|marks| marks.pages_of(&item.id));
        let pages: Vec<String> =
            pages.map(|page| format!("[{page}](../book/src/{page}.md)")).collect();
        if !pages.is_empty() {
            lines.push(format!("book: {}", pages.join(", ")));
        }
    }
    let missing = item.owners.iter().filter(|owner| !has_evidence(item, owner, tests, marks));
    lines.extend(missing.map(|owner| format!("not yet: {owner}")));
    lines
}

fn file_entry(path: &str, names: &[&str]) -> String {
    let shown = path.strip_prefix("crates/").unwrap_or(path);
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    format!("[{shown}](../{path}): {}", names.join(", "))
}

/// Returns whether a crate has a test that names the item.
pub fn has_test(item: &Item, owner: &str, tests: &[Test]) -> bool {
    tests.iter().any(|test| test.owner() == owner && test.ids.contains(&item.id))
}

/// Returns whether a crate has a test that names the item. For a topic outside mathematics, returns
/// whether a page of the book marks it.
pub fn has_evidence(item: &Item, owner: &str, tests: &[Test], marks: Option<&BookMarks>) -> bool {
    if owner == DOCUMENTS {
        return marks.is_some_and(|marks| marks.pages_of(&item.id).next().is_some());
    }
    has_test(item, owner, tests)
}
