//! Models as plain arrays, with every index checked and every default applied.
//!
//! A [`Model`] is read from a file by the `import` crate, or built by a program.
//! [`Model::apply_animation`] poses it, and [`Model::skin_primitive`] deforms its vertices. Nothing
//! here reads a file or decodes an image.
//!
//! | module | contents |
//! | --- | --- |
//! | `model`, `scene_graph`, `mesh` | meshes, their primitives and the nodes that show them |
//! | `material`, `texture`, `light`, `camera` | surfaces, lights and cameras |
//! | `animation`, `skinning` | keyframes, morph targets, skins |
//! | `animation::object_model` | properties that animations may change, by JSON pointer |
//! | `model_instance` | models placed in a world |
//! | `diagnostic` | errors and warnings about a location in a file |

mod animation;
mod camera;
mod colormap;
mod diagnostic;
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

pub use animation::{
    Animation, AnimationChannel, AnimationCurve, AnimationTarget, Interpolation, NodeProperty,
    ObjectProperty, object_model,
};
pub use camera::{CameraProjection, ModelCamera};
pub use colormap::Colormap;
pub use diagnostic::{Diagnostic, Severity, codes};
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
pub use model_instance::{FirstIds, ModelInstance, model_names, world_points};
pub use scene_graph::{MeshInstance, Node, SceneRoots, Skin, Trs};
pub use skinning::SkinnedPrimitive;
pub use texture::{
    Image, ImageHeader, ImageInfo, MipmapMode, Sampler, Texture, TextureFilter, WrapMode,
};
pub use timings::Timings;
pub use up_axis::UpAxis;

/// Compiles and runs the examples in the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
