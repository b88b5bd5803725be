//! `alberti reference` and `alberti scene doc`: every flag, and every field of scene files.
//!
//! ```text
//!  clap's commands ─► flags ──┐
//!  scene::reference ─► fields ┴─► sections ─► those that match a word ─► text, Markdown, HTML
//! ```

mod fields;
mod flags;
mod html;
mod markdown;
mod search;
mod text;

use super::{CliError, print_stdout};
use clap::{Command, ValueEnum};

#[derive(Debug, clap::Args)]
pub(crate) struct ReferenceArgs {
    /// A flag, a command, a type, a field or a path of fields, such as --size, render, LookAt or camera.projection [default:
    /// everything]
    #[arg(allow_hyphen_values = true)]
    word: Option<String>,
    /// How it is written
    #[arg(long, default_value = "text")]
    format: ReferenceFormat,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum ReferenceFormat {
    /// Lines of up to 100 columns
    Text,
    /// Markdown
    Markdown,
    /// A page that needs no other file
    Html,
}

/// A part of the reference: a command, or a type of scene files.
#[derive(Clone, Debug, Default)]
struct ReferenceSection {
    title: String,
    about: String,
    entries: Vec<ReferenceEntry>,
}

/// A flag, a field, or a word to choose.
#[derive(Clone, Debug, Default)]
struct ReferenceEntry {
    /// Its name, as it is written.
    term: String,
    /// What kind of value it has.
    value: String,
    /// Whether it may be left out, and other remarks in few words.
    note: String,
    about: String,
    /// The fields of a variant, the words that a flag takes.
    inner: Vec<Self>,
}

/// Prints the reference of the flags and of scene files.
pub(crate) fn run(args: &ReferenceArgs, program: Command) -> Result<(), CliError> {
    let flags = flags::command_sections(program);
    print_reference(
        args,
        "Reference of Alberti",
        flags.into_iter().chain(fields::type_sections()).collect(),
    )
}

/// Prints the reference of scene files.
pub(crate) fn run_fields(args: &ReferenceArgs) -> Result<(), CliError> {
    print_reference(args, "Reference of scene files", fields::type_sections())
}

fn print_reference(
    args: &ReferenceArgs,
    title: &str,
    sections: Vec<ReferenceSection>,
) -> Result<(), CliError> {
    let sections = match &args.word {
        Some(word) => search::find_sections(&sections, word).map_err(CliError::Usage)?,
        None => sections,
    };
    print_stdout(
        match args.format {
            ReferenceFormat::Text => text::format_text(&sections),
            ReferenceFormat::Markdown => markdown::format_markdown(title, &sections),
            ReferenceFormat::Html => html::format_html(title, &sections),
        }
        .as_bytes(),
    )
}
