//! Import: reads a file into a [`Model`] without trusting anything in it.
//!
//! Files are untrusted input. Every index, length and size is checked before it is used, URIs refer
//! to files below one folder only, and everything a file can declare has a [limit](Limits). A
//! [`Diagnostic`](crate::Diagnostic) says where the file is wrong, what is wrong and what to do.
//!
//! Faults in the geometry (positions, indices, the node hierarchy) are errors; faults in the
//! appearance (materials, normals, images) are [warnings](Model::warnings), and the file is drawn
//! without what is broken. With [`ImportOptions::lenient`] most errors become warnings too, as long
//! as something is left to load. [`check_file`] lists everything that is wrong instead of stopping
//! at the first error.
//!
//! | option | error by default | with `lenient` |
//! | --- | --- | --- |
//! | broken shape | yes | the primitive is left out |
//! | missing buffer file | yes | what uses it is left out |
//! | unknown required extension | yes | it is ignored |
//! | not glTF, other version | yes | yes |
//! | exceeded limit | yes | yes |
//!
//! The modules here serve every format; `gltf` reads glTF 2.0.

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

/// Options for loading a file.
#[derive(Clone, Debug, Default)]
pub struct ImportOptions {
    /// The largest sizes that are accepted.
    pub limits: Limits,
    /// The folder below which all referenced files must be. Default: the folder of the file itself.
    pub root: Option<PathBuf>,
    /// Further folders that may hold referenced files: `..` and symbolic links may lead there.
    /// Default: none.
    pub allow_outside: Vec<PathBuf>,
    /// Whether broken, missing or unknown data is left out with a warning instead of an error, as
    /// long as something else is left to load. Limits hold all the same. Default: no.
    pub lenient: bool,
    /// The active scene. Default: the file's default scene, else its first.
    pub scene: Option<NameOrIndex>,
    /// The active material variant (KHR_materials_variants). Default: none.
    pub variant: Option<NameOrIndex>,
    /// Whether images are decoded. Default: those that are visible.
    pub images: ImageLoading,
    /// Stopwatch for the stages of loading. Default: none.
    pub timings: Timings,
}

/// Treatment of a file's images.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum ImageLoading {
    /// Images that visible surfaces use are decoded; no other is read.
    #[default]
    Decode,
    /// No image is decoded, but the headers of all are read.
    Headers,
}

/// Loads a `.gltf` or `.glb` file; its content decides which of the two it is.
///
/// Faults that leave something to draw do not stop it: they are in [`Model::warnings`]. A file
/// without anything to draw loads as well.
///
/// ```no_run
/// use model::{ImportOptions, load};
/// let model = load("chair.glb".as_ref(), &ImportOptions::default())?;
/// let primitives = model.meshes.iter().flat_map(|mesh| &mesh.primitives);
/// println!("{} triangles", primitives.map(|primitive| primitive.item_count()).sum::<usize>());
/// for warning in &model.warnings {
///     println!("{warning}");
/// }
/// # Ok::<(), model::ImportError>(())
/// ```
///
/// # Errors
/// The file, or one it refers to, cannot be read or is forbidden; is not glTF 2.0 or breaks its
/// rules; requires an unsupported extension; exceeds a limit; has no such scene or variant as the
/// options ask for.
pub fn load(path: &Path, options: &ImportOptions) -> Result<Model, ImportError> {
    let read = || uri_resolver::read_file(path, &options.limits, "");
    let loaded = options.timings.measure("read", read).and_then(|bytes| {
        let resolver = UriResolver::new(path, bytes.len(), options)?;
        import_gltf(path, &bytes, &resolver, options)
    });
    loaded.map_err(|diagnostic| ImportError {
        file: path.to_owned(),
        diagnostic: Box::new(diagnostic),
    })
}

/// Loads a model from a file in memory, as [`load`] does; `name` stands for its path in messages.
///
/// Without a [root](ImportOptions::root) the file must be self-contained: no other file is read.
/// With one, relative URIs are resolved against that folder.
///
/// # Errors
/// As for [`load`].
pub fn load_bytes(name: &str, bytes: &[u8], options: &ImportOptions) -> Result<Model, ImportError> {
    let path = Path::new(name);
    let loaded = UriResolver::in_memory(bytes.len(), options)
        .and_then(|resolver| import_gltf(path, bytes, &resolver, options));
    loaded.map_err(|diagnostic| ImportError {
        file: path.to_owned(),
        diagnostic: Box::new(diagnostic),
    })
}
