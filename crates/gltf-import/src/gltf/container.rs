//! Reads the GLB container: locates the JSON and the binary chunk of a `.gltf` or `.glb` file.
//!
//! The first bytes distinguish the two formats; the file name is ignored. A binary file has the
//! layout
//!
//! ```text
//!  0      4        8        12       16      20                 20+n
//!  ┌──────┬────────┬────────┬────────┬───────┬───────────────────┬──── … more chunks:
//!  │ glTF │ 2      │ length │ n      │ JSON  │ n bytes of JSON   │     length, type, data
//!  └──────┴────────┴────────┴────────┴───────┴───────────────────┴────
//! ```
//!
//! with little-endian numbers (glTF 2.0 §4.4). No length is used before it has been checked. Only
//! the first chunk may be JSON, and only the second may be BIN; later chunks are ignored, as are
//! bytes after the declared end.

use crate::warnings::ImportWarnings;
use files::counted;
use model::{Diagnostic, codes};
use std::ops::Range;

/// The byte ranges of the JSON and the binary chunk.
///
/// The JSON range excludes a byte order mark.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Container {
    /// The range of the JSON text in the file.
    pub(super) json: Range<usize>,
    /// The content of the BIN chunk, which is buffer 0 if that buffer has no URI.
    pub(super) binary: Option<Range<usize>>,
}

/// Size of the file header in bytes: magic, version and length.
const HEADER: usize = 12;
/// Size of a chunk header in bytes: length and type.
const CHUNK_HEADER: usize = 8;
/// The advice for truncated files, which are mostly the result of interrupted downloads.
const TRUNCATED: &str = "copy or export the file again: it is truncated";

impl Container {
    /// Locates the JSON and the binary chunk in a text or GLB file.
    ///
    /// A UTF-16 file, which some editors write, starts with a two-byte byte order mark and gets a
    /// separate error.
    ///
    /// # Errors
    /// Returns [`NOT_GLTF`](codes::NOT_GLTF) if the file is neither JSON nor a GLB, or its
    /// container is damaged.
    pub(super) fn from_bytes(
        bytes: &[u8],
        warnings: &mut ImportWarnings,
    ) -> Result<Self, Diagnostic> {
        if bytes.starts_with(b"glTF") {
            return Self::from_glb(bytes, warnings);
        }
        let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        match text.iter().find(|byte| !byte.is_ascii_whitespace()) {
            Some(b'{') => Ok(Self { json: bytes.len() - text.len()..bytes.len(), binary: None }),
            None => Err(format_error("the file is empty", "use a .gltf or .glb file")),
            _ if bytes.starts_with(b"\xFF\xFE") || bytes.starts_with(b"\xFE\xFF") => {
                Err(format_error("the text is in UTF-16", "save it as UTF-8"))
            }
            _ => Err(format_error(
                "this is not a glTF file: it starts neither with { nor with glTF",
                "use a .gltf or .glb file",
            )),
        }
    }

    /// Locates the chunks of a GLB file.
    ///
    /// Chunks after the second are not read, because the specification reserves them for
    /// extensions.
    fn from_glb(bytes: &[u8], warnings: &mut ImportWarnings) -> Result<Self, Diagnostic> {
        let end = check_glb_header(bytes, warnings)?;
        if end < bytes.len() {
            let more = counted(bytes.len() - end, "byte", "bytes");
            let message = format!("ignored {more} after the end of the GLB");
            warnings.push_warning("", message);
        }
        let mut chunks = GlbChunks { bytes: &bytes[..end], offset: HEADER };
        let Some((b"JSON", json)) = chunks.next(warnings)? else {
            return Err(format_error("the first chunk is not JSON", "export the file again"));
        };
        let binary = match chunks.next(warnings)? {
            Some((b"BIN\0", range)) => Some(range),
            _ => None,
        };
        Ok(Self { json, binary })
    }
}

/// Checks the version and length, and returns the declared end of the file.
///
/// # Errors
/// Fails if the file is shorter than 12 bytes or its declared length, if that length is too small,
/// or if the version is not 2. In lenient mode, the available part of a truncated file is read.
fn check_glb_header(bytes: &[u8], warnings: &mut ImportWarnings) -> Result<usize, Diagnostic> {
    let (Some(version), Some(length)) = (read_u32(bytes, 4), read_u32(bytes, 8)) else {
        return Err(format_error(&format!("the file has only {} bytes", bytes.len()), TRUNCATED));
    };
    if version != 2 {
        return Err(Diagnostic::error(
            codes::UNSUPPORTED_VERSION,
            "",
            format!("the file is glTF {version}.0, but only glTF 2.0 is supported"),
            "convert it to glTF 2.0",
        ));
    }
    if length > bytes.len() {
        let message =
            format!("the header declares {length} bytes, but the file has {}", bytes.len());
        warnings.downgrade_if_lenient(
            format_error(&message, TRUNCATED),
            "the available data is read",
        )?;
        return Ok(bytes.len());
    }
    if length < HEADER + CHUNK_HEADER {
        let message = format!("the header declares {length} bytes, too few for any content");
        return Err(format_error(&message, "export the file again"));
    }
    Ok(length)
}

/// The type and byte range of a chunk.
type GlbChunk<'a> = (&'a [u8; 4], Range<usize>);

/// Iterates over the chunks of a GLB file.
///
/// This is not an [`Iterator`], because each step may add a warning.
struct GlbChunks<'a> {
    /// The file, up to its declared end.
    bytes: &'a [u8],
    /// Offset of the next chunk header.
    offset: usize,
}

impl<'a> GlbChunks<'a> {
    /// Returns the next chunk, or `None` at the end.
    ///
    /// In lenient mode, a chunk that is too long is cut off at the end of the file, and an
    /// incomplete header is ignored.
    fn next(&mut self, warnings: &mut ImportWarnings) -> Result<Option<GlbChunk<'a>>, Diagnostic> {
        let rest = &self.bytes[self.offset..];
        if rest.is_empty() {
            return Ok(None);
        }
        let Some((header, data)) = rest.split_first_chunk::<CHUNK_HEADER>() else {
            warnings.downgrade_if_lenient(
                format_error("a chunk header is incomplete", TRUNCATED),
                "the chunk is ignored",
            )?;
            return Ok(None);
        };
        let (length, kind) = (read_u32(header, 0).unwrap_or(usize::MAX), header.last_chunk());
        let (start, left) = (self.offset + CHUNK_HEADER, data.len());
        if length > left {
            let message =
                format!("a chunk declares {length} bytes, but the file has only {left} more");
            warnings.downgrade_if_lenient(
                format_error(&message, TRUNCATED),
                "the available data is read",
            )?;
        }
        self.offset = start + length.min(left);
        Ok(kind.map(|kind| (kind, start..self.offset)))
    }
}

/// Reads the little-endian 32-bit integer at an offset. Returns `None` if the bytes end too early.
fn read_u32(bytes: &[u8], at: usize) -> Option<usize> {
    let number = u32::from_le_bytes(*bytes.get(at..)?.first_chunk()?);
    usize::try_from(number).ok()
}

/// Returns the error for a damaged or unknown container, with advice.
fn format_error(message: &str, help: &str) -> Diagnostic {
    Diagnostic::error(codes::NOT_GLTF, "", message.to_owned(), help)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glb(version: u32, length: u32, chunks: &[(&[u8; 4], u32, &[u8])]) -> Vec<u8> {
        let mut bytes = b"glTF".to_vec();
        bytes.extend(version.to_le_bytes());
        bytes.extend(length.to_le_bytes());
        for (kind, length, data) in chunks {
            bytes.extend(length.to_le_bytes());
            bytes.extend(*kind);
            bytes.extend(*data);
        }
        bytes
    }

    fn message(bytes: &[u8]) -> String {
        Container::from_bytes(bytes, &mut ImportWarnings::default()).unwrap_err().message
    }

    #[test]
    fn json_and_binary_chunk_are_located() {
        let find =
            |bytes: &[u8]| Container::from_bytes(bytes, &mut ImportWarnings::default()).unwrap();
        assert_eq!(find(b" {}"), Container { json: 0..3, binary: None });
        assert_eq!(find(b"\xEF\xBB\xBF{}"), Container { json: 3..5, binary: None });
        let two = glb(2, 36, &[(b"JSON", 4, b"{}  "), (b"BIN\0", 4, b"1234")]);
        assert_eq!(find(&two), Container { json: 20..24, binary: Some(32..36) });
        let unknown = glb(2, 36, &[(b"JSON", 4, b"{}  "), (b"ACME", 4, b"1234")]);
        assert_eq!(find(&unknown), Container { json: 20..24, binary: None });
    }

    #[test]
    fn invalid_headers_are_rejected() {
        assert_eq!(message(b""), "the file is empty");
        assert!(message(b"OBJ").starts_with("this is not a glTF file"));
        assert_eq!(message(b"glTF\x02"), "the file has only 5 bytes");
        assert_eq!(
            message(&glb(1, 12, &[])),
            "the file is glTF 1.0, but only glTF 2.0 is supported"
        );
        assert_eq!(
            message(&glb(2, 4_000_000_000, &[])),
            "the header declares 4000000000 bytes, but the file has 12"
        );
        assert_eq!(
            message(&glb(2, 3, &[])),
            "the header declares 3 bytes, too few for any content"
        );
        let long = glb(2, 24, &[(b"JSON", u32::MAX, b"{}  ")]);
        assert_eq!(
            message(&long),
            "a chunk declares 4294967295 bytes, but the file has only 4 more"
        );
        let wrong = glb(2, 24, &[(b"BIN\0", 4, b"{}  ")]);
        assert_eq!(message(&wrong), "the first chunk is not JSON");
    }

    #[test]
    fn every_truncation_is_an_error_without_a_panic() {
        let whole = glb(2, 36, &[(b"JSON", 4, b"{}  "), (b"BIN\0", 4, b"1234")]);
        for end in 0..whole.len() {
            let cut = Container::from_bytes(&whole[..end], &mut ImportWarnings::default());
            let diagnostic = cut.unwrap_err();
            assert_eq!(diagnostic.code, codes::NOT_GLTF, "truncated at {end}");
            if end >= HEADER {
                let expected = format!("the header declares 36 bytes, but the file has {end}");
                assert_eq!(diagnostic.message, expected);
            }
        }
    }
}
