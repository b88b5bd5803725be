//! Statements of OBJ and MTL files: a keyword and its arguments, on one line or several lines
//! joined by backslashes.

use crate::text::Token;

/// Reads one statement after another. The position stays in a statement until the next statement is
/// requested.
#[derive(Clone, Copy, Debug)]
pub(super) struct StatementReader<'a> {
    /// The text in UTF-8, or in another encoding that contains ASCII.
    text: &'a [u8],
    /// Offset of the next byte.
    at: usize,
}

impl<'a> StatementReader<'a> {
    /// Creates a reader at the beginning of the text.
    pub(super) const fn new(text: &'a [u8]) -> Self {
        Self { text, at: 0 }
    }

    /// Returns the keyword of the next statement, or `None` at the end of the text.
    ///
    /// The rest of the current statement is skipped, as are blank lines and comments.
    pub(super) fn next_statement(&mut self) -> Option<Token<'a>> {
        if self.at > 0 {
            self.skip_line();
        }
        while self.at < self.text.len() {
            let keyword = self.next_argument();
            if keyword.is_some() {
                return keyword;
            }
            self.skip_line();
        }
        None
    }

    /// Returns the next argument of the current statement, or `None` at the end of the statement.
    #[inline]
    pub(super) fn next_argument(&mut self) -> Option<Token<'a>> {
        let (text, mut start) = (self.text, self.at);
        loop {
            match *text.get(start)? {
                b'\n' | b'\r' | b'#' => break,
                b'\\' => match self.continuation_length(start) {
                    0 => break,
                    length => start += length,
                },
                byte if byte <= b' ' => start += 1,
                _ => break,
            }
            self.at = start;
        }
        if matches!(text[start], b'\n' | b'\r' | b'#') {
            return None;
        }
        let mut end = start + 1;
        while text.get(end).is_some_and(|byte| *byte > b' ') {
            end += 1;
        }
        // `7\` at the end of a line is a number followed by a continuation.
        if text[end - 1] == b'\\' && end - start > 1 && self.continuation_length(end - 1) > 0 {
            end -= 1;
        }
        self.at = end;
        Some(Token { bytes: &text[start..end], offset: start })
    }

    /// Returns the trimmed rest of the line, for names, which may contain spaces.
    pub(super) fn rest_of_line(&mut self) -> Token<'a> {
        let rest = self.text.get(self.at..).unwrap_or_default();
        let length = line_length(rest);
        let line = Token { bytes: &rest[..length], offset: self.at };
        self.at += length;
        line.trim()
    }

    /// Skips to the end of the statement. A comment ends with its line: `# C:\` does not continue.
    fn skip_line(&mut self) {
        loop {
            let rest = self.text.get(self.at..).unwrap_or_default();
            let is_comment = rest.first() == Some(&b'#');
            let length = line_length(rest);
            let is_joined = !is_comment && rest[..length].last() == Some(&b'\\');
            self.at = (self.at + length + 1).min(self.text.len());
            if !is_joined || self.at == self.text.len() {
                return;
            }
            if rest.get(length..length + 2) == Some(b"\r\n") {
                self.at += 1;
            }
        }
    }

    /// Returns the length of a backslash and the line end after it, or 0 if there is no such
    /// sequence.
    fn continuation_length(&self, at: usize) -> usize {
        match self.text.get(at + 1..) {
            Some([b'\r', b'\n', ..]) => 3,
            Some([b'\r' | b'\n', ..]) => 2,
            _ => 0,
        }
    }
}

/// Returns the number of bytes before the next line end.
fn line_length(rest: &[u8]) -> usize {
    rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the statements, each as a list of words.
    fn statements(text: &str) -> Vec<Vec<String>> {
        let mut reader = StatementReader::new(text.as_bytes());
        let mut all = Vec::new();
        while let Some(keyword) = reader.next_statement() {
            let mut words = vec![keyword.to_text()];
            while let Some(word) = reader.next_argument() {
                words.push(word.to_text());
            }
            all.push(words);
        }
        all
    }

    #[test]
    fn comments_and_continuations_are_handled() {
        for (text, expected) in [
            ("", vec![]),
            ("\n  \r\n# f 1\n", vec![]),
            (
                "v 1 2\r\nf  3\t4 # five\rend",
                vec![vec!["v", "1", "2"], vec!["f", "3", "4"], vec!["end"]],
            ),
            ("f 1 \\\n 2\\\r\n3\nv", vec![vec!["f", "1", "2", "3"], vec!["v"]]),
            // Backslashes in the middle of a line, at the end of the file, and in a comment.
            ("g a\\b\nf 1 \\", vec![vec!["g", "a\\b"], vec!["f", "1", "\\"]]),
            ("# C:\\\nv 1", vec![vec!["v", "1"]]),
            ("\\\n\\\nv \\\n", vec![vec!["v"]]),
        ] {
            assert_eq!(statements(text), expected, "{text:?}");
        }
    }

    #[test]
    fn names_extend_to_the_end_of_the_line() {
        let mut reader = StatementReader::new(b"g  two words \r\nf 1 2 \\\n3\ng");
        assert_eq!(reader.next_statement().unwrap().bytes, b"g");
        assert_eq!(reader.rest_of_line().bytes, b"two words");
        assert_eq!(reader.next_statement().unwrap().offset, 15);
        assert_eq!(reader.next_statement().unwrap().bytes, b"g", "the joined line is also skipped");
        assert_eq!(reader.rest_of_line().bytes, b"");
        assert_eq!(reader.next_statement(), None);
    }
}
