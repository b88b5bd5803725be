//! Import: reads a file into a [`Model`](model::Model) without trusting any of its content.
//!
//! Files are untrusted input. Every index, length and size is checked before it is used, URIs may
//! refer only to files below one folder, and everything a file can declare has a [limit](Limits). A
//! [`Diagnostic`](model::Diagnostic) gives the location, the problem and the remedy.
//!
//! Problems in the geometry (positions, indices, the node hierarchy) are errors. Problems in the
//! appearance (materials, normals, images) are [warnings](model::Model::warnings), and the file is
//! drawn without the broken parts. With [`ImportOptions::lenient`] most errors also become
//! warnings, as long as something remains to load. The `gltf-check` crate lists every error instead
//! of stopping at the first.
//!
//! | problem | error by default | with `lenient` |
//! | --- | --- | --- |
//! | broken shape | yes | the primitive is skipped |
//! | missing buffer file | yes | anything that uses it is skipped |
//! | unknown required extension | yes | it is ignored |
//! | unknown format or version | yes | still an error |
//! | exceeded limit | yes | still an error |
//!
//! The `gltf-import` crate reads glTF and contains the safeguards. `stl`, `obj`, `ply` and
//! `threemf` read one format each; the other modules support them.

mod arrays;
mod corner_vertices;
mod file_format;
mod load;
mod obj;
mod ply;
mod polygons;
mod stl;
mod surfaces;
mod text;
mod threemf;

pub use arrays::{MeshArrays, MeshNode, load_arrays};
pub use file_format::FileFormat;
pub use load::{import_model, load, load_bytes, load_from_memory};
pub use obj::PhongMaterial;

// Parameter and result types of the functions in this crate.
pub use gltf_import::{
    ExtensionUse, ImageLoading, ImportError, ImportOptions, LessonModel, Limits, MemoryFolder,
    NameOrIndex, ScalarColors, UriResolver, decode_image, extension_use, percent_decode,
    percent_encode,
};

/// Compiles and runs the examples in the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
