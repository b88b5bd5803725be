//! Makes names safe for messages: writes terminal control characters as codes.

use std::borrow::Cow;
use std::path::Path;

/// Whether a terminal may interpret a character instead of showing it. This applies to control
/// characters (C0, DEL and C1), line and paragraph separators, and characters that change the text
/// direction.
#[must_use]
pub fn is_terminal_control(character: char) -> bool {
    character.is_control() || matches!(character, '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Prepares text for a message line. Control characters are written as in Rust, such as `\n` or
/// `\u{1b}`.
///
/// Untrusted files contain node names, keys and file names. Such a name must not be able to
/// move the cursor, color the screen or start a new line.
///
/// ```
/// assert_eq!(files::visible_text("roof"), "roof");
/// assert_eq!(files::visible_text("a\nb\u{1b}[2J\u{202e}"), "a\\nb\\u{1b}[2J\\u{202e}");
/// ```
#[must_use]
pub fn visible_text(text: &str) -> Cow<'_, str> {
    if !text.contains(is_terminal_control) {
        return Cow::Borrowed(text);
    }
    let mut visible = String::with_capacity(text.len() + 8);
    for character in text.chars() {
        match character {
            '\n' | '\r' | '\t' => visible.extend(character.escape_default()),
            control if is_terminal_control(control) => visible.extend(control.escape_unicode()),
            plain => visible.push(plain),
        }
    }
    Cow::Owned(visible)
}

/// Prepares a path for a message line, as [`visible_text`] does.
#[must_use]
pub fn visible_path(path: impl AsRef<Path>) -> String {
    visible_text(&path.as_ref().to_string_lossy()).into_owned()
}

/// The maximum number of characters in an excerpt. Part names can have any length.
const MAX_EXCERPT: usize = 60;

/// Returns the beginning of a string for a message. Invisible characters, including control
/// characters and characters that change the text direction, are written as codes such as
/// `\u{202e}`.
///
/// ```
/// assert_eq!(files::visible_excerpt("roof\u{200b}"), "roof\\u{200b}");
/// assert_eq!(files::visible_excerpt(&"a".repeat(61)), "a".repeat(60) + "...");
/// ```
#[must_use]
pub fn visible_excerpt(text: &str) -> String {
    let is_invisible = |c: char| {
        is_terminal_control(c)
            || matches!(c, '\u{ad}' | '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2060}'..='\u{206f}')
            || c == '\u{feff}'
    };
    let shown =
        |c: char| if is_invisible(c) { c.escape_unicode().to_string() } else { c.to_string() };
    let start = text.chars().take(MAX_EXCERPT).map(shown);
    let is_longer = text.chars().nth(MAX_EXCERPT).is_some();
    start.chain(is_longer.then(|| "...".to_owned())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terminal_control_characters_are_written_as_codes() {
        let hostile = "\0\u{7}\u{8}\t\r\n\u{1b}\u{7f}\u{9b}\u{2028}\u{202a}\u{2069}";
        let expected =
            "\\u{0}\\u{7}\\u{8}\\t\\r\\n\\u{1b}\\u{7f}\\u{9b}\\u{2028}\\u{202a}\\u{2069}";
        assert_eq!(visible_text(hostile), expected);
        let plain = "Haus 2 \\n ä 屋顶 \u{200d} 🏠";
        assert!(matches!(visible_text(plain), Cow::Borrowed(same) if same == plain));
    }
}
