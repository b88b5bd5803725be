//! `cargo xtask book`: builds the book in English and Chinese, in target/book/en and
//! target/book/zh.
//!
//! ```text
//! book                    build both editions
//! book --language CODE    build one
//! book --check            check the built editions: links, ids, sizes, topics, search, layout
//! book --test             test the builder, build the book, check the editions and the catalogs
//! book --pdf              print each edition to PDF with Chromium
//! book --pot              write catalog templates for translators to target/book/pot
//! book --update [PAGE…]   update the catalogs in book/po from the pages
//! book --check-po [PAGE…] check the catalogs
//! book --coverage         print how much of each page is translated
//! ```
//!
//! The work is done by a separate package, `book/mdbook-alberti`, because nothing else needs
//! mdBook.

mod pdf;

use crate::Outcome;
use crate::browser::{current_site, missing_tool};
use crate::program::{Build, Program, cargo_command, compile, run_visibly};
use crate::skip::report_skip;
use crate::web::{list_lessons, missing_tools};
use crate::workspace::{create_folder, list_files, project_root, read_text, target_folder};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The package that builds the book.
const BUILDER: &str = "book/mdbook-alberti/Cargo.toml";

/// The percentage of messages that must be translated.
const COVERAGE: &str = "98";

/// Runs the command named by the first argument, or builds the book if there are no arguments.
pub fn run_book(arguments: &[String]) -> Outcome {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        [] => build_editions(&[]),
        ["--language", code] => build_editions(&["--language", code]),
        ["--check"] => check_editions(),
        ["--test"] => test_book(),
        ["--pdf"] => pdf::print_editions(&book_folder()),
        ["--pot"] => {
            let folder = book_folder().join("pot");
            run_builder("pot", &[&folder.to_string_lossy()])
        }
        ["--update", pages @ ..] => run_builder("update", pages),
        ["--check-po", pages @ ..] => run_builder("check-po", pages),
        ["--coverage"] => run_builder("coverage", &[]),
        _ => Err(
            "book [--language CODE | --check | --test | --pdf | --pot | --update | --check-po | --coverage]"
                .into(),
        ),
    }
}

/// Runs the book step of the tests.
fn test_book() -> Outcome {
    let mut tests = cargo_command(&["test", "--quiet", "--locked", "--manifest-path", BUILDER]);
    compile(|| run_visibly(tests.env("CARGO_TARGET_DIR", builder_target())))?;
    build_editions(&[])?;
    run_builder("coverage", &["--assert", COVERAGE])?;
    run_builder("check-po", &[])?;
    check_editions()
}

/// Returns the folder of the editions.
fn book_folder() -> PathBuf {
    target_folder().join("book")
}

/// Returns the folder in which the builder is compiled.
fn builder_target() -> PathBuf {
    target_folder().join("book-build")
}

fn build_editions(flags: &[&str]) -> Outcome {
    let program = Program::build(Build::Release)?;
    copy_explorer(&book_folder().join("explorer"))?;
    let path = program.path().to_string_lossy().into_owned();
    run_builder("build", &[&["--program", &path], flags].concat())
}

/// Copies the explorer's page next to the editions. If the page has not been built, the editions
/// omit their links to it.
fn copy_explorer(folder: &Path) -> Outcome {
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    match current_site() {
        Some(site) => copy_folder(&site, folder),
        None => {
            report_skip(
                "book",
                "links to the explorer: its page is missing; build it with `cargo xtask web`",
            );
            Ok(())
        }
    }
}

fn copy_folder(from: &Path, to: &Path) -> Outcome {
    create_folder(to)?;
    let entries = fs::read_dir(from).map_err(|error| format!("{}: {error}", from.display()))?;
    for path in entries.flatten().map(|entry| entry.path()) {
        let target = to.join(path.file_name().unwrap_or_default());
        if path.is_dir() {
            copy_folder(&path, &target)?;
        } else {
            fs::copy(&path, &target).map_err(|error| format!("{}: {error}", path.display()))?;
        }
    }
    Ok(())
}

/// Checks links, ids, sizes and topics, then search and layout if there is a browser.
fn check_editions() -> Outcome {
    run_builder("check", &[])?;
    check_lessons()?;
    let folder = project_root().join("tests/browser");
    if let Some(missing) = missing_tool(&folder) {
        report_skip("book", &format!("search and layout in a browser: {missing}"));
        return Ok(());
    }
    let mut node = Command::new("node");
    run_visibly(node.current_dir(&folder).arg("book.mjs").arg(book_folder()))
}

/// Checks that links to the explorer name existing lessons.
fn check_lessons() -> Outcome {
    let site = book_folder().join("explorer");
    if !site.is_dir() || missing_tools().is_some() {
        report_skip("book", "lessons in links to the explorer: its page is not next to the book");
        return Ok(());
    }
    let lessons = list_lessons(&site)?;
    let known: BTreeSet<&str> = lessons.iter().filter_map(|it| it["id"].as_str()).collect();
    let mut faults = Vec::new();
    for page in list_files(&book_folder().join("en"), "html")? {
        let html = read_text(&page)?;
        let links = html.split("../explorer/index.html#").skip(1);
        let queries = links.filter_map(|link| link.split('"').next());
        let names = queries.filter_map(|query| query.split("lesson=").nth(1)?.split('&').next());
        let unknown = names.filter(|name| !known.contains(name));
        faults.extend(unknown.map(|name| format!("{}: no lesson `{name}`", page.display())));
    }
    if faults.is_empty() { Ok(()) } else { Err(faults.join("\n")) }
}

fn run_builder(command: &str, arguments: &[&str]) -> Outcome {
    let mut cargo =
        cargo_command(&["run", "--quiet", "--locked", "--manifest-path", BUILDER, "--", command]);
    cargo.env("CARGO_TARGET_DIR", builder_target());
    run_visibly(cargo.args(arguments).arg("--out").arg(book_folder()))
}
