//! A model as the pipeline wants it: plain arrays, every index checked, every default decided.
//!
//! The importer makes it and promises what the fields say; nobody after the importer looks at a glTF file again.
//! Positions stay in the mesh's own coordinates; the node tree places them.

mod animation;
mod image;
mod instance;
mod material;
mod mesh;
mod parts;
mod posed;
mod shown;

pub use animation::{Animation, Channel, Curve, Interpolation, Property};
pub use image::{Filter, Image, Mipmap, Sampler, Texture, Wrap};
pub use instance::Instance;
pub use material::{AlphaMode, Material, TextureUse};
pub use mesh::{Mesh, MorphTarget, Primitive, Topology};
pub use parts::Parts;
pub use posed::Posed;

use homog::{Affine, Model as ModelSpace};

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
    /// The root nodes of the scene that is shown: the file's default scene, else its first, else all roots.
    pub roots: Vec<usize>,
    /// The skins, as numbered in the file; one that cannot be used has no joints, and no node names it.
    pub skins: Vec<Skin>,
    /// The cameras, as numbered in the file; one whose numbers make no view has a usual lens instead, and no node
    /// names it.
    pub cameras: Vec<Lens>,
    /// The animations, as numbered in the file; channels that cannot be used are left out.
    pub animations: Vec<Animation>,
    /// The extensions the file uses, sorted by name.
    pub extensions_used: Vec<String>,
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
    pub parts: Option<Parts>,
    /// From the node's own coordinates to the model's: the product of the transforms from here up, all of them finite.
    pub to_model: Affine<ModelSpace, ModelSpace>,
    /// The node above it; `None` for a root.
    pub parent: Option<usize>,
    /// The nodes below it.
    pub children: Vec<usize>,
    /// The mesh that is shown here.
    pub mesh: Option<usize>,
    /// Where the mesh is shown, in the node's own coordinates, if not once and just here.
    pub places: Option<Vec<Affine<ModelSpace, ModelSpace>>>,
    /// How much of each morph target of the mesh is shown here, if not as much as the mesh says.
    pub weights: Option<Vec<f32>>,
    /// The skin that bends the mesh.
    pub skin: Option<usize>,
    /// The camera that looks from here along −z with y up.
    pub camera: Option<usize>,
}

/// The joints that bend a mesh.
#[derive(Clone, Debug)]
pub struct Skin {
    /// The nodes that are joints; a vertex's joint numbers point into this list.
    pub joints: Vec<usize>,
    /// For each joint, the map from the mesh's coordinates to the joint's in the pose the mesh was made in.
    pub inverse_bind: Vec<Affine<ModelSpace, ModelSpace>>,
}

/// A camera of the file: its projection only, the node that carries it gives the view.
#[derive(Clone, Debug)]
pub struct Lens {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// What kind of projection, with its parameters, already checked for sense.
    pub kind: LensKind,
}

/// The two kinds of camera that glTF has.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum LensKind {
    /// Perspective projection.
    Perspective {
        /// The vertical opening angle in radians, in (0, π).
        fov_y: f64,
        /// Width over height, if the file fixes it.
        aspect: Option<f64>,
        /// The distance of the near plane, > 0.
        near: f64,
        /// The distance of the far plane, > near; infinite if the file gives none.
        far: f64,
    },
    /// Orthographic projection.
    Orthographic {
        /// Half the width of the view volume, > 0.
        half_width: f64,
        /// Half the height of the view volume, > 0.
        half_height: f64,
        /// The distance of the near plane, ≥ 0.
        near: f64,
        /// The distance of the far plane, > near.
        far: f64,
    },
}

/// A soft fault of a file: the model is shown all the same.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Warning {
    /// Where, as a JSON pointer (RFC 6901) such as `/meshes/3/primitives/0/attributes/NORMAL`.
    pub pointer: String,
    /// What is wrong and what was done about it.
    pub message: String,
}
