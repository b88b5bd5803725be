//! Nodes by name, and the drawing objects below them.

use model::{Model, ModelInstance};

/// Returns all objects below the nodes with a matching name: one list per such node, in the order
/// of the models and their nodes.
///
/// A node without a name takes its mesh's name. Objects are numbered as in line drawings: the nodes
/// with a mesh, model by model.
pub(super) fn objects_below(
    models: &[ModelInstance],
    is_meant: impl Fn(&str) -> bool,
) -> Vec<Vec<u32>> {
    let mut first_object = 0;
    let mut found = Vec::new();
    for ModelInstance { model, .. } in models {
        let objects: Vec<(usize, u32)> =
            model.mesh_instances().zip(first_object..).map(|(at, o)| (at.node, o)).collect();
        for instance in model.node_instances() {
            if node_name(model, instance.node).is_some_and(&is_meant) {
                let below = nodes_below(model, instance.node);
                let own = objects.iter().filter(|(node, _)| below[*node]);
                found.push(own.map(|(_, object)| *object).collect());
            }
        }
        first_object += objects.len() as u32;
    }
    found
}

/// Returns all node names, without duplicates.
pub(super) fn node_names(models: &[ModelInstance]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for ModelInstance { model, .. } in models {
        let nodes = model.node_instances();
        let own = nodes.iter().filter_map(|instance| node_name(model, instance.node));
        names.extend(own.map(ToOwned::to_owned));
    }
    names.sort_unstable();
    names.dedup();
    names
}

/// Returns the name of a node, or of its mesh if the node has no name.
fn node_name(model: &Model, node: usize) -> Option<&str> {
    let node = &model.nodes[node];
    let mesh = || node.mesh.and_then(|mesh| model.meshes[mesh].name.as_deref());
    node.name.as_deref().or_else(mesh)
}

/// Returns, for each node of the model, whether it is `node` or a descendant.
fn nodes_below(model: &Model, node: usize) -> Vec<bool> {
    let mut is_below = vec![false; model.nodes.len()];
    let mut stack = vec![node];
    while let Some(node) = stack.pop() {
        if !std::mem::replace(&mut is_below[node], true) {
            stack.extend(&model.nodes[node].children);
        }
    }
    is_below
}
