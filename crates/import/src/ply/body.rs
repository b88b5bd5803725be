//! The body of a PLY file: a sequence of numbers in text or binary form.
//!
//! Every number is read as `f64`, which represents every value of every type exactly.

use super::header::{Encoding, PlyElement, ScalarType};
use crate::text::{LineCounter, TextScanner, Token, parse_f64};
use model::Diagnostic;
use std::cell::RefCell;

/// Reads a body number by number.
pub(super) struct Body<'a> {
    /// The whole file, for locations.
    bytes: &'a [u8],
    /// Offset of the next number.
    at: usize,
    encoding: Encoding,
    /// Counts lines incrementally from one message to the next.
    lines: RefCell<LineCounter<'a>>,
    /// Whether each record of a text body starts a new line; the rest of a line is then ignored.
    has_lines: bool,
    /// The location of the first record with more numbers than the header declares, and the number
    /// of such records.
    longer: Option<(String, usize)>,
}

impl<'a> Body<'a> {
    /// Creates a reader for the body that begins at an offset of the file.
    pub(super) fn new(bytes: &'a [u8], at: usize, encoding: Encoding) -> Self {
        let lines = RefCell::new(LineCounter::new(bytes));
        let at = at.min(bytes.len());
        Self { bytes, at, encoding, lines, has_lines: false, longer: None }
    }

    /// Treats each line as a record if the body is text with at least `count` lines.
    pub(super) fn with_records(mut self, count: u64) -> Self {
        if self.encoding == Encoding::Ascii {
            let lines = self.bytes[self.at..].split(|byte| *byte == b'\n' || *byte == b'\r');
            let used = lines.filter(|line| !line.iter().all(u8::is_ascii_whitespace));
            self.has_lines = used.count() as u64 >= count;
        }
        self
    }

    /// Ends a record by skipping the rest of its line, as other readers do.
    pub(super) fn end_record(&mut self) {
        if !self.has_lines {
            return;
        }
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(|byte| *byte == b'\n' || *byte == b'\r');
        let end = end.unwrap_or(rest.len());
        let mut words = rest[..end].split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        // A word that is not a number remains, so that the next read reports it.
        if words.clone().any(|word| parse_f64(word).is_none()) {
            return;
        }
        if words.next().is_some() {
            let place = match self.longer.take() {
                Some((place, count)) => (place, count + 1),
                None => (self.location(), 1),
            };
            self.longer = Some(place);
        }
        self.at += end;
    }

    /// Returns the warning about records that are longer than the header declares.
    pub(super) fn longer_records(&self) -> Option<(&str, String)> {
        let (place, count) = self.longer.as_ref()?;
        let message = match count {
            1 => "a record has more numbers than the header declares; the extra numbers are \
                  skipped"
                .to_owned(),
            _ => format!(
                "{count} records from here on have more numbers than the header declares; the \
                 extra numbers are skipped"
            ),
        };
        Some((place, message))
    }

    /// Returns how many records the rest of the file can contain at most, for reserving memory.
    pub(super) fn plausible_records(&self, element: &PlyElement) -> usize {
        let left = self.bytes.len() - self.at;
        let possible = left / element.min_record_bytes(self.encoding).max(1) + 1;
        usize::try_from(element.count).unwrap_or(usize::MAX).min(possible)
    }

    /// Reads the next number.
    ///
    /// # Errors
    /// Fails if the file ends or the next word is not a number.
    pub(super) fn next_number(&mut self, scalar: ScalarType) -> Result<f64, Diagnostic> {
        if self.encoding == Encoding::Ascii {
            return self.next_decimal();
        }
        let size = scalar.size();
        let Some(slice) = self.bytes.get(self.at..self.at + size) else {
            return Err(self.fault("the file ends in the middle of its data"));
        };
        let mut value = [0; 8];
        value[..size].copy_from_slice(slice);
        if self.encoding == Encoding::BigEndian {
            value[..size].reverse();
        }
        self.at += size;
        Ok(to_number(u64::from_le_bytes(value), scalar))
    }

    /// Reads the length of a list, and checks it against the remaining bytes.
    ///
    /// # Errors
    /// Fails if the length is negative, not an integer, or more than the rest of the file can
    /// contain.
    pub(super) fn next_list_length(
        &mut self,
        length: ScalarType,
        value: ScalarType,
    ) -> Result<usize, Diagnostic> {
        let number = self.next_number(length)?;
        let least = if self.encoding == Encoding::Ascii { 2 } else { value.size() };
        // The last number of a text body needs no separator.
        let possible = (self.bytes.len() - self.at + 1) / least;
        if number >= 0.0 && number <= possible as f64 && number.fract() == 0.0 {
            return Ok(number as usize);
        }
        let message = if number >= 0.0 && number.fract() == 0.0 {
            format!("a list of {number} numbers begins here, but the file is too short for it")
        } else {
            format!("the length of this list is {number} but must be a whole number")
        };
        Err(self.fault(&message))
    }

    /// Skips the records of an unknown element.
    ///
    /// # Errors
    /// Fails if the file ends before the element's last record.
    pub(super) fn skip_element(&mut self, element: &PlyElement) -> Result<(), Diagnostic> {
        if element.properties.is_empty() {
            return Ok(());
        }
        for _ in 0..element.count {
            for property in &element.properties {
                let count = match property.list_length {
                    Some(length) => self.next_list_length(length, property.scalar)?,
                    None => 1,
                };
                self.skip_numbers(count, property.scalar)?;
            }
            self.end_record();
        }
        Ok(())
    }

    /// Skips numbers.
    ///
    /// # Errors
    /// Fails if the file ends too early.
    pub(super) fn skip_numbers(
        &mut self,
        count: usize,
        scalar: ScalarType,
    ) -> Result<(), Diagnostic> {
        for _ in 0..count {
            self.next_number(scalar)?;
        }
        Ok(())
    }

    /// Reads the next number of a text body, after any white space.
    fn next_decimal(&mut self) -> Result<f64, Diagnostic> {
        let mut scanner = TextScanner::new(&self.bytes[self.at..]);
        let Some(Token { bytes: token, offset }) = scanner.next_token() else {
            self.at = self.bytes.len();
            return Err(self.fault("the file ends in the middle of its data"));
        };
        self.at += offset;
        match parse_f64(token) {
            Some(number) => {
                self.at += token.len();
                Ok(number)
            }
            None => {
                let word: String = String::from_utf8_lossy(token).chars().take(32).collect();
                Err(self.fault(&format!("{word:?} is not a number")))
            }
        }
    }

    /// Returns an error at the current location.
    #[cold]
    #[inline(never)]
    pub(super) fn fault(&self, message: &str) -> Diagnostic {
        Diagnostic::invalid(&self.location(), message)
    }

    /// Returns the current location: line and column in text, or the byte offset in binary.
    pub(super) fn location(&self) -> String {
        if self.encoding != Encoding::Ascii {
            return format!("byte {}", self.at);
        }
        self.lines.borrow_mut().locate(self.at)
    }
}

/// Converts the low-order bytes of a word to a number.
fn to_number(word: u64, scalar: ScalarType) -> f64 {
    match scalar {
        ScalarType::I8 => f64::from(word as i8),
        ScalarType::U8 => f64::from(word as u8),
        ScalarType::I16 => f64::from(word as i16),
        ScalarType::U16 => f64::from(word as u16),
        ScalarType::I32 => f64::from(word as i32),
        ScalarType::U32 => f64::from(word as u32),
        ScalarType::F32 => f64::from(f32::from_bits(word as u32)),
        ScalarType::F64 => f64::from_bits(word),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_type_is_read_in_both_byte_orders() {
        let table: [(ScalarType, f64, &[u8]); 8] = [
            (ScalarType::I8, -2.0, &[0xFE]),
            (ScalarType::U8, 254.0, &[0xFE]),
            (ScalarType::I16, -2.0, &[0xFE, 0xFF]),
            (ScalarType::U16, 258.0, &[2, 1]),
            (ScalarType::I32, -2.0, &[0xFE, 0xFF, 0xFF, 0xFF]),
            (ScalarType::U32, 4_294_967_294.0, &[0xFE, 0xFF, 0xFF, 0xFF]),
            (ScalarType::F32, 1.5, &[0, 0, 0xC0, 0x3F]),
            (ScalarType::F64, -0.1, &(-0.1f64).to_le_bytes()),
        ];
        for (scalar, expected, bytes) in table {
            let little = Body::new(bytes, 0, Encoding::LittleEndian).next_number(scalar);
            assert_eq!(little, Ok(expected));
            let reversed: Vec<u8> = bytes.iter().rev().copied().collect();
            let big = Body::new(&reversed, 0, Encoding::BigEndian).next_number(scalar);
            assert_eq!(big, Ok(expected));
        }
    }

    #[test]
    fn list_lengths_are_bounded_by_the_file() {
        let mut body = Body::new(&[255, 255, 255, 127, 0], 0, Encoding::LittleEndian);
        let message = body.next_list_length(ScalarType::I32, ScalarType::U8).unwrap_err();
        assert!(message.sentence().starts_with("byte 4: a list of 2147483647 numbers begins here"));
        let mut body = Body::new(b"3 1 2 3", 0, Encoding::Ascii);
        assert_eq!(body.next_list_length(ScalarType::U8, ScalarType::U8), Ok(3));
    }

    #[test]
    fn text_errors_have_a_line_and_column() {
        let mut body = Body::new(b"1\r\n2  x", 0, Encoding::Ascii);
        body.skip_numbers(2, ScalarType::U8).unwrap();
        let message = body.next_number(ScalarType::U8).unwrap_err().sentence();
        assert!(message.starts_with("line 2, column 4: \"x\" is not a number"), "{message}");
    }
}
