//! DXF tags: pairs of a group code and a value, each on its own line. A DXF file is a list of tags.

use glam::DVec2;
use std::fmt::{Display, Write};

/// A DXF file under construction, or part of one.
#[derive(Debug, Default)]
pub(super) struct TagWriter {
    out: String,
}

impl TagWriter {
    /// Appends a tag.
    pub(super) fn tag(&mut self, code: u16, value: impl Display) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.out, "{code}\n{value}");
    }

    /// Appends a tag with a handle, as hexadecimal digits.
    pub(super) fn handle(&mut self, code: u16, handle: u32) {
        self.tag(code, format_args!("{handle:X}"));
    }

    /// Appends a tag with a number, as the shortest decimal that reads back as the same number. It
    /// has a decimal point and no exponent.
    pub(super) fn number(&mut self, code: u16, number: f64) {
        // Adding 0 turns −0 into 0.
        let number = number + 0.0;
        if number == libm::trunc(number) {
            self.tag(code, format_args!("{number}.0"));
        } else {
            self.tag(code, number);
        }
    }

    /// Appends x and y, with the codes `code` and `code` + 10.
    pub(super) fn point(&mut self, code: u16, point: DVec2) {
        self.number(code, point.x);
        self.number(code + 10, point.y);
    }

    /// Appends x, y and z = 0.
    pub(super) fn point_in_space(&mut self, code: u16, point: DVec2) {
        self.point(code, point);
        self.number(code + 20, 0.0);
    }

    /// Appends tags from a string in which `|` separates tags and `=` separates code and value.
    pub(super) fn tags(&mut self, text: &str) {
        for pair in text.split('|').map(str::trim).filter(|pair| !pair.is_empty()) {
            let (code, value) = pair.split_once('=').unwrap_or((pair, ""));
            let _ = writeln!(self.out, "{code}\n{value}");
        }
    }

    /// Appends the tags of another writer.
    pub(super) fn append(&mut self, other: &Self) {
        self.out += &other.out;
    }

    /// Begins a section of the file.
    pub(super) fn begin_section(&mut self, name: &str) {
        self.tag(0, "SECTION");
        self.tag(2, name);
    }

    /// Ends a section.
    pub(super) fn end_section(&mut self) {
        self.tag(0, "ENDSEC");
    }

    /// Returns the bytes of the file.
    pub(super) fn finish(mut self) -> Vec<u8> {
        self.tag(0, "EOF");
        self.out.into_bytes()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_a_decimal_point_and_no_exponent() {
        for (number, written) in [
            (0.0, "0.0"),
            (-0.0, "0.0"),
            (-12.5, "-12.5"),
            (1e-7, "0.0000001"),
            (3e9, "3000000000.0"),
        ] {
            let mut tags = TagWriter::default();
            tags.number(10, number);
            assert_eq!(tags.out, format!("10\n{written}\n"));
        }
    }

    #[test]
    fn tag_strings_are_written_pair_by_pair() {
        let mut tags = TagWriter::default();
        tags.tags("0=LAYER|2=a=b| 70=0 |3=");
        assert_eq!(tags.out, "0\nLAYER\n2\na=b\n70\n0\n3\n\n");
    }
}
