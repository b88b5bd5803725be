//! Validation of nodes and scenes: transforms, the hierarchy, and node meshes (glTF 2.0 §3.5).
//!
//! The hierarchy must be a set of disjoint strict trees (glTF 2.0 §3.5.2): a node has at most one
//! parent, and no node is its own ancestor. Files may violate both rules, so traversals in this
//! module never recurse or follow a link twice.

use super::codes;
use super::document::{
    CheckedDocument, array_items, as_whole_number, index_member, number_array, object_members,
};
use glam::DMat4;
use serde_json::Value;

/// The node hierarchy as a forest; links that would break the tree structure are dropped.
///
/// ```text
///        A [0, 4)            B is below A: [1, 3) is inside [0, 4)
///       ╱        ╲
///   B [1, 3)    D [3, 4)     C is not below D: [2, 3) is not inside [3, 4)
///      │
///   C [2, 3)
/// ```
#[derive(Debug)]
pub(super) struct NodeTree {
    /// The parent of each node, or the first if there are several.
    pub(super) parents: Vec<Option<usize>>,
    /// The root of the tree that contains each node; `None` for nodes in or below a cycle.
    pub(super) roots: Vec<Option<usize>>,
    /// The entry and exit times of each node in a depth-first traversal. The interval of a
    /// descendant is inside its ancestor's interval.
    visit_intervals: Vec<(usize, usize)>,
}

impl NodeTree {
    /// Returns in constant time whether a node is the other node or one of its descendants.
    ///
    /// A node in or below a cycle counts as below every node, because the cycle has been reported.
    pub(super) fn is_at_or_below(&self, node: usize, other: usize) -> bool {
        let (Some(inner), Some(outer)) =
            (self.visit_intervals.get(node), self.visit_intervals.get(other))
        else {
            return false;
        };
        outer.0 <= inner.0 && inner.1 <= outer.1
    }
}

/// Validates all nodes and scenes, and returns the hierarchy for the skin checks.
///
/// The root nodes of a scene must not have a parent (glTF 2.0 §3.5.1): a node drawn as a root would
/// lose its ancestors' transforms.
pub(super) fn check_nodes(document: &CheckedDocument<'_>) -> NodeTree {
    let meshes = document.root_array("meshes");
    let shapes: Vec<MeshSummary> = meshes.iter().map(MeshSummary::from_mesh).collect();
    for (at, node) in document.root_array("nodes").iter().enumerate() {
        check_transform(document, at, node);
        check_mesh_use(document, at, node, &shapes);
    }
    let tree = build_tree(document);
    for (at, scene) in document.root_array("scenes").iter().enumerate() {
        for (slot, node) in array_items(scene, "nodes").iter().enumerate() {
            let node = as_whole_number(node).and_then(|node| usize::try_from(node).ok());
            if let Some(parent) = node.and_then(|node| *tree.parents.get(node)?) {
                let message = format_args!(
                    "node {} is not a root: its parent is node {parent}",
                    node.unwrap_or(0)
                );
                let pointer = format_args!("/scenes/{at}/nodes/{slot}");
                document.diagnostics.add(&codes::SCENE_NON_ROOT_NODE, pointer, message);
            }
        }
    }
    tree
}

/// Validates the transform of a node (glTF 2.0 §3.5.3).
///
/// A node may have a matrix or translation, rotation and scale, but not both. The matrix must be
/// decomposable into these three, without shear or projection, and the rotation must be a unit
/// quaternion. An identity matrix gets a note, because it is the default and can be omitted.
fn check_transform(document: &CheckedDocument<'_>, at: usize, node: &Value) {
    let diagnostics = document.diagnostics;
    let has_parts = ["translation", "rotation", "scale"].iter().any(|key| node.get(key).is_some());
    if node.get("matrix").is_some() && has_parts {
        let message = "a node with a matrix must not have a translation, rotation or scale";
        diagnostics.add(&codes::NODE_MATRIX_TRS, format_args!("/nodes/{at}/matrix"), message);
    }
    if let Some(matrix) = number_array::<16>(node, "matrix") {
        let pointer = format_args!("/nodes/{at}/matrix");
        let matrix = DMat4::from_cols_array(&matrix);
        if matrix == DMat4::IDENTITY {
            diagnostics.add(
                &codes::NODE_MATRIX_DEFAULT,
                pointer,
                "the matrix is the identity, which is the default",
            );
        } else if !is_decomposable(&matrix) {
            let message = "the matrix cannot be decomposed into translation, rotation and scale";
            diagnostics.add(&codes::NODE_MATRIX_NON_TRS, pointer, message);
        }
    }
    if let Some(rotation) = number_array::<4>(node, "rotation") {
        let length = rotation.iter().map(|x| x * x).sum::<f64>().sqrt();
        if (length - 1.0).abs() > 5e-7 * 4.0 + ROTATION_ROUNDING {
            let message = format_args!("the quaternion {rotation:?} has length {length}, not 1");
            diagnostics.add(
                &codes::ROTATION_NON_UNIT,
                format_args!("/nodes/{at}/rotation"),
                message,
            );
        }
    }
    if node.as_object().is_some_and(serde_json::Map::is_empty) {
        diagnostics.add(&codes::NODE_EMPTY, format_args!("/nodes/{at}"), "the node is empty");
    }
}

/// The tolerance for the length of rotations in JSON, which exporters may round to four digits.
const ROTATION_ROUNDING: f64 = 5e-4;

/// Returns whether a matrix is a product of translation, rotation and scale.
///
/// The columns of such a matrix are perpendicular, and its last row is 0, 0, 0, 1. The tolerance is
/// relative to the column lengths, so it does not depend on the scale; 0.005 is an angle of about
/// 0.3°. A column of length 0 has no direction and is rejected.
fn is_decomposable(matrix: &DMat4) -> bool {
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(glam::DVec4::truncate);
    let [x, y, z] = columns;
    let are_perpendicular =
        |a: glam::DVec3, b: glam::DVec3| a.dot(b).abs() <= 5e-3 * a.length() * b.length();
    let row = matrix.row(3);
    let is_affine = (row - glam::DVec4::W).abs().max_element() < 1e-6;
    let has_lengths = columns.iter().all(|column| column.length() > 0.0);
    is_affine
        && has_lengths
        && are_perpendicular(x, y)
        && are_perpendicular(y, z)
        && are_perpendicular(z, x)
}

/// The properties of a mesh that the checks of its nodes need.
#[derive(Clone, Copy, Debug)]
struct MeshSummary {
    /// The number of morph targets of the first primitive.
    targets: usize,
    /// Whether a primitive has `JOINTS_0`.
    has_joints: bool,
    /// Whether there are any primitives; a mesh without primitives has already been reported.
    has_primitives: bool,
}

impl MeshSummary {
    /// Summarizes the JSON of a mesh.
    ///
    /// Many nodes may share a mesh, so the summary is computed once per mesh instead of once per
    /// node.
    fn from_mesh(mesh: &Value) -> Self {
        let primitives = array_items(mesh, "primitives");
        let has_joints = |primitive: &Value| {
            object_members(primitive, "attributes")
                .is_some_and(|named| named.contains_key("JOINTS_0"))
        };
        Self {
            targets: primitives.first().map_or(0, |first| array_items(first, "targets").len()),
            has_joints: primitives.iter().any(has_joints),
            has_primitives: !primitives.is_empty(),
        }
    }
}

/// Validates the morph weights and skin of a node against its mesh.
///
/// A mesh with joints on a node without a skin gets only a warning, because it can be drawn
/// undeformed.
fn check_mesh_use(document: &CheckedDocument<'_>, at: usize, node: &Value, shapes: &[MeshSummary]) {
    let diagnostics = document.diagnostics;
    let Some(&shape) = index_member(node, "mesh").and_then(|mesh| shapes.get(mesh)) else { return };
    let weights = array_items(node, "weights").len();
    if weights != 0 && shape.has_primitives && weights != shape.targets {
        let message = format_args!(
            "the number of weights is {weights}, but the number of morph targets is {}",
            shape.targets
        );
        diagnostics.add(&codes::NODE_WEIGHTS_INVALID, format_args!("/nodes/{at}/weights"), message);
    }
    let has_skin =
        index_member(node, "skin").is_some_and(|skin| skin < document.root_array("skins").len());
    if has_skin && shape.has_primitives && !shape.has_joints {
        let message = "the node has a skin, but its mesh has no JOINTS_0";
        let pointer = format_args!("/nodes/{at}/skin");
        diagnostics.add(&codes::NODE_SKIN_WITH_NON_SKINNED_MESH, pointer, message);
    }
    if shape.has_joints && node.get("skin").is_none() {
        let message = "the mesh has JOINTS_0, but the node has no skin";
        diagnostics.add(
            &codes::NODE_SKINNED_MESH_WITHOUT_SKIN,
            format_args!("/nodes/{at}"),
            message,
        );
    }
}

/// Builds the hierarchy, and reports nodes that have several parents or are in a cycle.
///
/// If a node has several parents, the first is used, so that the rest of the validation can rely on
/// a forest.
///
/// A node with several parents is reported at every parent after the first. The schema walk has
/// reported indices that are out of range; they are skipped.
fn build_tree(document: &CheckedDocument<'_>) -> NodeTree {
    let nodes = document.root_array("nodes");
    let mut parents: Vec<Option<usize>> = vec![None; nodes.len()];
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); nodes.len()];
    for (parent, node) in nodes.iter().enumerate() {
        for (slot, child) in array_items(node, "children").iter().enumerate() {
            let child = as_whole_number(child).and_then(|child| usize::try_from(child).ok());
            let Some(child) = child.filter(|&child| child < nodes.len()) else { continue };
            if let Some(other) = parents[child] {
                if other != parent {
                    let message = format_args!("node {child} already has a parent, node {other}");
                    let pointer = format_args!("/nodes/{parent}/children/{slot}");
                    document.diagnostics.add(&codes::NODE_PARENT_OVERRIDE, pointer, message);
                }
                continue;
            }
            parents[child] = Some(parent);
            children[parent].push(child);
        }
    }
    traverse_tree(document, parents, &children)
}

/// Traverses the hierarchy depth first from every root, without recursion.
///
/// This numbers the nodes for [`NodeTree::is_at_or_below`], and finds cycles, whose nodes the
/// traversal does not reach.
///
/// Hostile files may nest nodes a million levels deep, so the stack of open nodes is on the heap. A
/// cycle has no root, and its nodes retain the empty interval. The time is linear in the number of
/// nodes.
fn traverse_tree(
    document: &CheckedDocument<'_>,
    parents: Vec<Option<usize>>,
    children: &[Vec<usize>],
) -> NodeTree {
    let count = parents.len();
    let mut tree = NodeTree {
        parents,
        roots: vec![None; count],
        visit_intervals: vec![(usize::MAX, 0); count],
    };
    let mut time = 0;
    for root in (0..count).filter(|&at| tree.parents[at].is_none()).collect::<Vec<_>>() {
        // A stack of open nodes, each with the position of its next child.
        let mut open = vec![(root, 0)];
        while let Some((at, next)) = open.pop() {
            if next == 0 {
                tree.roots[at] = Some(root);
                tree.visit_intervals[at].0 = time;
                time += 1;
            }
            match children[at].get(next) {
                Some(&child) => open.extend([(at, next + 1), (child, 0)]),
                None => tree.visit_intervals[at].1 = time,
            }
        }
    }
    for at in (0..count).filter(|&at| is_in_loop(&tree, at)) {
        let message = format_args!("node {at} is in or below a cycle");
        document.diagnostics.add(&codes::NODE_LOOP, format_args!("/nodes/{at}/children"), message);
    }
    tree
}

/// Returns whether a node is in or below a cycle, that is, not reached by the traversal from the
/// roots.
fn is_in_loop(tree: &NodeTree, at: usize) -> bool {
    tree.roots[at].is_none()
}
