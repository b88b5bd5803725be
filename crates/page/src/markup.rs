//! Markup escaping: text made safe for HTML and XML, in content and in quoted attributes.

/// Escapes `&`, `<`, `>` and `"` as references, and drops characters that XML 1.0 forbids.
///
/// The result is safe between tags and in attribute values in double quotes; it is not meant for
/// single quotes, scripts or style sheets. Control characters other than tab, line feed and
/// carriage return, and the noncharacters U+FFFE and U+FFFF, have no representation in XML 1.0, not
/// even as references (section 2.2), so names from files cannot make a document malformed.
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
