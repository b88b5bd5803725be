//! A model as the pipeline wants it: plain arrays, every index checked, every default decided.
//!
//! The importer makes it and promises what the fields say; nobody after the importer looks at a glTF file again.
//! Positions stay in the mesh's own coordinates; the node tree places them.

mod animation;
mod animation_curve;
mod camera;
mod edge_visibility;
mod image;
pub mod import;
mod light;
mod material;
mod material_extensions;
mod mesh;
mod mesh_instance;
mod model_instance;
mod object_model;
mod pose;
mod scene_contents;
mod skinning;
mod tangents;
mod texture_slot;
mod timings;
mod trs;
mod uv_transform;

pub use animation::{Animation, AnimationChannel, AnimationTarget, NodeProperty};
pub use animation_curve::{AnimationCurve, Interpolation};
pub use camera::{CameraProjection, ModelCamera};
pub use edge_visibility::{EdgeList, EdgeVisibility, PrimitiveEdges};
pub use image::{
    Image, ImageHeader, ImageInfo, MipmapMode, Sampler, Texture, TextureFilter, WrapMode,
};
pub use import::{ImportError, ImportOptions, Limits, load, load_bytes};
pub use light::{LightKind, PunctualLight};
pub use material::{AlphaMode, Emission, Material, NormalTexture, OcclusionTexture, TextureInfo};
pub use material_extensions::{
    Anisotropy, Clearcoat, Iridescence, MaterialExtensions, Sheen, Specular, SpecularGlossiness,
    Transmission, Volume,
};
pub use mesh::{Mesh, MorphTarget, Primitive, Topology, VariantMaterial};
pub use mesh_instance::MeshInstance;
pub use model_instance::{ModelInstance, model_names, world_points};
pub use object_model::ObjectProperty;
pub(crate) use object_model::{LIGHT_PROPERTIES, MATERIAL_PROPERTIES, PropertyRow};
pub use skinning::SkinnedPrimitive;
pub use texture_slot::TextureSlot;
pub use timings::Timings;
pub use trs::Trs;
pub use uv_transform::{UvTransform, UvTransformPart};

use homog::{Affine, Model as ModelSpace};
use std::sync::Arc;

/// Everything that was read from one glTF file.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// The file's name without folder and ending, for messages.
    pub name: String,
    /// The meshes, as numbered in the file.
    pub meshes: Vec<Mesh>,
    /// The materials, as numbered in the file.
    pub materials: Vec<Material>,
    /// The textures, as numbered in the file.
    pub textures: Vec<Texture>,
    /// The images, as numbered in the file; `None` for those that no visible primitive uses (they are not
    /// decoded) and for broken ones (a warning says so). They are shared: a clone of a model that is
    /// posed differently has the same images.
    pub images: Arc<[Option<Image>]>,
    /// The nodes, as numbered in the file. They form a forest: the importer has refused cycles.
    pub nodes: Vec<Node>,
    /// The root nodes of the scene that is shown.
    pub roots: Vec<usize>,
    /// The scenes, as numbered in the file.
    pub scenes: Vec<SceneRoots>,
    /// The scene that is shown: the one that was asked for, else the file's default scene, else its first. `None` if the file
    /// has no scenes; all roots are shown then.
    pub active_scene: Option<usize>,
    /// The skins, as numbered in the file; one that cannot be used has no joints, and no node names it.
    pub skins: Vec<Skin>,
    /// The cameras, as numbered in the file; one whose numbers make no view has a usual lens instead, and no node
    /// names it.
    pub cameras: Vec<ModelCamera>,
    /// The lights, as numbered in the file (KHR_lights_punctual).
    pub lights: Vec<PunctualLight>,
    /// The animations, as numbered in the file; channels that cannot be used are left out.
    pub animations: Vec<Animation>,
    /// The transforms of textures that animations change.
    pub uv_transforms: Vec<UvTransform>,
    /// The names of the variants (KHR_materials_variants).
    pub variants: Vec<String>,
    /// The variant that is shown; `None` for the materials that primitives have without.
    pub active_variant: Option<usize>,
    /// The extensions the file uses, sorted by name.
    pub extensions_used: Vec<String>,
    /// Those it requires, sorted by name.
    pub extensions_required: Vec<String>,
    /// What the file says of its images, as numbered in it.
    pub image_infos: Vec<ImageInfo>,
    /// Soft faults: what was wrong or left out, and where.
    pub warnings: Vec<Warning>,
}

/// A node of the tree: a place for a mesh or a camera, and for other nodes.
#[derive(Clone, Debug)]
pub struct Node {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// The node's transform: from its own coordinates to its parent's (the model's, for a root).
    pub to_parent: Affine<ModelSpace, ModelSpace>,
    /// The parts of that transform, which animations change; `None` if the file gives it as a matrix.
    pub trs: Option<Trs>,
    /// From the node's own coordinates to the model's: the product of the transforms from here up, all of them finite.
    pub to_model: Affine<ModelSpace, ModelSpace>,
    /// The node above it; `None` for a root.
    pub parent: Option<usize>,
    /// The nodes below it.
    pub children: Vec<usize>,
    /// The mesh that is shown here.
    pub mesh: Option<usize>,
    /// Where the mesh is shown, in the node's own coordinates, if not once and just here.
    pub instance_transforms: Option<Vec<Affine<ModelSpace, ModelSpace>>>,
    /// How much of each morph target of the mesh is shown here, if not as much as the mesh says.
    pub morph_weights: Option<Vec<f32>>,
    /// The skin that bends the mesh.
    pub skin: Option<usize>,
    /// The camera that looks from here along −z with y up.
    pub camera: Option<usize>,
    /// The light that shines from here, or along −z.
    pub light: Option<usize>,
}

impl Default for Node {
    /// A root without content that stands where the model does.
    fn default() -> Self {
        Self {
            name: None,
            to_parent: Affine::IDENTITY,
            trs: Some(Trs::default()),
            to_model: Affine::IDENTITY,
            parent: None,
            children: Vec::new(),
            mesh: None,
            instance_transforms: None,
            morph_weights: None,
            skin: None,
            camera: None,
            light: None,
        }
    }
}

/// A scene of the file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SceneRoots {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// Its root nodes as the file lists them; an entry may name no node of the model unless the scene is shown.
    pub nodes: Vec<usize>,
}

/// The joints that bend a mesh.
#[derive(Clone, Debug)]
pub struct Skin {
    /// The nodes that are joints; a vertex's joint numbers point into this list.
    pub joints: Vec<usize>,
    /// For each joint, the map from the mesh's coordinates to the joint's in the pose the mesh was made in.
    pub inverse_bind_matrices: Vec<Affine<ModelSpace, ModelSpace>>,
}

/// A soft fault of a file: the model is shown all the same.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Warning {
    /// Where, as a JSON pointer (RFC 6901) such as `/meshes/3/primitives/0/attributes/NORMAL`.
    pub pointer: String,
    /// What is wrong and what was done about it.
    pub message: String,
}
