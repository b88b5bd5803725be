//! Lexer for RON text: words, strings, punctuation and comments, each with its position in the
//! text.
//!
//! The lexer accepts any text. An unterminated string or comment runs to the end of the text, and
//! the parser reports it; the formatter only sees text that was parsed without errors.

use core::ops::Range;

/// A token and its position.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Token<'a> {
    pub(crate) kind: TokenKind,
    /// The token as written, without the white space that ends a line comment.
    pub(crate) text: &'a str,
    /// Byte offset of the token in the text.
    pub(crate) start: usize,
    /// Line breaks between the previous token and this one.
    pub(crate) line_breaks_before: usize,
}

impl Token<'_> {
    /// Returns the bytes of the token in the text.
    pub(crate) fn span(&self) -> Range<usize> {
        self.start..self.start + self.text.len()
    }
}

/// The lexical class of a token.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum TokenKind {
    /// An identifier, a number or a string.
    Word,
    Colon,
    Comma,
    /// `(`, `[` or `{`.
    Open,
    /// `)`, `]` or `}`.
    Close,
    /// A comment up to the end of its line, or an attribute such as `#![enable(implicit_some)]`.
    LineComment,
    /// A comment between `/*` and `*/`; block comments nest.
    BlockComment,
}

/// Splits RON text into tokens. A byte order mark counts as white space.
pub(crate) fn tokenize(text: &str) -> Vec<Token<'_>> {
    let is_blank = |c: char| c.is_whitespace() || c == '\u{feff}';
    let mut tokens = Vec::new();
    let mut at = 0;
    loop {
        let rest = &text[at..];
        let blank = rest.find(|c: char| !is_blank(c)).unwrap_or(rest.len());
        let line_breaks_before = rest[..blank].matches('\n').count();
        at += blank;
        let rest = &text[at..];
        let Some(first) = rest.chars().next() else { return tokens };
        let (kind, length) = token_kind_and_length(rest, first);
        tokens.push(Token { kind, text: rest[..length].trim_end(), start: at, line_breaks_before });
        at += length;
    }
}

/// Returns the kind and the length of the token at the beginning of `rest`.
fn token_kind_and_length(rest: &str, first: char) -> (TokenKind, usize) {
    let line = || rest.find('\n').unwrap_or(rest.len());
    match first {
        '(' | '[' | '{' => (TokenKind::Open, 1),
        ')' | ']' | '}' => (TokenKind::Close, 1),
        ',' => (TokenKind::Comma, 1),
        ':' => (TokenKind::Colon, 1),
        // A color without quotation marks.
        '#' if rest[1..].starts_with(|c: char| c.is_ascii_hexdigit()) => {
            (TokenKind::Word, word_length(rest, first))
        }
        '#' => (TokenKind::LineComment, rest.find(']').map_or_else(line, |end| end + 1)),
        '"' => (TokenKind::Word, 1 + string_length(&rest[1..])),
        '/' if rest.starts_with("//") => (TokenKind::LineComment, line()),
        '/' if rest.starts_with("/*") => (TokenKind::BlockComment, block_comment_length(rest)),
        // Equals signs and semicolons are never valid. Each is a separate word, so that the parser
        // can point at it.
        '=' | ';' => (TokenKind::Word, 1),
        _ => (TokenKind::Word, raw_string_length(rest).unwrap_or_else(|| word_length(rest, first))),
    }
}

/// Returns the length of an identifier, a number, or text that is neither. A single slash is part
/// of the word, as in an unquoted path.
fn word_length(rest: &str, first: char) -> usize {
    let ends = |(at, c): (usize, char)| {
        c.is_whitespace()
            || "()[]{},:\"=;".contains(c)
            || (c == '/' && (rest[at..].starts_with("//") || rest[at..].starts_with("/*")))
    };
    let length = rest.char_indices().find(|&place| ends(place)).map_or(rest.len(), |(at, _)| at);
    length.max(first.len_utf8())
}

/// Returns the length of a string after its first quotation mark.
fn string_length(rest: &str) -> usize {
    let mut escaped = false;
    let end = rest.find(|c| {
        let ends = c == '"' && !escaped;
        escaped = c == '\\' && !escaped;
        ends
    });
    end.map_or(rest.len(), |end| end + 1)
}

/// Returns the length of a raw string, `r"…"` or `r#"…"#`, or `None` if `rest` does not begin with
/// one.
fn raw_string_length(rest: &str) -> Option<usize> {
    let hashes = rest.strip_prefix('r')?.chars().take_while(|c| *c == '#').count();
    let body = rest[1 + hashes..].strip_prefix('"')?;
    let end = format!("\"{}", "#".repeat(hashes));
    Some(body.find(&end).map_or(rest.len(), |at| 2 + hashes + at + end.len()))
}

/// Returns the length of a block comment, including the comments nested in it.
fn block_comment_length(rest: &str) -> usize {
    let mut depth = 0_usize;
    let mut at = 0;
    while at < rest.len() {
        if rest[at..].starts_with("/*") {
            depth += 1;
            at += 2;
        } else if rest[at..].starts_with("*/") {
            depth = depth.saturating_sub(1);
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += rest[at..].chars().next().map_or(1, char::len_utf8);
        }
    }
    rest.len()
}
