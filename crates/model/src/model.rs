//! The model: everything that was read from one file.

use crate::{
    Animation, Diagnostic, Image, ImageInfo, Material, Mesh, ModelCamera, Node, PunctualLight,
    SceneRoots, Skin, Texture, UvTransform,
};

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
    /// decoded) and for broken ones (a warning says so).
    pub images: Vec<Option<Image>>,
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
    pub warnings: Vec<Diagnostic>,
}
