//! Scenes, nodes, meshes, cameras and lights in `alberti info --json`.
//!
//! Arrays are in file order, so an index in the glTF document is also an index here. Nodes refer to
//! meshes, skins, cameras and lights by index; unlike in the glTF document, cameras and lights also
//! list their nodes.

use super::json::{bounds_json, counts_json, shortest_number, shortest_numbers, topology_name};
use model::{
    CameraProjection, EdgeVisibility, LightKind, Mesh, Model, Node, Primitive, PrimitiveEdges,
    SceneRoots, VariantMaterial,
};
use serde_json::{Value, json};

/// Returns all scenes in the file, with their root nodes and bounds.
///
/// `bounds` is `null` for a scene that draws nothing.
pub(super) fn scenes_json(model: &Model) -> Vec<Value> {
    let describe = |scene: &SceneRoots| {
        let bounds = bounds_json(model.scene_bounds(scene));
        json!({"name": scene.name, "nodes": scene.nodes, "bounds": bounds})
    };
    model.scenes.iter().map(describe).collect()
}

/// Returns all nodes in the file.
pub(super) fn nodes_json(model: &Model) -> Vec<Value> {
    model.nodes.iter().map(node_json).collect()
}

/// Returns a node: its place in the hierarchy, its transforms, and the objects attached to it.
///
/// `transform` is the local transform, or `null` for a node with a matrix; `to_model` is the matrix
/// from the node to the model, column by column, in the current pose.
///
/// `rotation` is a unit quaternion `x, y, z, w`. `places` is the number of instances of
/// EXT_mesh_gpu_instancing, or `null` without the extension. `weights` are the node's weights,
/// which replace the mesh's weights.
fn node_json(node: &Node) -> Value {
    let parts = node.trs.map(|parts| {
        json!({
            "translation": parts.translation,
            "rotation": parts.rotation,
            "scale": parts.scale,
        })
    });
    json!({
        "name": node.name,
        "parent": node.parent,
        "children": node.children,
        "transform": parts,
        "to_model": node.to_model.raw().to_cols_array(),
        "mesh": node.mesh,
        "places": node.instance_transforms.as_ref().map(Vec::len),
        "weights": node.morph_weights.as_deref().map(shortest_numbers),
        "skin": node.skin,
        "camera": node.camera,
        "light": node.light,
    })
}

/// Returns all meshes in the file; `shown` is the number of instances in the drawn scene.
///
/// A mesh with `shown` 0 is not in the drawn scene, which often explains why something is missing.
pub(super) fn meshes_json(model: &Model) -> Vec<Value> {
    let mut shown = vec![0_usize; model.meshes.len()];
    for instance in model.mesh_instances() {
        if let Some(mesh) = model.nodes[instance.node].mesh {
            shown[mesh] += 1;
        }
    }
    let meshes = model.meshes.iter().zip(shown);
    meshes
        .map(|(Mesh { name, primitives, morph_weights: weights }, shown)| {
            json!({
                "name": name,
                "shown": shown,
                "counts": counts_json(primitives.iter()),
                "weights": shortest_numbers(weights),
                "primitives": primitives.iter().map(primitive_json).collect::<Vec<_>>(),
            })
        })
        .collect()
}

/// Returns a primitive: its topology, its counts and the attributes it has.
///
/// `count` is the number of triangles, lines or points; strips, fans and loops count as lists.
fn primitive_json(primitive: &Primitive) -> Value {
    let variant = |of: &VariantMaterial| json!({"variant": of.variant, "material": of.material});
    json!({
        "topology": topology_name(primitive.topology),
        "count": primitive.item_count(),
        "vertices": primitive.positions.len(),
        "normals": primitive.normals.is_some(),
        "tangents": primitive.tangents.is_some(),
        "colors": primitive.colors.is_some(),
        "uv_sets": primitive.uvs.len(),
        "joint_sets": primitive.joint_indices.len(),
        "morph_targets": primitive.morph_targets.len(),
        "material": primitive.material,
        "variants": primitive.material_variants.iter().map(variant).collect::<Vec<_>>(),
        "edges": primitive.edges.as_deref().map(edges_json),
    })
}

/// Returns the edges that the file declares visible (EXT_mesh_primitive_edge_visibility).
///
/// `hard` and `silhouette` count edges of triangles, so an edge shared by two triangles may count
/// twice. `lines` counts segments of explicit line strings.
fn edges_json(edges: &PrimitiveEdges) -> Value {
    let of_triangles = edges.visibility.iter().flat_map(|all| all.as_flattened());
    let count = |wanted: EdgeVisibility| of_triangles.clone().filter(|v| **v == wanted).count();
    json!({
        "hard": count(EdgeVisibility::Hard),
        "silhouette": count(EdgeVisibility::Silhouette),
        "lines": edges.lines.iter().map(|lines| lines.vertex_pairs.len()).sum::<usize>(),
        "material": edges.material,
    })
}

/// Returns all cameras in the file, with the nodes that refer to them.
///
/// `fov_y` is in radians; `width` and `height` are the full extents, twice glTF's `xmag` and
/// `ymag`. `aspect` is `null` if the camera adapts to the picture, and `far` is `null` if the far
/// plane is at infinity.
pub(super) fn cameras_json(model: &Model) -> Vec<Value> {
    let describe = |(number, lens): (usize, &model::ModelCamera)| {
        let mut value = match lens.projection {
            CameraProjection::Perspective { fov_y, aspect, near, far } => json!({
                "kind": "perspective",
                "fov_y": fov_y,
                "aspect": aspect,
                "near": near,
                "far": far,
            }),
            CameraProjection::Orthographic { half_width, half_height, near, far } => json!({
                "kind": "orthographic",
                "width": 2.0 * half_width,
                "height": 2.0 * half_height,
                "near": near,
                "far": far,
            }),
        };
        value["name"] = json!(lens.name);
        value["nodes"] = nodes_where(model, |node| node.camera == Some(number));
        value
    };
    model.cameras.iter().enumerate().map(describe).collect()
}

/// Returns all punctual lights in the file, with the nodes that refer to them.
///
/// `range` is present for point and spot lights; the cone angles, in radians from the axis, are
/// present only for spot lights.
pub(super) fn lights_json(model: &Model) -> Vec<Value> {
    let describe = |(number, light): (usize, &model::PunctualLight)| {
        let unit = if light.kind == LightKind::Directional { "lux" } else { "candela" };
        let mut value = json!({
            "name": light.name,
            "kind": light.kind.gltf_name(),
            "color": shortest_numbers(&light.color),
            "intensity": shortest_number(light.intensity),
            "unit": unit,
            "nodes": nodes_where(model, |node| node.light == Some(number)),
        });
        if let LightKind::Point { range } | LightKind::Spot { range, .. } = light.kind {
            value["range"] = shortest_number(range);
        }
        if let LightKind::Spot { inner_cone_angle: inner, outer_cone_angle: outer, .. } = light.kind
        {
            (value["inner_angle"], value["outer_angle"]) =
                (shortest_number(inner), shortest_number(outer));
        }
        value
    };
    model.lights.iter().enumerate().map(describe).collect()
}

/// Returns the indices of the nodes that satisfy a predicate.
///
/// Several nodes may share one camera or light.
fn nodes_where(model: &Model, carries: impl Fn(&Node) -> bool) -> Value {
    let nodes = model.nodes.iter().enumerate().filter(|(_, node)| carries(node));
    nodes.map(|(at, _)| Value::from(at)).collect()
}
