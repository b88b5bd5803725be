//! Finds mesh instances: traverses the nodes of the active scene with their global transforms.

use crate::Model;
use homog::{Affine, Model as ModelSpace};

/// A node of the active scene with its global transform: one instance of its mesh, camera or light.
#[derive(Clone, Copy, Debug)]
pub struct MeshInstance {
    /// Index of the node in [`Model::nodes`].
    pub node: usize,
    /// The transform from node coordinates (for an instanced mesh, instance coordinates) to model
    /// space.
    pub node_to_model: Affine<ModelSpace, ModelSpace>,
}

impl Model {
    /// Returns all nodes of the active scene, parents before their children, and otherwise in file
    /// order.
    ///
    /// The traversal uses an explicit stack, so a deep hierarchy cannot overflow the thread's
    /// stack.
    #[must_use]
    pub fn node_instances(&self) -> Vec<MeshInstance> {
        self.instances_below(&self.roots)
    }

    /// Returns the given nodes and all their descendants.
    ///
    /// Roots and children are pushed in reverse, so that they are popped in file order.
    pub(super) fn instances_below(&self, roots: &[usize]) -> Vec<MeshInstance> {
        let mut instances = Vec::new();
        let mut stack: Vec<MeshInstance> =
            roots.iter().rev().map(|&node| self.child_instance(node, Affine::IDENTITY)).collect();
        while let Some(instance) = stack.pop() {
            let children = &self.nodes[instance.node].children;
            stack.extend(
                children.iter().rev().map(|&n| self.child_instance(n, instance.node_to_model)),
            );
            instances.push(instance);
        }
        instances
    }

    /// Returns the nodes of the active scene that have a mesh, once per instance of the mesh
    /// (EXT_mesh_gpu_instancing).
    pub fn mesh_instances(&self) -> impl Iterator<Item = MeshInstance> {
        self.mesh_instances_below(&self.roots)
    }

    /// Returns the mesh instances among the given nodes and their descendants.
    ///
    /// An instanced mesh with an empty list of transforms is not drawn.
    pub(super) fn mesh_instances_below(
        &self,
        roots: &[usize],
    ) -> impl Iterator<Item = MeshInstance> {
        let instances = self.instances_below(roots).into_iter();
        let meshes = instances.filter(|at| self.nodes[at.node].mesh.is_some());
        meshes.flat_map(|node_instance| {
            let transforms = self.nodes[node_instance.node].instance_transforms.as_deref();
            let single = transforms.is_none().then_some(node_instance);
            let instanced = transforms.unwrap_or(&[]).iter();
            single.into_iter().chain(instanced.map(move |transform| MeshInstance {
                node_to_model: transform.then(node_instance.node_to_model),
                ..node_instance
            }))
        })
    }

    /// Returns the node with its local transform followed by its parent's global transform.
    fn child_instance(&self, node: usize, parent: Affine<ModelSpace, ModelSpace>) -> MeshInstance {
        MeshInstance { node, node_to_model: self.nodes[node].to_parent.then(parent) }
    }
}
