//! Lists the pages of the book as modules with their text as documentation.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

fn main() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src");
    println!("cargo:rerun-if-changed={}", folder.display());
    let mut names: Vec<String> = fs::read_dir(&folder)
        .expect("the pages of the book")
        .flatten()
        .filter_map(|entry| entry.file_name().to_str()?.strip_suffix(".md").map(str::to_owned))
        .filter(|name| name != "SUMMARY")
        .collect();
    names.sort();
    let mut modules = String::new();
    for name in names {
        let path = folder.join(format!("{name}.md"));
        // Writing to a text does not fail.
        let _ = writeln!(
            modules,
            "#[doc = include_str!({path:?})]\nmod {} {{}}",
            name.replace('-', "_")
        );
    }
    let out = env::var_os("OUT_DIR").expect("Cargo names the folder");
    fs::write(Path::new(&out).join("pages.rs"), modules).expect("the folder can be written to");
}
