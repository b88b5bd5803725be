//! From a glTF file to a [`Model`]: nothing in the file is trusted.
//!
//! ```text
//!  bytes ──container──► JSON ──json──► Root ──scene, material, primitive, …──► Model
//!                       binary chunk ─┐          │
//!  other files ──resolver──► buffers ─┴─► accessor, elements, image
//! ```
//!
//! The `gltf` crate lends its JSON types and nothing else: its own importer panics on malformed files and reads any
//! file a URI names. Here every index, length and size is checked before it is used, URIs name files below one folder
//! only, everything a file can declare has a [limit](Limits), and a fault says where it is, what is wrong and what to
//! do. What makes the shape unreadable refuses the file; what only spoils the look is a [`Warning`](crate::model::Warning).

mod accessor;
mod animation;
mod attribute;
mod budget;
mod buffers;
mod camera;
mod container;
mod decode;
mod draco;
mod elements;
mod error;
mod extensions;
mod image;
mod instancing;
mod json;
mod limits;
mod material;
mod meshopt;
mod normals;
mod placement;
mod primitive;
mod resolver;
mod scene;
mod skin;
mod texture;
mod topology;
mod warnings;

pub use error::{Fault, FaultKind, ImportError};
pub use limits::Limits;

use crate::model::{Model, Node};
use accessor::Source;
use buffers::Buffers;
use container::Container;
use json::Document;
use resolver::Resolver;
use std::path::{Path, PathBuf};
use warnings::Warnings;

/// How a file is loaded.
#[derive(Clone, Debug, Default)]
pub struct ImportOptions {
    /// The largest sizes that are accepted.
    pub limits: Limits,
    /// The folder that all files the glTF file refers to must be below. Default: the folder of the glTF file.
    pub root: Option<PathBuf>,
}

/// Loads a `.gltf` or `.glb` file; which of the two it is, its content says.
///
/// Soft faults do not stop it: they are in [`Model::warnings`]. A file with nothing to draw loads as well.
///
/// ```no_run
/// use pipeline::import::{ImportOptions, load};
/// let model = load("chair.glb".as_ref(), &ImportOptions::default())?;
/// let triangles: usize = model.meshes.iter().flat_map(|mesh| &mesh.primitives).map(|p| p.count()).sum();
/// for warning in &model.warnings {
///     println!("{}: {}", warning.pointer, warning.message);
/// }
/// # Ok::<(), pipeline::import::ImportError>(())
/// ```
///
/// # Errors
/// The file, or one it refers to, cannot be read or may not be; is not glTF 2.0 or breaks its rules; requires an
/// unknown extension; exceeds a limit.
pub fn load(path: &Path, options: &ImportOptions) -> Result<Model, ImportError> {
    let loaded = resolver::read_file(path, &options.limits, "").and_then(|bytes| {
        let root = options.root.as_deref();
        let resolver = Resolver::new(path, bytes.len(), root, &options.limits)?;
        read_model(path, &bytes, &resolver)
    });
    loaded.map_err(|fault| ImportError { file: path.to_owned(), fault })
}

/// Loads a model whose file is in memory, as [`load`] does; `name` stands for its path in messages.
///
/// Without a [root](ImportOptions::root) the file must be complete in itself: no other file is read, whatever it says. With
/// one, the files it names begin at that folder.
///
/// # Errors
/// As for [`load`].
pub fn load_bytes(name: &str, bytes: &[u8], options: &ImportOptions) -> Result<Model, ImportError> {
    let (path, root) = (Path::new(name), options.root.as_deref());
    let loaded = Resolver::in_memory(bytes.len(), root, &options.limits)
        .and_then(|resolver| read_model(path, bytes, &resolver));
    loaded.map_err(|fault| ImportError { file: path.to_owned(), fault })
}

fn read_model(path: &Path, bytes: &[u8], resolver: &Resolver<'_>) -> Result<Model, Fault> {
    let limits = resolver.limits;
    let mut warnings = Warnings::default();
    let container = Container::find(bytes, &mut warnings)?;
    let document = Document::parse(&bytes[container.json], limits)?;
    let chunk = container.binary.map(|range| &bytes[range]);
    extensions::check(&document.root, &mut warnings)?;
    let buffers = Buffers::new(&document.root, resolver, chunk, limits);
    let source = Source::new(&document.root, &buffers, limits);
    let mut model = build(&document, &source, &mut warnings)?;
    model.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    model.warnings = warnings.into_list();
    Ok(model)
}

fn build(
    document: &Document,
    source: &Source<'_>,
    warnings: &mut Warnings,
) -> Result<Model, Fault> {
    let root = &document.root;
    let nodes = scene::nodes(document, source.limits, warnings)?;
    let (cameras, usable) = camera::cameras(root, warnings);
    let mut model = Model {
        roots: scene::roots(document, &nodes, warnings)?,
        animations: animation::animations(source, &nodes, warnings)?,
        nodes,
        materials: material::materials(root, warnings),
        textures: texture::textures(root, warnings),
        cameras,
        skins: skin::skins(source, warnings)?,
        meshes: primitive::meshes(source, warnings)?,
        extensions_used: sorted(&root.extensions_used),
        ..Model::default()
    };
    drop_lost_references(&mut model, &usable);
    material::warn_of_missing_texcoords(&model, warnings);
    instancing::read(source, &mut model.nodes, warnings)?;
    scene::check_items(&model, source.limits)?;
    let shown = shown_meshes(&model);
    let Model { meshes, materials, textures, .. } = &model;
    let needed = image::needed(meshes, &shown, materials, textures, root.images.len());
    let encoded = image::read(&needed, source, warnings);
    model.images = image::decode_all(&encoded, root.images.len(), warnings);
    Ok(model)
}

/// Nodes do not name skins and cameras that have been left out.
fn drop_lost_references(model: &mut Model, usable_cameras: &[bool]) {
    let Model { nodes, skins, .. } = model;
    for Node { skin, camera, .. } in nodes {
        *skin = skin.filter(|&at| !skins[at].joints.is_empty());
        *camera = camera.filter(|&at| usable_cameras[at]);
    }
}

/// For each mesh, whether the shown scene shows it.
fn shown_meshes(model: &Model) -> Vec<bool> {
    let mut shown = vec![false; model.meshes.len()];
    for instance in model.instances() {
        if let Some(mesh) = model.nodes[instance.node].mesh {
            shown[mesh] = true;
        }
    }
    shown
}

fn sorted(names: &[String]) -> Vec<String> {
    let mut names = names.to_vec();
    names.sort();
    names.dedup();
    names
}
