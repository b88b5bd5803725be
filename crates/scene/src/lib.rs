//! Resolution of scene files: loads models, converts angles to radians, and fills in defaults.
//!
//! ```text
//!  text ─► SceneFile ─► Scene ─► renderer, line drawings
//!     scene_file    resolve
//!               mistakes with carets ◄── validate
//! ```
//! A scene is described in a file ([`SceneFile`], RON) and resolved ([`Scene`]); every mistake is
//! an error that points into the file. The crate [`scene_file`] defines the language.
//!
//! | module | subject |
//! | --- | --- |
//! | `scene` | [`Scene`]: models, camera, lights, style, image |
//! | `origin`, `read_scene` | the source of a scene and its models; all mistakes in one report |
//! | `resolve`, `single_view`, `insets` | the order of resolution; viewports, stereo |
//! | `diagnostics` | mistakes, collected while a scene is resolved |
//! | `model_files`, `instances`, `material_overrides` | models: loaded, posed, placed, recolored |
//! | `view_projection`, `lens`, `classical`, `camera_path` | cameras and projections |
//! | `lights`, `shadows`, `surrounding_light`, `exposure`, `ground` | light |
//! | `style`, `section`, `overlays`, `caption` | the content and style of the drawing |
//! | `sheet`, `sheet_views`, `dimensions`, `assembly` | drawing sheets |
//! | `lints` | valid scenes that probably do not show what was intended |
//! | `builder` | scenes built from in-memory models |
//! | `referenced_files` | the files that a model refers to, found by a quick scan |

#[cfg(feature = "sheets")]
mod assembly;
mod backdrop;
mod builder;
mod calibrated_lens;
mod camera_fields;
mod camera_path;
mod camera_placement;
mod camera_resolver;
mod caption;
mod classical;
mod depth_span;
mod diagnostics;
#[cfg(feature = "sheets")]
mod dimensions;
mod exposure;
mod file_access;
mod ground;
mod insets;
mod instances;
mod lens;
mod lights;
mod lints;
mod material_overrides;
mod model_files;
mod named_nodes;
mod origin;
mod outputs;
mod overlays;
mod read_scene;
mod referenced_files;
mod resolve;
mod resolve_error;
mod resolve_options;
mod scene;
mod section;
mod shadows;
mod shared_scale;
#[cfg(feature = "sheets")]
mod sheet;
#[cfg(feature = "sheets")]
mod sheet_errors;
#[cfg(feature = "sheets")]
mod sheet_scale;
#[cfg(feature = "sheets")]
mod sheet_views;
mod single_view;
mod style;
mod surrounding_light;
mod uncut;
mod view_projection;

pub use self::scene::{ImageSpec, MAX_IMAGE_SIDE, Scene, Style};
#[cfg(feature = "sheets")]
pub use self::sheet::{SheetContent, resolve_sheet};
pub use builder::SceneBuilder;
pub use camera_path::CameraPath;
pub use depth_span::DepthSpan;
pub use file_access::FileAccess;
pub use ground::{Ground, OcclusionArea};
pub use insets::Inset;
pub use lights::fixed_key_light;
pub use lints::{Lint, lint_description, lint_scene};
pub use model_files::{name_or_index, select_animation};
pub use origin::Origin;
pub use outputs::Outputs;
pub use referenced_files::referenced_files;
pub use resolve::validate_scene;
pub use resolve_error::ResolveError;
pub use resolve_options::ResolveOptions;
#[cfg(feature = "sheets")]
pub use sheet_views::sheet_view_error;

/// The parts of the scene language that embedders need to read or build a scene file.
pub use scene_file::{
    SceneError, SceneErrors, SceneFile, SceneSource, SourceText, UnreadableScene, file,
    format_source, options, parse_scene, reference, scene_ron_options,
};

/// The examples of the README, compiled as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
