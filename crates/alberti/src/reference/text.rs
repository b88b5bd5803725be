//! The reference as plain text for a terminal.
//!
//! ```text
//! alberti render
//!   --size <WxH>
//!       Width and height of the picture in pixels, such as 1920x1080
//! ```

use super::{ReferenceEntry, ReferenceSection};

/// The width of a line in characters.
const LINE_WIDTH: usize = 100;

/// Returns the text, with a block for each section.
pub(super) fn format_text(sections: &[ReferenceSection]) -> String {
    let mut page = String::new();
    for (number, section) in sections.iter().enumerate() {
        if number > 0 {
            page.push('\n');
        }
        page.push_str(&section.title);
        page.push('\n');
        wrap_paragraphs(&mut page, &section.about, 2);
        section.entries.iter().for_each(|entry| write_entry(&mut page, entry, 2));
    }
    page
}

/// Appends an entry and, indented, its description and inner entries.
fn write_entry(page: &mut String, entry: &ReferenceEntry, indent: usize) {
    page.push_str(&" ".repeat(indent));
    page.push_str(&entry.term);
    if !entry.value.is_empty() {
        page.push_str(if entry.term.starts_with('-') { " " } else { ": " });
        page.push_str(&entry.value);
    }
    if !entry.note.is_empty() {
        page.push_str(&format!(" ({})", entry.note));
    }
    page.push('\n');
    wrap_paragraphs(page, &entry.about, indent + 4);
    entry.inner.iter().for_each(|inner| write_entry(page, inner, indent + 4));
}

/// Appends paragraphs, wrapped at [`LINE_WIDTH`] and indented.
///
/// The width includes the indentation. A word longer than a line is not broken. Widths are counted
/// in characters, which is exact for the reference text.
pub(crate) fn wrap_paragraphs(page: &mut String, text: &str, indent: usize) {
    for line in text.lines().filter(|line| !line.is_empty()) {
        let mut column = 0;
        for word in line.split_whitespace() {
            let length = word.chars().count();
            if column > 0 && column + 1 + length > LINE_WIDTH {
                page.push('\n');
                column = 0;
            }
            let gap = if column == 0 { indent } else { 1 };
            page.push_str(&" ".repeat(gap));
            page.push_str(word);
            column += gap + length;
        }
        page.push('\n');
    }
}
