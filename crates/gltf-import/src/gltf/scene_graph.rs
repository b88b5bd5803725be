//! Scene graph import: nodes with their transforms, a check that they form a forest, and scene
//! roots.
//!
//! In glTF, parents list their children. Nothing in the format prevents a node from having two
//! parents or from being its own ancestor, either of which would make traversal of the model wrong
//! or endless. The check has two steps: each node gets at most one parent, and a traversal from the
//! nodes without a parent must visit every node. Traversals use an explicit stack, so deep
//! hierarchies cannot overflow the thread's stack; [`Limits::node_depth`] also limits the depth.

use super::document::GltfDocument;
use super::node_transform::NodeTransform;
use crate::limits::Limits;
use crate::warnings::ImportWarnings;
use gltf::json::{Index, Root};
use homog::Affine;
use model::{Diagnostic, Mesh, MeshInstance, Model, Node, Primitive, SceneRoots, Trs};

/// Reads all nodes of a file. They form a forest of bounded depth, and every index in them is
/// valid.
///
/// The time is linear in the number of nodes and children.
///
/// # Errors
/// Fails if there are too many nodes, they are nested too deeply, an index is out of range, or a
/// node has two parents or is its own ancestor. In lenient mode, the last three are only warnings.
pub(super) fn import_nodes(
    document: &GltfDocument,
    limits: &Limits,
    warnings: &mut ImportWarnings,
) -> Result<Vec<Node>, Diagnostic> {
    let count = document.root.nodes.len();
    if count > limits.nodes {
        let what = format!("the file has {count} nodes");
        return Err(Diagnostic::limit_exceeded("/nodes", &what, "nodes", limits.nodes as u64));
    }
    let mut nodes =
        (0..count).map(|at| read_node(document, at, warnings)).collect::<Result<Vec<_>, _>>()?;
    link_parents(&mut nodes, warnings)?;
    update_global_transforms(&mut nodes, limits, warnings)?;
    Ok(nodes)
}

/// Reads a node, without its parent and children.
///
/// Checks that its mesh, skin and camera exist. A skin without a mesh is dropped with a warning. In
/// lenient mode, a node with an invalid transform gets its parent's transform. A node with a matrix
/// has no `trs` and cannot be animated.
fn read_node(
    document: &GltfDocument,
    at: usize,
    warnings: &mut ImportWarnings,
) -> Result<Node, Diagnostic> {
    let root = &document.root;
    let json = &root.nodes[at];
    let pointer = format!("/nodes/{at}");
    let mut placement = document.node_transforms.get(at);
    let to_parent = match placement.map_or(Ok(Affine::IDENTITY), |p| p.to_affine(&pointer)) {
        Err(diagnostic) => {
            warnings.downgrade_if_lenient(diagnostic, "the transform is ignored")?;
            placement = None;
            Affine::IDENTITY
        }
        Ok(to_parent) => to_parent,
    };
    let children = json.children.iter().flatten().map(Index::value).collect();
    let mesh = checked_index(json.mesh, "mesh", root.meshes.len(), &pointer, warnings)?;
    let mut skin = checked_index(json.skin, "skin", root.skins.len(), &pointer, warnings)?;
    if skin.is_some() && mesh.is_none() {
        warnings.push_warning(
            &format!("{pointer}/skin"),
            "the skin has no effect: the node has no mesh",
        );
        skin = None;
    }
    let camera = checked_index(json.camera, "camera", root.cameras.len(), &pointer, warnings)?;
    Ok(Node {
        name: json.name.clone(),
        to_parent,
        trs: placement.map_or(Some(Trs::default()), NodeTransform::to_trs),
        to_model: to_parent,
        parent: None,
        children,
        mesh,
        instance_transforms: None,
        morph_weights: json.weights.clone(),
        skin,
        camera,
        light: None,
    })
}

/// Returns an index after checking that it refers to one of `count` items.
///
/// `what` is the name of the member and, in messages, the kind of object that it refers to.
///
/// # Errors
/// Fails if the index is out of range. In lenient mode, the reference is dropped instead.
fn checked_index<T>(
    index: Option<Index<T>>,
    what: &str,
    count: usize,
    node: &str,
    warnings: &mut ImportWarnings,
) -> Result<Option<usize>, Diagnostic> {
    match index.map(|index| index.value()) {
        Some(index) if index >= count => {
            let diagnostic =
                Diagnostic::unresolved_index(&format!("{node}/{what}"), what, index, count);
            warnings.downgrade_if_lenient(diagnostic, "the reference is ignored").map(|()| None)
        }
        index => Ok(index),
    }
}

/// Sets the parent of every node. Each node may have only one parent.
///
/// # Errors
/// Fails if a child does not exist or already has a parent. In lenient mode, the first parent is
/// used.
///
/// The children lists are rebuilt from the accepted links, so that parents and children are
/// consistent afterwards.
fn link_parents(nodes: &mut [Node], warnings: &mut ImportWarnings) -> Result<(), Diagnostic> {
    let count = nodes.len();
    for parent in 0..count {
        let children = std::mem::take(&mut nodes[parent].children);
        let mut linked = Vec::with_capacity(children.len());
        for (slot, child) in children.into_iter().enumerate() {
            let pointer = format!("/nodes/{parent}/children/{slot}");
            let diagnostic = match nodes.get(child).map(|node| node.parent) {
                Some(None) => {
                    nodes[child].parent = Some(parent);
                    linked.push(child);
                    continue;
                }
                None => Diagnostic::unresolved_index(&pointer, "node", child, count),
                Some(Some(other)) => {
                    let message = format!("node {child} already has a parent, node {other}");
                    Diagnostic::invalid(&pointer, message)
                }
            };
            warnings.downgrade_if_lenient(diagnostic, "the reference is ignored")?;
        }
        nodes[parent].children = linked;
    }
    Ok(())
}

/// Computes global transforms. Because each node has at most one parent, the nodes form a forest if
/// a traversal from the roots visits them all; nodes that it misses are in or below cycles.
///
/// In lenient mode, the first node that cannot be reached from a root becomes a root itself; this
/// breaks any cycle that contains the node.
///
/// # Errors
/// Fails if a node is its own ancestor, a product of transforms overflows, or the depth limit is
/// exceeded.
fn update_global_transforms(
    nodes: &mut [Node],
    limits: &Limits,
    warnings: &mut ImportWarnings,
) -> Result<(), Diagnostic> {
    let mut visited = vec![false; nodes.len()];
    for at in 0..nodes.len() {
        if nodes[at].parent.is_none() {
            update_transforms_below(nodes, at, &mut visited, limits, warnings)?;
        }
    }
    for at in 0..nodes.len() {
        if visited[at] {
            continue;
        }
        let message = format!("node {at} is its own descendant");
        let diagnostic = Diagnostic::invalid(&format!("/nodes/{at}/children"), message);
        warnings.downgrade_if_lenient(diagnostic, "it is treated as a root")?;
        if let Some(parent) = nodes[at].parent.take() {
            nodes[parent].children.retain(|&child| child != at);
        }
        update_transforms_below(nodes, at, &mut visited, limits, warnings)?;
    }
    Ok(())
}

/// Computes the global transforms of a root and its descendants, and checks their depth.
///
/// # Errors
/// Fails if a product of transforms overflows, or the hierarchy is deeper than the limit.
///
/// Transforms are composed in double precision from the root down, with one product per node.
fn update_transforms_below(
    nodes: &mut [Node],
    root: usize,
    visited: &mut [bool],
    limits: &Limits,
    warnings: &mut ImportWarnings,
) -> Result<(), Diagnostic> {
    let mut stack = vec![(root, 1)];
    while let Some((at, depth)) = stack.pop() {
        visited[at] = true;
        if depth > limits.node_depth {
            let what = format!("the node tree is {depth} levels deep");
            let allowed = limits.node_depth as u64;
            return Err(Diagnostic::limit_exceeded(
                &format!("/nodes/{at}"),
                &what,
                "node_depth",
                allowed,
            ));
        }
        let parent = nodes[at].parent.map_or(Affine::IDENTITY, |parent| nodes[parent].to_model);
        nodes[at].to_model = nodes[at].to_parent.then(parent);
        if !nodes[at].to_model.is_finite() {
            let message = "the accumulated transform overflows";
            let diagnostic = Diagnostic::invalid(&format!("/nodes/{at}"), message);
            warnings.downgrade_if_lenient(diagnostic, "the transform is ignored")?;
            (nodes[at].to_parent, nodes[at].to_model) = (Affine::IDENTITY, parent);
            nodes[at].trs = Some(Trs::default());
        }
        stack.extend(nodes[at].children.iter().map(|&child| (child, depth + 1)));
    }
    Ok(())
}

/// Returns all scenes of a file.
pub(super) fn import_scenes(root: &Root) -> Vec<SceneRoots> {
    let scene = |json: &gltf::json::Scene| SceneRoots {
        name: json.name.clone(),
        nodes: json.nodes.iter().map(Index::value).collect(),
    };
    root.scenes.iter().map(scene).collect()
}

/// Returns the roots of the active scene or, if there are no scenes, all nodes without a parent.
///
/// A node that is listed twice is drawn once, with a warning. A listed node that has a parent is
/// also drawn, unless one of its ancestors is listed. The specification forbids both cases.
///
/// `scene` is the index of the active scene, which the caller has checked or defaulted.
///
/// # Errors
/// Fails if a listed node does not exist. In lenient mode, it is skipped.
pub(super) fn scene_roots(
    root: &Root,
    scene: usize,
    nodes: &[Node],
    warnings: &mut ImportWarnings,
) -> Result<Vec<usize>, Diagnostic> {
    let Some(json) = root.scenes.get(scene) else {
        return Ok((0..nodes.len()).filter(|&at| nodes[at].parent.is_none()).collect());
    };
    let mut listed = vec![false; nodes.len()];
    let mut roots = Vec::with_capacity(json.nodes.len());
    for (slot, node) in json.nodes.iter().enumerate() {
        let pointer = format!("/scenes/{scene}/nodes/{slot}");
        match listed.get_mut(node.value()) {
            None => {
                let diagnostic =
                    Diagnostic::unresolved_index(&pointer, "node", node.value(), nodes.len());
                warnings.downgrade_if_lenient(diagnostic, "the reference is ignored")?;
            }
            Some(true) => {
                warnings.push_warning(&pointer, "the node is listed twice; it is shown once");
            }
            Some(is_listed) => {
                *is_listed = true;
                roots.push(node.value());
            }
        }
    }
    let scene = format!("/scenes/{scene}/nodes");
    roots.retain(|&at| is_scene_root(nodes, &listed, at, &scene, warnings));
    Ok(roots)
}

/// Returns whether a node that a scene lists should be drawn as a root. If one of its ancestors is
/// also listed, the node is already drawn with that ancestor.
fn is_scene_root(
    nodes: &[Node],
    listed: &[bool],
    at: usize,
    scene: &str,
    warnings: &mut ImportWarnings,
) -> bool {
    let mut parent = nodes[at].parent;
    if parent.is_some() {
        warnings.push_warning(scene, format!("node {at} is listed as a root but has a parent"));
    }
    while let Some(node) = parent {
        if listed[node] {
            return false;
        }
        parent = nodes[node].parent;
    }
    true
}

/// Checks the number of items that the active scene draws, counting each once per instance.
///
/// A primitive counts as one additional item, so that many empty primitives are not free. Vertices
/// and joints of skinned meshes also count, and so do vertices of instanced meshes.
///
/// # Errors
/// Fails if the scene contains more items than a limit allows.
pub fn check_scene_items(model: &Model, limits: &Limits) -> Result<(), Diagnostic> {
    let sum = |count: fn(&Primitive) -> usize| -> Vec<u64> {
        let of_mesh = |mesh: &Mesh| mesh.primitives.iter().map(|p| count(p) as u64 + 1).sum();
        model.meshes.iter().map(of_mesh).collect()
    };
    let (items, vertices) =
        (sum(Primitive::item_count), sum(|primitive| primitive.positions.len()));
    let mut total = 0u64;
    for MeshInstance { node, .. } in model.node_instances() {
        let Some(mesh) = model.nodes[node].mesh else { continue };
        let joints = model.nodes[node].skin.map(|skin| model.skins[skin].joints.len() as u64);
        let parts = model.meshes[mesh].primitives.len() as u64;
        let bending =
            joints.map_or(0, |joints| vertices[mesh].saturating_add(joints.saturating_mul(parts)));
        let shown = match &model.nodes[node].instance_transforms {
            Some(instances) => {
                items[mesh].saturating_add(vertices[mesh]).saturating_mul(instances.len() as u64)
            }
            None => items[mesh],
        };
        // The arithmetic saturates, because all counts come from the file.
        total = total.saturating_add(shown).saturating_add(bending);
    }
    if total <= limits.scene_items {
        return Ok(());
    }
    let what = format!("the scene shows {total} points, lines and triangles");
    Err(Diagnostic::limit_exceeded("/scenes", &what, "scene_items", limits.scene_items))
}
