//! Instances: the nodes of the shown scene, each with its place in the model.

use super::Model;
use homog::{Affine, Model as ModelSpace};

/// A node of the shown scene with the product of all transforms above it.
#[derive(Clone, Copy, Debug)]
pub struct Instance {
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
    pub fn instances(&self) -> Vec<Instance> {
        self.instances_below(&self.roots)
    }

    /// These nodes and all below them.
    pub(super) fn instances_below(&self, roots: &[usize]) -> Vec<Instance> {
        let mut found = Vec::new();
        let mut open: Vec<Instance> =
            roots.iter().rev().map(|&node| self.instance(node, Affine::IDENTITY)).collect();
        while let Some(instance) = open.pop() {
            let children = &self.nodes[instance.node].children;
            open.extend(children.iter().rev().map(|&n| self.instance(n, instance.node_to_model)));
            found.push(instance);
        }
        found
    }

    /// The instances of nodes with meshes, one for each time that a mesh is shown.
    pub fn shown_meshes(&self) -> impl Iterator<Item = Instance> {
        self.meshes_below(&self.roots)
    }

    /// The instances of nodes with meshes among these nodes and those below them, one for each time that a mesh is shown.
    pub(super) fn meshes_below(&self, roots: &[usize]) -> impl Iterator<Item = Instance> {
        let instances = self.instances_below(roots).into_iter();
        let meshes = instances.filter(|at| self.nodes[at.node].mesh.is_some());
        meshes.flat_map(|here| {
            let places = self.nodes[here.node].places.as_deref();
            let once = places.is_none().then_some(here);
            let often = places.unwrap_or(&[]).iter();
            once.into_iter().chain(often.map(move |place| Instance {
                node_to_model: place.then(here.node_to_model),
                ..here
            }))
        })
    }

    fn instance(&self, node: usize, above: Affine<ModelSpace, ModelSpace>) -> Instance {
        Instance { node, node_to_model: self.nodes[node].to_parent.then(above) }
    }
}
