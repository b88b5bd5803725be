//! The formatter's tree: tokens grouped into brackets and items, each with its comment.
//!
//! Unlike the parser's syntax tree, it keeps comments, blank lines and the spelling of literals,
//! and it does not know the declared fields or types. An item is everything between two commas.

use crate::syntax::{Token, TokenKind};

/// An element, a comment, or an element followed by a comment on its line.
#[derive(Debug, Default)]
pub(super) struct FormatItem {
    /// The element; `None` for a comment on a separate line.
    pub(super) element: Option<Element>,
    /// The comment with its slashes, with or without an element before it.
    pub(super) comment: Option<String>,
    /// Whether a blank line separates it from the previous item.
    pub(super) blank_before: bool,
}

/// A value, perhaps with the name of its field.
#[derive(Debug, Default)]
pub(super) struct Element {
    /// Alternating text and groups: `path: "a.glb"` is one run of text, `view: LookAt(…)` a run of
    /// text and a group.
    pub(super) parts: Vec<Part>,
}

/// A run of text or a bracketed group.
#[derive(Debug)]
pub(super) enum Part {
    /// Words with the spaces between them.
    Text(String),
    /// Brackets with the items inside.
    Group(FormatGroup),
}

/// A pair of brackets.
#[derive(Debug)]
pub(super) struct FormatGroup {
    /// The opening bracket: `(`, `[` or `{`.
    pub(super) open: char,
    /// The closing bracket, as written.
    pub(super) close: char,
    /// Whether a line break follows the opening bracket.
    pub(super) multiline: bool,
    /// The items between the brackets.
    pub(super) items: Vec<FormatItem>,
}

/// Groups the tokens of the whole text into items.
pub(super) fn group_tokens(tokens: &[Token<'_>]) -> Vec<FormatItem> {
    ItemReader { tokens, at: 0 }.read_items()
}

/// Recursive-descent parser for items; comments are items too.
struct ItemReader<'a> {
    /// The tokens of the whole text.
    tokens: &'a [Token<'a>],
    /// Index of the next token.
    at: usize,
}

impl<'a> ItemReader<'a> {
    /// Returns the next token and moves past it.
    fn next(&mut self) -> Option<Token<'a>> {
        let token = self.tokens.get(self.at).copied()?;
        self.at += 1;
        Some(token)
    }

    /// Returns the next token.
    fn peek(&self) -> Option<Token<'a>> {
        self.tokens.get(self.at).copied()
    }

    /// Reads the items up to the closing bracket, or to the end.
    ///
    /// Comments inside an element become items before it, and the first of them takes over the
    /// blank line. Commas are dropped; the writer puts one after each element.
    fn read_items(&mut self) -> Vec<FormatItem> {
        let mut items: Vec<FormatItem> = Vec::new();
        while let Some(token) = self.peek() {
            match token.kind {
                TokenKind::Close => return items,
                TokenKind::Comma => self.at += 1,
                TokenKind::LineComment => {
                    self.at += 1;
                    self.attach_comment(&mut items, token);
                }
                TokenKind::BlockComment if self.ends_its_line() => {
                    self.at += 1;
                    self.attach_comment(&mut items, token);
                }
                _ => {
                    let blank_before = token.line_breaks_before > 1;
                    let (element, comments) = self.read_element();
                    let own = |(number, text): (usize, &str)| FormatItem {
                        comment: Some(text.to_owned()),
                        blank_before: blank_before && number == 0,
                        ..FormatItem::default()
                    };
                    let blank_before = blank_before && comments.is_empty();
                    items.extend(comments.into_iter().enumerate().map(own));
                    items.push(FormatItem { element: Some(element), comment: None, blank_before });
                }
            }
        }
        items
    }

    /// Attaches a comment to the item before it on the same line; other comments become items.
    ///
    /// Only one comment can follow an element; a second one on the line begins an item.
    fn attach_comment(&self, items: &mut Vec<FormatItem>, token: Token<'_>) {
        let text = token.text.to_owned();
        match items.last_mut() {
            Some(last) if token.line_breaks_before == 0 && last.comment.is_none() => {
                last.comment = Some(text);
            }
            _ => {
                let blank_before = token.line_breaks_before > 1;
                items.push(FormatItem { element: None, comment: Some(text), blank_before });
            }
        }
    }

    /// Whether the next token, a block comment, is the last on its line.
    fn ends_its_line(&self) -> bool {
        let next = self.tokens.get(self.at + 1);
        next.is_none_or(|next| next.line_breaks_before > 0 || next.kind == TokenKind::Close)
    }

    /// Reads an element and the line comments inside it.
    ///
    /// Line comments cannot stay inside, since the element may end up on one line; they are
    /// returned to be placed before the element. Block comments stay among the words.
    fn read_element(&mut self) -> (Element, Vec<&'a str>) {
        let (mut parts, mut comments) = (Vec::new(), Vec::new());
        let mut text = String::new();
        while let Some(token) = self.peek() {
            match token.kind {
                TokenKind::Comma | TokenKind::Close => break,
                // The comment follows the element, with or without a comma after it.
                TokenKind::LineComment if self.is_element_end() => break,
                TokenKind::LineComment => comments.push(token.text),
                TokenKind::Colon => text.push_str(": "),
                TokenKind::Word | TokenKind::BlockComment => {
                    let glued = text.is_empty() || text.ends_with(' ');
                    text.push_str(if glued { "" } else { " " });
                    text.push_str(token.text);
                }
                TokenKind::Open => {
                    self.at += 1;
                    parts.push(Part::Text(std::mem::take(&mut text)));
                    parts.push(Part::Group(self.read_group(token)));
                    continue;
                }
            }
            self.at += 1;
        }
        if !text.is_empty() {
            parts.push(Part::Text(text));
        }
        (Element { parts }, comments)
    }

    /// Whether the line comments from here on are followed by the end of the element.
    fn is_element_end(&self) -> bool {
        let rest = self.tokens[self.at..].iter().find(|token| token.kind != TokenKind::LineComment);
        rest.is_none_or(|token| matches!(token.kind, TokenKind::Comma | TokenKind::Close))
    }

    /// Reads the group after an opening bracket.
    ///
    /// The first token after the bracket decides whether the group stays open: if a line break
    /// precedes it, every item gets a line. An empty group is always closed.
    fn read_group(&mut self, open: Token<'_>) -> FormatGroup {
        let broken = self.peek().is_some_and(|first| first.line_breaks_before > 0);
        let items = self.read_items();
        let close = self.next().and_then(|token| token.text.chars().next());
        let open = open.text.chars().next().unwrap_or('(');
        let usual = match open {
            '[' => ']',
            '{' => '}',
            _ => ')',
        };
        let broken = broken && !items.is_empty();
        FormatGroup { open, close: close.unwrap_or(usual), multiline: broken, items }
    }
}
