//! Instances: the meshes and cameras of the shown scene, each with its place in the model.

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
        let mut found = Vec::new();
        let mut open: Vec<Instance> =
            self.roots.iter().rev().map(|&node| self.instance(node, Affine::IDENTITY)).collect();
        while let Some(instance) = open.pop() {
            let children = &self.nodes[instance.node].children;
            open.extend(children.iter().rev().map(|&n| self.instance(n, instance.node_to_model)));
            found.push(instance);
        }
        found
    }

    fn instance(&self, node: usize, above: Affine<ModelSpace, ModelSpace>) -> Instance {
        Instance { node, node_to_model: self.nodes[node].to_parent.then(above) }
    }
}
