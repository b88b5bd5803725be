//! A reader for template XML: elements, quoted attributes and text.
//!
//! It reads the output of drawing programs. A document type declaration is an error, because it
//! could define entities.

use super::TemplateError;
use super::path_data::parse_number;

/// The maximum nesting depth of elements.
const MAX_DEPTH: usize = 64;

/// An event in the document.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Event<'a> {
    /// A start tag, or an empty element, which is followed by an end event.
    Start(Element<'a>),
    /// The text between two tags, with references replaced.
    Text(String),
    /// An end tag.
    End(&'a str),
}

/// The start tag of an element.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Element<'a> {
    pub(super) name: &'a str,
    /// The byte position of the tag's `<`.
    pub(super) at: usize,
    /// Names, values and the byte positions where the values begin.
    attributes: Vec<(&'a str, &'a str, usize)>,
}

/// Elements whose contents are not drawn.
const SILENT: [&str; 4] = ["metadata", "title", "desc", "defs"];

/// Attributes that have no effect, because sheets have one ink and one font.
const NEUTRAL: [&str; 14] = [
    "id",
    "class",
    "fill",
    "stroke",
    "font-family",
    "font-weight",
    "stroke-linecap",
    "stroke-linejoin",
    "xmlns",
    "version",
    "lang",
    "space",
    "text-rendering",
    "vector-effect",
];

/// Supported attributes.
const READ: [&str; 20] = [
    "x",
    "y",
    "x1",
    "y1",
    "x2",
    "y2",
    "width",
    "height",
    "points",
    "d",
    "stroke-width",
    "font-size",
    "text-anchor",
    "textLength",
    "viewBox",
    "lengthAdjust",
    "rx",
    "ry",
    "preserveAspectRatio",
    "baseProfile",
];

impl<'a> Element<'a> {
    /// Returns the value of an attribute and the byte position where it begins.
    pub(super) fn attribute(&self, name: &str) -> Option<(&'a str, usize)> {
        let found = self.attributes.iter().find(|(own, ..)| *own == name);
        found.map(|(_, value, at)| (*value, *at))
    }

    /// Parses the number in an attribute, which is in units of the view box and may end in `mm` or
    /// `px`.
    pub(super) fn number(
        &self,
        source: &str,
        name: &str,
        default: f64,
    ) -> Result<f64, TemplateError> {
        let Some((text, at)) = self.attribute(name) else { return Ok(default) };
        let own = text.trim();
        let own = own.strip_suffix("mm").or_else(|| own.strip_suffix("px")).unwrap_or(own);
        parse_number(own).ok_or_else(|| {
            TemplateError::at(source, at, format!("`{text}` is not a number for `{name}`"))
        })
    }

    /// Parses the number in an attribute, which must be greater than 0.
    pub(super) fn size(
        &self,
        source: &str,
        name: &str,
        default: f64,
    ) -> Result<f64, TemplateError> {
        let number = self.number(source, name, default)?;
        if number > 0.0 {
            return Ok(number);
        }
        let at = self.attribute(name).map_or(self.at, |(_, at)| at);
        Err(TemplateError::at(source, at, format!("`{name}` must be greater than 0")))
    }

    /// Checks for unsupported attributes that would change the drawing, such as a transform.
    pub(super) fn check_attributes(&self, source: &str) -> Result<(), TemplateError> {
        let is_known =
            |name: &str| name.contains(':') || NEUTRAL.contains(&name) || READ.contains(&name);
        match self.attributes.iter().find(|(name, ..)| !is_known(name)) {
            None => Ok(()),
            Some((name, _, at)) => {
                let remedy = match *name {
                    "transform" => "write coordinates as they are on the paper",
                    "style" => "write stroke-width, font-size and text-anchor as attributes",
                    _ => "remove it",
                };
                let message = format!("`{name}` of `{}` is not supported; {remedy}", self.name);
                Err(TemplateError::at(source, *at, message))
            }
        }
    }
}

/// Reads the document event by event.
pub(super) struct MarkupReader<'a> {
    source: &'a str,
    at: usize,
    open: Vec<&'a str>,
    /// Whether the end event of an empty element is pending.
    pending_end: bool,
}

impl<'a> MarkupReader<'a> {
    pub(super) const fn new(source: &'a str) -> Self {
        Self { source, at: 0, open: Vec::new(), pending_end: false }
    }

    /// Returns the next event, or `None` at the end of the document.
    pub(super) fn next(&mut self) -> Result<Option<Event<'a>>, TemplateError> {
        loop {
            if core::mem::take(&mut self.pending_end) {
                return Ok(self.open.pop().map(Event::End));
            }
            let rest = &self.source[self.at..];
            if rest.is_empty() {
                return match self.open.last() {
                    None => Ok(None),
                    Some(name) => Err(self.fault(format!("`{name}` is not closed"))),
                };
            }
            if let Some(after) = rest.strip_prefix("<?") {
                self.skip_past(after, "?>", 2)?;
            } else if let Some(after) = rest.strip_prefix("<!--") {
                self.skip_past(after, "-->", 4)?;
            } else if rest.starts_with("<!") {
                // Entities in a document type could expand without limit.
                return Err(self.fault("document types and CDATA are not supported; remove them"));
            } else if let Some(after) = rest.strip_prefix("</") {
                return self.end_tag(after).map(Some);
            } else if rest.starts_with('<') {
                let element = self.start_tag()?;
                // Skip metadata of drawing programs, such as `sodipodi:namedview`.
                if SILENT.contains(&element.name) || element.name.contains(':') {
                    self.skip_element(element.name)?;
                } else {
                    return Ok(Some(Event::Start(element)));
                }
            } else {
                return self.text().map(Some);
            }
        }
    }

    /// Returns an error at the current position.
    fn fault(&self, message: impl Into<String>) -> TemplateError {
        TemplateError::at(self.source, self.at, message)
    }

    /// Skips to the end of a comment or a processing instruction.
    fn skip_past(&mut self, rest: &str, end: &str, begun: usize) -> Result<(), TemplateError> {
        let length = rest.find(end).ok_or_else(|| self.fault(format!("missing `{end}`")))?;
        self.at += begun + length + end.len();
        Ok(())
    }

    /// Skips to the end of an element that has just begun.
    fn skip_element(&mut self, name: &str) -> Result<(), TemplateError> {
        let depth = self.open.len();
        loop {
            match self.next()? {
                Some(Event::End(_)) if self.open.len() < depth => return Ok(()),
                Some(_) => {}
                None => return Err(self.fault(format!("`{name}` is not closed"))),
            }
        }
    }

    /// Reads the end tag after `</`.
    fn end_tag(&mut self, after: &'a str) -> Result<Event<'a>, TemplateError> {
        let end = after.find('>').ok_or_else(|| self.fault("missing `>`"))?;
        let name = after[..end].trim();
        if self.open.last() != Some(&name) {
            return Err(self.fault(format!("`{name}` is closed but not open")));
        }
        self.open.pop();
        self.at += 2 + end + 1;
        Ok(Event::End(name))
    }

    /// Reads the start tag at `<`.
    fn start_tag(&mut self) -> Result<Element<'a>, TemplateError> {
        let at = self.at;
        self.at += 1;
        let name = self.name()?;
        let mut attributes = Vec::new();
        loop {
            self.skip_space();
            let rest = &self.source[self.at..];
            if rest.starts_with("/>") || rest.starts_with('>') {
                self.pending_end = rest.starts_with('/');
                self.at += if self.pending_end { 2 } else { 1 };
                break;
            }
            let own = self.name()?;
            self.skip_space();
            self.expect('=')?;
            self.skip_space();
            let rest = &self.source[self.at..];
            let quote = rest.chars().next().filter(|c| matches!(c, '"' | '\''));
            let quote = quote.ok_or_else(|| self.fault("missing value in quotes"))?;
            let length = rest[1..].find(quote);
            let length = length.ok_or_else(|| self.fault("the quoted value is not closed"))?;
            attributes.push((own, &rest[1..=length], self.at + 1));
            self.at += length + 2;
        }
        if self.open.len() >= MAX_DEPTH {
            return Err(self.fault("elements are nested too deeply"));
        }
        self.open.push(name);
        Ok(Element { name, at, attributes })
    }

    /// Reads the name of an element or an attribute.
    fn name(&mut self) -> Result<&'a str, TemplateError> {
        let rest = &self.source[self.at..];
        let is_name = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | ':' | '.');
        let length = rest.find(|c| !is_name(c)).unwrap_or(rest.len());
        if length == 0 {
            return Err(self.fault("missing name"));
        }
        self.at += length;
        Ok(&rest[..length])
    }

    fn skip_space(&mut self) {
        let rest = &self.source[self.at..];
        self.at += rest.len() - rest.trim_start().len();
    }

    fn expect(&mut self, character: char) -> Result<(), TemplateError> {
        if !self.source[self.at..].starts_with(character) {
            return Err(self.fault(format!("missing `{character}`")));
        }
        self.at += character.len_utf8();
        Ok(())
    }

    /// Reads the text up to the next tag, replacing each whitespace character with a space.
    fn text(&mut self) -> Result<Event<'a>, TemplateError> {
        let rest = &self.source[self.at..];
        let own = &rest[..rest.find('<').unwrap_or(rest.len())];
        let mut text = String::new();
        let mut left = own;
        while let Some((before, after)) = left.split_once('&') {
            text.push_str(before);
            let (name, after) =
                after.split_once(';').ok_or_else(|| self.fault("`&` without `;`; write &amp;"))?;
            let replaced = reference(name);
            text.push(replaced.ok_or_else(|| self.fault(format!("unknown reference `&{name};`")))?);
            left = after;
        }
        text.push_str(left);
        self.at += own.len();
        Ok(Event::Text(text.replace(|c: char| c.is_whitespace(), " ")))
    }
}

/// Returns the character for a reference.
fn reference(name: &str) -> Option<char> {
    match name {
        "amp" => Some('&'),
        "lt" => Some('<'),
        "gt" => Some('>'),
        "quot" => Some('"'),
        "apos" => Some('\''),
        _ => {
            let digits = name.strip_prefix('#')?;
            let code = match digits.strip_prefix('x') {
                Some(digits) => u32::from_str_radix(digits, 16).ok()?,
                None => digits.parse().ok()?,
            };
            char::from_u32(code)
        }
    }
}
