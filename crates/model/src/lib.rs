//! Models: files read into plain arrays, with every index checked and every default decided.
//!
//! [`load`] reads a file into a [`Model`]; [`import::check_file`] validates one, glTF as the
//! Khronos glTF validator does. A model is posed by [`Model::apply_animation`], and its vertices
//! are deformed by [`Model::skin_primitive`].

mod animation;
mod camera;
mod check;
mod colormap;
mod diagnostic;
pub mod import;
mod length_unit;
mod light;
mod material;
mod mesh;
mod model;
mod model_instance;
mod scene_graph;
mod skinning;
mod texture;
mod timings;
mod up_axis;
mod visible_text;

pub use animation::{
    Animation, AnimationChannel, AnimationCurve, AnimationTarget, Interpolation, NodeProperty,
    ObjectProperty,
};
pub use camera::{CameraProjection, ModelCamera};
pub use check::{CheckReport, check_bytes, check_file};
pub use colormap::Colormap;
pub use diagnostic::{Diagnostic, Severity, codes};
pub use import::{FileFormat, ImportError, ImportOptions, Limits, ScalarColors, load, load_bytes};
pub use length_unit::LengthUnit;
pub use light::{LightKind, PunctualLight};
pub use material::{
    AlphaMode, Anisotropy, Clearcoat, Emission, Iridescence, Material, MaterialExtensions,
    NormalTexture, OcclusionTexture, Sheen, Specular, SpecularGlossiness, TextureInfo, TextureSlot,
    Transmission, UvTransform, UvTransformPart, Volume,
};
pub use mesh::{
    EdgeList, EdgeVisibility, Mesh, MorphTarget, Primitive, PrimitiveEdges, Topology,
    VariantMaterial,
};
pub use model::Model;
pub use model_instance::{ModelInstance, model_names, world_points};
pub use scene_graph::{MeshInstance, Node, SceneRoots, Skin, Trs};
pub use skinning::SkinnedPrimitive;
pub use texture::{
    Image, ImageHeader, ImageInfo, MipmapMode, Sampler, Texture, TextureFilter, WrapMode,
};
pub use timings::Timings;
pub use up_axis::UpAxis;
pub use visible_text::{is_terminal_control, visible_path, visible_text};

/// Compiles and runs the examples of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
