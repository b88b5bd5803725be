//! Comma-separated values (RFC 4180), record by record.

/// A reader for one record, fed line by line because a quoted field may span several lines.
#[derive(Debug, Default)]
pub(super) struct CsvRecord {
    /// The complete fields, and the one being read.
    fields: Vec<String>,
    /// Whether the last line ended inside quotes.
    is_open: bool,
}

impl CsvRecord {
    /// Adds a line, with or without its line break; returns whether the record is complete.
    ///
    /// # Errors
    /// Returns an error if a quote is misplaced.
    pub(super) fn add_line(&mut self, line: &str) -> Result<bool, String> {
        let is_quoted_before = std::mem::take(&mut self.is_open);
        let mut state = if is_quoted_before {
            FieldState::Quoted
        } else {
            self.fields.push(String::new());
            FieldState::Start
        };
        for c in line.chars() {
            state = self.add_character(state, c)?;
        }
        self.is_open = matches!(state, FieldState::Quoted);
        Ok(!self.is_open)
    }

    /// Adds a character to the field being read; a comma begins the next one.
    fn add_character(&mut self, state: FieldState, c: char) -> Result<FieldState, String> {
        let field = self.fields.last_mut();
        match (state, c) {
            (FieldState::Start, '"') => return Ok(FieldState::Quoted),
            (FieldState::Start | FieldState::Plain | FieldState::AfterQuote, ',') => {
                self.fields.push(String::new());
                return Ok(FieldState::Start);
            }
            (FieldState::Quoted, '"') => return Ok(FieldState::AfterQuote),
            // A line break is part of a field only within quotes.
            (FieldState::Start | FieldState::Plain | FieldState::AfterQuote, '\r' | '\n') => {
                return Ok(state);
            }
            (FieldState::Plain, '"') => {
                return Err(
                    "an unquoted field contains `\"`; quote the field, and write `\"\"` inside"
                        .to_owned(),
                );
            }
            (FieldState::AfterQuote, c) if c != '"' => {
                return Err(format!("unexpected `{c}` after a quoted field; expected a comma"));
            }
            _ => {}
        }
        field.into_iter().for_each(|field| field.push(c));
        let is_quoted = matches!(state, FieldState::Quoted | FieldState::AfterQuote);
        Ok(if is_quoted { FieldState::Quoted } else { FieldState::Plain })
    }

    /// Returns the fields of a complete record.
    pub(super) fn into_fields(self) -> Vec<String> {
        self.fields
    }
}

/// The position of a character within a field.
#[derive(Clone, Copy)]
enum FieldState {
    /// At its beginning.
    Start,
    /// In a field without quotes.
    Plain,
    /// Between the quotes.
    Quoted,
    /// After a quote in a quoted field: either the closing quote or the first of two.
    AfterQuote,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(lines: &[&str]) -> Result<Vec<String>, String> {
        let mut record = CsvRecord::default();
        for (at, line) in lines.iter().enumerate() {
            assert_eq!(record.add_line(line)?, at + 1 == lines.len(), "{line}");
        }
        Ok(record.into_fields())
    }

    #[test]
    fn fields_may_be_quoted_and_span_lines() {
        let all: [(&[&str], &[&str]); 7] = [
            (&["a,b,c\r\n"], &["a", "b", "c"]),
            (&["a,,\n"], &["a", "", ""]),
            (&[""], &[""]),
            (&["\"a,b\",c"], &["a,b", "c"]),
            (&["\"say \"\"hi\"\"\",\"\"\r\n"], &["say \"hi\"", ""]),
            (&["a,\"two\n", "lines\"\n"], &["a", "two\nlines"]),
            (&["\"two\r\n", "lines\",b\r\n"], &["two\r\nlines", "b"]),
        ];
        for (lines, fields) in all {
            assert_eq!(read(lines).expect("a record"), fields, "{lines:?}");
        }
        assert!(read(&["a\"b"]).is_err() && read(&["\"a\"b"]).is_err());
    }
}
