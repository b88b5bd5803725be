//! The GLB container: header and chunks of a binary file (glTF 2.0 §4.4).
//!
//! ```text
//!  magic · version · length │ length · JSON · … │ length · BIN · … │ length · anything · …
//! ```
//!
//! All numbers are little-endian 32-bit integers. The file header takes 12 bytes and each chunk
//! header takes 8. A chunk's length counts only its content, which is padded to a multiple of 4. A
//! defect in one chunk does not stop the validation if the start of the next chunk is known.

use super::codes::{self, DiagnosticCode};
use super::diagnostics::Diagnostics;
use std::fmt::Display;
use std::ops::Range;

/// The parts of a file that can be located.
///
/// A part is absent if the container is damaged before it. Without a JSON part, the JSON checks are
/// skipped.
#[derive(Default, Debug)]
pub(super) struct ContainerParts {
    /// The JSON; in a GLB, the content of the first chunk.
    pub(super) json: Option<Range<usize>>,
    /// The content of the binary chunk of a GLB.
    pub(super) binary: Option<Range<usize>>,
    /// Whether the file is a GLB.
    pub(super) is_binary: bool,
}

/// Validates the container and finds its parts.
///
/// A file that does not start with `glTF` is treated as JSON. A byte order mark is reported and
/// skipped, because many editors write one, and everything after it may be valid.
pub(super) fn check_container(bytes: &[u8], diagnostics: &Diagnostics) -> ContainerParts {
    if !bytes.starts_with(b"glTF") {
        let mark = if bytes.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
        check_byte_order_mark(bytes, diagnostics);
        return ContainerParts { json: Some(mark..bytes.len()), ..ContainerParts::default() };
    }
    let mut reader = ContainerReader {
        bytes,
        diagnostics,
        parts: ContainerParts { is_binary: true, ..ContainerParts::default() },
    };
    reader.check_header();
    if let Some(json) = &reader.parts.json {
        check_byte_order_mark(&bytes[json.clone()], diagnostics);
    }
    reader.parts
}

/// Reports a leading byte order mark, which glTF forbids in JSON (glTF 2.0 §2.7).
fn check_byte_order_mark(json: &[u8], diagnostics: &Diagnostics) {
    if json.starts_with(b"\xEF\xBB\xBF") {
        diagnostics.add(&codes::INVALID_JSON, "", "the JSON starts with a byte order mark");
    }
}

/// Reads the container chunk by chunk.
struct ContainerReader<'a> {
    /// The file, truncated at the length that its header declares.
    bytes: &'a [u8],
    diagnostics: &'a Diagnostics,
    /// The parts found so far.
    parts: ContainerParts,
}

impl ContainerReader<'_> {
    /// Reports a diagnostic about the file as a whole.
    fn report(&self, code: &DiagnosticCode, message: impl Display) {
        self.diagnostics.add(code, "", message);
    }

    /// Reads the little-endian u32 at an offset.
    fn read_u32(&self, at: usize) -> Option<usize> {
        let number = u32::from_le_bytes(*self.bytes.get(at..)?.first_chunk()?);
        usize::try_from(number).ok()
    }

    /// Validates the 12-byte header: the version, and the declared length against the file size.
    ///
    /// An unsupported version ends the validation, because the chunks may be laid out differently.
    /// Extra bytes after the declared end cause a warning and are ignored. If a file is shorter
    /// than declared, the available part is read. The minimum length is 20: the file header and the
    /// header of an empty chunk.
    fn check_header(&mut self) {
        let actual = self.bytes.len();
        let (Some(version), Some(length)) = (self.read_u32(4), self.read_u32(8)) else {
            let message = format_args!("unexpected end of the header: the file has {actual} bytes");
            return self.report(&codes::GLB_UNEXPECTED_END_OF_HEADER, message);
        };
        if version != 2 {
            let message = format_args!("unsupported GLB version {version}: expected 2");
            return self.report(&codes::GLB_INVALID_VERSION, message);
        }
        let is_small = length < 20;
        if is_small {
            let message =
                format_args!("the declared length of {length} bytes is too small for any content");
            self.report(&codes::GLB_LENGTH_TOO_SMALL, message);
        }
        if length > actual || is_small {
            let message =
                format_args!("the declared length is {length} bytes, but the file has {actual}");
            self.report(&codes::GLB_LENGTH_MISMATCH, message);
        } else if length < actual {
            let more = actual - length;
            let bytes = if more == 1 { "byte" } else { "bytes" };
            let message = format_args!("{more} {bytes} of extra data after the end");
            self.report(&codes::GLB_EXTRA_DATA, message);
            self.bytes = &self.bytes[..length];
        }
        self.check_chunks();
    }

    /// Validates all chunks, and finds the content of the JSON and BIN chunks.
    ///
    /// The JSON chunk must be first and the BIN chunk second (glTF 2.0 §4.4.3). Later JSON or BIN
    /// chunks are reported and ignored, as in the loader.
    fn check_chunks(&mut self) {
        let (mut at, mut number, mut known) = (12, 0, [false; 2]);
        while at < self.bytes.len() {
            let (Some(length), Some(kind)) = (self.read_u32(at), self.bytes.get(at + 4..at + 8))
            else {
                let message =
                    format_args!("unexpected end of file in the header of chunk {number}");
                return self.report(&codes::GLB_UNEXPECTED_END_OF_CHUNK_HEADER, message);
            };
            let name = String::from_utf8_lossy(kind).escape_default().to_string();
            self.check_chunk(number, &name, kind, length, &mut known);
            let (start, end) = (at + 8, (at + 8).saturating_add(length));
            if end > self.bytes.len() {
                let left = self.bytes.len() - start;
                let message = format_args!(
                    "chunk {number} declares {length} bytes, but the file has only {left} more"
                );
                return self.report(&codes::GLB_UNEXPECTED_END_OF_CHUNK_DATA, message);
            }
            match kind {
                b"JSON" if self.parts.json.is_none() && number == 0 => {
                    self.parts.json = Some(start..end);
                }
                b"BIN\0" if self.parts.binary.is_none() && number == 1 => {
                    self.parts.binary = Some(start..end);
                }
                _ => {}
            }
            (at, number) = (end, number + 1);
        }
    }

    /// Validates one chunk: alignment, type, order and duplicates.
    ///
    /// `known` has two flags, set once a JSON or BIN chunk has been found. Unknown types are
    /// allowed and ignored (glTF 2.0 §4.4.3); the warning about them helps to find misspelled
    /// types.
    fn check_chunk(
        &self,
        number: usize,
        name: &str,
        kind: &[u8],
        length: usize,
        known: &mut [bool; 2],
    ) {
        if !length.is_multiple_of(4) {
            let message =
                format_args!("the length {length} of chunk {number} is not a multiple of 4");
            self.report(&codes::GLB_CHUNK_LENGTH_UNALIGNED, message);
        }
        if number == 0 && kind != b"JSON" {
            let message = format_args!("the first chunk must be JSON, not {name}");
            self.report(&codes::GLB_UNEXPECTED_FIRST_CHUNK, message);
        }
        let slot = match kind {
            b"JSON" => 0,
            b"BIN\0" => 1,
            _ => {
                let message = format_args!("chunk {number} has the unknown type {name}");
                return self.report(&codes::GLB_UNKNOWN_CHUNK_TYPE, message);
            }
        };
        if length == 0 && slot == 0 {
            self.report(&codes::GLB_EMPTY_CHUNK, format_args!("chunk {number} is empty"));
        }
        if known[slot] {
            let message = format_args!("chunk {number} is a duplicate {name} chunk");
            self.report(&codes::GLB_DUPLICATE_CHUNK, message);
        } else if slot == 1 && number > 1 {
            let message = format_args!("{name} must be the second chunk, not chunk {number}");
            self.report(&codes::GLB_UNEXPECTED_BIN_CHUNK, message);
        }
        known[slot] = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chunk's type and data.
    type TestChunk<'a> = (&'a [u8; 4], &'a [u8]);

    fn build_glb(length: Option<u32>, chunks: &[TestChunk<'_>]) -> Vec<u8> {
        let mut bytes = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
        for (kind, data) in chunks {
            bytes.extend((data.len() as u32).to_le_bytes());
            bytes.extend(*kind);
            bytes.extend(*data);
        }
        let length = length.unwrap_or(bytes.len() as u32);
        bytes[8..12].copy_from_slice(&length.to_le_bytes());
        bytes
    }

    fn reported_codes(bytes: &[u8]) -> (ContainerParts, Vec<&'static str>) {
        let diagnostics = Diagnostics::default();
        let parts = check_container(bytes, &diagnostics);
        let (problems, _) = diagnostics.into_parts();
        (parts, problems.iter().map(|problem| problem.code).collect())
    }

    #[test]
    fn container_rules_are_checked() {
        let (json, bin): (TestChunk<'_>, TestChunk<'_>) = ((b"JSON", b"{}  "), (b"BIN\0", b"1234"));
        let good = build_glb(None, &[json, bin]);
        let (parts, found) = reported_codes(&good);
        assert_eq!((parts.json, parts.binary, found), (Some(20..24), Some(32..36), vec![]));
        let cases: [(Vec<u8>, &[&str]); 9] = [
            (b"glTF\x02".to_vec(), &["GLB_UNEXPECTED_END_OF_HEADER"]),
            (build_glb(Some(3), &[json]), &["GLB_LENGTH_TOO_SMALL", "GLB_LENGTH_MISMATCH"]),
            (good[..34].to_vec(), &["GLB_LENGTH_MISMATCH", "GLB_UNEXPECTED_END_OF_CHUNK_DATA"]),
            (good[..28].to_vec(), &["GLB_LENGTH_MISMATCH", "GLB_UNEXPECTED_END_OF_CHUNK_HEADER"]),
            (build_glb(None, &[bin, json]), &["GLB_UNEXPECTED_FIRST_CHUNK"]),
            (
                build_glb(None, &[json, (b"ACME", b""), bin]),
                &["GLB_UNEXPECTED_BIN_CHUNK", "GLB_UNKNOWN_CHUNK_TYPE"],
            ),
            (build_glb(None, &[json, bin, bin]), &["GLB_DUPLICATE_CHUNK"]),
            (build_glb(None, &[(b"JSON", b"")]), &["GLB_EMPTY_CHUNK"]),
            (build_glb(None, &[(b"JSON", b"{}")]), &["GLB_CHUNK_LENGTH_UNALIGNED"]),
        ];
        for (bytes, expected) in cases {
            assert_eq!(reported_codes(&bytes).1, expected);
        }
        for end in 4..good.len() {
            assert!(!reported_codes(&good[..end]).1.is_empty(), "truncated at {end}");
        }
    }
}
