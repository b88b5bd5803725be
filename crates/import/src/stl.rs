//! The STL importer: reads ASCII and binary triangle files into a [`Model`].
//!
//! ```text
//!  bytes ─┬─ binary ─┬─► facets ──VertexWelder──► vertices ──CreaseNormals──► Mesh per solid
//!         └─ ascii ──┘
//! ```
//!
//! Files of either form may begin with `solid`, so the file length distinguishes them. By
//! convention z points up and lengths are in millimeters. The normals in the file are not read,
//! because they are flat face normals, and often 0 or wrong.
//!
//! Triangles without area are retained, because they close the surface. Triangles with a non-finite
//! corner are skipped with a warning.

mod ascii;
mod binary;
mod facet_color;
mod solid;

use super::file_format::FileFormat;
use super::text::decode_text;
use binary::BinaryFile;
use gltf_import::ImportOptions;
use gltf_import::ImportWarnings;
use gltf_import::MemoryBudget;
use gltf_import::UriResolver;
use model::{Diagnostic, LengthUnit, Material, Mesh, Model, Node, UpAxis, codes};
use solid::Solid;
use std::fs::File;
use std::io::Read as _;
use std::path::Path;

/// Imports an STL file from its bytes.
///
/// Each solid with triangles becomes a node with a mesh. All meshes have the same material; facet
/// colors become vertex colors.
///
/// # Errors
/// Fails if the file is truncated or malformed, or a limit is exceeded.
pub(super) fn import_stl(
    _path: &Path,
    bytes: &[u8],
    resolver: &UriResolver<'_>,
    options: &ImportOptions,
) -> Result<Model, Diagnostic> {
    let mut warnings = ImportWarnings::new(options.lenient);
    let limits = resolver.limits;
    let budget = MemoryBudget::new(limits);
    let parse = || {
        // Binary files may also begin with `solid`, so the length is checked first.
        if has_binary_length(bytes) || !is_text(bytes) {
            let Some((header, mut body)) = bytes.split_first_chunk() else {
                return Err(binary::no_stl(bytes));
            };
            let body_bytes = body.len();
            let file = BinaryFile { header: *header, body: &mut body, body_bytes };
            binary::read_solid(file, &budget, &mut warnings).map(|solid| vec![solid])
        } else {
            // A facet takes at most twice the memory of its shortest possible text.
            budget.charge_bytes("", 2 * bytes.len() as u64, resolver.total_bytes())?;
            ascii::read_solids(&decode_text(bytes), limits, &mut warnings)
        }
    };
    let solids = options.timings.measure("parse", parse)?;
    let crease = options.crease_degrees();
    let build = || build_model(solids, crease);
    let mut model = options.timings.measure("geometry", build);
    model.warnings = warnings.into_list();
    Ok(model)
}

/// Imports a binary STL file of exactly the right length without holding all of it in memory.
/// Returns `None` for any other file, or if the file cannot be opened.
///
/// # Errors
/// Fails if a limit is exceeded, or the file cannot be read to its end.
pub(super) fn import_binary_file(
    path: &Path,
    options: &ImportOptions,
) -> Option<Result<Model, Diagnostic>> {
    // Opening a pipe would wait for a writer.
    let metadata = path.metadata().ok().filter(std::fs::Metadata::is_file)?;
    let mut body = File::open(path).ok()?;
    let length = usize::try_from(metadata.len()).ok()?;
    let mut header = [0; HEADER_BYTES];
    body.read_exact(&mut header).ok()?;
    let is_other = FileFormat::from_content(&header).is_some_and(FileFormat::precedes_binary_stl);
    let is_allowed = metadata.len() <= options.limits.file_bytes;
    if is_other || !is_allowed || binary_length(&header) != Some(length) {
        return None;
    }
    let mut warnings = ImportWarnings::new(options.lenient);
    let budget = MemoryBudget::new(&options.limits);
    let file = BinaryFile { header, body: &mut body, body_bytes: length - HEADER_BYTES };
    let parse = || binary::read_solid(file, &budget, &mut warnings);
    Some(options.timings.measure("parse", parse).map(|solid| {
        let build = || build_model(vec![solid], options.crease_degrees());
        let model = options.timings.measure("geometry", build);
        Model { warnings: warnings.into_list(), ..model }
    }))
}

/// Builds the model from solids. Solids without triangles are skipped.
fn build_model(solids: Vec<Solid>, crease_degrees: f64) -> Model {
    let mut model = Model {
        materials: vec![Material::plain()],
        length_unit: LengthUnit::Millimeter,
        up_axis: UpAxis::Z,
        ..Model::default()
    };
    for mut solid in solids.into_iter().filter(|solid| solid.triangle_count() > 0) {
        let name = solid.name.take().filter(|name| !name.is_empty());
        let primitive = solid.into_primitive(crease_degrees);
        if primitive.colors.is_some() {
            // Vertex colors multiply the material color.
            model.materials[0].base_color = [1.0; 4];
        }
        let at = model.nodes.len();
        model.nodes.push(Node { name: name.clone(), mesh: Some(at), ..Node::default() });
        model.roots.push(at);
        model.meshes.push(Mesh { name, primitives: vec![primitive], ..Mesh::default() });
    }
    model
}

/// Number of bytes before the triangles of a binary file: an 80-byte comment and the number of
/// triangles.
const HEADER_BYTES: usize = 84;
/// Number of bytes per triangle in a binary file: the normal, three corners and the attribute.
const TRIANGLE_BYTES: usize = 50;
/// Number of bytes at the start of a file that are searched for signs of the text form.
const PREFIX_BYTES: usize = 4 << 10;

/// Returns whether the content of a file is certainly STL. `text` is the beginning of the file as
/// UTF-8.
pub(super) fn is_stl(bytes: &[u8], text: &[u8]) -> bool {
    has_binary_length(bytes) || starts_with(text.trim_ascii_start(), b"solid") && has_facets(text)
}

/// Returns the number of triangles that a binary file declares, or `None` if the file is too short.
fn declared_triangles(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(80..HEADER_BYTES)?.first_chunk()?;
    usize::try_from(u32::from_le_bytes(*count)).ok()
}

/// Returns whether the length of a file matches its declared number of triangles exactly.
///
/// A text file cannot match: the four characters at the position of the count would encode more
/// than 500 million triangles.
fn has_binary_length(bytes: &[u8]) -> bool {
    binary_length(bytes) == Some(bytes.len())
}

/// Returns the length of a binary file that begins with these bytes, or `None` if there are too few
/// bytes.
fn binary_length(bytes: &[u8]) -> Option<usize> {
    declared_triangles(bytes)?.checked_mul(TRIANGLE_BYTES)?.checked_add(HEADER_BYTES)
}

/// Returns whether a file is text, given that its length does not match a binary file.
fn is_text(bytes: &[u8]) -> bool {
    let text = decode_text(bytes.get(..PREFIX_BYTES).unwrap_or(bytes));
    let start = text.trim_ascii_start();
    let begins = starts_with(start, b"solid") || starts_with(start, b"facet");
    begins && (has_facets(&text) || !text.contains(&0))
}

/// Returns whether text contains a facet or the end of a solid.
fn has_facets(text: &[u8]) -> bool {
    let mut rests = (0..text.len()).map(|at| &text[at..]);
    rests.any(|rest| starts_with(rest, b"facet") || starts_with(rest, b"endsolid"))
}

/// Returns whether text starts with a word, ignoring case.
fn starts_with(text: &[u8], word: &[u8]) -> bool {
    text.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word))
}

/// Returns the error for a file that ends too early. In lenient mode, the available part is read.
fn truncated(location: &str, message: String) -> Diagnostic {
    let help = "the file is truncated: copy or export it again";
    Diagnostic::error(codes::INVALID_DATA, location, message, help)
}

#[cfg(test)]
mod tests;
