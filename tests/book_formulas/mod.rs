//! Compares the numbered formulas of the book with the crates.
//!
//! A formula in the book is LaTeX with an id and `% check` lines, which specify the values for
//! which it must agree with a public function: `% check n=-2 f=-5 : PE-1`. The LaTeX itself is
//! evaluated, so the test covers the formula as printed. Then each number, sign and letter of the
//! formula is changed, one at a time. A change that no check detects is also an error, because a
//! misprint there would pass.

#![allow(clippy::unwrap_used, clippy::panic, reason = "unreadable input fails the test")]

mod check_line;
mod compare;
mod evaluate;
mod expression;
mod name;
mod name_parser;
mod page;
mod parser;
mod registry;
mod scope;
mod statement;
mod token;
mod value;

use alberti_tests::skip::report_skip;
use compare::Counts;
use std::fs;
use std::io::Write;
use std::path::PathBuf;

/// Returns the folder in `$BOOK`, or else the book in this repository; `None` if there is no book.
fn book_folder() -> Option<PathBuf> {
    if let Some(folder) = std::env::var_os("BOOK") {
        return Some(folder.into());
    }
    let folder = alberti_tests::project_root().join("book/src");
    folder.is_dir().then_some(folder)
}

/// Prints a line that is visible even if the test passes.
fn print_uncaptured(line: &str) {
    std::io::stdout().write_all(format!("\n{line}\n").as_bytes()).unwrap();
}

#[test]
fn formulas_of_the_book_agree_with_the_crates() {
    let Some(folder) = book_folder() else {
        return report_skip("book_formulas", "the folder book/src is missing");
    };
    let mut pages: Vec<PathBuf> = match fs::read_dir(&folder) {
        Ok(entries) => entries.map(|entry| entry.unwrap().path()).collect(),
        Err(error) => panic!("{}: {error}", folder.display()),
    };
    pages.retain(|page| page.extension().is_some_and(|extension| extension == "md"));
    pages.sort_unstable();
    let (mut counts, mut faults) = (Counts::default(), Vec::new());
    for path in &pages {
        let text = fs::read_to_string(path).unwrap();
        for formula in page::find_formulas(&text) {
            let found = compare::find_faults(&formula, &mut counts);
            faults.extend(found.iter().map(|fault| format!("{}:{fault}", path.display())));
        }
    }
    let Counts { numbered, checks, damages, names } = counts;
    print_uncaptured(&format!(
        "{numbered} numbered formulas, {checks} checks, {damages} changed formulas"
    ));
    // A name that no page uses is not tested, but other books need not use all names.
    if std::env::var_os("BOOK").is_none() {
        let unused = registry::all_entries().filter(|entry| !names.contains(entry.name));
        faults.extend(unused.map(|entry| format!("registry: no check uses {}", entry.name)));
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
    assert!(numbered > 0, "{} has no numbered formulas", folder.display());
}
