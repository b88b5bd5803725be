//! The glTF 2.0 reader, and the safeguards shared by all file readers: limits, a memory budget, a
//! sandbox for referenced files, and image decoders that cannot crash the program.
//!
//! ```text
//!  bytes ──container──► JSON ──document──► Root ──model_builder──► Model
//!                       binary chunk ─┐             │
//!  other files ──uri_resolver──► buffers ─┴─► accessor, elements, images
//! ```
//!
//! Files are untrusted input: every index, length and size is checked before it is used. The
//! `import` crate reads the other formats with the same safeguards, and loads files in any format.
//!
//! | module | contents |
//! | --- | --- |
//! | `gltf` | containers, accessors, compressed meshes, materials, animations, extensions |
//! | `options`, `limits`, `memory_budget` | loading options, and limits on a file |
//! | `uri_resolver`, `memory_folder` | files that a URI may refer to |
//! | `image_decoder`, `parallel_decoding` | PNG, JPEG, WebP, KTX2 |
//! | `warnings`, `error` | skipped data, and the error that stops loading |
//! | `scalars`, `normals`, `srgb` | vertex attributes |

mod error;
mod gltf;
mod image_decoder;
mod limits;
mod memory_budget;
mod memory_folder;
mod name_or_index;
mod normals;
mod options;
mod parallel_decoding;
mod percent_encoding;
mod scalars;
mod srgb;
mod texture_images;
mod uri_resolver;
mod warnings;

pub use self::gltf::{
    CompressedView, ExtensionUse, check_json_limits, check_scene_items, extension_use, import_gltf,
};
pub use error::ImportError;
pub use image_decoder::{decode_bounded as decode_image, image_size, is_decoded};
pub use limits::Limits;
pub use memory_budget::MemoryBudget;
pub use memory_folder::MemoryFolder;
pub use name_or_index::NameOrIndex;
pub use normals::{NormalRepairs, normalize_normals};
pub use options::{ImageLoading, ImportOptions, LessonModel};
pub use percent_encoding::{percent_decode, percent_encode};
pub use scalars::ScalarColors;
pub use srgb::{linear_from_srgb, linear_table};
pub use texture_images::{TextureImage, store_images};
pub use uri_resolver::{UriResolver, check_file_size, missing_file, read_file};
pub use warnings::ImportWarnings;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
