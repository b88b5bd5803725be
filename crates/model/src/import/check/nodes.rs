//! Nodes and scenes: transforms, the tree, and what hangs on it (glTF 2.0 §3.5).

use super::codes;
use super::document::{Document, index, items, members, numbers, whole};
use glam::DMat4;
use serde_json::Value;

/// The tree of the nodes, as far as it is one.
#[derive(Debug)]
pub(super) struct Tree {
    pub(super) parents: Vec<Option<usize>>,
    /// The top of the tree that each node is in; `None` for nodes of a loop.
    pub(super) tops: Vec<Option<usize>>,
    /// When a walk in depth enters and leaves each node: below a node are those entered and left between.
    spans: Vec<(usize, usize)>,
}

impl Tree {
    /// Whether a node is another one or below it.
    pub(super) fn is_below(&self, node: usize, other: usize) -> bool {
        let (Some(inner), Some(outer)) = (self.spans.get(node), self.spans.get(other)) else {
            return false;
        };
        outer.0 <= inner.0 && inner.1 <= outer.1
    }
}

/// Checks all nodes and scenes.
pub(super) fn check(document: &Document<'_>) -> Tree {
    let meshes = document.all("meshes");
    let shapes: Vec<Shape> = meshes.iter().map(Shape::of).collect();
    for (at, node) in document.all("nodes").iter().enumerate() {
        check_transform(document, at, node);
        check_mesh(document, at, node, &shapes);
    }
    let tree = tree(document);
    for (at, scene) in document.all("scenes").iter().enumerate() {
        for (place, node) in items(scene, "nodes").iter().enumerate() {
            let node = whole(node).and_then(|node| usize::try_from(node).ok());
            if let Some(parent) = node.and_then(|node| *tree.parents.get(node)?) {
                let message = format_args!("node {} is below node {parent}", node.unwrap_or(0));
                let pointer = format_args!("/scenes/{at}/nodes/{place}");
                document.findings.add(&codes::SCENE_NON_ROOT_NODE, pointer, message);
            }
        }
    }
    tree
}

fn check_transform(document: &Document<'_>, at: usize, node: &Value) {
    let findings = document.findings;
    let has_parts = ["translation", "rotation", "scale"].iter().any(|key| node.get(key).is_some());
    if node.get("matrix").is_some() && has_parts {
        let message = "a node has either a matrix or translation, rotation and scale";
        findings.add(&codes::NODE_MATRIX_TRS, format_args!("/nodes/{at}/matrix"), message);
    }
    if let Some(matrix) = numbers::<16>(node, "matrix") {
        let pointer = format_args!("/nodes/{at}/matrix");
        let matrix = DMat4::from_cols_array(&matrix);
        if matrix == DMat4::IDENTITY {
            findings.add(&codes::NODE_MATRIX_DEFAULT, pointer, "the matrix changes nothing");
        } else if !is_decomposable(&matrix) {
            let message = "the matrix is no product of translation, rotation and scale";
            findings.add(&codes::NODE_MATRIX_NON_TRS, pointer, message);
        }
    }
    if let Some(rotation) = numbers::<4>(node, "rotation") {
        let length = rotation.iter().map(|x| x * x).sum::<f64>().sqrt();
        if (length - 1.0).abs() > 5e-7 * 4.0 + UNIT_ROUNDING {
            let message = format_args!("the rotation {rotation:?} is of length {length}");
            findings.add(&codes::ROTATION_NON_UNIT, format_args!("/nodes/{at}/rotation"), message);
        }
    }
    if node.as_object().is_some_and(serde_json::Map::is_empty) {
        findings.add(&codes::NODE_EMPTY, format_args!("/nodes/{at}"), "the node has nothing in it");
    }
}

/// Texts of rotations are rounded: those of four digits are no mistake.
const UNIT_ROUNDING: f64 = 5e-4;

/// Whether a matrix moves, turns and scales only: its columns are at right angles, and its last row is 0, 0, 0, 1.
fn is_decomposable(matrix: &DMat4) -> bool {
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(glam::DVec4::truncate);
    let [x, y, z] = columns;
    let is_square =
        |a: glam::DVec3, b: glam::DVec3| a.dot(b).abs() <= 5e-3 * a.length() * b.length();
    let row = matrix.row(3);
    let is_affine = (row - glam::DVec4::W).abs().max_element() < 1e-6;
    let has_lengths = columns.iter().all(|column| column.length() > 0.0);
    is_affine && has_lengths && is_square(x, y) && is_square(y, z) && is_square(z, x)
}

/// What a node must know of its mesh.
#[derive(Clone, Copy, Debug)]
struct Shape {
    targets: usize,
    has_joints: bool,
    is_whole: bool,
}

impl Shape {
    fn of(mesh: &Value) -> Self {
        let primitives = items(mesh, "primitives");
        let has_joints = |primitive: &Value| {
            members(primitive, "attributes").is_some_and(|named| named.contains_key("JOINTS_0"))
        };
        Self {
            targets: primitives.first().map_or(0, |first| items(first, "targets").len()),
            has_joints: primitives.iter().any(has_joints),
            is_whole: !primitives.is_empty(),
        }
    }
}

fn check_mesh(document: &Document<'_>, at: usize, node: &Value, shapes: &[Shape]) {
    let findings = document.findings;
    let Some(&shape) = index(node, "mesh").and_then(|mesh| shapes.get(mesh)) else { return };
    let weights = items(node, "weights").len();
    if weights != 0 && shape.is_whole && weights != shape.targets {
        let message = format_args!("{weights} weights for {} morph targets", shape.targets);
        findings.add(&codes::NODE_WEIGHTS_INVALID, format_args!("/nodes/{at}/weights"), message);
    }
    let has_skin = index(node, "skin").is_some_and(|skin| skin < document.all("skins").len());
    if has_skin && shape.is_whole && !shape.has_joints {
        let message = "the mesh has no joints that the skin could bend";
        let pointer = format_args!("/nodes/{at}/skin");
        findings.add(&codes::NODE_SKIN_WITH_NON_SKINNED_MESH, pointer, message);
    }
    if shape.has_joints && node.get("skin").is_none() {
        let message = "the mesh has joints, and the node no skin";
        findings.add(&codes::NODE_SKINNED_MESH_WITHOUT_SKIN, format_args!("/nodes/{at}"), message);
    }
}

/// One parent for each node, and no loops.
fn tree(document: &Document<'_>) -> Tree {
    let nodes = document.all("nodes");
    let mut parents: Vec<Option<usize>> = vec![None; nodes.len()];
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); nodes.len()];
    for (parent, node) in nodes.iter().enumerate() {
        for (place, child) in items(node, "children").iter().enumerate() {
            let child = whole(child).and_then(|child| usize::try_from(child).ok());
            let Some(child) = child.filter(|&child| child < nodes.len()) else { continue };
            if let Some(other) = parents[child] {
                if other != parent {
                    let message = format_args!("node {child} is below node {other} already");
                    let pointer = format_args!("/nodes/{parent}/children/{place}");
                    document.findings.add(&codes::NODE_PARENT_OVERRIDE, pointer, message);
                }
                continue;
            }
            parents[child] = Some(parent);
            children[parent].push(child);
        }
    }
    walk(document, parents, &children)
}

fn walk(document: &Document<'_>, parents: Vec<Option<usize>>, children: &[Vec<usize>]) -> Tree {
    let count = parents.len();
    let mut tree = Tree { parents, tops: vec![None; count], spans: vec![(usize::MAX, 0); count] };
    let mut time = 0;
    for top in (0..count).filter(|&at| tree.parents[at].is_none()).collect::<Vec<_>>() {
        // The node, and which of its children is next.
        let mut open = vec![(top, 0)];
        while let Some((at, next)) = open.pop() {
            if next == 0 {
                tree.tops[at] = Some(top);
                tree.spans[at].0 = time;
                time += 1;
            }
            match children[at].get(next) {
                Some(&child) => open.extend([(at, next + 1), (child, 0)]),
                None => tree.spans[at].1 = time,
            }
        }
    }
    for at in (0..count).filter(|&at| is_in_loop(&tree, at)) {
        let message = format_args!("node {at} is below itself");
        document.findings.add(&codes::NODE_LOOP, format_args!("/nodes/{at}/children"), message);
    }
    tree
}

/// Nodes that the walk has not met are in a loop, or below one.
fn is_in_loop(tree: &Tree, at: usize) -> bool {
    tree.tops[at].is_none()
}
