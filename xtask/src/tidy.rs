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
pub struct Fault {
    /// The file from the root, with a line where there is one.
    pub place: String,
    pub message: String,
}

impl Fault {
    pub fn new(place: impl Into<String>, message: impl Into<String>) -> Self {
        Self { place: place.into(), message: message.into() }
    }
}

/// The rules for a single file of Rust.
const FILE_RULES: &[fn(&Source) -> Vec<Fault>] = &[
    size::file_length,
    size::function_length,
    boundaries::only_one_names,
    boundaries::no_std_where_promised,
    words::opening,
    words::unfinished,
    words::printing,
];

pub fn run(arguments: &[String]) -> Outcome {
    if let Some(argument) = arguments.first() {
        return Err(format!("unknown argument `{argument}`"));
    }
    let sources = rust_files()?;
    for long in sources.iter().filter_map(size::long_file) {
        println!("note: {}: {}", long.place, long.message);
    }
    let mut faults: Vec<Fault> =
        sources.iter().flat_map(|source| FILE_RULES.iter().flat_map(|rule| rule(source))).collect();
    faults.extend(words::machine_paths(&source::text_files()?));
    faults.extend(boundaries::dependencies()?);
    faults.extend(scenes::goldens_and_table()?);
    faults.extend(documents::links()?);
    if faults.is_empty() {
        println!("{} files of Rust are tidy", sources.len());
        return Ok(());
    }
    let lines = faults.iter().map(|fault| format!("\n  {}: {}", fault.place, fault.message));
    Err(format!("{} rules are broken{}", faults.len(), lines.collect::<String>()))
}
