//! The OBJ importer: Wavefront's text format for polygons, with its material libraries (MTL).
//!
//! ```text
//!  text ──parser──► vertices, elements ──parts──► triangles ──primitives──► meshes ─scene─► Model
//!   └─ mtllib ──mtl──► statements ──material, textures─────────────────────────────────────┘
//! ```
//!
//! Reads polygons with any number of corners, lines and points, with texture coordinates, normals
//! and vertex colors. Objects, groups, smoothing groups, materials and textures are read as well.
//! Free-form curves and surfaces and unknown statements are listed in a warning.
//!
//! A file without elements is a point cloud. Missing normals are computed from the smoothing groups
//! if the file has any, and otherwise with the crease angle. The format defines neither up axis nor
//! unit; y and the meter are assumed.
//!
//! The `tobj` crate is not used, because its fans are wrong for concave polygons. It also lacks
//! smoothing groups, error locations and UTF-16 support.

mod elements;
mod fault_counts;
mod material;
mod mtl;
mod parser;
mod parts;
mod phong;
mod primitives;
mod scene;
mod statements;
mod textures;
mod vertex_sharing;

pub use phong::PhongMaterial;

use super::text::{Token, decode_text};
use gltf_import::ImportOptions;
use gltf_import::ImportWarnings;
use gltf_import::MemoryBudget;
use gltf_import::UriResolver;
use model::{Diagnostic, LengthUnit, Material, Mesh, Model, Node, Primitive, UpAxis};
use mtl::MtlMaterial;
use parser::ObjFile;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use textures::TextureTable;

/// Maximum number of material libraries. Files usually name one, or one per object.
const MAX_LIBRARIES: usize = 1024;
/// Maximum number of array bytes per corner: references, triangle, vertex with attributes, and
/// temporary data for computing normals.
const BYTES_PER_CORNER: u64 = 140;

/// Imports an OBJ file from its bytes.
pub(super) fn import_obj(
    _path: &Path,
    bytes: &[u8],
    resolver: &UriResolver<'_>,
    options: &ImportOptions,
) -> Result<Model, Diagnostic> {
    let mut warnings = ImportWarnings::new(options.lenient);
    let timings = &options.timings;
    let text = decode_text(bytes);
    let file = timings.measure("parse", || parser::parse_obj(&text, &mut warnings))?;
    check_sizes(&file, resolver)?;
    let (names, groups) = (file.material_names.clone(), file.groups.clone());
    let libraries = read_libraries(&file.libraries, resolver, &mut warnings);
    let crease_angle = options.crease_degrees();
    let build = || primitives::build_primitives(file, &text, crease_angle, &mut warnings);
    let primitives = timings.measure("geometry", build)?;
    let mut model =
        Model { up_axis: UpAxis::Y, length_unit: LengthUnit::Meter, ..Model::default() };
    scene::build_scene(&mut model, &groups, primitives);
    build_materials(&mut model, &names, &libraries, resolver, options, &mut warnings);
    model.warnings = warnings.into_list();
    Ok(model)
}

/// Checks the number of nodes and the memory for the elements against the limits.
fn check_sizes(file: &ObjFile<'_>, resolver: &UriResolver<'_>) -> Result<(), Diagnostic> {
    let limits = resolver.limits;
    let nodes = 2 * file.groups.len();
    if nodes > limits.nodes {
        let what = format!("there are {} objects and groups", file.groups.len());
        return Err(Diagnostic::limit_exceeded("", &what, "nodes", limits.nodes as u64));
    }
    let corners = file.elements.corners.len() as u64 * BYTES_PER_CORNER;
    let group = 2 * size_of::<Node>() + size_of::<Mesh>() + size_of::<Primitive>();
    let groups = (file.groups.len() * group) as u64;
    let materials = (file.material_names.len() * size_of::<Material>()) as u64;
    let budget = MemoryBudget::new(limits);
    budget.charge_bytes("", corners + groups + materials, resolver.total_bytes())
}

/// A material library that has been read.
struct Library {
    /// The name in the OBJ file.
    name: String,
    /// The text in UTF-8.
    text: Vec<u8>,
}

/// Reads the material libraries. Each missing library causes a warning.
///
/// `mtllib` gives either one name, which may contain spaces, or several names.
fn read_libraries(
    statements: &[Token<'_>],
    resolver: &UriResolver<'_>,
    warnings: &mut ImportWarnings,
) -> Vec<Library> {
    let (mut libraries, mut seen, mut tried) = (Vec::new(), BTreeSet::new(), 0);
    for token in statements.iter().filter(|token| !token.bytes.is_empty()) {
        if !seen.insert(token.bytes) || tried >= MAX_LIBRARIES {
            continue;
        }
        tried += 1;
        let words = token.tokens().map(Token::to_text);
        let is_one = words.clone().nth(1).is_none();
        // The whole line is tried as one name first, because exporters do not quote spaces.
        match read_library(token.to_text(), resolver) {
            Ok(library) => libraries.push(library),
            Err(fault) if is_one => warnings.downgrade(&fault, "the default material is used"),
            Err(_) => {
                for name in words.take(MAX_LIBRARIES - tried) {
                    tried += 1;
                    match read_library(name, resolver) {
                        Ok(library) => libraries.push(library),
                        Err(fault) => warnings.downgrade(&fault, "the default material is used"),
                    }
                }
            }
        }
    }
    if tried >= MAX_LIBRARIES {
        warnings.push_warning(
            "",
            format!("only the first {MAX_LIBRARIES} material libraries are read"),
        );
    }
    libraries
}

/// Reads one library.
fn read_library(name: String, resolver: &UriResolver<'_>) -> Result<Library, Diagnostic> {
    let bytes = resolver.read_uri(&name, &format!("mtllib {}", shorten(&name)))?;
    let text = decode_text(&bytes).into_owned();
    Ok(Library { name, text })
}

/// Adds the materials of the primitives to the model, in the order of their first use, and the
/// images of their textures.
fn build_materials(
    model: &mut Model,
    names: &[&[u8]],
    libraries: &[Library],
    resolver: &UriResolver<'_>,
    options: &ImportOptions,
    warnings: &mut ImportWarnings,
) {
    // Use the last definition in the first library that defines the name.
    let mut defined: BTreeMap<&[u8], (usize, MtlMaterial<'_>)> = BTreeMap::new();
    for (at, library) in libraries.iter().enumerate() {
        for material in mtl::parse_mtl(&library.text, &shorten(&library.name), warnings) {
            let is_earlier = |other: &(usize, _)| other.0 < at;
            if !defined.get(material.name).is_some_and(is_earlier) {
                defined.insert(material.name, (at, material));
            }
        }
    }
    let mut textures = TextureTable::default();
    let mut undefined = Vec::new();
    for &name in names {
        let material = match defined.get(name) {
            Some((library, material)) => {
                textures.folder = folder_of(&libraries[*library].name);
                material::to_material(material, &mut textures, warnings)
            }
            None => {
                undefined.push(name);
                Material { name: scene::to_name(name), ..Material::plain() }
            }
        };
        model.materials.push(material);
    }
    report_undefined(&undefined, warnings);
    // Elements without a material share one, which is added only if it is used.
    let mut has_plain = false;
    let plain = names.len();
    for primitive in model.meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives) {
        has_plain |= primitive.material.is_none();
        primitive.material = primitive.material.or(Some(plain));
    }
    model.materials.extend(has_plain.then(Material::plain));
    report_missing_uvs(model, warnings);
    textures.load_images(model, resolver, options, warnings);
}

/// Returns a name from a file as quoted in messages, truncated if it is very long.
fn shorten(name: &str) -> String {
    const LENGTH: usize = 80;
    let mut short: String = name.chars().take(LENGTH).collect();
    if short.len() < name.len() {
        short.push('…');
    }
    short
}

/// Returns the folder of a path with a trailing slash, or an empty string for data URIs and paths
/// without a folder.
fn folder_of(path: &str) -> String {
    let path = if path.starts_with("data:") { "" } else { path };
    path.rfind(['/', '\\']).map_or_else(String::new, |slash| path[..=slash].to_owned())
}

/// Adds a warning that lists undefined materials.
fn report_undefined(names: &[&[u8]], warnings: &mut ImportWarnings) {
    const NAMED: usize = 8;
    if names.is_empty() {
        return;
    }
    let quoted = names.iter().take(NAMED).map(|name| {
        let name: String = String::from_utf8_lossy(name).chars().take(64).collect();
        format!("{name:?}")
    });
    let mut list = quoted.collect::<Vec<_>>().join(", ");
    if names.len() > NAMED {
        list.push_str(&format!(" and {} more", names.len() - NAMED));
    }
    let message = format!("no material library defines {list}; the default material is used");
    warnings.push_warning("", message);
}

/// Adds a warning about surfaces with textures but without texture coordinates.
fn report_missing_uvs(model: &Model, warnings: &mut ImportWarnings) {
    let primitives = model.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let has_textures = |material: usize| model.materials[material].all_textures().next().is_some();
    let bare = primitives.filter(|at| at.uvs.is_empty() && at.material.is_some_and(has_textures));
    let count = bare.count();
    if count > 0 {
        let message = match count {
            1 => "1 surface has textures but no texture coordinates; \
                  it is drawn without textures"
                .to_owned(),
            _ => format!(
                "{count} surfaces have textures but no texture coordinates; \
                 they are drawn without textures"
            ),
        };
        warnings.push_warning("", message);
    }
}

#[cfg(test)]
mod tests;
