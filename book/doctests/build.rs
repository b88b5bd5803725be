//! Lists the pages of the book as modules whose documentation is their Rust code.
//!
//! All other lines are left empty, so that a failure names the line of the page: figures, formulas
//! and outputs are blocks that rustdoc would warn about.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

fn main() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src");
    println!("cargo:rerun-if-changed={}", folder.display());
    let out = env::var_os("OUT_DIR").expect("Cargo names the folder");
    let out = Path::new(&out);
    let files = fs::read_dir(&folder).expect("the pages of the book").flatten();
    let mut names: Vec<String> = files
        .filter_map(|entry| entry.file_name().to_str()?.strip_suffix(".md").map(str::to_owned))
        .collect();
    names.sort();
    let mut modules = String::new();
    for name in names {
        let text = fs::read_to_string(folder.join(format!("{name}.md"))).expect("a page");
        let code = out.join(format!("{name}.md"));
        fs::write(&code, rust_lines(&text)).expect("the folder can be written to");
        // Writing to a text does not fail.
        let _ = writeln!(
            modules,
            "#[doc = include_str!({code:?})]\nmod {} {{}}",
            name.replace('-', "_").to_lowercase()
        );
    }
    fs::write(out.join("pages.rs"), modules).expect("the folder can be written to");
}

/// A page with nothing but its title, where rustdoc begins to count lines, and its blocks of Rust.
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
