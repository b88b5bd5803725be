//! The scene language: RON scene files as Rust types, with every mistake found and located.
//!
//! ```
//! let text = "Scene(models: [(path: \"duck.glb\")], style: Flat)";
//! let scene = scene_file::parse_scene("scene.ron", text)?;
//! assert_eq!(scene.models[0].path, "duck.glb");
//! # Ok::<(), scene_file::SceneErrors>(())
//! ```
//!
//! | module | subject |
//! | --- | --- |
//! | [`mod@file`] | the contents of a scene file, as types that can be read and written |
//! | [`options`] | enumerations of other crates, by their names in scene files and flags |
//! | [`mod@reference`] | the declarations of all types: names, documentation, defaults |
//! | `scene_source`, `include` | the text of a scene and of the files it includes |
//! | `parse`, `schema`, `syntax` | the reader: tokens, tree, declarations, mistakes |
//! | `vocabulary`, `suggest` | the meaning of misspelled words and of words from other programs |
//! | `format` | one layout for all scene files |
//! | `error` | a mistake with its line and a caret |
//!
//! No model is loaded and no image is decoded here; the crate `scene` does both.

mod color;
mod error;
pub mod file;
mod format;
mod include;
mod include_map;
mod mistake;
#[cfg(test)]
mod mistakes;
mod number;
pub mod options;
mod parse;
mod pass;
pub mod reference;
mod ron_options;
mod ron_text;
mod scene_source;
mod schema;
mod source_text;
mod suggest;
mod syntax;
mod vocabulary;

pub use color::color_names;
pub use error::{SceneError, SceneErrors};
pub use file::SceneFile;
pub use format::format_source;
pub use include::FileMistake;
pub use parse::parse_scene;
pub use pass::{Pass, PassEncoding};
pub use ron_options::scene_ron_options;
pub use scene_source::{SceneSource, UnreadableScene, is_scene_file};
pub use source_text::SourceText;
pub use suggest::{closest_name, suggest_name};
pub use syntax::PathStep;

/// The examples of the README, compiled as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
