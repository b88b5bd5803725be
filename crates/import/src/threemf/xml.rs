//! A parser for the subset of XML that 3MF uses: reads elements with attributes in one pass and
//! without allocation.
//!
//! Only the five predefined entities and numeric references are supported, and a document type
//! declaration is an error, as OPC requires, so nothing can expand. Text between elements is
//! skipped.

use crate::text::LineCounter;
use model::Diagnostic;
use std::borrow::Cow;
use std::cell::RefCell;

/// The start tag of an element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element<'a> {
    /// The name with its prefix.
    name: &'a [u8],
    /// Everything between the name and the end of the tag.
    attributes: &'a [u8],
    /// Offset of the tag.
    offset: usize,
}

/// Reads the elements of a document in order.
#[derive(Debug)]
pub(super) struct XmlReader<'a> {
    text: &'a [u8],
    at: usize,
    /// Names of the open elements.
    open: Vec<&'a [u8]>,
    /// Whether the last tag was an empty-element tag, so that its element ends next.
    closes_next: bool,
    /// The name of the document, which precedes every location.
    document: &'a str,
    /// Counts lines incrementally, because every object has a location.
    lines: RefCell<LineCounter<'a>>,
}

/// A tag. An empty-element tag counts as a start tag and an end tag.
enum Tag<'a> {
    Start(Element<'a>),
    End,
}

impl<'a> XmlReader<'a> {
    /// Creates a reader at the beginning of UTF-8 text; `document` is its name in messages.
    pub(super) const fn new(text: &'a [u8], document: &'a str) -> Self {
        let lines = RefCell::new(LineCounter::new(text));
        Self { text, at: 0, open: Vec::new(), closes_next: false, document, lines }
    }

    /// Returns the number of open elements, which is the depth of the last returned element.
    pub(super) const fn depth(&self) -> usize {
        self.open.len()
    }

    /// Returns the next child of the open element at a depth (0 for the document), skipping the
    /// rest of the previous child. Returns `None` at the end of the element.
    ///
    /// # Errors
    /// Fails if the text is not XML or has a document type declaration.
    pub(super) fn next_child(&mut self, depth: usize) -> Result<Option<Element<'a>>, Diagnostic> {
        loop {
            match self.next_tag()? {
                Some(Tag::Start(element)) if self.open.len() == depth + 1 => {
                    return Ok(Some(element));
                }
                Some(Tag::End) if self.open.len() < depth => return Ok(None),
                Some(_) => {}
                None if depth == 0 && self.open.is_empty() => return Ok(None),
                None => return Err(self.fault(self.at, "the text ends within an element")),
            }
        }
    }

    /// Returns the next tag, or `None` at the end of the text.
    fn next_tag(&mut self) -> Result<Option<Tag<'a>>, Diagnostic> {
        if std::mem::take(&mut self.closes_next) {
            self.open.pop();
            return Ok(Some(Tag::End));
        }
        loop {
            let rest = &self.text[self.at..];
            let Some(begin) = rest.iter().position(|&byte| byte == b'<') else {
                self.at = self.text.len();
                return Ok(None);
            };
            self.at += begin;
            let rest = &rest[begin..];
            let (end, skipped): (&[u8], usize) = match rest {
                [b'<', b'!', b'-', b'-', ..] => (b"-->", 4),
                [b'<', b'?', ..] => (b"?>", 2),
                [b'<', b'!', b'[', ..] => (b"]]>", 3),
                // Entities in a document type could expand without limit.
                [b'<', b'!', ..] => {
                    let message = "document type declarations are not allowed in 3MF";
                    return Err(self.fault(self.at, message));
                }
                [b'<', b'/', ..] => return self.end_tag(rest).map(Some),
                _ => return self.start_tag(rest).map(Some),
            };
            let inner = &rest[skipped.min(rest.len())..];
            let Some(length) = inner.windows(end.len()).position(|window| window == end) else {
                return Err(self.fault(self.at, "this markup is not closed"));
            };
            self.at += skipped + length + end.len();
        }
    }

    /// Parses an end tag, which must match the innermost element.
    fn end_tag(&mut self, rest: &'a [u8]) -> Result<Tag<'a>, Diagnostic> {
        let length = rest.iter().position(|&byte| byte == b'>');
        let name = length.map(|length| rest[2..length].trim_ascii());
        if name.is_none() || self.open.pop() != name {
            return Err(self.fault(self.at, "this end tag does not match the innermost element"));
        }
        self.at += length.unwrap_or(0) + 1;
        Ok(Tag::End)
    }

    /// Parses a start tag or an empty-element tag.
    fn start_tag(&mut self, rest: &'a [u8]) -> Result<Tag<'a>, Diagnostic> {
        let Some(length) = tag_length(rest) else {
            return Err(self.fault(self.at, "the tag is not closed"));
        };
        let inner = &rest[1..length];
        let (inner, is_empty) = match inner {
            [inner @ .., b'/'] => (inner, true),
            inner => (inner, false),
        };
        let is_space = |byte: &u8| byte.is_ascii_whitespace();
        let (name, attributes) =
            inner.split_at(inner.iter().position(is_space).unwrap_or(inner.len()));
        if name.is_empty() {
            return Err(self.fault(self.at, "the tag has no name"));
        }
        let element = Element { name, attributes, offset: self.at };
        self.at += length + 1;
        self.open.push(name);
        self.closes_next = is_empty;
        Ok(Tag::Start(element))
    }

    /// Returns an error at an offset.
    #[cold]
    #[inline(never)]
    pub(super) fn fault(&self, offset: usize, message: &str) -> Diagnostic {
        Diagnostic::invalid(&self.location(offset), message)
    }

    /// Returns the document name, line and column of an offset.
    #[inline(never)]
    pub(super) fn location(&self, offset: usize) -> String {
        format!("{}: {}", self.document, self.lines.borrow_mut().locate(offset))
    }

    /// Returns the document name, line and column of an element.
    pub(super) fn location_of(&self, element: &Element<'_>) -> String {
        self.location(element.offset)
    }
}

/// Returns the offset of the `>` that ends a tag, ignoring any inside quotation marks.
fn tag_length(rest: &[u8]) -> Option<usize> {
    let mut quote = 0;
    rest.iter().position(|&byte| {
        match byte {
            b'>' if quote == 0 => return true,
            b'"' | b'\'' if quote == 0 => quote = byte,
            _ if byte == quote => quote = 0,
            _ => {}
        }
        false
    })
}

impl<'a> Element<'a> {
    /// Returns the prefix of the name, or an empty string if there is none.
    pub(super) fn prefix(&self) -> &'a [u8] {
        split_name(self.name).0
    }

    /// Returns the name without its prefix, or an empty string if it is not UTF-8.
    pub(super) fn local_name(&self) -> &'a str {
        std::str::from_utf8(split_name(self.name).1).unwrap_or("")
    }

    /// Returns the attributes in order: the prefix, the local name and the raw value.
    pub(super) fn attributes(&self) -> Attributes<'a> {
        Attributes { rest: self.attributes }
    }

    /// Returns the raw value of the first attribute with a local name, without surrounding white
    /// space.
    #[inline(never)]
    pub(super) fn attribute(&self, name: &str) -> Option<&'a [u8]> {
        let found = self.attributes().find(|(_, local, _)| *local == name.as_bytes());
        found.map(|(_, _, value)| value.trim_ascii())
    }

    /// Returns the value of an attribute with its character references resolved.
    #[inline(never)]
    pub(super) fn text_attribute(&self, name: &str) -> Option<String> {
        self.attribute(name).map(|value| unescape(value).into_owned())
    }
}

/// Splits a name into prefix and local name.
fn split_name(name: &[u8]) -> (&[u8], &[u8]) {
    match name.iter().position(|&byte| byte == b':') {
        Some(colon) => (&name[..colon], &name[colon + 1..]),
        None => (&[], name),
    }
}

/// The attributes of a tag; iteration ends at the first malformed attribute.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attributes<'a> {
    rest: &'a [u8],
}

impl<'a> Iterator for Attributes<'a> {
    type Item = (&'a [u8], &'a [u8], &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let equals = self.rest.iter().position(|&byte| byte == b'=')?;
        let (prefix, local) = split_name(self.rest[..equals].trim_ascii());
        let value = self.rest[equals + 1..].trim_ascii_start();
        let (&quote, value) = value.split_first().filter(|(q, _)| matches!(q, b'"' | b'\''))?;
        let end = value.iter().position(|&byte| byte == quote)?;
        self.rest = &value[end + 1..];
        Some((prefix, local, &value[..end]))
    }
}

/// Returns text with its character references resolved. Unknown references are not changed.
pub(super) fn unescape(value: &[u8]) -> Cow<'_, str> {
    let text = String::from_utf8_lossy(value);
    if !text.contains('&') {
        return text;
    }
    let mut resolved = String::with_capacity(text.len());
    let mut rest = text.as_ref();
    while let Some(at) = rest.find('&') {
        resolved.push_str(&rest[..at]);
        rest = &rest[at..];
        // The longest reference is `&#x10FFFF;`.
        let end = rest.bytes().take(12).position(|byte| byte == b';');
        let reference = end.and_then(|end| {
            referenced_character(&rest[1..end]).map(|character| (character, &rest[end + 1..]))
        });
        if let Some((character, after)) = reference {
            resolved.push(character);
            rest = after;
        } else {
            resolved.push('&');
            rest = &rest[1..];
        }
    }
    resolved.push_str(rest);
    Cow::Owned(resolved)
}

/// Returns the character for a reference without `&` and `;`.
fn referenced_character(name: &str) -> Option<char> {
    match name {
        "lt" => Some('<'),
        "gt" => Some('>'),
        "amp" => Some('&'),
        "quot" => Some('"'),
        "apos" => Some('\''),
        _ => {
            let number = name.strip_prefix('#')?;
            let code = match number.strip_prefix('x') {
                Some(digits) => u32::from_str_radix(digits, 16),
                None => number.parse(),
            };
            char::from_u32(code.ok()?)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn children(text: &str) -> Result<Vec<String>, String> {
        let mut reader = XmlReader::new(text.as_bytes(), "a.xml");
        let mut read = || {
            let mut names = Vec::new();
            if reader.next_child(0)?.is_some() {
                let depth = reader.depth();
                while let Some(child) = reader.next_child(depth)? {
                    names.push(child.local_name().to_owned());
                }
            }
            reader.next_child(0)?;
            Ok(names)
        };
        read().map_err(|error: Diagnostic| error.sentence())
    }

    #[test]
    fn children_are_listed_and_their_content_skipped() {
        let text = "<?xml version='1.0'?><!-- <x> --><a><b><c/><c>1</c></b> text\
                    <![CDATA[<d>]]><m:e x=\"a > b\" /><f></f></a>\n";
        assert_eq!(children(text).unwrap(), ["b", "e", "f"]);
    }

    #[test]
    fn malformed_xml_is_an_error_with_a_location() {
        let table = [
            ("<a><b>\n</a>", "a.xml: line 2, column 1: this end tag does not match"),
            ("<a><b", "a.xml: line 1, column 4: the tag is not closed"),
            ("<a>", "a.xml: line 1, column 4: the text ends within an element"),
            ("<a><!-- ", "a.xml: line 1, column 4: this markup is not closed"),
            ("<!DOCTYPE a [<!ENTITY b 'bb'>]><a/>", "a.xml: line 1, column 1: document type"),
            ("<a>< b/></a>", "a.xml: line 1, column 4: the tag has no name"),
            ("<a></a></a>", "a.xml: line 1, column 8: this end tag does not match"),
        ];
        for (text, expected) in table {
            let message = children(text).unwrap_err();
            assert!(message.starts_with(expected), "{text}: {message}");
        }
    }

    #[test]
    fn attributes_are_found_by_local_name() {
        let text = br#"<a x = '1 ' p:y="&lt;&#65;&#x42;&amp;&no;&" z=3>"#;
        let element = XmlReader::new(text, "").next_child(0).unwrap().unwrap();
        assert_eq!(element.attribute("x"), Some(&b"1"[..]));
        assert_eq!(element.text_attribute("y").unwrap(), "<AB&&no;&");
        assert_eq!(element.attribute("z"), None, "a value needs quotation marks");
    }
}
