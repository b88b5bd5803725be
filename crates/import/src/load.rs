//! Loading: detects the format, runs its reader, and applies the options to the model.

use crate::{FileFormat, obj, ply, stl, threemf};
use glam::DVec3;
use gltf_import::{
    ImportError, ImportOptions, Limits, MemoryFolder, UriResolver, check_file_size,
    check_scene_items, import_gltf, missing_file, read_file,
};
use model::{Diagnostic, Model, Severity, Topology, codes};
use std::path::Path;

/// Loads a model. Its [format](FileFormat) is detected from the content; the name is used only if
/// the content is ambiguous.
///
/// Problems in the appearance do not stop loading; they are listed in [`Model::warnings`]. A file
/// without anything to draw also loads.
///
/// ```no_run
/// use import::{ImportOptions, load};
/// let model = load("chair.glb".as_ref(), &ImportOptions::default())?;
/// let primitives = model.meshes.iter().flat_map(|mesh| &mesh.primitives);
/// println!("{} triangles", primitives.map(|primitive| primitive.item_count()).sum::<usize>());
/// for warning in &model.warnings {
///     println!("{warning}");
/// }
/// # Ok::<(), import::ImportError>(())
/// ```
///
/// # Errors
/// Fails if the file or a referenced file cannot be read, is not allowed, has an unknown format,
/// breaks the rules of its format or exceeds a limit. Also fails if it requires an unsupported
/// extension or lacks the scene, variant or scalar attribute that the options select.
pub fn load(path: &Path, options: &ImportOptions) -> Result<Model, ImportError> {
    if let Some(bytes) = options.lesson_model_at(path) {
        return load_bytes(&path.with_added_extension("glb").to_string_lossy(), &bytes, options);
    }
    let read = || read_file(path, &options.limits, "");
    let load_bytes = || {
        let bytes = options.timings.measure("read", read)?;
        let resolver = UriResolver::new(path, bytes.len(), options)?;
        import_model(path, &bytes, &resolver, options)
    };
    let loaded = match stl::import_binary_file(path, options) {
        Some(imported) => {
            imported.and_then(|model| complete_model(model, path, FileFormat::Stl, options))
        }
        None => load_bytes(),
    };
    loaded.map_err(|diagnostic| ImportError::new(path, diagnostic))
}

/// Loads a model from a file in memory, as [`load`] does. `name` replaces the path in messages.
///
/// Without a [root](ImportOptions::root) no other files are read, so the file must be
/// self-contained. With a root, relative URIs are resolved against that folder.
///
/// # Errors
/// Fails in the same cases as [`load`].
pub fn load_bytes(name: &str, bytes: &[u8], options: &ImportOptions) -> Result<Model, ImportError> {
    let path = Path::new(name);
    let loaded = UriResolver::in_memory(bytes.len(), options)
        .and_then(|resolver| import_model(path, bytes, &resolver, options));
    loaded.map_err(|diagnostic| ImportError::new(path, diagnostic))
}

/// Loads a model from a file in an in-memory folder, as [`load`] does from disk.
///
/// Relative URIs are resolved within the folder. [`root`](ImportOptions::root) and
/// [`allow_outside`](ImportOptions::allow_outside) are ignored, and no file on disk is read.
///
/// ```
/// use import::{MemoryFolder, load_from_memory};
/// let mut folder = MemoryFolder::default();
/// folder.insert("triangle.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec());
/// let model = load_from_memory(&folder, "triangle.obj", &Default::default())?;
/// assert_eq!(model.meshes[0].primitives[0].indices.len(), 3);
/// # Ok::<(), import::ImportError>(())
/// ```
///
/// # Errors
/// Fails if there is no such file in the folder, and in the same cases as [`load`].
pub fn load_from_memory(
    folder: &MemoryFolder,
    path: &str,
    options: &ImportOptions,
) -> Result<Model, ImportError> {
    let import = || {
        let missing = || missing_file("", path);
        let bytes = folder.file(path).ok_or_else(missing)?;
        let resolver = UriResolver::in_memory_folder(folder, path, bytes.len(), options);
        check_file_size(bytes.len(), &options.limits)?;
        import_model(Path::new(path), bytes, &resolver, options)
    };
    import().map_err(|diagnostic| ImportError::new(path, diagnostic))
}

/// Imports a file from its bytes. The file name in `path` becomes the model's name.
///
/// # Errors
/// Fails in the same cases as [`load`].
pub fn import_model(
    path: &Path,
    bytes: &[u8],
    resolver: &UriResolver<'_>,
    options: &ImportOptions,
) -> Result<Model, Diagnostic> {
    let format = FileFormat::recognize(path, bytes)?;
    let import = match format {
        FileFormat::Gltf => import_gltf,
        FileFormat::Stl => stl::import_stl,
        FileFormat::Obj => obj::import_obj,
        FileFormat::Ply => ply::import_ply,
        FileFormat::ThreeMf => threemf::import_threemf,
    };
    complete_model(import(path, bytes, resolver, options)?, path, format, options)
}

/// Completes a model from a format reader, and rotates it so that y is up. The options override the
/// file's up axis and unit.
fn complete_model(
    mut model: Model,
    path: &Path,
    format: FileFormat,
    options: &ImportOptions,
) -> Result<Model, Diagnostic> {
    model.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    model.length_unit = options.length_unit.unwrap_or(model.length_unit);
    if let Some(colors) = &options.scalars {
        if !matches!(format, FileFormat::Gltf | FileFormat::Ply) {
            return Err(colors.unsupported_in(format.name()));
        }
        let active = colors.find_among(&model.scalar_attributes, "")?;
        model.active_scalar_attribute = Some(active);
    }
    model.rotate_roots(options.up.unwrap_or(model.up_axis));
    if format != FileFormat::Gltf {
        check_scene_limits(&model, &options.limits)?;
        model.warnings.extend(surface_without_area(&model));
    }
    model.warnings.extend(misleading_name(path, format));
    Ok(model)
}

/// Returns the note about a file whose name suggests a different format than its content.
fn misleading_name(path: &Path, format: FileFormat) -> Option<Diagnostic> {
    let named = FileFormat::from_extension(path).filter(|named| *named != format)?;
    let message =
        format!("the name suggests {}, but the content is {}", named.name(), format.name());
    let help = format!("rename it to end in .{}", format.extensions().last()?);
    let fault = Diagnostic::error(codes::MISLEADING_NAME, "", message, &help);
    Some(fault.with_severity(Severity::Info))
}

/// Returns the warning about a model whose triangles all have zero area, so that none is visible.
pub(crate) fn surface_without_area(model: &Model) -> Option<Diagnostic> {
    let primitives = model.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let mut triangles = primitives
        .filter(|primitive| primitive.topology == Topology::Triangles)
        .flat_map(|primitive| {
            let corners = primitive.indices.as_chunks::<3>().0.iter();
            corners.map(|corners| corners.map(|vertex| primitive.positions[vertex as usize]))
        })
        .peekable();
    triangles.peek()?;
    let has_area = |[a, b, c]: [[f32; 3]; 3]| {
        let [a, b, c] = [a, b, c].map(|corner| DVec3::from(corner.map(f64::from)));
        (b - a).cross(c - a).length_squared() > 0.0
    };
    let help = "export the model again";
    let fault =
        || Diagnostic::error(codes::LEFT_OUT, "", "no triangle in the file has an area", help);
    (!triangles.any(has_area)).then(|| fault().with_severity(Severity::Warning))
}

/// Checks the node and item counts of the scene.
pub(crate) fn check_scene_limits(model: &Model, limits: &Limits) -> Result<(), Diagnostic> {
    let nodes = model.nodes.len();
    if nodes > limits.nodes {
        let what = format!("the model has {nodes} nodes");
        return Err(Diagnostic::limit_exceeded("", &what, "nodes", limits.nodes as u64));
    }
    check_scene_items(model, limits)
}
