//! What `alberti info --json` tells of scenes, nodes, meshes, cameras and lights.

use super::json::{bounds, counts, short, shorts, topology};
use model::{
    CameraProjection, EdgeVisibility, LightKind, Mesh, Model, Node, Primitive, PrimitiveEdges,
    SceneRoots, VariantMaterial,
};
use serde_json::{Value, json};

pub(super) fn scenes(model: &Model) -> Vec<Value> {
    let describe = |scene: &SceneRoots| {
        let bounds = bounds(model.scene_bounds(scene));
        json!({"name": scene.name, "nodes": scene.nodes, "bounds": bounds})
    };
    model.scenes.iter().map(describe).collect()
}

pub(super) fn nodes(model: &Model) -> Vec<Value> {
    model.nodes.iter().map(node).collect()
}

fn node(node: &Node) -> Value {
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
        "weights": node.morph_weights.as_deref().map(shorts),
        "skin": node.skin,
        "camera": node.camera,
        "light": node.light,
    })
}

pub(super) fn meshes(model: &Model) -> Vec<Value> {
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
                "counts": counts(primitives.iter()),
                "weights": shorts(weights),
                "primitives": primitives.iter().map(primitive).collect::<Vec<_>>(),
            })
        })
        .collect()
}

fn primitive(primitive: &Primitive) -> Value {
    let variant = |of: &VariantMaterial| json!({"variant": of.variant, "material": of.material});
    json!({
        "topology": topology(primitive.topology),
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
        "edges": primitive.edges.as_deref().map(edges),
    })
}

fn edges(edges: &PrimitiveEdges) -> Value {
    let of_triangles = edges.visibility.iter().flat_map(|all| all.as_flattened());
    let count = |wanted: EdgeVisibility| of_triangles.clone().filter(|v| **v == wanted).count();
    json!({
        "hard": count(EdgeVisibility::Hard),
        "silhouette": count(EdgeVisibility::Silhouette),
        "lines": edges.lines.iter().map(|lines| lines.vertex_pairs.len()).sum::<usize>(),
        "material": edges.material,
    })
}

pub(super) fn cameras(model: &Model) -> Vec<Value> {
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
        value["nodes"] = carriers(model, |node| node.camera == Some(number));
        value
    };
    model.cameras.iter().enumerate().map(describe).collect()
}

pub(super) fn lights(model: &Model) -> Vec<Value> {
    let describe = |(number, light): (usize, &model::PunctualLight)| {
        let unit = if light.kind == LightKind::Directional { "lux" } else { "candela" };
        let mut value = json!({
            "name": light.name,
            "kind": light.kind.gltf_name(),
            "color": shorts(&light.color),
            "intensity": short(light.intensity),
            "unit": unit,
            "nodes": carriers(model, |node| node.light == Some(number)),
        });
        if let LightKind::Point { range } | LightKind::Spot { range, .. } = light.kind {
            value["range"] = short(range);
        }
        if let LightKind::Spot { inner_cone_angle: inner, outer_cone_angle: outer, .. } = light.kind
        {
            (value["inner_angle"], value["outer_angle"]) = (short(inner), short(outer));
        }
        value
    };
    model.lights.iter().enumerate().map(describe).collect()
}

/// The nodes that carry something.
fn carriers(model: &Model, carries: impl Fn(&Node) -> bool) -> Value {
    let nodes = model.nodes.iter().enumerate().filter(|(_, node)| carries(node));
    nodes.map(|(at, _)| Value::from(at)).collect()
}
