//! The scene graph: a forest of nodes that carry meshes, skins, cameras and lights.
//!
//! Terms and structure follow glTF 2.0 §3.5: a scene lists root nodes, and a node has a local
//! transform and children. Its contents are drawn with the product of the transforms from the root
//! down to it.

mod contents;
mod mesh_instance;
mod trs;

pub use mesh_instance::MeshInstance;
pub use trs::Trs;

use homog::{Affine, Model as ModelSpace};

/// A node of the scene graph: a transform relative to its parent, and the attached objects.
#[derive(Clone, Debug)]
pub struct Node {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// Local transform: from the node's coordinates to its parent's (the model's, for a root).
    pub to_parent: Affine<ModelSpace, ModelSpace>,
    /// The local transform as translation, rotation and scale, which animations change; `None` if
    /// the file gives it as a matrix.
    pub trs: Option<Trs>,
    /// Global transform: from the node's coordinates to the model's, the product of the local
    /// transforms from the root down to this node. All components are finite.
    pub to_model: Affine<ModelSpace, ModelSpace>,
    /// The parent node; `None` for a root.
    pub parent: Option<usize>,
    /// The child nodes.
    pub children: Vec<usize>,
    /// The attached mesh.
    pub mesh: Option<usize>,
    /// Transforms of the instances of the mesh relative to the node (EXT_mesh_gpu_instancing);
    /// `None` if the mesh is drawn once, at the node itself.
    pub instance_transforms: Option<Vec<Affine<ModelSpace, ModelSpace>>>,
    /// Weights of the mesh's morph targets at this node; `None` for the mesh's default weights.
    pub morph_weights: Option<Vec<f32>>,
    /// The skin that deforms the mesh.
    pub skin: Option<usize>,
    /// The attached camera; it looks along the node's −z with y up.
    pub camera: Option<usize>,
    /// The attached light; it shines along the node's −z, if it has a direction.
    pub light: Option<usize>,
}

impl Default for Node {
    /// Returns a root node without content, whose local transform is the identity.
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

/// A scene of the file: the list of its root nodes.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SceneRoots {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// Root nodes in the order of the file. Only the active scene's are checked: other entries may
    /// be out of range.
    pub nodes: Vec<usize>,
}

/// A skin: the joints that deform a mesh, and the mesh's transform relative to each of them.
///
/// The matrix of a joint in the current pose is its inverse bind matrix followed by its global
/// transform. In the bind pose the two cancel, and vertices stay where they were modeled.
#[derive(Clone, Debug)]
pub struct Skin {
    /// The nodes that are joints; joint indices of vertices point into this list.
    pub joints: Vec<usize>,
    /// Inverse bind matrix of each joint: from the mesh's coordinates to the joint's, in the pose
    /// in which the mesh was modeled (the bind pose).
    pub inverse_bind_matrices: Vec<Affine<ModelSpace, ModelSpace>>,
}
