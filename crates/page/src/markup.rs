//! Markup escaping: makes text safe for HTML and XML, in content and in quoted attributes.

/// Escapes `&`, `<`, `>` and `"`, and drops characters that XML 1.0 forbids.
///
/// The result is safe between tags and in attribute values in double quotes. It is not meant for
/// single quotes, scripts or style sheets. XML 1.0 cannot represent control characters other than
/// tab, line feed and carriage return, or the noncharacters U+FFFE and U+FFFF, even as references
/// (section 2.2). Dropping them ensures that names from files cannot make a document malformed.
///
/// ```
/// use page::escape_markup;
///
/// assert_eq!(escape_markup("a < b & \"c\""), "a &lt; b &amp; &quot;c&quot;");
/// assert_eq!(escape_markup("bell\u{7}"), "bell");
/// ```
#[must_use]
pub fn escape_markup(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\t' | '\n' | '\r' => escaped.push(character),
            '\0'..' ' | '\u{fffe}' | '\u{ffff}' => {}
            _ => escaped.push(character),
        }
    }
    escaped
}
