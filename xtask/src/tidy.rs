//! `cargo xtask tidy`: the rules of the house that no lint can check.
//!
//! Each rule is a function from what it looks at to the faults it finds; each file below holds the
//! rules of one subject.

mod boundaries;
mod code;
mod documents;
mod scenes;
mod size;
mod source;
mod words;

use crate::Outcome;
pub use boundaries::NO_STD;
pub use source::{Source, rust_files};

/// A broken rule: where, and what to do about it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Violation {
    /// The file from the root, with a line where there is one.
    pub location: String,
    pub message: String,
}

impl Violation {
    pub fn new(place: impl Into<String>, message: impl Into<String>) -> Self {
        Self { location: place.into(), message: message.into() }
    }
}

/// The rules for a single file of Rust.
const FILE_RULES: &[fn(&Source) -> Vec<Violation>] = &[
    size::file_length,
    size::function_length,
    boundaries::crate_boundaries,
    boundaries::no_std_where_promised,
    words::module_docs,
    words::unfinished_markers,
    words::printing_macros,
];

pub fn run_tidy(arguments: &[String]) -> Outcome {
    if let Some(argument) = arguments.first() {
        return Err(format!("unknown argument `{argument}`"));
    }
    let sources = rust_files()?;
    for long in sources.iter().filter_map(size::long_file) {
        println!("note: {}: {}", long.location, long.message);
    }
    let mut faults: Vec<Violation> =
        sources.iter().flat_map(|source| FILE_RULES.iter().flat_map(|rule| rule(source))).collect();
    faults.extend(words::machine_path_mentions(&source::text_files()?));
    faults.extend(boundaries::dependencies()?);
    faults.extend(scenes::goldens_and_table()?);
    faults.extend(documents::broken_links()?);
    if faults.is_empty() {
        println!("{} files of Rust are tidy", sources.len());
        return Ok(());
    }
    let lines = faults.iter().map(|fault| format!("\n  {}: {}", fault.location, fault.message));
    Err(format!("{} rules are broken{}", faults.len(), lines.collect::<String>()))
}
