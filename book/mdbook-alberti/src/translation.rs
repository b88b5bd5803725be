//! Translation of pages: messages, catalogs, and translated text.

use crate::marks::Marks;
use crate::style::is_han;
use mdbook_i18n_helpers::{
    extract_events, extract_messages, reconstruct_markdown, translate_events,
};
use polib::catalog::Catalog;
use polib::message::Message;
use polib::metadata::CatalogMetadata;
use polib::po_file;
use pulldown_cmark::{Event, Tag, TagEnd};
use std::path::Path;

/// Reads a catalog, or returns an empty one if the file is missing.
pub fn read_catalog(path: &Path) -> Result<Catalog, String> {
    if !path.exists() {
        return Ok(Catalog::new(CatalogMetadata::new()));
    }
    // The library panics if a header field is missing.
    let parsed = std::panic::catch_unwind(|| po_file::parse(path)).map_err(|_| {
        format!("{}: the header is incomplete; copy it from another catalog", path.display())
    })?;
    parsed.map_err(|error| format!("{}: {error}", path.display()))
}

/// Returns the translation of a message, unless it is missing or marked fuzzy.
pub fn find_translation<'a>(catalog: &'a Catalog, msgid: &str) -> Option<&'a str> {
    let message = catalog.find_message(None, msgid, None)?;
    let is_usable = message.is_translated() && !message.is_fuzzy();
    message.msgstr().ok().filter(|_| is_usable)
}

/// Translates a page; messages without a translation stay in English.
pub fn translate_page(text: &str, catalog: &Catalog) -> Result<String, String> {
    let events = extract_events(text, None);
    let translated = translate_events(&events, catalog).map_err(|error| error.to_string())?;
    let translated = emphasis_as_html(translated);
    let (text, _) = reconstruct_markdown(&translated, None)
        .map_err(|error| format!("a translation's markup does not match the source: {error}"))?;
    Ok(translate_summaries(&text, catalog))
}

/// Converts emphasis to HTML elements, except for whole paragraphs: Markdown recognizes `_` only
/// next to spaces or punctuation, and Han text has no spaces between words.
fn emphasis_as_html(mut events: Vec<(usize, Event<'_>)>) -> Vec<(usize, Event<'_>)> {
    let mut open: Vec<usize> = Vec::new();
    for at in 0..events.len() {
        let html = |text: &'static str| Event::InlineHtml(text.into());
        match &events[at].1 {
            Event::Start(Tag::Strong) => events[at].1 = html("<strong>"),
            Event::End(TagEnd::Strong) => events[at].1 = html("</strong>"),
            Event::Start(Tag::Emphasis) => open.push(at),
            Event::End(TagEnd::Emphasis) => {
                let Some(start) = open.pop() else { continue };
                let before = start.checked_sub(1).map(|before| &events[before].1);
                let is_whole = matches!(before, Some(Event::Start(Tag::Paragraph)))
                    && matches!(events.get(at + 1), Some((_, Event::End(TagEnd::Paragraph))));
                if !is_whole {
                    events[start].1 = html("<em>");
                    events[at].1 = html("</em>");
                }
            }
            _ => {}
        }
    }
    events
}

/// Translates a title or another short text, which stays unchanged if it has no translation.
pub fn translate_line(text: &str, catalog: &Catalog) -> String {
    find_translation(catalog, text).unwrap_or(text).to_owned()
}

/// Returns the messages of a page that need a translation, without duplicates. The messages are in
/// order, except that summaries come last. Code and messages without words are omitted.
pub fn messages(text: &str) -> Result<Vec<String>, String> {
    let marks = Marks::read(text);
    let is_code = |line: usize| {
        let of =
            |fence: &crate::marks::Fence| fence.line + text[fence.range.clone()].lines().count();
        marks.fences.iter().any(|fence| (fence.line..of(fence)).contains(&line))
    };
    let mut out: Vec<String> = Vec::new();
    let mut add = |message: String| {
        if needs_translation(&message) && !out.contains(&message) {
            out.push(message);
        }
    };
    for (line, extracted) in extract_messages(text).map_err(|error| error.to_string())? {
        if !is_code(line) {
            add(extracted.message);
        }
    }
    summaries(text).for_each(|words| add(words.to_owned()));
    Ok(out)
}

/// Returns whether a message has a word of two or more non-Han letters outside code, HTML and URLs.
pub fn needs_translation(message: &str) -> bool {
    let words = |text: &str| {
        let mut parts = text.split(|letter: char| !letter.is_alphabetic() || is_han(letter));
        parts.any(|word| word.chars().count() > 1)
    };
    extract_events(message, None)
        .iter()
        .any(|(_, event)| matches!(event, Event::Text(text) if words(text)))
}

/// Returns the text of the `<summary>` elements, which the extraction treats as code.
fn summaries(text: &str) -> impl Iterator<Item = &str> {
    text.split("<summary>")
        .skip(1)
        .filter_map(|rest| rest.split_once("</summary>"))
        .map(|(words, _)| words)
}

fn translate_summaries(text: &str, catalog: &Catalog) -> String {
    let mut out = text.to_owned();
    for words in summaries(text) {
        let translated = translate_line(words, catalog);
        out = out.replace(
            &format!("<summary>{words}</summary>"),
            &format!("<summary>{translated}</summary>"),
        );
    }
    out
}

/// Creates a catalog of `messages` that keeps the translations from an older catalog.
pub fn update_catalog(page: &str, language: &str, messages: &[String], old: &Catalog) -> Catalog {
    let metadata = CatalogMetadata {
        project_id_version: format!("Alberti, the book: {page}"),
        language: language.to_owned(),
        mime_version: "1.0".into(),
        content_type: "text/plain; charset=UTF-8".into(),
        content_transfer_encoding: "8bit".into(),
        ..CatalogMetadata::new()
    };
    let mut catalog = Catalog::new(metadata);
    for msgid in messages {
        let mut builder = Message::build_singular();
        builder.with_source(format!("book/src/{page}.md")).with_msgid(msgid.clone());
        if let Some(found) = old.find_message(None, msgid, None) {
            builder.with_msgstr(found.msgstr().unwrap_or_default().to_owned());
            builder.with_flags(found.flags().clone());
        } else if let Some(similar) = most_similar(msgid, messages, old) {
            let mut flags = polib::message::MessageFlags::new();
            flags.add_flag("fuzzy");
            builder.with_msgstr(similar.to_owned()).with_flags(flags);
        }
        catalog.append_or_update(builder.done());
    }
    catalog
}

/// Returns the translation of the obsolete message most similar to `msgid`, if similar enough.
fn most_similar<'a>(msgid: &str, messages: &[String], old: &'a Catalog) -> Option<&'a str> {
    let gone = old.messages().filter(|message| !messages.iter().any(|id| id == message.msgid()));
    let scored = gone
        .filter(|message| message.is_translated())
        .map(|message| (similarity(msgid, message.msgid()), message.msgstr().unwrap_or_default()));
    let best = scored.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 > 0.6).then_some(best.1)
}

/// Returns the fraction of words that two texts share, from 0 to 1.
fn similarity(a: &str, b: &str) -> f64 {
    let [a, b] = [a, b].map(|text| text.split_whitespace().collect::<Vec<_>>());
    let mut rest = b.clone();
    let mut shared = 0;
    for word in &a {
        if let Some(at) = rest.iter().position(|other| other == word) {
            rest.swap_remove(at);
            shared += 2;
        }
    }
    f64::from(shared) / (a.len() + b.len()).max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::marks::is_topic;

    const PAGE: &str = "# Title `C4`\n\nA paragraph\nwith `$a_b$` and `C14`.\n\n```formula PE-1\na \\_ b \\\\ \"x\" // y\n% check a=1 : PE-1\n```\n\n\
        ```alberti format=png explore=\"lesson=a&b=1\"\nalberti render a.ron --label \"a, b\" \\\n  --x\n```\n\n*A caption `$x$`.*\n\n\
        | a | `$x$` |\n| --- | --- |\n| 1 | words here |\n\n```rust\n// A comment.\n# let hidden = \"text\";\nassert!(true);\n```\n\n\
        > **Printed wrong** `M5` is this.\n\n<details><summary>Hint</summary>\n\nInside.\n\n</details>\n\n1. One\n2. Two [link](a.md#b)\n";

    fn catalog(pairs: &[(&str, &str)]) -> Catalog {
        let mut catalog = Catalog::new(CatalogMetadata::new());
        for (msgid, msgstr) in pairs {
            let mut builder = Message::build_singular();
            builder.with_msgid((*msgid).into()).with_msgstr((*msgstr).into());
            catalog.append_or_update(builder.done());
        }
        catalog
    }

    #[test]
    fn messages_contain_only_readable_text() {
        let expected = [
            "Title `C4`",
            "A paragraph with `$a_b$` and `C14`.",
            "_A caption `$x$`._",
            "words here",
            "**Printed wrong** `M5` is this.",
            "Inside.",
            "One",
            "Two [link](a.md#b)",
            "Hint",
        ];
        assert_eq!(messages(PAGE).unwrap(), expected);
    }

    #[test]
    fn a_round_trip_keeps_all_marks() {
        let catalog = catalog(&[
            ("A paragraph with `$a_b$` and `C14`.", "一段 `$a_b$`，见 `C14`。"),
            ("_A caption `$x$`._", "_图注 `$x$`。_"),
            ("Hint", "提示"),
        ]);
        let (before, text) = (Marks::read(PAGE), translate_page(PAGE, &catalog).unwrap());
        let after = Marks::read(&text);
        let blocks = |marks: &Marks| {
            marks
                .fences
                .iter()
                .map(|it| (it.info.clone(), it.body.clone(), it.caption.is_some()))
                .collect::<Vec<_>>()
        };
        assert_eq!(blocks(&before), blocks(&after), "{text}");
        let codes =
            |marks: &Marks| marks.spans.iter().map(|it| it.code.clone()).collect::<Vec<_>>();
        assert_eq!(codes(&before), codes(&after));
        assert_eq!(codes(&before).iter().filter(|code| is_topic(code)).count(), 3);
        for words in ["一段", "图注", "<summary>提示</summary>"] {
            assert!(text.contains(words), "{words}: {text}");
        }
    }

    #[test]
    fn emphasis_between_han_characters_is_preserved() {
        let catalog = catalog(&[("It _is_ **so**.", "*它*是这**样**的。")]);
        let text = translate_page("It *is* **so**.\n", &catalog).unwrap();
        assert_eq!(text, "<em>它</em>是这<strong>样</strong>的。");
    }

    #[test]
    fn changed_messages_keep_a_fuzzy_translation() {
        let old = catalog(&[("The eye is at the origin.", "视点在原点。"), ("Same.", "同。")]);
        let new = ["The eye is at the center.".to_owned(), "Same.".to_owned(), "Else".to_owned()];
        let updated = update_catalog("p", "zh", &new, &old);
        assert_eq!(find_translation(&updated, "Same."), Some("同。"));
        assert_eq!(find_translation(&updated, &new[0]), None);
        let fuzzy = updated.find_message(None, &new[0], None).unwrap();
        assert!(fuzzy.is_fuzzy() && fuzzy.msgstr().unwrap() == "视点在原点。");
        assert!(!updated.find_message(None, "Else", None).unwrap().is_translated());
    }
}
