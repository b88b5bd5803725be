//! Binary STL: 84 bytes, then 50 for each triangle, all numbers little-endian.
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
use crate::diagnostic::{Diagnostic, codes};
use crate::import::memory_budget::MemoryBudget;
use crate::import::warnings::ImportWarnings;

/// Bytes of the arrays for a triangle, at most: while normals are computed, without any vertex in
/// common.
const ARRAY_BYTES: u64 = 140;

/// Reads a binary file.
///
/// The number of triangles is that of the header, as far as the bytes go. Programs that cannot go
/// back to write it leave 0; then it is as many as there are.
///
/// # Errors
/// The file is too short for its triangles, or too large for the budget.
pub(super) fn read_solid(
    bytes: &[u8],
    budget: &MemoryBudget<'_>,
    warnings: &mut ImportWarnings,
) -> Result<Solid, Diagnostic> {
    let (Some(declared), Some(body)) = (declared_triangles(bytes), bytes.get(HEADER_BYTES..))
    else {
        return Err(no_stl(bytes));
    };
    let count = count_triangles(declared, body.len(), warnings)?;
    budget.charge_bytes("", ARRAY_BYTES * count as u64, bytes.len() as u64)?;
    let mut solid = Solid::with_capacity(count);
    let mut colors = FacetColors::from_header(&bytes[..80]);
    for (at, facet) in body.as_chunks::<TRIANGLE_BYTES>().0.iter().take(count).enumerate() {
        let number = |at: usize| {
            f32::from_le_bytes([facet[at], facet[at + 1], facet[at + 2], facet[at + 3]])
        };
        let corners = [12, 24, 36].map(|at| [at, at + 4, at + 8].map(number));
        let triangle = solid.triangle_count();
        let locate = || format!("byte {}", HEADER_BYTES + at * TRIANGLE_BYTES);
        if solid.push_triangle(corners, locate) {
            colors.record(triangle, u16::from_le_bytes([facet[48], facet[49]]));
        }
    }
    solid.colors = colors;
    solid.warn_of_omissions(warnings);
    Ok(solid)
}

/// The number of triangles to read: what the header declares, compared with what there is.
fn count_triangles(
    declared: usize,
    length: usize,
    warnings: &mut ImportWarnings,
) -> Result<usize, Diagnostic> {
    let present = length / TRIANGLE_BYTES;
    if declared > present {
        let message = format!("the file declares {declared} triangles and has {present}");
        let consequence = "those that are whole are read";
        warnings.downgrade_if_lenient(truncated("byte 80", message), consequence)?;
        return Ok(present);
    }
    if declared == 0 && present > 0 {
        let message = format!("the file declares no triangles and has {present}; all are read");
        warnings.push_warning("byte 80", message);
        return Ok(present);
    }
    let end = declared * TRIANGLE_BYTES;
    if length > end {
        let message = format!(
            "there is more after the last triangle; it is ignored (bytes: {})",
            length - end
        );
        warnings.push_warning(&format!("byte {}", HEADER_BYTES + end), message);
    }
    Ok(declared)
}

/// The error for a file that is too short to be binary, and no text either.
fn no_stl(bytes: &[u8]) -> Diagnostic {
    let message = match bytes.len() {
        0 => "the file is empty".to_owned(),
        length => {
            format!("this is no STL file: it has {length} bytes and does not begin with solid")
        }
    };
    Diagnostic::error(codes::INVALID_DATA, "", message, "give an STL file, or export it again")
}
