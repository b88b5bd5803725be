//! Adds a title and a table of contents to `print.html`, the page that contains the whole book.

use crate::language::Language;
use anyhow::{Context as _, Result, anyhow};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

/// The element in which mdBook puts the chapters.
const CHAPTERS: &str = "<main>";

/// Adds the title and the table of contents to the printed page of an edition.
pub fn add_contents(out: &Path, language: Language) -> Result<()> {
    let path = out.join("print.html");
    let html = fs::read_to_string(&path).with_context(|| path.display().to_string())?;
    let at =
        html.find(CHAPTERS).ok_or(anyhow!("{}: no {CHAPTERS}", path.display()))? + CHAPTERS.len();
    let title =
        html.split("<h1 class=\"menu-title\">").nth(1).and_then(|rest| rest.split("</h1>").next());
    let mut front = format!(
        "<section class=\"front\"><p class=\"title\">{}</p>\n<h2>{}</h2>\n<ol>\n",
        title.unwrap_or_default(),
        language.texts().contents
    );
    for (level, id, text) in headings(&html[at..]) {
        // Writing to a string cannot fail.
        let _ = writeln!(front, "<li class=\"level-{level}\"><a href=\"#{id}\">{text}</a></li>");
    }
    front += "</ol></section>\n";
    let html = format!("{}{front}{}", &html[..at], &html[at..]);
    fs::write(&path, html).with_context(|| path.display().to_string())
}

/// Returns the level, id and inner HTML of each page and section heading.
pub fn headings(html: &str) -> Vec<(u8, &str, String)> {
    let mut out = Vec::new();
    for (level, tag) in [(1, "h1"), (2, "h2")] {
        for (at, _) in html.match_indices(&format!("<{tag} id=\"")) {
            let rest = &html[at + tag.len() + 6..];
            let parts = rest.split_once('"').zip(rest.split_once(&format!("</{tag}>")));
            if let Some(((id, _), (element, _))) = parts
                && let Some((_, inner)) = element.split_once("class=\"header\"")
                && let Some((_, inner)) = inner.split_once('>')
            {
                out.push((at, level, id, without_links(inner)));
            }
        }
    }
    out.sort_by_key(|(at, ..)| *at);
    out.into_iter().map(|(_, level, id, text)| (level, id, text)).collect()
}

/// Removes links from the HTML of a heading: drops topic marks, and keeps the text of other links.
fn without_links(html: &str) -> String {
    let mut out = String::new();
    let mut rest = html.trim_end_matches("</a>");
    while let Some((before, link)) = rest.split_once("<a ") {
        out.push_str(before);
        let (tag, inside) = link.split_once('>').unwrap_or((link, ""));
        let (words, after) = inside.split_once("</a>").unwrap_or((inside, ""));
        out.push_str(if tag.contains("class=\"topic\"") { "" } else { words });
        rest = after;
    }
    (out + rest).trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_of_contents_omits_topic_marks() {
        let html = "<h1 id=\"a\"><a class=\"header\" href=\"#a\">A <a class=\"topic\" href=\"#C1\">C1</a></a></h1>\
            <h3 id=\"x\"><a class=\"header\" href=\"#x\">X</a></h3><h2 id=\"b\"><a class=\"header\" href=\"#b\"><em>B</em></a></h2>";
        let expected = [(1, "a", "A".to_owned()), (2, "b", "<em>B</em>".to_owned())];
        assert_eq!(headings(html), expected);
    }
}
