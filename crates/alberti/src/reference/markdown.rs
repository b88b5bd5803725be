//! The reference as Markdown.

use super::{ReferenceEntry, ReferenceSection};

/// Returns the document: a heading for each section, and a nested list of its entries.
pub(super) fn format_markdown(title: &str, sections: &[ReferenceSection]) -> String {
    let mut page = format!("# {title}\n");
    for section in sections {
        page.push_str(&format!("\n## {}\n", section.title));
        if !section.about.is_empty() {
            page.push_str(&format!("\n{}\n", escape_markdown(&section.about)));
        }
        if !section.entries.is_empty() {
            page.push('\n');
        }
        section.entries.iter().for_each(|entry| write_entry(&mut page, entry, 0));
    }
    page
}

/// Appends an entry as a list item, then its inner entries.
///
/// ```text
/// - `--size` `<WxH>` — Width and height of the picture in pixels, such as 1920x1080
/// ```
/// Paragraphs are joined, because an empty line would end the list item.
fn write_entry(page: &mut String, entry: &ReferenceEntry, depth: usize) {
    let value = match (entry.value.is_empty(), entry.term.starts_with('-')) {
        (true, _) => String::new(),
        (false, true) => format!(" `{}`", entry.value),
        (false, false) => format!(": {}", entry.value),
    };
    let note = if entry.note.is_empty() { String::new() } else { format!(" ({})", entry.note) };
    let about = escape_markdown(&entry.about).replace("\n\n", " ");
    let dash = if about.is_empty() { "" } else { " — " };
    page.push_str(&format!("{}- `{}`{value}{note}{dash}{about}\n", "  ".repeat(depth), entry.term));
    entry.inner.iter().for_each(|inner| write_entry(page, inner, depth + 1));
}

/// Escapes angle brackets, asterisks and underscores outside code spans.
///
/// Angle brackets could start tags, and the other two emphasis. Code spans need no escapes.
fn escape_markdown(text: &str) -> String {
    let parts = text.split('`').enumerate().map(|(number, part)| match number % 2 {
        0 => part.replace('<', "&lt;").replace('*', "\\*").replace('_', "\\_"),
        _ => part.to_owned(),
    });
    parts.collect::<Vec<_>>().join("`")
}
