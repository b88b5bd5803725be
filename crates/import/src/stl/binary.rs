//! Binary STL: an 84-byte header, then 50 bytes per triangle, with little-endian numbers.
//!
//! ```text
//!  0          80       84        96        108       120       132     134
//!  ┌──────────┬────────┬─────────┬─────────┬─────────┬─────────┬───────┬───
//!  │ comment  │ count  │ normal  │ corner  │ corner  │ corner  │ color │ …
//!  └──────────┴────────┴─────────┴─────────┴─────────┴─────────┴───────┴───
//! ```

use super::facet_color::FacetColors;
use super::solid::Solid;
use super::{HEADER_BYTES, TRIANGLE_BYTES, declared_triangles, truncated};
use files::counted;
use gltf_import::ImportWarnings;
use gltf_import::MemoryBudget;
use model::{Diagnostic, codes};
use std::io::Read;

/// Maximum number of array bytes per triangle, reached while normals are computed for triangles
/// that share no vertices.
const ARRAY_BYTES: u64 = 140;

/// Number of bytes to read at a time: 1,024 triangles.
const CHUNK_BYTES: usize = 1024 * TRIANGLE_BYTES;

/// A binary file whose header has been read.
pub(super) struct BinaryFile<'a> {
    /// The header, which contains a comment and the number of triangles.
    pub(super) header: [u8; HEADER_BYTES],
    /// The bytes after the header.
    pub(super) body: &'a mut dyn Read,
    /// The number of bytes after the header.
    pub(super) body_bytes: usize,
}

/// Reads a binary file.
///
/// The header declares the number of triangles, which must fit in the available bytes. Programs
/// that cannot seek back to write this number leave it at 0; all triangles are then read.
///
/// # Errors
/// Fails if the file is too short for its triangles or too large for the budget, or if it cannot be
/// read to its end.
pub(super) fn read_solid(
    file: BinaryFile<'_>,
    budget: &MemoryBudget<'_>,
    warnings: &mut ImportWarnings,
) -> Result<Solid, Diagnostic> {
    let BinaryFile { header, body, body_bytes } = file;
    let count = count_triangles(&header, body_bytes, warnings)?;
    budget.charge_bytes("", ARRAY_BYTES * count as u64, (HEADER_BYTES + body_bytes) as u64)?;
    let mut solid = Solid::with_capacity(count);
    let mut colors = FacetColors::from_header(&header[..80]);
    // The body may be a stream, so it is read in chunks of limited size.
    let mut chunk = vec![0; CHUNK_BYTES.min(count * TRIANGLE_BYTES)];
    let mut at = 0;
    while at < count {
        let bytes = chunk.len().min((count - at) * TRIANGLE_BYTES);
        let chunk = &mut chunk[..bytes];
        body.read_exact(chunk).map_err(|error| unreadable_body(at, &error))?;
        for facet in chunk.as_chunks::<TRIANGLE_BYTES>().0 {
            let triangle = solid.triangle_count();
            // Formatted only if the triangle is skipped.
            let locate = || format!("byte {}", HEADER_BYTES + at * TRIANGLE_BYTES);
            if solid.push_triangle(corners(facet), locate) {
                colors.record(triangle, u16::from_le_bytes([facet[48], facet[49]]));
            }
            at += 1;
        }
    }
    solid.colors = colors;
    solid.warn_of_omissions(warnings);
    Ok(solid)
}

/// Returns the corners of a triangle, the nine numbers after its normal.
fn corners(facet: &[u8; TRIANGLE_BYTES]) -> [[f32; 3]; 3] {
    let words = facet[12..48].as_chunks::<4>().0;
    std::array::from_fn(|corner| {
        std::array::from_fn(|axis| f32::from_le_bytes(words[3 * corner + axis]))
    })
}

/// Returns the error for a file that cannot be read to its end.
fn unreadable_body(triangle: usize, error: &std::io::Error) -> Diagnostic {
    let location = format!("byte {}", HEADER_BYTES + triangle * TRIANGLE_BYTES);
    let message = format!("cannot read the rest of the file: {error}");
    Diagnostic::error(codes::IO_ERROR, &location, message, "copy or export it again")
}

/// Returns the number of triangles to read, after comparing the number in the header with the file
/// length.
fn count_triangles(
    header: &[u8; HEADER_BYTES],
    length: usize,
    warnings: &mut ImportWarnings,
) -> Result<usize, Diagnostic> {
    let declared = declared_triangles(header).unwrap_or(0);
    let present = length / TRIANGLE_BYTES;
    if declared > present {
        let message = format!("the file declares {declared} triangles but has {present}");
        let consequence = "the complete triangles are read";
        warnings.downgrade_if_lenient(truncated("byte 80", message), consequence)?;
        return Ok(present);
    }
    if declared == 0 && present > 0 {
        let message = format!("the file declares no triangles but has {present}; all are read");
        warnings.push_warning("byte 80", message);
        return Ok(present);
    }
    let end = declared * TRIANGLE_BYTES;
    if length > end {
        let more = counted(length - end, "byte", "bytes");
        let message = format!("ignored {more} after the last triangle");
        warnings.push_warning(&format!("byte {}", HEADER_BYTES + end), message);
    }
    Ok(declared)
}

/// Returns the error for a file that is neither text nor long enough to be binary.
pub(super) fn no_stl(bytes: &[u8]) -> Diagnostic {
    let message = match bytes.len() {
        0 => "the file is empty".to_owned(),
        length => {
            format!("this is not an STL file: it has {length} bytes and does not begin with solid")
        }
    };
    Diagnostic::error(codes::INVALID_DATA, "", message, "use an STL file, or export it again")
}
