//! Meshes and nodes of an OBJ file: one mesh and one node per object and group.

use super::parser::GroupName;
use super::primitives::GroupPrimitive;
use model::{Mesh, Model, Node};
use std::collections::BTreeMap;

/// Adds the groups' meshes and nodes to a model.
///
/// The groups of an object are children of its node; objects, and groups without an object, are
/// roots.
pub(super) fn build_scene(
    model: &mut Model,
    groups: &[GroupName<'_>],
    primitives: Vec<GroupPrimitive>,
) {
    let mut meshes: Vec<Mesh> = groups.iter().map(group_mesh).collect();
    for GroupPrimitive { group, primitive } in primitives {
        meshes[group as usize].primitives.push(primitive);
    }
    let mut objects = BTreeMap::new();
    for (group, mesh) in groups.iter().zip(meshes) {
        // Skip groups whose elements are all broken.
        if mesh.primitives.is_empty() {
            continue;
        }
        let mut node = None;
        if !group.object.is_empty() {
            let object = *objects
                .entry(group.object)
                .or_insert_with(|| push_node(model, to_name(group.object), None));
            node = Some(object);
        }
        if node.is_none() || !group.group.is_empty() {
            node = Some(push_node(model, to_name(group.group), node));
        }
        if let Some(node) = node {
            model.nodes[node].mesh = Some(model.meshes.len());
        }
        model.meshes.push(mesh);
    }
}

/// Returns a mesh without primitives, named after its group or else its object.
fn group_mesh(names: &GroupName<'_>) -> Mesh {
    let name = if names.group.is_empty() { names.object } else { names.group };
    Mesh { name: to_name(name), ..Mesh::default() }
}

/// Appends a node as a child of a parent or as a root, and returns its index.
fn push_node(model: &mut Model, name: Option<String>, parent: Option<usize>) -> usize {
    let node = model.nodes.len();
    model.nodes.push(Node { name, parent, ..Node::default() });
    match parent {
        Some(parent) => model.nodes[parent].children.push(node),
        None => model.roots.push(node),
    }
    node
}

/// Decodes a name from UTF-8, or else from ISO 8859-1. Returns `None` for an empty name.
pub(super) fn to_name(bytes: &[u8]) -> Option<String> {
    let latin_1 = || bytes.iter().map(|&byte| char::from(byte)).collect();
    (!bytes.is_empty()).then(|| str::from_utf8(bytes).map_or_else(|_| latin_1(), str::to_owned))
}
