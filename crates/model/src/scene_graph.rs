//! The scene graph: nodes with transforms, the scenes that list their roots, and skins.

mod contents;
mod mesh_instance;
mod trs;

pub use mesh_instance::MeshInstance;
pub use trs::Trs;

use homog::{Affine, Model as ModelSpace};

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
