//! `alberti reference` and `alberti scene doc`: flags, scene fields, formulas and JSON.
//!
//! ```text
//!  clap's commands ─► flags ──┐
//!  scene::reference ─► fields ┴─► sections ─► search by a word ─► text, Markdown, HTML
//! ```
//!
//! Flags and fields are both reduced to sections with entries, the only form that the search and
//! the output formats handle. Descriptions come from doc comments and help texts, so each is
//! written only once.

mod fields;
mod flags;
mod formula;
mod html;
mod markdown;
mod schema;
mod search;
mod text;

pub(super) use text::wrap_paragraphs;

use super::{CliError, print_stdout};
use clap::{Command, ValueEnum};
use explain::formulas::{Formula, entries, find_formula, find_formulas};
use schema::SchemaName;

/// Arguments of `alberti reference` and `alberti scene doc`.
#[derive(Debug, clap::Args)]
pub(crate) struct ReferenceArgs {
    /// Flag, command, type, field, field path, formula or code [default: all flags and fields]
    ///
    /// Examples: --size, LookAt, PE-1 (a formula), C61 (a topic of the book), M14 (a misprint). A
    /// word from a formula's name or text lists the matching ids; `formulas` lists all formulas.
    #[arg(allow_hyphen_values = true)]
    word: Option<String>,
    /// Output format
    #[arg(long, default_value = "text")]
    format: ReferenceFormat,
}

/// Arguments of `alberti reference`: the arguments of `scene doc`, and schemas.
#[derive(Debug, clap::Args)]
pub(crate) struct FullReferenceArgs {
    #[command(flatten)]
    sections: ReferenceArgs,
    /// Print the JSON Schema of a command's output
    ///
    /// Schemas use draft 2020-12. Any release may add members. The version in a document increases
    /// when a member is removed or changes its meaning.
    #[arg(long, value_name = "NAME", conflicts_with_all = ["word", "format"])]
    schema: Option<SchemaName>,
}

/// The value of `--format`.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum ReferenceFormat {
    /// Plain text, wrapped at 100 columns
    Text,
    /// Markdown
    Markdown,
    /// A self-contained HTML page
    Html,
}

/// A section of the reference: a command, or a scene file type.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
struct ReferenceSection {
    /// The command, or the name of the type.
    title: String,
    /// The description, in paragraphs separated by empty lines.
    about: String,
    /// The flags, fields or variants.
    entries: Vec<ReferenceEntry>,
}

/// An entry of the reference: a flag, a field, a variant or a possible value.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
struct ReferenceEntry {
    /// The name as written.
    term: String,
    /// The type or value name.
    value: String,
    /// A short remark, such as `required`.
    note: String,
    /// The description.
    about: String,
    /// The fields of a variant, or the possible values of a flag.
    inner: Vec<Self>,
}

/// Prints the reference for flags and scene files, a formula, or a schema.
///
/// # Errors
/// Returns an error if nothing has the requested name.
pub(crate) fn run(args: &FullReferenceArgs, program: Command) -> Result<(), CliError> {
    if let Some(schema) = args.schema {
        return print_stdout(schema.schema_text().as_bytes());
    }
    let args = &args.sections;
    let word = args.word.as_deref().unwrap_or_default();
    if let Some(formula) = find_formula(word) {
        return print_stdout(formula::format_formula(&formula, args.format).as_bytes());
    }
    if word == "formulas" {
        let names = entries().map(|entry| format!("{}\n", entry.name));
        return print_stdout(names.collect::<String>().as_bytes());
    }
    let flags = flags::command_sections(program);
    let sections: Vec<ReferenceSection> =
        flags.into_iter().chain(fields::type_sections()).collect();
    let found = match &args.word {
        Some(word) => match (search::find_sections(&sections, word), find_formulas(word)) {
            (Ok(found), formulas) => {
                // If flags and fields only mention the word, include formulas that mention it.
                let spoken = search::is_only_mentioned(&found, word);
                let titled = formulas.into_iter().filter(|(_, in_name)| *in_name || spoken);
                found.into_iter().chain(formula::list_section(titled)).collect()
            }
            (Err(_), formulas) if !formulas.is_empty() => {
                formula::list_section(formulas.into_iter()).into_iter().collect()
            }
            (Err(message), _) => match formula::list_section(formulas_with(word)) {
                Some(section) => vec![section],
                None => return Err(CliError::Usage(message + FORMULAS_HINT)),
            },
        },
        None => sections,
    };
    print_sections(args, "Alberti reference", &found)
}

/// The hint for a word that matches nothing.
const FORMULAS_HINT: &str =
    "\n  = help: `alberti reference formulas` lists the formulas, with their ids";

/// Returns the formulas whose ids begin with the word, such as `HO`, or that contain it as a
/// symbol, such as `M_vp`.
fn formulas_with(word: &str) -> impl Iterator<Item = (Formula, bool)> {
    let prefix = format!("{}-", word.to_uppercase());
    let symbol = word.contains('_').then(|| word.to_owned());
    let has = move |entry: &Formula| {
        let in_text = |symbol: &String| entry.name.contains(symbol) || entry.text.contains(symbol);
        let ids = entry.name.split([',', ' ']);
        ids.into_iter().any(|id| id.starts_with(&prefix)) || symbol.as_ref().is_some_and(in_text)
    };
    entries().filter(has).map(|entry| (entry, true))
}

/// Prints the scene file reference.
pub(crate) fn run_fields(args: &ReferenceArgs) -> Result<(), CliError> {
    let sections = fields::type_sections();
    let sections = match &args.word {
        Some(word) => search::find_sections(&sections, word).map_err(CliError::Usage)?,
        None => sections,
    };
    print_sections(args, "Scene file reference", &sections)
}

/// Prints sections in the format that the flags select.
fn print_sections(
    args: &ReferenceArgs,
    title: &str,
    sections: &[ReferenceSection],
) -> Result<(), CliError> {
    print_stdout(
        match args.format {
            ReferenceFormat::Text => text::format_text(sections),
            ReferenceFormat::Markdown => markdown::format_markdown(title, sections),
            ReferenceFormat::Html => html::format_html(title, sections),
        }
        .as_bytes(),
    )
}
