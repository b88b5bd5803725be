//! The model: everything that was read from one file, as plain arrays with every index checked and
//! every default applied.
//!
//! Positions stay in the coordinates of their mesh; the [scene graph](Node) places the meshes.
//! Nothing after the importer reads the file again.

use crate::{
    Animation, Diagnostic, Image, ImageInfo, LengthUnit, Material, Mesh, ModelCamera, Node,
    Primitive, PunctualLight, SceneRoots, Skin, Texture, UpAxis, UvTransform,
};

/// The meshes, materials, textures, scene graph and animations of one file.
///
/// Vectors are indexed as in the file: material 3 of a glTF file is `materials[3]`. Indices in
/// other fields are in range, so that no later stage needs to check them.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// The file's name without folder and extension, for messages.
    pub name: String,
    /// Unit of all lengths: declared in the file, given by the convention of its format, or set in
    /// the reader's options. Coordinates stay as they are.
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
    /// Decoded images, indexed as in the file. `None` for images that no visible primitive uses,
    /// which are not decoded, and for broken ones, which cause a warning.
    ///
    /// Shared: a clone of a model that is posed differently has the same images.
    pub images: std::sync::Arc<[Option<Image>]>,
    /// Nodes of the scene graph, indexed as in the file. They form a forest: the importer rejects
    /// cycles.
    pub nodes: Vec<Node>,
    /// Root nodes of the active scene, in the order of the file.
    pub roots: Vec<usize>,
    /// All scenes of the file.
    pub scenes: Vec<SceneRoots>,
    /// The active scene: the requested one, otherwise the file's default scene, otherwise its
    /// first. `None` if the file has no scenes; all root nodes are then visible.
    pub active_scene: Option<usize>,
    /// Skins, indexed as in the file; an invalid one has no joints, and no node refers to it.
    pub skins: Vec<Skin>,
    /// Cameras, indexed as in the file; one with invalid parameters has a default projection
    /// instead, and no node refers to it.
    pub cameras: Vec<ModelCamera>,
    /// Punctual lights, indexed as in the file (KHR_lights_punctual).
    pub lights: Vec<PunctualLight>,
    /// Animations, indexed as in the file, without invalid channels.
    pub animations: Vec<Animation>,
    /// Texture transforms that animations change (KHR_texture_transform, KHR_animation_pointer).
    pub uv_transforms: Vec<UvTransform>,
    /// Names of the material variants (KHR_materials_variants).
    pub variants: Vec<String>,
    /// The active material variant; `None` for the default materials of the primitives.
    pub active_variant: Option<usize>,
    /// Names of the scalar attributes of vertices that colors can show
    /// (`scalars` of the options of `import`): `_TEMPERATURE` in glTF, `quality`
    /// in PLY.
    pub scalar_attributes: Vec<String>,
    /// The scalar attribute shown as vertex colors; `None` for the colors of the file.
    pub active_scalar_attribute: Option<usize>,
    /// Names of the extensions the file uses, sorted.
    pub extensions_used: Vec<String>,
    /// Names of the extensions the file requires, sorted.
    pub extensions_required: Vec<String>,
    /// Name, URI and header of every image of the file, decoded or not.
    pub image_infos: Vec<ImageInfo>,
    /// Warnings of the importer: everything that was skipped, replaced or corrected, with its
    /// location.
    pub warnings: Vec<Diagnostic>,
}

impl Model {
    /// Returns the bytes of the arrays of all meshes and of the decoded images.
    #[must_use]
    pub fn array_bytes(&self) -> u64 {
        let meshes =
            self.meshes.iter().flat_map(|mesh| &mesh.primitives).map(Primitive::array_bytes);
        let images = self.images.iter().flatten().map(|image| size_of_val(&*image.rgba));
        meshes.chain(images).map(|bytes| bytes as u64).sum()
    }
}
