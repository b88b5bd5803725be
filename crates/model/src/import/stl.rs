//! The STL importer: ASCII and binary files of triangles become a [`Model`].

use super::ImportOptions;
use super::text::{TextScanner, decode_text};
use super::uri_resolver::UriResolver;
use crate::Model;
use crate::diagnostic::{Diagnostic, codes};
use std::path::Path;

/// Imports an STL file whose bytes have been read.
pub(super) fn import_stl(
    _path: &Path,
    bytes: &[u8],
    _resolver: &UriResolver<'_>,
    _options: &ImportOptions,
) -> Result<Model, Diagnostic> {
    let _ = (decode_text(bytes), TextScanner::new(bytes).next_token());
    Err(Diagnostic::error(codes::UNKNOWN_FORMAT, "", "STL is not read yet", "convert it to .glb"))
}

/// Bytes of a binary file before its triangles: a comment of 80, and the number of triangles.
const HEADER_BYTES: usize = 84;
/// Bytes of a triangle in a binary file: normal, three corners, attribute.
const TRIANGLE_BYTES: usize = 50;

/// Whether the content of a file is certainly STL; `text` is its beginning as UTF-8.
pub(super) fn is_stl(bytes: &[u8], text: &[u8]) -> bool {
    has_binary_length(bytes) || is_ascii(text)
}

/// Whether a file is exactly as long as a binary file of its number of triangles.
fn has_binary_length(bytes: &[u8]) -> bool {
    let count = bytes.get(80..HEADER_BYTES).and_then(|count| count.first_chunk());
    let triangles = count.map(|count| u64::from(u32::from_le_bytes(*count)));
    triangles.is_some_and(|triangles| {
        (bytes.len() - HEADER_BYTES) as u64 == triangles * TRIANGLE_BYTES as u64
    })
}

/// Whether a text begins with `solid` and goes on with a facet or the end of the solid.
fn is_ascii(text: &[u8]) -> bool {
    let starts_with = |at: &[u8], word: &[u8]| {
        at.get(..word.len()).is_some_and(|at| at.eq_ignore_ascii_case(word))
    };
    let mut tails = (0..text.len()).map(|at| &text[at..]);
    starts_with(text.trim_ascii_start(), b"solid")
        && tails.any(|tail| starts_with(tail, b"facet") || starts_with(tail, b"endsolid"))
}
