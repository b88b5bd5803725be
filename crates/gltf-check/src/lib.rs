//! Validates glTF files and reports every violation of the specification, not only the first fatal
//! error. For other formats, it reports the loader's diagnostics.
//!
//! Loading stops at the first error that prevents drawing. Validation continues: it compares the
//! JSON with the schema, resolves every reference and reads every accessor element. Finally, it
//! loads the file, so that the report includes the loader's diagnostics.
//!
//! ```text
//!  bytes ─glb─► JSON ─schema_walk, with the tables in schema─► references
//!        ─nodes, meshes, skins, animations─► rules for elements ─data─► diagnostics
//!  loader ─load_outcome─► diagnostics
//! ```
//!
//! Validation works on the raw JSON, in which members may be missing or have any type. The rules
//! follow glTF 2.0, with the codes and severities of the Khronos glTF validator. The
//! [limits](import::Limits) apply as they do for loading: time and memory are bounded by the size
//! of the files, not by the sizes they declare.

mod accessors;
mod animations;
mod check;
mod codes;
mod data;
mod diagnostics;
mod document;
mod document_rules;
mod elements;
mod formats;
mod glb;
mod images;
mod layout;
mod load_outcome;
mod materials;
mod meshes;
mod nodes;
mod report;
mod schema;
mod schema_walk;
mod skins;
mod store;
mod uris;
mod usage;

pub use check::{check_bytes, check_file};
pub use report::CheckReport;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
