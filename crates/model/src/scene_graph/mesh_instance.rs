//! Instances: the nodes of the shown scene, each with its place in the model.

use crate::Model;
use homog::{Affine, Model as ModelSpace};

/// A node of the shown scene with the product of all transforms above it.
#[derive(Clone, Copy, Debug)]
pub struct MeshInstance {
    /// The node's number.
    pub node: usize,
    /// From the node's coordinates to the model's.
    pub node_to_model: Affine<ModelSpace, ModelSpace>,
}

impl Model {
    /// All nodes of the shown scene, parents before their children, in the order of the file.
    ///
    /// The walk keeps its own stack, so that no depth of the tree can exhaust the program's.
    #[must_use]
    pub fn node_instances(&self) -> Vec<MeshInstance> {
        self.instances_below(&self.roots)
    }

    /// These nodes and all below them.
    pub(super) fn instances_below(&self, roots: &[usize]) -> Vec<MeshInstance> {
        let mut found = Vec::new();
        let mut open: Vec<MeshInstance> =
            roots.iter().rev().map(|&node| self.child_instance(node, Affine::IDENTITY)).collect();
        while let Some(instance) = open.pop() {
            let children = &self.nodes[instance.node].children;
            open.extend(
                children.iter().rev().map(|&n| self.child_instance(n, instance.node_to_model)),
            );
            found.push(instance);
        }
        found
    }

    /// The instances of nodes with meshes, one for each time that a mesh is shown.
    pub fn mesh_instances(&self) -> impl Iterator<Item = MeshInstance> {
        self.mesh_instances_below(&self.roots)
    }

    /// The instances of nodes with meshes among these nodes and those below them, one for each time that a mesh is shown.
    pub(super) fn mesh_instances_below(
        &self,
        roots: &[usize],
    ) -> impl Iterator<Item = MeshInstance> {
        let instances = self.instances_below(roots).into_iter();
        let meshes = instances.filter(|at| self.nodes[at.node].mesh.is_some());
        meshes.flat_map(|here| {
            let places = self.nodes[here.node].instance_transforms.as_deref();
            let once = places.is_none().then_some(here);
            let often = places.unwrap_or(&[]).iter();
            once.into_iter().chain(often.map(move |place| MeshInstance {
                node_to_model: place.then(here.node_to_model),
                ..here
            }))
        })
    }

    fn child_instance(&self, node: usize, above: Affine<ModelSpace, ModelSpace>) -> MeshInstance {
        MeshInstance { node, node_to_model: self.nodes[node].to_parent.then(above) }
    }
}
