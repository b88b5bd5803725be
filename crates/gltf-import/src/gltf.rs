//! The glTF 2.0 importer: a `.gltf` or `.glb` file becomes a [`Model`].
//!
//! ```text
//!  bytes ──container──► JSON ──document──► Root ──model_builder──► Model
//!                       binary chunk ─┐             │
//!  other files ──uri_resolver──► buffers ─┴─► accessor, elements, images
//! ```
//!
//! Only the JSON types of the `gltf` crate are used, because its importer panics on malformed files
//! and reads any file that a URI names.

mod accessor;
mod animation;
mod animation_pointer;
mod attribute;
mod buffers;
mod camera;
mod container;
mod document;
mod draco;
mod edge_visibility;
mod elements;
mod extensions;
mod gpu_instancing;
mod images;
mod json_repair;
mod lights;
mod material;
mod meshopt;
mod model_builder;
mod morph_target;
mod node_transform;
mod primitive;
mod scalars;
mod scene_graph;
mod selection;
mod skin;
mod texture;
mod topology;
mod untyped_members;

pub use document::check_json_limits;
pub use extensions::{ExtensionUse, extension_use};
pub(crate) use images::check_image_size;
pub use meshopt::CompressedView;
pub use scene_graph::check_scene_items;

use super::ImportOptions;
use super::uri_resolver::UriResolver;
use super::warnings::ImportWarnings;
use accessor::AccessorReader;
use buffers::Buffers;
use container::Container;
use document::GltfDocument;
use model::{Diagnostic, Model};
use std::path::Path;

/// Imports a glTF file from its bytes.
///
/// # Errors
/// Fails if the file breaks a rule, requires an extension that is not supported, or exceeds a
/// limit.
pub fn import_gltf(
    _path: &Path,
    bytes: &[u8],
    resolver: &UriResolver<'_>,
    options: &ImportOptions,
) -> Result<Model, Diagnostic> {
    let limits = resolver.limits;
    let mut warnings = ImportWarnings::new(options.lenient);
    let container = Container::from_bytes(bytes, &mut warnings)?;
    let json = &bytes[container.json];
    let parse = || GltfDocument::parse_json(json, limits, &mut warnings);
    let document = options.timings.measure("parse", parse)?;
    let chunk = container.binary.map(|range| &bytes[range]);
    extensions::check_extensions(&document.root, &mut warnings)?;
    let buffers = Buffers::new(&document.root, resolver, chunk, limits);
    let source = AccessorReader::new(&document.root, &buffers, limits);
    let mut model = model_builder::build_model(&document, &source, options, &mut warnings)?;
    model.warnings = warnings.into_list();
    Ok(model)
}
