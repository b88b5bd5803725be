//! The tokens of RON, with comments. The text has been parsed before, so strings and brackets have their ends.

/// A token, and the line breaks before it.
#[derive(Clone, Copy, Debug)]
pub(in crate::scene) struct Token<'a> {
    pub(in crate::scene) kind: TokenKind,
    pub(in crate::scene) text: &'a str,
    pub(in crate::scene) line_breaks_before: usize,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(in crate::scene) enum TokenKind {
    /// A name, a number, a string.
    Word,
    Colon,
    Comma,
    Open,
    Close,
    /// A comment up to the end of its line, or an attribute.
    Line,
    /// A comment with an end of its own.
    Block,
}

pub(in crate::scene) fn tokenize(text: &str) -> Vec<Token<'_>> {
    let mut rest = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut tokens = Vec::new();
    loop {
        let start = rest.find(|c: char| !c.is_whitespace()).unwrap_or(rest.len());
        let breaks = rest[..start].matches('\n').count();
        rest = &rest[start..];
        let Some(first) = rest.chars().next() else { return tokens };
        let (kind, length) = token_kind_and_length(rest, first);
        let (text, behind) = rest.split_at(length);
        tokens.push(Token { kind, text: text.trim_end(), line_breaks_before: breaks });
        rest = behind;
    }
}

/// The kind and the length of the token at the beginning of `rest`.
fn token_kind_and_length(rest: &str, first: char) -> (TokenKind, usize) {
    let line = || rest.find('\n').unwrap_or(rest.len());
    match first {
        '(' | '[' | '{' => (TokenKind::Open, 1),
        ')' | ']' | '}' => (TokenKind::Close, 1),
        ',' => (TokenKind::Comma, 1),
        ':' => (TokenKind::Colon, 1),
        '#' => (TokenKind::Line, rest.find(']').map_or_else(line, |end| end + 1)),
        '"' => (TokenKind::Word, 1 + string_length(&rest[1..])),
        '/' if rest.starts_with("//") => (TokenKind::Line, line()),
        '/' => (TokenKind::Block, block_comment_length(rest)),
        'r' if raw_string_length(rest).is_some() => {
            (TokenKind::Word, raw_string_length(rest).unwrap_or(1))
        }
        _ => {
            let ends = |c: char| c.is_whitespace() || "()[]{},:\"/".contains(c);
            let length = rest.find(ends).unwrap_or(rest.len());
            (TokenKind::Word, length.max(first.len_utf8()))
        }
    }
}

/// The length of a string behind its first quotation mark.
fn string_length(rest: &str) -> usize {
    let mut escaped = false;
    let end = rest.find(|c| {
        let ends = c == '"' && !escaped;
        escaped = c == '\\' && !escaped;
        ends
    });
    end.map_or(rest.len(), |end| end + 1)
}

/// The length of a raw string, `r"…"` or `r#"…"#`.
fn raw_string_length(rest: &str) -> Option<usize> {
    let marks = rest[1..].chars().take_while(|c| *c == '#').count();
    let body = rest[1 + marks..].strip_prefix('"')?;
    let end = format!("\"{}", "#".repeat(marks));
    Some(2 + marks + body.find(&end)? + end.len())
}

/// The length of a block comment; they may be inside one another.
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
