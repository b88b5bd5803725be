//! Error-tolerant recursive-descent parser for RON: reports every syntax error and still builds a
//! tree.
//!
//! ```text
//!  file  = value                        value = number | string | word | group
//!  group = [word] "(" items ")"         items = [ item { "," item } [","] ]
//!        | "[" items "]"                item  = [ word ":" ] value
//! ```
//!
//! Resynchronization: a missing comma or colon is reported and supplied. A token that cannot begin
//! a value is reported, and the text up to the next comma or bracket is skipped. A closing bracket
//! of the wrong kind closes the innermost group if the brackets that follow are then balanced,
//! otherwise the group that it matches.

use super::literal::looks_like_number;
use super::tokens::{Token, TokenKind, tokenize};
use super::tree::{Group, Key, Node, NodeKind, SyntaxItem};
use crate::mistake::Mistake;
use core::ops::Range;

/// The maximum nesting depth of groups, so that no text can overflow the stack.
const MAX_DEPTH: usize = 128;

/// The help for files that are not scenes at all.
pub(crate) const SAMPLE_SCENE: &str =
    "a scene looks like this: Scene(models: [(path: \"model.glb\")])";

/// The tree of a text, and the syntax errors in it.
pub(crate) struct SyntaxTree<'a> {
    /// The value of the file, if any.
    pub(crate) root: Option<Node<'a>>,
    pub(crate) errors: Vec<Mistake>,
    /// Whether brackets or strings are so broken that the tree may have values in the wrong group.
    pub(crate) is_unreliable: bool,
}

/// Parses the text of a scene file.
pub(crate) fn parse_tree(source: &str) -> SyntaxTree<'_> {
    let is_code =
        |token: &Token<'_>| !matches!(token.kind, TokenKind::LineComment | TokenKind::BlockComment);
    let tokens = tokenize(source);
    let mut parser = Parser {
        source,
        errors: Vec::new(),
        is_unreliable: false,
        resumed_at: None,
        open: Vec::new(),
        tokens: tokens.iter().copied().filter(is_code).collect(),
        at: 0,
    };
    parser.report_unterminated(&tokens);
    let root = parser.parse_file();
    let Parser { errors, is_unreliable, .. } = parser;
    SyntaxTree { root, errors, is_unreliable }
}

/// The state of the parser: a position among the tokens, and the open brackets.
struct Parser<'a> {
    source: &'a str,
    /// The tokens without comments and attributes.
    tokens: Vec<Token<'a>>,
    /// Index of the next token.
    at: usize,
    /// The open brackets, from outside to inside.
    open: Vec<Token<'a>>,
    errors: Vec<Mistake>,
    is_unreliable: bool,
    /// The index of a token that needs no comma, because a group ended there without its bracket.
    resumed_at: Option<usize>,
}

impl<'a> Parser<'a> {
    /// Returns the next token.
    fn peek(&self) -> Option<Token<'a>> {
        self.tokens.get(self.at).copied()
    }

    /// Returns the kind of the next token.
    fn peek_kind(&self) -> Option<TokenKind> {
        self.peek().map(|token| token.kind)
    }

    /// Moves past the next token if it is of this kind.
    fn eat(&mut self, kind: TokenKind) -> bool {
        let found = self.peek_kind() == Some(kind);
        self.at += usize::from(found);
        found
    }

    /// Reports a syntax error.
    fn report(&mut self, span: Range<usize>, message: impl Into<String>, help: impl Into<String>) {
        self.errors.push(Mistake::new(span, message, Some(help.into())));
    }

    /// Reports a string or a comment that runs to the end of the text.
    fn report_unterminated(&mut self, tokens: &[Token<'a>]) {
        let Some(last) = tokens.last() else { return };
        let (message, help) = match last.kind {
            TokenKind::Word
                if last.text.starts_with(['"', 'r']) && !is_terminated_string(last.text) =>
            {
                if !last.text.starts_with('"')
                    && !last.text.trim_start_matches('r').trim_start_matches('#').starts_with('"')
                {
                    return;
                }
                ("this string is not closed", "close it with a quotation mark")
            }
            TokenKind::BlockComment if !last.text.ends_with("*/") => {
                ("this comment is not closed", "close it with */")
            }
            _ => return,
        };
        // After a missing quotation mark, strings and the text between them are swapped. The first
        // string that spans lines is the likely culprit.
        let spans_lines =
            |token: &&Token<'_>| token.kind == TokenKind::Word && token.text.contains('\n');
        let first = tokens.iter().find(spans_lines).filter(|_| last.kind == TokenKind::Word);
        let start = first.unwrap_or(last).start;
        self.is_unreliable = true;
        self.report(start..start + 1, message, help);
        // Errors in the rest of the text are not worth reporting.
        self.tokens.retain(|token| token.start < start);
    }

    /// Parses the value of the whole file.
    fn parse_file(&mut self) -> Option<Node<'a>> {
        if self.tokens.is_empty() {
            if self.errors.is_empty() {
                self.report(0..self.source.len().min(1), "the file is empty", SAMPLE_SCENE);
            }
            return None;
        }
        let root = self.parse_value();
        // Text that is not a scene has no last bracket; the checker reports it.
        let is_scene = matches!(root.kind, NodeKind::Group(_) | NodeKind::Invalid);
        if let Some(token) = self.peek().filter(|_| is_scene && !self.is_unreliable) {
            let end = self.tokens.last().map_or(token.start, |last| last.span().end);
            let message = "unexpected text after the scene's closing bracket";
            let help = "a file holds one scene; move the text inside the brackets, or remove it";
            self.report(token.start..end, message, help);
        }
        Some(root)
    }

    /// Parses a value. If none begins here, reports an error and returns `Invalid`.
    fn parse_value(&mut self) -> Node<'a> {
        let Some(token) = self.peek() else {
            let end = self.source.trim_end().len();
            self.report_unclosed();
            return Node { span: end..end, kind: NodeKind::Invalid };
        };
        match token.kind {
            TokenKind::Open => self.parse_group(None),
            TokenKind::Word if is_string(token.text) => {
                self.at += 1;
                let is_closed = is_terminated_string(token.text);
                let kind = if is_closed { NodeKind::String(token.text) } else { NodeKind::Invalid };
                Node { span: token.span(), kind }
            }
            TokenKind::Word if looks_like_number(token.text) => {
                self.at += 1;
                self.parse_ratio(token)
            }
            TokenKind::Word if !matches!(token.text, "=" | ";") => {
                self.at += 1;
                let name = token.text.strip_prefix("r#").unwrap_or(token.text);
                if self.peek().is_some_and(|next| next.text == "(" || next.text == "{") {
                    return self.parse_group(Some(Key { name, span: token.span() }));
                }
                Node { span: token.span(), kind: NodeKind::Word(name) }
            }
            _ => self.missing_value(token),
        }
    }

    /// Parses a number. A ratio such as 1:20 is reported with the form to write instead.
    fn parse_ratio(&mut self, number: Token<'a>) -> Node<'a> {
        let colon = self.peek_kind() == Some(TokenKind::Colon);
        let second = self.tokens.get(self.at + 1).copied();
        match second.filter(|second| colon && looks_like_number(second.text)) {
            Some(second) => {
                self.at += 2;
                let span = number.start..second.span().end;
                let help = format!("write ({}, {})", number.text, second.text);
                self.report(span.clone(), "a pair of numbers goes in brackets", help);
                Node { span, kind: NodeKind::Invalid }
            }
            None => Node { span: number.span(), kind: NodeKind::Number(number.text) },
        }
    }

    /// Reports that a value is missing before `token`, and skips tokens that cannot begin one.
    fn missing_value(&mut self, token: Token<'a>) -> Node<'a> {
        self.report(token.span(), "expected a value here", "write fields as `name: value`");
        if matches!(token.kind, TokenKind::Word | TokenKind::Colon) {
            self.at += 1;
        }
        Node { span: token.start..token.start, kind: NodeKind::Invalid }
    }

    /// Parses the items between brackets.
    fn parse_group(&mut self, name: Option<Key<'a>>) -> Node<'a> {
        let Some(open) = self.peek() else { return self.parse_value() };
        let start = name.as_ref().map_or(open.start, |name| name.span.start);
        self.at += 1;
        self.open.push(open);
        let mut items = Vec::new();
        if self.open.len() > MAX_DEPTH {
            self.report(
                open.span(),
                "the brackets are nested too deeply",
                "no scene field needs that many levels",
            );
            self.is_unreliable = true;
            self.at = self.tokens.len();
        }
        let end = loop {
            match self.peek() {
                None => {
                    self.report_unclosed();
                    break self.source.trim_end().len();
                }
                Some(token) if token.kind == TokenKind::Close => break self.close_group(token),
                Some(token) if self.is_field_in_list(token) => {
                    let help = format!("put `{}` before `{}`", closing(open.text), token.text);
                    let message = format!("this `{}` is not closed", open.text);
                    self.report(open.span(), message, help);
                    self.resumed_at = Some(self.at);
                    break token.start;
                }
                Some(_) => items.push(self.parse_item()),
            }
            self.expect_comma();
        };
        self.open.pop();
        let open = open.text.chars().next().unwrap_or('(');
        Node { span: start..end, kind: NodeKind::Group(Group { name, open, items }) }
    }

    /// Moves past the bracket `close`, if it closes the innermost group or is written in place of
    /// the bracket that would. Returns the end of the group.
    fn close_group(&mut self, close: Token<'a>) -> usize {
        let open = self.open.last().copied().unwrap_or(close);
        if close.text == closing(open.text) {
            self.at += 1;
            return close.span().end;
        }
        let line = line_of(self.source, open.start);
        let help =
            format!("close the `{}` on line {line} with `{}`", open.text, closing(open.text));
        self.report(close.span(), "expected a comma or a closing bracket here", help);
        // Brackets that the rest of the text closes but does not open.
        let mut depth = 0_usize;
        let mut unopened = 0_usize;
        for token in &self.tokens[self.at + 1..] {
            match token.kind {
                TokenKind::Open => depth += 1,
                TokenKind::Close if depth > 0 => depth -= 1,
                TokenKind::Close => unopened += 1,
                _ => {}
            }
        }
        if unopened + 1 >= self.open.len() {
            self.at += 1;
            return close.span().end;
        }
        close.start
    }

    /// Reports the end of the text inside a group, once.
    fn report_unclosed(&mut self) {
        if self.is_unreliable {
            return;
        }
        self.is_unreliable = true;
        let end = self.source.trim_end().len();
        let last = self.source[..end].chars().next_back().map_or(0, char::len_utf8);
        let help = self.open.last().map(|open| {
            format!("close the `{}` on line {}", open.text, line_of(self.source, open.start))
        });
        self.report(
            end - last..end,
            "unexpected end of file",
            help.unwrap_or(SAMPLE_SCENE.to_owned()),
        );
    }

    /// Whether a field begins here although the innermost group is a list, so that the list's
    /// bracket is missing.
    fn is_field_in_list(&self, token: Token<'_>) -> bool {
        let in_list = self.open.last().is_some_and(|open| open.text == "[")
            && self.open.iter().any(|open| open.text == "(");
        let next = self.tokens.get(self.at + 1).map(|next| next.kind);
        in_list && is_identifier(token.text) && next == Some(TokenKind::Colon)
    }

    /// Parses an element, or a field with its key.
    fn parse_item(&mut self) -> SyntaxItem<'a> {
        let (first, second) = (self.peek(), self.tokens.get(self.at + 1).copied());
        let (Some(first), Some(second)) = (first, second) else {
            return SyntaxItem { key: None, value: self.parse_value() };
        };
        let in_list = self.open.last().is_some_and(|open| open.text == "[");
        let may_be_key = first.kind == TokenKind::Word && !in_list;
        // `name = value` and `name value` lack a colon.
        let begins_value = matches!(second.kind, TokenKind::Word)
            || (second.kind == TokenKind::Open && second.text == "[");
        let has_colon = second.kind == TokenKind::Colon && first.kind == TokenKind::Word;
        let lacks_colon = may_be_key && is_identifier(first.text) && begins_value;
        if !has_colon && !lacks_colon {
            return SyntaxItem { key: None, value: self.parse_value() };
        }
        let quoted = is_string(first.text).then(|| first.text.trim_matches('"'));
        let name = quoted.unwrap_or(first.text);
        let key = Key { name: name.strip_prefix("r#").unwrap_or(name), span: first.span() };
        self.at += 1;
        if lacks_colon {
            self.report(second.span(), "expected a colon here", "write fields as `name: value`");
            self.at += usize::from(matches!(second.text, "=" | ";"));
        } else {
            self.at += 1;
        }
        SyntaxItem { key: Some(key), value: self.parse_value() }
    }

    /// Moves past the comma after an item, and reports it if it is missing.
    fn expect_comma(&mut self) {
        if self.eat(TokenKind::Comma) {
            return;
        }
        let Some(token) = self.peek().filter(|token| token.kind != TokenKind::Close) else {
            return;
        };
        if self.is_field_in_list(token) || self.resumed_at == Some(self.at) {
            return;
        }
        let is_missing = token.kind != TokenKind::Colon && !matches!(token.text, "=" | ";");
        let help = if is_missing {
            "put a comma before it; commas separate fields and elements"
        } else {
            "separate fields and elements with commas"
        };
        let first = token.text.chars().next().map_or(0, char::len_utf8);
        self.report(
            token.start..token.start + first,
            "expected a comma or a closing bracket here",
            help,
        );
        if !is_missing {
            self.at += 1;
        }
    }
}

/// Whether a word is a string literal, plain or raw.
fn is_string(word: &str) -> bool {
    word.starts_with('"')
        || (word.starts_with('r')
            && word.trim_start_matches('r').trim_start_matches('#').starts_with('"'))
}

/// Whether a string literal has its closing quotation mark.
fn is_terminated_string(word: &str) -> bool {
    if let Some(raw) = word.strip_prefix('r') {
        let hashes = raw.len() - raw.trim_start_matches('#').len();
        let end = format!("\"{}", "#".repeat(hashes));
        return raw.len() >= 2 * (hashes + 1) && raw.ends_with(&end);
    }
    let body = word.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
    // An odd number of backslashes escapes the last quotation mark.
    body.is_some_and(|body| (body.len() - body.trim_end_matches('\\').len()) % 2 == 0)
}

/// Whether a word can be a name. Hyphens are accepted, so that `camera-position` is an unknown
/// field rather than a syntax error.
fn is_identifier(word: &str) -> bool {
    let word = word.strip_prefix("r#").unwrap_or(word);
    word.starts_with(|c: char| c.is_alphabetic() || c == '_')
        && word.chars().all(|c| c.is_alphanumeric() || "_-".contains(c))
        && !matches!(word, "inf" | "NaN")
}

/// Returns the bracket that closes `open`.
fn closing(open: &str) -> &'static str {
    match open {
        "[" => "]",
        "{" => "}",
        _ => ")",
    }
}

/// Returns the line of a byte in the text, counted from 1.
fn line_of(source: &str, at: usize) -> usize {
    source[..at].matches('\n').count() + 1
}
