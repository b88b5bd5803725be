//! Rules for comments: their width, their opening words, and the formulas that they cite.

use super::Violation;
use super::source::Source;
use crate::workspace::{project_root, read_text};
use std::collections::BTreeSet;

/// The maximum width of code and comments, in columns.
const MAX_COLUMNS: usize = 100;
/// The number of wider comment lines that remain. It may only fall.
const WIDE_LINES_LEFT: usize = 700;

/// Openings that mean nothing until the reader has looked up another item.
const EMPTY_OPENINGS: [&str; 2] = ["What ", "The same "];
/// The number of doc comments with such an opening that remain. It may only fall.
const EMPTY_OPENINGS_LEFT: usize = 300;

/// The file that lists the formulas.
const FORMULAS: &str = "docs/formulas.md";
/// Names that look like formula ids but are not.
const NOT_FORMULAS: [&str; 7] =
    ["UTF-8", "UTF-16", "SHA-256", "AVX-512", "ECMA-48", "PDF-1", "SSE-2"];

/// Finds comment lines that are too wide.
pub fn wide_lines(sources: &[Source]) -> Vec<Violation> {
    let wide = |line: &str| line.chars().count() > MAX_COLUMNS && line.trim().starts_with("//");
    let message = format!("a comment is wider than {MAX_COLUMNS} columns");
    beyond_budget(lines_that(sources, wide, &message), WIDE_LINES_LEFT)
}

/// Finds doc comments that open with words that refer to another item.
pub fn empty_openings(sources: &[Source]) -> Vec<Violation> {
    let is_empty = |line: &str| {
        let text = line.trim().strip_prefix("///").or(line.trim().strip_prefix("//!"));
        text.is_some_and(|text| EMPTY_OPENINGS.iter().any(|word| text.trim().starts_with(word)))
    };
    let message = "begin with the technical term for the thing itself";
    beyond_budget(lines_that(sources, is_empty, message), EMPTY_OPENINGS_LEFT)
}

/// Finds formulas that are cited but not listed.
pub fn unlisted_formulas(sources: &[Source]) -> Result<Vec<Violation>, String> {
    Ok(unlisted_ids(sources, &read_text(&project_root().join(FORMULAS))?))
}

fn unlisted_ids(sources: &[Source], list: &str) -> Vec<Violation> {
    let listed: BTreeSet<&str> = formula_ids(list).collect();
    let mut violations = Vec::new();
    for source in sources.iter().filter(|source| !source.path.starts_with("xtask/")) {
        for (index, line) in source.text.lines().enumerate() {
            for id in formula_ids(line).filter(|id| !listed.contains(id)) {
                let message = format!("the formula {id} is not listed in {FORMULAS}");
                violations.push(Violation::new(source.line_text(index + 1), message));
            }
        }
    }
    violations
}

/// Returns the ids in text: two to five capital letters or digits, a hyphen and a number.
fn formula_ids(text: &str) -> impl Iterator<Item = &str> {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '-' && c != '_');
    words.filter(|word| {
        let Some((letters, number)) = word.split_once('-') else { return false };
        (2..=5).contains(&letters.len())
            && letters.starts_with(|c: char| c.is_ascii_uppercase())
            && letters.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit())
            && !number.is_empty()
            && number.chars().all(|c| c.is_ascii_digit())
            && !NOT_FORMULAS.contains(word)
    })
}

fn lines_that(sources: &[Source], is_bad: impl Fn(&str) -> bool, message: &str) -> Vec<Violation> {
    let mut violations = Vec::new();
    for source in sources {
        let bad = source.text.lines().enumerate().filter(|(_, line)| is_bad(line));
        violations.extend(bad.map(|(at, _)| Violation::new(source.line_text(at + 1), message)));
    }
    violations
}

/// Returns the violations if there are more than `left`, the known ones that remain, or else none.
fn beyond_budget(violations: Vec<Violation>, left: usize) -> Vec<Violation> {
    if violations.len() <= left { Vec::new() } else { violations }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(text: &str) -> Vec<Source> {
        vec![Source::new("crates/a/src/x.rs", text)]
    }

    #[test]
    fn comments_are_no_wider_than_code() {
        let line = |columns: usize| format!("/// {}\n", "ü".repeat(columns - 4));
        assert_eq!(wide_lines(&source(&line(MAX_COLUMNS))).len(), 0);
        let wide = line(MAX_COLUMNS + 1).repeat(WIDE_LINES_LEFT + 1);
        assert_eq!(wide_lines(&source(&wide)).len(), WIDE_LINES_LEFT + 1);
    }

    #[test]
    fn docs_must_not_open_with_a_reference_to_another_item() {
        let count = |line: &str| {
            empty_openings(&source(&line.repeat(EMPTY_OPENINGS_LEFT + 1))).len()
                / (EMPTY_OPENINGS_LEFT + 1)
        };
        assert_eq!(count("    /// What it is.\n"), 1);
        assert_eq!(count("//! The same without holes.\n"), 1);
        assert_eq!(count("// What about this?\n"), 0);
        assert_eq!(count("/// Whatever.\n"), 0);
    }

    #[test]
    fn cited_formulas_are_listed() {
        let ids: Vec<&str> = formula_ids("PE-1, (D3D-6); THREE-1: UTF-8, a-1, X-2, PE-x").collect();
        assert_eq!(ids, ["PE-1", "D3D-6", "THREE-1"]);
        let violations = unlisted_ids(&source("//! PE-1.\n/// PE-9\n"), "**PE-1, P** [S].");
        assert_eq!(violations.len(), 1);
        assert_eq!(violations[0].location, "crates/a/src/x.rs:2");
    }
}
