//! The scene graph: a forest of nodes with meshes, skins, cameras and lights.
//!
//! Terms and structure follow glTF 2.0 §3.5: a scene lists root nodes, and a node has a local
//! transform and children. The content of a node is drawn with the product of the transforms from
//! the root down to the node.

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
    /// Local transform: from node coordinates to the parent's (for a root, the model's).
    pub to_parent: Affine<ModelSpace, ModelSpace>,
    /// The local transform as translation, rotation and scale, which animations change; `None` if
    /// the file specifies a matrix.
    pub trs: Option<Trs>,
    /// Global transform: from node coordinates to model space, the product of the local transforms
    /// from the root down to this node. All components are finite.
    pub to_model: Affine<ModelSpace, ModelSpace>,
    /// The parent node, or `None` for a root.
    pub parent: Option<usize>,
    /// The child nodes.
    pub children: Vec<usize>,
    /// The attached mesh.
    pub mesh: Option<usize>,
    /// Transforms of the mesh instances relative to the node (EXT_mesh_gpu_instancing), or `None`
    /// if the mesh is drawn once, at the node itself.
    pub instance_transforms: Option<Vec<Affine<ModelSpace, ModelSpace>>>,
    /// Morph target weights at this node, or `None` for the mesh's default weights.
    pub morph_weights: Option<Vec<f32>>,
    /// The skin that deforms the mesh.
    pub skin: Option<usize>,
    /// The attached camera, which looks along the node's −z with y up.
    pub camera: Option<usize>,
    /// The attached light, which shines along the node's −z if it has a direction.
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

/// A scene of the file: a list of root nodes.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SceneRoots {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// Root nodes in file order. Only the active scene is checked; entries in other scenes may be
    /// out of range.
    pub nodes: Vec<usize>,
}

/// A skin: the joints that deform a mesh, and the mesh's transform relative to each joint.
///
/// The matrix of a joint in the current pose is its inverse bind matrix followed by its global
/// transform. In the bind pose the two cancel, and vertices stay where they were modeled.
#[derive(Clone, Debug)]
pub struct Skin {
    /// The nodes that are joints; vertex joint indices refer to this list.
    pub joints: Vec<usize>,
    /// Inverse bind matrix of each joint: from mesh coordinates to joint coordinates, in the pose
    /// in which the mesh was modeled (the bind pose).
    pub inverse_bind_matrices: Vec<Affine<ModelSpace, ModelSpace>>,
}
