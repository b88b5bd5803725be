//! Scans the lines and tokens of text by byte offset, and locates offsets by line and column for
//! messages.

use super::decimal::simple_decimal;

/// Reads the lines or tokens of text.
///
/// Lines end with LF, CR or both. Every byte up to and including the space character, except for
/// line ends, is white space, because some exporters write tabs, form feeds and NUL.
#[derive(Clone, Debug)]
pub(crate) struct TextScanner<'a> {
    text: &'a [u8],
    at: usize,
}

/// A piece of text: a line, or a run of bytes without white space.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Token<'a> {
    /// The bytes; only a line may be empty.
    pub(crate) bytes: &'a [u8],
    /// Offset of the first byte in the text.
    pub(crate) offset: usize,
}

impl<'a> TextScanner<'a> {
    /// Creates a scanner at the beginning of UTF-8 text.
    pub(crate) const fn new(text: &'a [u8]) -> Self {
        Self { text, at: 0 }
    }

    /// Creates a scanner that starts at an offset in text.
    pub(crate) const fn starting_at(text: &'a [u8], offset: usize) -> Self {
        Self { text, at: offset }
    }

    /// Returns the offset of the next byte.
    pub(crate) const fn offset(&self) -> usize {
        self.at
    }

    /// Returns the rest of the current line, without its line end, or `None` at the end of the
    /// text.
    ///
    /// A carriage return followed by a line feed is one line end.
    pub(crate) fn next_line(&mut self) -> Option<Token<'a>> {
        let rest = self.text.get(self.at..).filter(|rest| !rest.is_empty())?;
        let length =
            rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len());
        let offset = self.at;
        let end = if rest[length..].starts_with(b"\r\n") { 2 } else { 1 };
        self.at = (offset + length + end).min(self.text.len());
        Some(Token { bytes: &rest[..length], offset })
    }

    /// Skips the next token if it has exactly this spelling; otherwise does nothing.
    #[inline]
    pub(crate) fn skip_token(&mut self, token: &[u8]) -> bool {
        let start = self.skip_space();
        let rest = self.text.get(start..).unwrap_or_default();
        let is_next = rest.starts_with(token) && rest.get(token.len()).is_some_and(|b| *b <= b' ');
        if is_next {
            self.at = start + token.len();
        }
        is_next
    }

    /// Reads a number in the most common form, which is faster than reading a token. Returns
    /// `None`, without consuming anything, for any other token.
    #[inline]
    pub(crate) fn next_simple_number(&mut self) -> Option<f32> {
        let start = self.skip_space();
        let (number, length) = simple_decimal(self.text.get(start..)?)?;
        self.at = start + length;
        Some(number)
    }

    /// Returns the offset of the next byte that is not white space.
    #[inline]
    fn skip_space(&self) -> usize {
        let mut start = self.at;
        while self.text.get(start).is_some_and(|byte| *byte <= b' ') {
            start += 1;
        }
        start
    }

    /// Returns the next token on this line or a later line, or `None` at the end of the text.
    #[inline]
    pub(crate) fn next_token(&mut self) -> Option<Token<'a>> {
        let (text, mut start) = (self.text, self.at);
        while *text.get(start)? <= b' ' {
            start += 1;
        }
        let mut end = start + 1;
        while text.get(end).is_some_and(|byte| *byte > b' ') {
            end += 1;
        }
        self.at = end;
        Some(Token { bytes: &text[start..end], offset: start })
    }
}

impl<'a> Token<'a> {
    /// Returns the tokens of a line with their offsets in the whole text.
    pub(crate) fn tokens(self) -> impl Iterator<Item = Token<'a>> + Clone {
        let mut scanner = TextScanner::new(self.bytes);
        std::iter::from_fn(move || {
            let Token { bytes, offset } = scanner.next_token()?;
            Some(Token { bytes, offset: self.offset + offset })
        })
    }

    /// Returns the piece without leading and trailing white space.
    pub(crate) fn trim(self) -> Self {
        let start = self.bytes.iter().position(|byte| *byte > b' ').unwrap_or(self.bytes.len());
        let end = self.bytes.iter().rposition(|byte| *byte > b' ').map_or(start, |last| last + 1);
        Self { bytes: &self.bytes[start..end], offset: self.offset + start }
    }

    /// Returns whether this is the keyword, in upper or lower case.
    pub(crate) fn is_keyword(self, keyword: &str) -> bool {
        self.bytes.eq_ignore_ascii_case(keyword.as_bytes())
    }

    /// Returns the piece as text. Bytes that are not UTF-8 become U+FFFD.
    pub(crate) fn to_text(self) -> String {
        String::from_utf8_lossy(self.bytes).into_owned()
    }
}

/// Counts lines up to an offset, for the locations of messages.
///
/// Counting continues from the last offset, so locating offsets in text order takes a single pass.
#[derive(Debug)]
pub(crate) struct LineCounter<'a> {
    text: &'a [u8],
    at: usize,
    line: usize,
    line_start: usize,
}

impl<'a> LineCounter<'a> {
    /// Creates a counter for the text that offsets refer to.
    pub(crate) const fn new(text: &'a [u8]) -> Self {
        Self { text, at: 0, line: 1, line_start: 0 }
    }

    /// Returns the location of an offset as `line 12, column 5`. Both count from 1, and columns
    /// count bytes.
    pub(crate) fn locate(&mut self, offset: usize) -> String {
        if offset < self.at {
            *self = Self::new(self.text);
        }
        let passed = self.text.get(self.at..offset).unwrap_or_default();
        for (at, byte) in passed.iter().enumerate().map(|(at, byte)| (self.at + at, byte)) {
            let ends_here = match byte {
                b'\n' => true,
                b'\r' => self.text.get(at + 1) != Some(&b'\n'),
                _ => false,
            };
            if ends_here {
                (self.line, self.line_start) = (self.line + 1, at + 1);
            }
        }
        self.at += passed.len();
        format!("line {}, column {}", self.line, offset - self.line_start + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_end_is_recognized() {
        let text = b"a b\r\n\rc \xE4\n\nd";
        let mut scanner = TextScanner::new(text);
        let lines: Vec<&[u8]> =
            std::iter::from_fn(|| scanner.next_line()).map(|line| line.bytes).collect();
        assert_eq!(lines, [&b"a b"[..], b"", b"c \xE4", b"", b"d"]);
        assert_eq!(scanner.offset(), text.len());
    }

    #[test]
    fn tokens_have_lines_and_columns() {
        let text = b"one two\r\n\r  three\n\tfour";
        let mut scanner = TextScanner::new(text);
        let mut counter = LineCounter::new(text);
        let mut found = Vec::new();
        while let Some(token) = scanner.next_token() {
            found.push((token.to_text(), counter.locate(token.offset)));
        }
        let expected = [
            ("one", "line 1, column 1"),
            ("two", "line 1, column 5"),
            ("three", "line 3, column 3"),
            ("four", "line 4, column 2"),
        ];
        assert_eq!(found, expected.map(|(word, place)| (word.to_owned(), place.to_owned())));
        assert_eq!(counter.locate(4), "line 1, column 5", "an earlier offset");
        let line = TextScanner::new(b"  a  bc ").next_line().unwrap();
        let offsets: Vec<usize> = line.tokens().map(|token| token.offset).collect();
        assert_eq!((offsets, line.trim().bytes), (vec![2, 5], &b"a  bc"[..]));
    }
}
