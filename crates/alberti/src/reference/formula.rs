//! A formula from the reference, as text, Markdown or HTML.
//!
//! The text comes from `docs/formulas.md`, which is embedded in the program; paragraphs are
//! wrapped, and matrices and tables stay unchanged.

use super::text::wrap_paragraphs;
use super::{ReferenceEntry, ReferenceFormat, ReferenceSection};
use explain::formulas::Formula;

/// Returns the entry for a formula: name, formula, meaning, sources and a command.
pub(super) fn format_formula(formula: &Formula, format: ReferenceFormat) -> String {
    match format {
        ReferenceFormat::Text => plain_text(formula),
        ReferenceFormat::Markdown => format!("# {formula}"),
        ReferenceFormat::Html => formula.to_html(),
    }
}

/// Returns the entry with wrapped paragraphs, without Markdown markup.
fn plain_text(formula: &Formula) -> String {
    let mut page = String::new();
    let mut paragraph = String::new();
    let mut verbatim = false;
    let text = formula.to_string();
    for line in text.lines() {
        let is_fence = line.starts_with("```");
        if verbatim && !is_fence || line.starts_with('|') {
            page.push_str(&format!("  {line}\n"));
        } else if is_fence || line.is_empty() {
            push_paragraph(&mut page, &mut paragraph);
            verbatim ^= is_fence;
        } else if ["Source: ", "Command: ", "Book: "].iter().any(|word| line.starts_with(word)) {
            page.push_str(&format!("  {line}\n"));
        } else {
            paragraph += &format!("{} ", line.replace('`', ""));
        }
    }
    push_paragraph(&mut page, &mut paragraph);
    page.trim_start().to_owned()
}

/// Appends a paragraph, wrapped, with an empty line below it.
fn push_paragraph(page: &mut String, paragraph: &mut String) {
    if !page.is_empty() && !page.ends_with("\n\n") {
        page.push('\n');
    }
    if !paragraph.is_empty() {
        wrap_paragraphs(page, paragraph, 2);
        page.push('\n');
        paragraph.clear();
    }
}

/// Returns the section that lists formulas, or `None` if there are no formulas.
pub(super) fn list_section(
    formulas: impl Iterator<Item = (Formula, bool)>,
) -> Option<ReferenceSection> {
    let entry = |(formula, _): (Formula, bool)| ReferenceEntry {
        term: formula.name.to_owned(),
        about: formula.equations().next().unwrap_or_default().to_owned(),
        ..ReferenceEntry::default()
    };
    let entries: Vec<ReferenceEntry> = formulas.map(entry).collect();
    let section = ReferenceSection {
        title: "Formulas".to_owned(),
        about: "To print a formula, run alberti reference with its id, such as PE-1.".to_owned(),
        entries,
    };
    (!section.entries.is_empty()).then_some(section)
}
