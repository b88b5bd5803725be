//! Generates a module for each page of the book, with the page's Rust code as its documentation.
//!
//! The page's other lines are left empty, so a failing doctest reports the line number in the page.
//! Figures, formulas and commands are omitted because rustdoc would warn about their blocks.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

fn main() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src");
    println!("cargo:rerun-if-changed={}", folder.display());
    let out = env::var_os("OUT_DIR").expect("Cargo sets OUT_DIR");
    let out = Path::new(&out);
    let files = fs::read_dir(&folder).expect("the folder of the pages is readable").flatten();
    let mut names: Vec<String> = files
        .filter_map(|entry| entry.file_name().to_str()?.strip_suffix(".md").map(str::to_owned))
        .collect();
    names.sort();
    let mut modules = String::new();
    for name in names {
        let text = fs::read_to_string(folder.join(format!("{name}.md"))).expect("a readable page");
        let code = out.join(format!("{name}.md"));
        fs::write(&code, rust_lines(&text)).expect("OUT_DIR is writable");
        // Writing to a string cannot fail.
        let _ = writeln!(
            modules,
            "#[doc = include_str!({code:?})]\nmod {} {{}}",
            name.replace('-', "_").to_lowercase()
        );
    }
    fs::write(out.join("pages.rs"), modules).expect("OUT_DIR is writable");
}

/// Blanks all lines except the Rust blocks and the title, the line from which rustdoc counts.
fn rust_lines(page: &str) -> String {
    let mut is_rust = false;
    let mut out = String::new();
    for (at, line) in page.lines().enumerate() {
        let is_fence = line.starts_with("```");
        let is_opening = is_fence && !is_rust && line.starts_with("```rust");
        if is_rust || is_opening || at == 0 {
            out.push_str(line);
        }
        out.push('\n');
        is_rust = is_opening || is_rust && !is_fence;
    }
    out
}
