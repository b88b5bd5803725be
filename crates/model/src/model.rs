//! The model: everything that was read from one file, as plain arrays with every index checked and
//! every default decided.
//!
//! Positions stay in the coordinates of their mesh; the [scene graph](Node) says where each mesh
//! is. Nothing after the importer looks at the file again.

use crate::{
    Animation, Diagnostic, Image, ImageInfo, LengthUnit, Material, Mesh, ModelCamera, Node,
    Primitive, PunctualLight, SceneRoots, Skin, Texture, UpAxis, UvTransform,
};

/// One file's meshes, materials, textures, scene graph and animations.
///
/// Vectors are indexed as in the file: material 3 of a glTF file is `materials[3]`. Indices that
/// other fields hold are in range, so that no later stage needs to check them.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// The file's name without folder and extension, for messages.
    pub name: String,
    /// Unit of all lengths: what the file declares, or the convention of its format, or
    /// what the options of the reader say. Coordinates stay as they are.
    pub length_unit: LengthUnit,
    /// The axis that points up in the coordinates of the file. If that is not y, the root nodes
    /// have been rotated, so that y points up in model space.
    pub up_axis: UpAxis,
    /// Meshes, indexed as in the file.
    pub meshes: Vec<Mesh>,
    /// Materials, indexed as in the file.
    pub materials: Vec<Material>,
    /// Textures, indexed as in the file.
    pub textures: Vec<Texture>,
    /// Decoded images, indexed as in the file; `None` for those that no visible primitive uses
    /// (they are not decoded) and for broken ones (a warning says so).
    ///
    /// Shared: a clone of a model that is posed differently has the same images.
    pub images: std::sync::Arc<[Option<Image>]>,
    /// Nodes of the scene graph, indexed as in the file. They form a forest: the importer refuses
    /// cycles.
    pub nodes: Vec<Node>,
    /// Root nodes of the active scene, in the order of the file.
    pub roots: Vec<usize>,
    /// All scenes of the file.
    pub scenes: Vec<SceneRoots>,
    /// The active scene: the requested one, else the file's default scene, else its first. `None`
    /// if the file has no scenes; all root nodes are visible then.
    pub active_scene: Option<usize>,
    /// Skins, indexed as in the file; an invalid one has no joints, and no node refers to it.
    pub skins: Vec<Skin>,
    /// Cameras, indexed as in the file; one with invalid parameters has a default projection
    /// instead, and no node refers to it.
    pub cameras: Vec<ModelCamera>,
    /// Punctual lights, indexed as in the file (KHR_lights_punctual).
    pub lights: Vec<PunctualLight>,
    /// Animations, indexed as in the file, without the channels that are invalid.
    pub animations: Vec<Animation>,
    /// Texture transforms that animations change (KHR_texture_transform, KHR_animation_pointer).
    pub uv_transforms: Vec<UvTransform>,
    /// Names of the material variants (KHR_materials_variants).
    pub variants: Vec<String>,
    /// The active material variant; `None` for the materials that primitives have without variants.
    pub active_variant: Option<usize>,
    /// Names of the scalar attributes of vertices that colors can show
    /// (`scalars` of the options of `import`): `_TEMPERATURE` in glTF, `quality`
    /// in PLY.
    pub scalar_attributes: Vec<String>,
    /// The scalar attribute that the colors of the vertices show; `None` for the colors of the file.
    pub active_scalar_attribute: Option<usize>,
    /// Names of the extensions the file uses, sorted.
    pub extensions_used: Vec<String>,
    /// Names of the extensions the file requires, sorted.
    pub extensions_required: Vec<String>,
    /// Name, URI and header of every image of the file, decoded or not.
    pub image_infos: Vec<ImageInfo>,
    /// Warnings of the importer: everything that was left out, replaced or corrected, and where.
    pub warnings: Vec<Diagnostic>,
}

impl Model {
    /// The bytes of the arrays of all meshes and of the decoded images.
    #[must_use]
    pub fn array_bytes(&self) -> u64 {
        let meshes =
            self.meshes.iter().flat_map(|mesh| &mesh.primitives).map(Primitive::array_bytes);
        let images = self.images.iter().flatten().map(|image| size_of_val(&*image.rgba));
        meshes.chain(images).map(|bytes| bytes as u64).sum()
    }
}
