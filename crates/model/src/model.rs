//! The model: the content of one file as plain arrays, with every index checked and every default
//! applied.
//!
//! Positions are in mesh coordinates; the [scene graph](Node) places the meshes. Nothing reads the
//! file again after the import.

use crate::{
    Animation, Diagnostic, Image, ImageInfo, LengthUnit, Material, Mesh, ModelCamera, Node,
    Primitive, PunctualLight, SceneRoots, Skin, Texture, UpAxis, UvTransform,
};

/// The meshes, materials, textures, scene graph and animations of one file.
///
/// Vectors are indexed as in the file: material 3 of a glTF file is `materials[3]`. Indices in
/// other fields are in range, so later stages do not need to check them.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// The file name without folder and extension, for messages.
    pub name: String,
    /// Unit of all lengths, from the file, from the convention of its format, or from the options.
    /// Coordinates are not converted.
    pub length_unit: LengthUnit,
    /// The axis that points up in the file's coordinates. If that is not y, the root nodes have
    /// been rotated so that y points up in model space.
    pub up_axis: UpAxis,
    /// Meshes, indexed as in the file.
    pub meshes: Vec<Mesh>,
    /// Materials, indexed as in the file.
    pub materials: Vec<Material>,
    /// Textures, indexed as in the file.
    pub textures: Vec<Texture>,
    /// Decoded images, indexed as in the file. `None` for images that no visible primitive uses,
    /// which are not decoded, and for broken images, which cause a warning.
    ///
    /// Images are shared between clones of a model, which may be posed differently.
    pub images: std::sync::Arc<[Option<Image>]>,
    /// Nodes of the scene graph, indexed as in the file. They form a forest, because the importer
    /// rejects cycles.
    pub nodes: Vec<Node>,
    /// Root nodes of the active scene, in file order.
    pub roots: Vec<usize>,
    /// All scenes of the file.
    pub scenes: Vec<SceneRoots>,
    /// The active scene: the requested scene, else the file's default scene, else its first scene.
    /// `None` if the file has no scenes; all root nodes are then visible.
    pub active_scene: Option<usize>,
    /// Skins, indexed as in the file. An invalid skin has no joints, and no node refers to it.
    pub skins: Vec<Skin>,
    /// Cameras, indexed as in the file. A camera with invalid parameters has a default projection,
    /// and no node refers to it.
    pub cameras: Vec<ModelCamera>,
    /// Punctual lights, indexed as in the file (KHR_lights_punctual).
    pub lights: Vec<PunctualLight>,
    /// Animations, indexed as in the file, without invalid channels.
    pub animations: Vec<Animation>,
    /// Texture transforms that animations change (KHR_texture_transform, KHR_animation_pointer).
    pub uv_transforms: Vec<UvTransform>,
    /// Names of the material variants (KHR_materials_variants).
    pub variants: Vec<String>,
    /// The active material variant, or `None` for the default materials of the primitives.
    pub active_variant: Option<usize>,
    /// Names of the scalar vertex attributes that can be shown as colors (`scalars` in the `import`
    /// options), such as `_TEMPERATURE` in glTF or `quality` in PLY.
    pub scalar_attributes: Vec<String>,
    /// The scalar attribute shown as vertex colors, or `None` for the colors in the file.
    pub active_scalar_attribute: Option<usize>,
    /// The extensions that the file uses, sorted by name.
    pub extensions_used: Vec<String>,
    /// The extensions that the file requires, sorted by name.
    pub extensions_required: Vec<String>,
    /// Name, URI and header of every image in the file, decoded or not.
    pub image_infos: Vec<ImageInfo>,
    /// The importer's warnings about everything that was skipped, replaced or corrected, with
    /// locations.
    pub warnings: Vec<Diagnostic>,
}

impl Model {
    /// Returns the size of all mesh arrays and decoded images in bytes.
    #[must_use]
    pub fn array_bytes(&self) -> u64 {
        let meshes =
            self.meshes.iter().flat_map(|mesh| &mesh.primitives).map(Primitive::array_bytes);
        let images = self.images.iter().flatten().map(|image| size_of_val(&*image.rgba));
        meshes.chain(images).map(|bytes| bytes as u64).sum()
    }
}
