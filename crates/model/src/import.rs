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
//! do. What makes the shape unreadable refuses the file; what only spoils the look is a [`Warning`](crate::Warning).
//! A lenient reader has warnings of both, as long as something is left to load. [`check`] tells all that is wrong.

mod error;
pub(crate) mod gltf;
pub(crate) mod image_decoder;
mod limits;
pub(crate) mod memory_budget;
mod name_or_index;
mod normals;
mod parallel_decoding;
pub(crate) mod uri_resolver;
mod warnings;

pub use crate::check::{CheckReport, check_bytes, check_file};
pub use error::ImportError;
pub use gltf::{ExtensionUse, extension_use};
pub use image_decoder::decode_bounded as decode_image;
pub use limits::Limits;
pub use name_or_index::NameOrIndex;

use crate::Model;
use crate::Timings;
use gltf::import_gltf;
use std::path::{Path, PathBuf};
use uri_resolver::UriResolver;

/// How a file is loaded.
#[derive(Clone, Debug, Default)]
pub struct ImportOptions {
    /// The largest sizes that are accepted.
    pub limits: Limits,
    /// The folder that all files the glTF file refers to must be below. Default: the folder of the glTF file.
    pub root: Option<PathBuf>,
    /// Other folders that files may be below: `..` and symbolic links may lead there. Default: none.
    pub allow_outside: Vec<PathBuf>,
    /// Whether what is broken, missing or unknown is left out with a warning wherever something else is left to load, in place
    /// of an error. Limits hold all the same. Default: no.
    pub lenient: bool,
    /// The scene of the file that is shown. Default: its default scene, else its first.
    pub scene: Option<NameOrIndex>,
    /// The variant of the file that is shown (KHR_materials_variants). Default: none.
    pub variant: Option<NameOrIndex>,
    /// What is done with images.
    pub images: ImageLoading,
    /// What the stages of loading are measured with. Default: not at all.
    pub timings: Timings,
}

/// What is done with the images of a file.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum ImageLoading {
    /// Those that visible surfaces show are decoded; no other is read.
    #[default]
    Decode,
    /// None is decoded, but the headers of all are read.
    Headers,
}

/// Loads a `.gltf` or `.glb` file; which of the two it is, its content says.
///
/// Soft faults do not stop it: they are in [`Model::warnings`]. A file with nothing to draw loads as well.
///
/// ```no_run
/// use model::{ImportOptions, load};
/// let model = load("chair.glb".as_ref(), &ImportOptions::default())?;
/// let triangles: usize = model.meshes.iter().flat_map(|mesh| &mesh.primitives).map(|p| p.item_count()).sum();
/// for warning in &model.warnings {
///     println!("{warning}");
/// }
/// # Ok::<(), model::ImportError>(())
/// ```
///
/// # Errors
/// The file, or one it refers to, cannot be read or may not be; is not glTF 2.0 or breaks its rules; requires an
/// unknown extension; exceeds a limit; has no such scene or variant as the options ask for.
pub fn load(path: &Path, options: &ImportOptions) -> Result<Model, ImportError> {
    let read = || uri_resolver::read_file(path, &options.limits, "");
    let loaded = options.timings.measure("read", read).and_then(|bytes| {
        let resolver = UriResolver::new(path, bytes.len(), options)?;
        import_gltf(path, &bytes, &resolver, options)
    });
    loaded.map_err(|fault| ImportError { file: path.to_owned(), diagnostic: fault })
}

/// Loads a model whose file is in memory, as [`load`] does; `name` stands for its path in messages.
///
/// Without a [root](ImportOptions::root) the file must be complete in itself: no other file is read, whatever it says. With
/// one, the files it names begin at that folder.
///
/// # Errors
/// As for [`load`].
pub fn load_bytes(name: &str, bytes: &[u8], options: &ImportOptions) -> Result<Model, ImportError> {
    let path = Path::new(name);
    let loaded = UriResolver::in_memory(bytes.len(), options)
        .and_then(|resolver| import_gltf(path, bytes, &resolver, options));
    loaded.map_err(|fault| ImportError { file: path.to_owned(), diagnostic: fault })
}
