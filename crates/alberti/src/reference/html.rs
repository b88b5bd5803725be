//! The reference as a self-contained HTML page.
//!
//! The page needs no script and no other file. Type names are links wherever they occur in a value,
//! such as `list of Model`.

use super::{ReferenceEntry, ReferenceSection};
use page::escape_markup;

/// The style sheet of the page, for light and dark color schemes.
const PAGE_STYLE: &str = "\
body { font: 16px/1.5 system-ui, sans-serif; margin: 0; display: grid; grid-template-columns: 15rem 1fr; color: #1a1f26; background: #fff }
nav { position: sticky; top: 0; height: 100vh; overflow: auto; padding: 1rem; background: #f4f1ea; box-sizing: border-box }
nav a { display: block } main { padding: 1rem 2rem; max-width: 50rem }
code, dt { font-family: ui-monospace, monospace } dt { margin-top: .7rem } dt b { font-weight: 600 }
dd { margin-left: 1.5rem } a { color: #1f4e79; text-decoration: none } .note { color: #8a5a00 }
@media (prefers-color-scheme: dark) { body { color: #e6e6e6; background: #16191d } nav { background: #20242a } a { color: #8ab8e6 } }
";

/// Returns the page: links to all sections on the left, the sections themselves on the right.
pub(super) fn format_html(title: &str, sections: &[ReferenceSection]) -> String {
    let titles: Vec<&str> = sections.iter().map(|section| section.title.as_str()).collect();
    let links =
        titles.iter().map(|title| format!("<a href=\"#{}\">{title}</a>\n", section_anchor(title)));
    let links: String = links.collect();
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>{title}</title>\n<style>\n{PAGE_STYLE}</style>\n\
         <nav>\n{links}</nav>\n<main>\n<h1>{title}</h1>\n"
    );
    for section in sections {
        let id = section_anchor(&section.title);
        page.push_str(&format!("<h2 id=\"{id}\">{}</h2>\n", section.title));
        for paragraph in section.about.split("\n\n").filter(|text| !text.is_empty()) {
            page.push_str(&format!("<p>{}</p>\n", mark_code(paragraph)));
        }
        write_entries(&mut page, &section.entries, &titles);
    }
    page.push_str("</main>\n</html>\n");
    page
}

/// Appends entries as a description list, recursively.
fn write_entries(page: &mut String, entries: &[ReferenceEntry], titles: &[&str]) {
    if entries.is_empty() {
        return;
    }
    page.push_str("<dl>\n");
    for entry in entries {
        let flag = entry.term.starts_with('-');
        let gap = if entry.value.is_empty() || flag { " " } else { ": " };
        let term = if flag { escape_markup(&entry.term) } else { link_titles(&entry.term, titles) };
        let value = link_titles(&entry.value, titles);
        let note = &entry.note;
        page.push_str(&format!(
            "<dt><b>{term}</b>{gap}{value} <span class=\"note\">{note}</span></dt>\n<dd>{}\n",
            mark_code(&entry.about)
        ));
        write_entries(page, &entry.inner, titles);
        page.push_str("</dd>\n");
    }
    page.push_str("</dl>\n");
}

/// Returns the fragment identifier of a section.
fn section_anchor(title: &str) -> String {
    title.replace(' ', "-")
}

/// Escapes text and links words that are section titles to those sections.
///
/// The text is split after every non-word character, so that `list of Model` contains the word
/// `Model`, which is a title.
fn link_titles(text: &str, titles: &[&str]) -> String {
    let mut html = String::new();
    for (number, part) in text.split_inclusive(|c: char| !c.is_alphanumeric()).enumerate() {
        let word = part.trim_end_matches(|c: char| !c.is_alphanumeric());
        let rest = escape_markup(&part[word.len()..]);
        // The first word of a variant is its own name, not a type.
        let is_link = titles.contains(&word) && (number > 0 || !text.contains('('));
        if is_link {
            html.push_str(&format!("<a href=\"#{}\">{word}</a>{rest}", section_anchor(word)));
        } else {
            html.push_str(&format!("{}{rest}", escape_markup(word)));
        }
    }
    html
}

/// Escapes text and turns backticks into `<code>`.
///
/// Escaping comes first and leaves backticks unchanged. Odd-numbered parts were between backticks.
fn mark_code(text: &str) -> String {
    let parts = escape_markup(text).split('`').map(str::to_owned).collect::<Vec<_>>();
    let part = |(number, part): (usize, &String)| match number % 2 {
        0 => part.clone(),
        _ => format!("<code>{part}</code>"),
    };
    parts.iter().enumerate().map(part).collect()
}
