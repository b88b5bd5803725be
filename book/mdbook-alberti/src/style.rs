//! Mechanical checks of a translation: lost marks and links, punctuation, spaces.

use crate::marks::{is_topic, parse};
use pulldown_cmark::{Event, Tag};

/// Finds errors in a translation.
pub fn message_faults(msgid: &str, msgstr: &str) -> Vec<String> {
    let mut faults = Vec::new();
    let (source, translated) = (Parts::of(msgid), Parts::of(msgstr));
    for (what, before, after) in [
        ("code spans", &source.codes, &translated.codes),
        ("links", &source.links, &translated.links),
    ] {
        let lost: Vec<_> =
            before.iter().filter(|it| !after.contains(it)).map(String::as_str).collect();
        let new: Vec<_> =
            after.iter().filter(|it| !before.contains(it)).map(String::as_str).collect();
        if !lost.is_empty() || !new.is_empty() {
            faults.push(format!("{what}: missing {lost:?}, added {new:?}"));
        } else if before.len() != after.len() {
            faults.push(format!("{what}: {} before, {} after", before.len(), after.len()));
        }
    }
    if !source.text.contains(['*', '_']) && translated.text.contains(['*', '_']) {
        faults.push(
            "unclosed emphasis: put the asterisk next to a letter, not next to punctuation".into(),
        );
    }
    if source.paragraphs != translated.paragraphs {
        faults.push(format!(
            "{} paragraphs in the source, {} in the translation",
            source.paragraphs, translated.paragraphs
        ));
    }
    let is_caption = |text: &str| {
        text.starts_with(['_', '*']) && !text.starts_with("**") && text.ends_with(['_', '*'])
    };
    if is_caption(msgid) != is_caption(msgstr) {
        faults.push("captions, and only captions, must be emphasized as a whole".into());
    }
    faults.extend(han_faults(&translated.text));
    faults
}

struct Parts {
    codes: Vec<String>,
    links: Vec<String>,
    paragraphs: usize,
    /// The text, with each code span replaced by `⌷` and each topic mark by a word joiner.
    text: String,
}

impl Parts {
    fn of(markdown: &str) -> Self {
        let mut parts =
            Self { codes: Vec::new(), links: Vec::new(), paragraphs: 0, text: String::new() };
        for event in parse(markdown) {
            match event {
                Event::Code(code) => {
                    parts.text.push(if is_topic(&code) { '\u{2060}' } else { '⌷' });
                    parts.codes.push(code.to_string());
                }
                Event::Start(Tag::Link { dest_url, .. }) => parts.links.push(dest_url.to_string()),
                Event::Start(Tag::Paragraph) => parts.paragraphs += 1,
                Event::Text(text) => parts.text.push_str(&text),
                Event::SoftBreak => parts.text.push(' '),
                _ => {}
            }
        }
        parts.codes.sort();
        parts.links.sort();
        parts
    }
}

/// Returns whether a character is a Han character.
pub fn is_han(letter: char) -> bool {
    ('\u{4e00}'..='\u{9fff}').contains(&letter)
}

/// Finds wrong punctuation after Han characters, and missing or superfluous spaces.
fn han_faults(text: &str) -> Vec<String> {
    let letters: Vec<char> = text.chars().collect();
    let mut faults = Vec::new();
    for (at, pair) in letters.windows(2).enumerate() {
        let [a, b] = [pair[0], pair[1]];
        let is_latin = |letter: char| letter.is_ascii_alphanumeric() || letter == '⌷';
        let what = if is_han(a) && matches!(b, ',' | '.' | ';' | ':' | '?' | '!') {
            "use full-width punctuation after Han characters"
        } else if (is_han(a) && is_latin(b)) || (is_latin(a) && is_han(b)) {
            "put a space between Han characters and Latin letters, digits or code"
        } else if a == ' ' && "，。：；、）".contains(b) {
            "remove the space before full-width punctuation"
        } else {
            continue;
        };
        let around: String =
            letters[at.saturating_sub(6)..(at + 8).min(letters.len())].iter().collect();
        faults.push(format!("{what}: “{around}”"));
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lost_marks_and_links_are_found() {
        assert_eq!(
            message_faults("See `C4`, `$x$` and [a](b.md).", "见 `C4`、`$x$` 和[甲](b.md)。"),
            [""; 0]
        );
        assert_eq!(message_faults("See `$x$`.", "见 `$y$`。").len(), 1);
        assert_eq!(message_faults("[a](b.md)", "甲").len(), 1);
        assert!(!message_faults("_A caption._", "图注。").is_empty());
        assert_eq!(message_faults("It is **so.** Yes", "是**这样。**对").len(), 1);
    }

    #[test]
    fn chinese_punctuation_and_spacing_are_checked() {
        for good in ["点 w = 1，除以 w。", "（见下）", "用 `$x$` 除", "中文，中文", "第 3 步"]
        {
            assert_eq!(han_faults(&Parts::of(good).text), [""; 0], "{good}");
        }
        for bad in ["点w", "第3步", "中文,中文", "用`$x$` 除", "w 。"] {
            assert!(!han_faults(&Parts::of(bad).text).is_empty(), "{bad}");
        }
    }
}
