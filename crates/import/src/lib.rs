//! Import: reads a file into a [`Model`](model::Model) without trusting anything in it.
//!
//! Files are untrusted input. Every index, length and size is checked before it is used, URIs refer
//! to files below one folder only, and everything a file can declare has a [limit](Limits). A
//! [`Diagnostic`](model::Diagnostic) says where the file is wrong, what is wrong and what to do.
//!
//! Faults in the geometry (positions, indices, the node hierarchy) are errors; faults in the
//! appearance (materials, normals, images) are [warnings](model::Model::warnings), and the file is drawn
//! without what is broken. With [`ImportOptions::lenient`] most errors become warnings too, as long
//! as something is left to load. The crate `gltf-check` lists everything that is wrong instead of
//! stopping at the first error.
//!
//! | option | error by default | with `lenient` |
//! | --- | --- | --- |
//! | broken shape | yes | the primitive is left out |
//! | missing buffer file | yes | what uses it is left out |
//! | unknown required extension | yes | it is ignored |
//! | unknown format, other version | yes | yes |
//! | exceeded limit | yes | yes |
//!
//! The modules here serve every format; `gltf`, `stl`, `obj`, `ply` and `threemf` read one each.

mod arrays;
mod corner_vertices;
mod error;
mod file_format;
mod gltf;
mod image_decoder;
mod limits;
mod load;
mod memory_budget;
mod memory_folder;
mod name_or_index;
mod normals;
mod obj;
mod parallel_decoding;
mod percent_encoding;
mod ply;
mod polygons;
mod scalars;
mod srgb;
mod stl;
mod surfaces;
mod text;
mod texture_images;
mod threemf;
mod uri_resolver;
mod warnings;

pub use self::gltf::{CompressedView, ExtensionUse, check_json_limits, extension_use};
pub use arrays::{MeshArrays, MeshNode, load_arrays};
pub use error::ImportError;
pub use file_format::FileFormat;
pub use image_decoder::{decode_bounded as decode_image, image_size, is_decoded};
pub use limits::Limits;
pub use load::{ImageLoading, ImportOptions, import_model, load, load_bytes, load_from_memory};
pub use memory_budget::MemoryBudget;
pub use memory_folder::MemoryFolder;
pub use name_or_index::NameOrIndex;
pub use obj::PhongMaterial;
pub use percent_encoding::{percent_decode, percent_encode};
pub use scalars::ScalarColors;
pub use uri_resolver::{UriResolver, read_file};

/// Compiles and runs the examples of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
