//! The reference as Markdown.

use super::{Entry, Section};

pub(super) fn page(title: &str, sections: &[Section]) -> String {
    let mut page = format!("# {title}\n");
    for section in sections {
        page.push_str(&format!("\n## {}\n", section.title));
        if !section.about.is_empty() {
            page.push_str(&format!("\n{}\n", escaped(&section.about)));
        }
        if !section.entries.is_empty() {
            page.push('\n');
        }
        section.entries.iter().for_each(|entry| write(&mut page, entry, 0));
    }
    page
}

fn write(page: &mut String, entry: &Entry, depth: usize) {
    let value = match (entry.value.is_empty(), entry.term.starts_with('-')) {
        (true, _) => String::new(),
        (false, true) => format!(" `{}`", entry.value),
        (false, false) => format!(": {}", entry.value),
    };
    let note = if entry.note.is_empty() { String::new() } else { format!(" ({})", entry.note) };
    let about = escaped(&entry.about).replace("\n\n", " ");
    let dash = if about.is_empty() { "" } else { " — " };
    page.push_str(&format!("{}- `{}`{value}{note}{dash}{about}\n", "  ".repeat(depth), entry.term));
    entry.inner.iter().for_each(|inner| write(page, inner, depth + 1));
}

/// Outside of code, angle brackets and stars are text and not markup.
fn escaped(text: &str) -> String {
    let parts = text.split('`').enumerate().map(|(number, part)| match number % 2 {
        0 => part.replace('<', "&lt;").replace('*', "\\*").replace('_', "\\_"),
        _ => part.to_owned(),
    });
    parts.collect::<Vec<_>>().join("`")
}
