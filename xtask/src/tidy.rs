//! `cargo xtask tidy`: checks project rules that no lint covers.
//!
//! Each rule is a function from sources to violations. Each module contains the rules for one
//! subject.

mod boundaries;
mod code;
mod comments;
mod commits;
mod crate_map;
mod documents;
mod names;
mod phrases;
mod scenes;
mod signatures;
mod size;
mod source;
mod terms;
mod words;

use crate::Outcome;
pub use boundaries::{LAYERS, NO_STD};
pub use source::{Source, rust_files};

/// A rule violation, with its location and what to do about it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Violation {
    /// The path of the file, relative to the workspace root, with the line number if there is one.
    pub location: String,
    /// The rule, as an instruction.
    pub message: String,
}

impl Violation {
    /// Creates a violation at `FILE:LINE` or in a whole file.
    pub fn new(location: impl Into<String>, message: impl Into<String>) -> Self {
        Self { location: location.into(), message: message.into() }
    }
}

/// The rules that apply to a single Rust file.
const FILE_RULES: &[fn(&Source) -> Vec<Violation>] = &[
    size::file_length,
    size::function_length,
    size::argument_count,
    signatures::tuple_parameters,
    boundaries::crate_boundaries,
    boundaries::no_std_where_promised,
    words::module_docs,
    words::unfinished_markers,
    words::printing_macros,
];

/// Checks all rules and lists every violation.
pub fn run_tidy(arguments: &[String]) -> Outcome {
    match arguments {
        [] => {}
        [flag] if flag == "--bless" => return crate_map::write_map(),
        _ => return Err(format!("unknown arguments `{}`", arguments.join(" "))),
    }
    let sources = rust_files()?;
    for long in sources.iter().filter_map(size::long_file) {
        println!("note: {}: {}", long.location, long.message);
    }
    let mut violations: Vec<Violation> =
        sources.iter().flat_map(|source| FILE_RULES.iter().flat_map(|rule| rule(source))).collect();
    violations.extend(names::repeated_types(&sources));
    violations.extend(names::functions_named_of(&sources));
    violations.extend(comments::wide_lines(&sources));
    violations.extend(comments::empty_openings(&sources));
    violations.extend(comments::unlisted_formulas(&sources)?);
    let files = source::text_files()?;
    violations.extend(words::machine_path_mentions(&files));
    violations.extend(phrases::phrases(&files));
    violations.extend(terms::chinese_variants(&files));
    violations.extend(boundaries::dependencies()?);
    violations.extend(crate_map::outdated_map()?);
    violations.extend(crate_map::crate_lengths(&sources));
    violations.extend(scenes::goldens_and_table()?);
    violations.extend(documents::broken_links()?);
    violations.extend(documents::citation_version()?);
    violations.extend(commits::large_commits_without_reason());
    if violations.is_empty() {
        println!("{} Rust files are tidy", sources.len());
        return Ok(());
    }
    let lines = violations
        .iter()
        .map(|violation| format!("\n  {}: {}", violation.location, violation.message));
    Err(format!("{} rule violations{}", violations.len(), lines.collect::<String>()))
}
