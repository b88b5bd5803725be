//! The header of a PLY file: lines of text that declare the elements and their properties.
//!
//! ```text
//!  ply
//!  format binary_little_endian 1.0
//!  comment TextureFile wood.png
//!  element vertex 8
//!  property float x
//!  element face 6
//!  property list uchar int vertex_indices
//!  end_header
//! ```
//!
//! Lines end with `\n`, `\r\n` or `\r`. After `end_header` exactly one line end is consumed,
//! because a binary body may begin with byte 10 or 13. A bare `\r` ends that line only if it also
//! ends the first line.

use model::{Diagnostic, codes};

/// The encoding of the values in the body.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Encoding {
    /// Decimal numbers.
    Ascii,
    /// Binary, least significant byte first.
    LittleEndian,
    /// Binary, most significant byte first.
    BigEndian,
}

/// The type of a number.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum ScalarType {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl ScalarType {
    /// Returns the type for an old (`uchar`) or new (`uint8`) type name.
    fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Returns the size in bytes of a value in a binary body.
    pub(super) const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// Returns the value that represents 1 in stored colors: the maximum of an integer type, read
    /// as unsigned, or 1 for floats.
    pub(super) const fn color_scale(self) -> f32 {
        match self {
            Self::I8 | Self::U8 => u8::MAX as f32,
            Self::I16 | Self::U16 => u16::MAX as f32,
            Self::I32 | Self::U32 => u32::MAX as f32,
            Self::F32 | Self::F64 => 1.0,
        }
    }
}

/// A property of an element: a number or a list of numbers.
#[derive(Clone, Debug)]
pub(super) struct PlyProperty {
    /// The name.
    pub(super) name: String,
    /// The type of the length that precedes a list, or `None` for a single number.
    pub(super) list_length: Option<ScalarType>,
    /// The type of the numbers.
    pub(super) scalar: ScalarType,
}

/// A kind of record, and the number of these records in the body.
#[derive(Clone, Debug)]
pub(super) struct PlyElement {
    /// The name: `vertex`, `face`, `edge`, `tristrips` or any other name.
    pub(super) name: String,
    /// The declared number of records, not yet verified.
    pub(super) count: u64,
    /// The properties of each record, in order.
    pub(super) properties: Vec<PlyProperty>,
}

impl PlyElement {
    /// Returns the minimum size of a record in bytes, which is 0 only for elements without
    /// properties.
    pub(super) fn min_record_bytes(&self, encoding: Encoding) -> usize {
        let bytes = |property: &PlyProperty| match encoding {
            // A digit and a separator.
            Encoding::Ascii => 2,
            _ => property.list_length.unwrap_or(property.scalar).size(),
        };
        self.properties.iter().map(bytes).sum()
    }
}

/// The declarations of the header.
#[derive(Debug)]
pub(super) struct Header {
    /// The encoding of the body.
    pub(super) encoding: Encoding,
    /// The elements in body order.
    pub(super) elements: Vec<PlyElement>,
    /// The texture file names from `comment TextureFile NAME`.
    pub(super) texture_files: Vec<String>,
    /// The lines that begin with an unknown word, with their numbers. They are treated as comments.
    pub(super) stray_lines: Vec<(usize, String)>,
    /// The offset of the body.
    pub(super) body: usize,
}

impl Header {
    /// Reads the header of a file.
    ///
    /// # Errors
    /// Fails if a line is malformed or `end_header` is missing.
    pub(super) fn from_bytes(bytes: &[u8]) -> Result<Self, Diagnostic> {
        let mut lines = Lines::new(bytes);
        let mut header = Self {
            encoding: Encoding::Ascii,
            elements: Vec::new(),
            texture_files: Vec::new(),
            stray_lines: Vec::new(),
            body: 0,
        };
        let mut has_format = false;
        while let Some(line) = lines.next_line() {
            let location = format!("line {}", lines.number);
            let Ok(line) = std::str::from_utf8(line).or_else(|error| match error.valid_up_to() {
                // Comments may be in any encoding.
                end if line.starts_with(b"comment") || line.starts_with(b"obj_info") => {
                    Ok(std::str::from_utf8(&line[..end]).unwrap_or("comment"))
                }
                _ => Err(()),
            }) else {
                let message = "the header contains bytes that are not text";
                return Err(Diagnostic::invalid(&location, message));
            };
            let mut words = line.split_ascii_whitespace();
            match words.next() {
                None | Some("ply" | "obj_info") => {}
                Some("comment") => header.texture_files.extend(texture_file(line)),
                Some("format") => {
                    header.encoding = parse_encoding(words.next(), &location)?;
                    has_format = true;
                }
                Some("element") => header.elements.push(parse_element(words, &location)?),
                Some("property") => {
                    let property = parse_property(words, &location)?;
                    let Some(element) = header.elements.last_mut() else {
                        let message = "there is a property before the first element";
                        return Err(Diagnostic::invalid(&location, message));
                    };
                    element.properties.push(property);
                }
                Some("end_header") if has_format => {
                    header.body = lines.at;
                    return Ok(header);
                }
                Some("end_header") => {
                    return Err(Diagnostic::invalid(&location, "the header has no `format` line"));
                }
                Some(word) => header.add_stray_line(lines.number, line, word)?,
            }
        }
        let location = format!("line {}", lines.number);
        Err(Diagnostic::invalid(&location, "the file ends before `end_header`"))
    }

    /// Treats a line that begins with an unknown word as a comment.
    ///
    /// # Errors
    /// Fails if the word is almost a keyword of the format, or there are too many such lines.
    fn add_stray_line(&mut self, number: usize, line: &str, word: &str) -> Result<(), Diagnostic> {
        if is_misspelled(word) || self.stray_lines.len() == MAX_STRAY_LINES {
            let message = format!(
                "a line of a PLY header cannot begin with `{}`: expected comment, element, property \
                 or end_header",
                shorten(word)
            );
            return Err(Diagnostic::invalid(&format!("line {number}"), message));
        }
        self.stray_lines.push((number, shorten(line)));
        Ok(())
    }
}

/// The maximum number of unknown header lines that are treated as comments.
const MAX_STRAY_LINES: usize = 16;

/// Returns whether a word could be a misspelled keyword, so that its line matters.
fn is_misspelled(word: &str) -> bool {
    let words = ["comment", "element", "end_header", "format", "obj_info", "property"];
    let word = word.to_ascii_lowercase();
    words.iter().any(|known| strsim::levenshtein(known, &word) <= 2)
}

/// Returns the first characters of a string, for quoting in a message.
fn shorten(text: &str) -> String {
    text.chars().take(32).collect()
}

/// Returns the texture name in a MeshLab comment, without surrounding spaces.
fn texture_file(line: &str) -> Option<String> {
    let rest = line.trim_start().strip_prefix("comment")?.trim_start();
    let name = rest.get(.."texturefile".len())?;
    let is_texture = name.eq_ignore_ascii_case("texturefile");
    let name = rest.get("texturefile".len()..)?;
    (is_texture && name.starts_with([' ', '\t'])).then(|| name.trim().to_owned())
}

/// Parses the encoding that a `format` line names.
fn parse_encoding(name: Option<&str>, location: &str) -> Result<Encoding, Diagnostic> {
    match name {
        Some("ascii") => Ok(Encoding::Ascii),
        Some("binary_little_endian") => Ok(Encoding::LittleEndian),
        Some("binary_big_endian") => Ok(Encoding::BigEndian),
        other => Err(Diagnostic::error(
            codes::UNSUPPORTED_VERSION,
            location,
            format!("unknown PLY format {:?}", shorten(other.unwrap_or(""))),
            "write `ascii`, `binary_little_endian` or `binary_big_endian`",
        )),
    }
}

/// Parses an element without its properties: `vertex 8`.
fn parse_element<'a>(
    mut words: impl Iterator<Item = &'a str>,
    location: &str,
) -> Result<PlyElement, Diagnostic> {
    let (name, count) = (words.next().unwrap_or(""), words.next().unwrap_or(""));
    let Ok(count) = count.parse() else {
        let (name, count) = (shorten(name), shorten(count));
        let message = format!("the count of {name:?} must be a whole number, not {count:?}");
        return Err(Diagnostic::invalid(location, message));
    };
    Ok(PlyElement { name: name.to_owned(), count, properties: Vec::new() })
}

/// Parses a property: `float x` or `list uchar int vertex_indices`.
fn parse_property<'a>(
    mut words: impl Iterator<Item = &'a str>,
    location: &str,
) -> Result<PlyProperty, Diagnostic> {
    let mut next = || words.next().unwrap_or("");
    let scalar_type = |name: &str| {
        ScalarType::from_name(name).ok_or_else(|| {
            let message = format!("unknown PLY type {:?}", shorten(name));
            Diagnostic::invalid(location, message)
        })
    };
    let first = next();
    let (list_length, scalar) = match first {
        "list" => (Some(scalar_type(next())?), scalar_type(next())?),
        _ => (None, scalar_type(first)?),
    };
    let name = next().to_owned();
    if name.is_empty() {
        return Err(Diagnostic::invalid(location, "the property has no name"));
    }
    Ok(PlyProperty { name, list_length, scalar })
}

/// Reads the lines of a header.
struct Lines<'a> {
    bytes: &'a [u8],
    /// Offset of the next line.
    at: usize,
    /// The number of the line returned last, counted from 1.
    number: usize,
    /// Whether lines end with a bare `\r`.
    ends_with_cr: bool,
}

impl<'a> Lines<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        let end = bytes.iter().position(|&byte| matches!(byte, b'\n' | b'\r')).unwrap_or(0);
        let ends_with_cr = bytes.get(end) == Some(&b'\r') && bytes.get(end + 1) != Some(&b'\n');
        Self { bytes, at: 0, number: 0, ends_with_cr }
    }

    /// Returns the next line without its line end, or `None` at the end of the file.
    fn next_line(&mut self) -> Option<&'a [u8]> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        self.number += 1;
        let end_byte = if self.ends_with_cr { b'\r' } else { b'\n' };
        let end = rest.iter().position(|&byte| byte == end_byte).unwrap_or(rest.len());
        self.at += (end + 1).min(rest.len());
        Some(rest[..end].trim_ascii_end())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Header, String> {
        Header::from_bytes(text.as_bytes()).map_err(|error| error.sentence())
    }

    #[test]
    fn the_body_begins_after_one_line_end() {
        for (end, body) in [("\n", "\n1"), ("\r\n", "\n1"), ("\r", "\n1"), ("\n", "\r\n")] {
            let text = ["ply", "format ascii 1.0", "end_header", body].join(end);
            let header = parse(&text).unwrap();
            assert_eq!(&text[header.body..], body, "{text:?}");
        }
        // Only the last line has a Windows line end.
        let text = "ply\nformat binary_big_endian 1.0\nend_header\r\n\n";
        assert_eq!(parse(text).unwrap().body, text.len() - 1);
    }

    #[test]
    fn old_and_new_type_names_and_texture_comments_are_read() {
        let header = parse(
            "ply\nformat ascii 1.0\ncomment TextureFile  a b.png \nelement face 2 \n\
             property list uint8 int32 vertex_index\nproperty ushort x\nend_header\n",
        )
        .unwrap();
        assert_eq!(header.texture_files, ["a b.png"]);
        let [list, x] = header.elements[0].properties.as_slice() else { panic!() };
        assert_eq!((list.list_length, list.scalar), (Some(ScalarType::U8), ScalarType::I32));
        assert_eq!((x.list_length, x.scalar), (None, ScalarType::U16));
        assert_eq!(header.elements[0].min_record_bytes(Encoding::LittleEndian), 3);
    }

    #[test]
    fn header_errors_have_a_line_number() {
        let table = [
            ("ply\nelement vertex 1\n", "line 2: the file ends before `end_header`"),
            ("ply\nend_header\n", "line 2: the header has no `format` line"),
            ("ply\nformat ascii 1.0\nproperty int x\n", "line 3: there is a property before the"),
            (
                "ply\nelement vertex -1\n",
                "line 2: the count of \"vertex\" must be a whole number, not \"-1\"",
            ),
            ("ply\nelement a 1\nproperty half x\n", "line 3: unknown PLY type \"half\""),
            ("ply\nformat text 1.0\n", "line 2: unknown PLY format \"text\""),
            ("ply\nelment vertex 1\n", "line 2: a line of a PLY header cannot begin with `elment`"),
        ];
        for (text, expected) in table {
            let message = parse(text).unwrap_err();
            assert!(message.starts_with(expected), "{message}");
        }
    }
}
