//! Explains a world point or a mesh vertex: all transforms up to its pixel.
//!
//! ```text
//!  mesh ─nodes─► model ─scene─► world ─camera─► view ─projection─► clip ─÷ w─► NDC ─► pixel
//! ```
//! A vertex is explained in the model's current pose, skinned and morphed as in the scene.

use super::plain_text::format_number;
use super::transform_chain::{TransformChain, describe_outcode};
use super::{Explanation, Step};
use homog::{Affine, Model as ModelSpace, Point, World};
use model::ModelInstance;
use model::{MeshInstance, Model};

/// Explains the transforms themselves, without a point.
///
/// The camera, projection and viewport matrices are all that a program needs for the projection.
#[must_use]
pub fn explain_transforms(chain: &TransformChain) -> Explanation {
    let [_, screen] = chain.screen_steps(&[]);
    let steps = vec![chain.camera_step(&[]), chain.projection_step(&[]), screen];
    let verdict =
        "Use --point, --segment or --node to trace a subject through the chain.".to_owned();
    Explanation { subject: "The transform chain from world to screen".to_owned(), steps, verdict }
}

/// Follows a world point through every stage.
///
/// Coordinates are world coordinates, in the scene's units.
#[must_use]
pub fn explain_point(chain: &TransformChain, point: Point<World>) -> Explanation {
    let [x, y, z] = <[f64; 3]>::from(point).map(format_number);
    explain_world_point(
        chain,
        point,
        format!("The point ({x}, {y}, {z}) in world space"),
        Vec::new(),
    )
}

/// The indices of a mesh vertex.
#[derive(Clone, Copy, Debug)]
pub struct VertexRef {
    /// The index of the node in its model.
    pub node: usize,
    /// The index of the primitive in the node's mesh.
    pub primitive: usize,
    /// The index of the vertex in the primitive.
    pub index: usize,
}

/// Follows a vertex of a model through every stage, in the model's current pose.
///
/// The order is morph targets, skinning, node transform and model transform, as glTF specifies.
///
/// # Errors
/// Returns an error if the model does not show such a vertex.
pub fn explain_vertex(
    chain: &TransformChain,
    model_instance: &ModelInstance,
    vertex: VertexRef,
) -> Result<Explanation, String> {
    let (instance, primitive) =
        find_shown_primitive(&model_instance.model, vertex.node, vertex.primitive)?;
    let skinned = model_instance.model.skin_primitive(instance, primitive);
    let position = *skinned.positions.get(vertex.index).ok_or_else(|| {
        let count = skinned.positions.len();
        format!(
            "there is no vertex {}: primitive {} has {count}, numbered from 0",
            vertex.index, vertex.primitive
        )
    })?;
    let to_world = skinned.to_model.then(model_instance.model_to_world);
    let mesh_point = model_point(position);
    let node = describe_node(&model_instance.model, vertex.node);
    let world = to_world.transform_point(mesh_point);
    let step = model_step(model_instance, skinned.to_model, &[("", mesh_point)]);
    let subject = format!("Vertex {} of primitive {} at {node}", vertex.index, vertex.primitive);
    Ok(explain_world_point(chain, world, subject, vec![step]))
}

/// Explains a world point, and puts the steps that led to it first.
///
/// The verdict is positive only if the outcode is 0 and w is not 0. The outcode is tested instead
/// of the NDC, because after the divide a point behind the eye can appear inside the image.
fn explain_world_point(
    chain: &TransformChain,
    point: Point<World>,
    subject: String,
    mut steps: Vec<Step>,
) -> Explanation {
    let clip = chain.world_to_clip().transform_point(point);
    steps.push(chain.camera_step(&[("", point)]));
    steps.push(chain.projection_step(&[("", point)]));
    steps.push(chain.outcode_step(&[("", clip)]));
    steps.extend(chain.screen_steps(&[("", clip)]));
    let code = chain.clip_volume().outcode(clip);
    let verdict = match chain.project_to_screen(clip) {
        Some(screen) if code.is_inside() => {
            let [x, y, depth] = <[f64; 3]>::from(screen).map(format_number);
            format!(
                "It is inside the view volume and maps to pixel position ({x}, {y}) with depth {depth}."
            )
        }
        _ => format!("It is not in the picture: it is {}.", describe_outcode(code)),
    };
    Explanation { subject, steps, verdict }
}

/// Returns the step with the model transform from mesh to world, for labeled points.
///
/// `to_model` is the accumulated node transform, or the identity for a skinned mesh: its joints
/// already map to model space. The product is applied in one multiplication.
pub(super) fn model_step(
    model_instance: &ModelInstance,
    to_model: Affine<ModelSpace, ModelSpace>,
    points: &[(&str, Point<ModelSpace>)],
) -> Step {
    let to_world = to_model.then(model_instance.model_to_world);
    let mut step = Step::new("model", "Model: from the mesh to the world", Some("HO-4, HO-5"))
        .with_item("node_to_model", "node transforms", to_model.rows())
        .with_item(
            "model_to_world",
            "the model's transform in the scene",
            model_instance.model_to_world.rows(),
        )
        .with_item("mesh_to_world", "the product", to_world.rows());
    for (name, point) in points {
        let label = |what: &str| {
            if name.is_empty() { what.to_owned() } else { format!("{what} of {name}") }
        };
        let id =
            |what: &str| if name.is_empty() { what.to_owned() } else { format!("{what}_{name}") };
        step.add_item(id("mesh"), label("in the mesh"), <[f64; 3]>::from(*point));
        step.add_item(
            id("world"),
            label("in the world"),
            <[f64; 3]>::from(to_world.transform_point(*point)),
        );
    }
    step
}

/// Finds the first instance of a node's mesh, and one of its primitives.
///
/// A node outside the drawn scene has no instance.
///
/// # Errors
/// Returns an error if either does not exist. The message lists up to twelve nodes that have an
/// instance, or counts the primitives.
pub(super) fn find_shown_primitive(
    model: &Model,
    node: usize,
    primitive: usize,
) -> Result<(MeshInstance, &model::Primitive), String> {
    let instance = model.mesh_instances().find(|instance| instance.node == node);
    let instance = instance.ok_or_else(|| {
        let shown: Vec<String> =
            model.mesh_instances().take(12).map(|at| describe_node(model, at.node)).collect();
        let name = describe_node(model, node);
        format!("{name} does not show a mesh; these nodes do: {}", shown.join(", "))
    })?;
    let mesh = model.nodes.get(node).and_then(|node| model.meshes.get(node.mesh?));
    let primitives = mesh.map_or(&[][..], |mesh| &mesh.primitives);
    let primitive = primitives.get(primitive).ok_or_else(|| {
        let (name, count) = (describe_node(model, node), primitives.len());
        format!("there is no primitive {primitive}: {name} shows {count}, numbered from 0")
    })?;
    Ok((instance, primitive))
}

/// Describes a node by index and name.
pub(super) fn describe_node(model: &Model, node: usize) -> String {
    match model.nodes.get(node).and_then(|node| node.name.as_deref()) {
        Some(name) => format!("node {node} `{name}`"),
        None => format!("node {node}"),
    }
}

/// Returns a vertex position in f64.
///
/// The conversion is exact; everything after it is computed in f64.
pub(super) fn model_point(position: [f32; 3]) -> Point<ModelSpace> {
    Point::from(position.map(f64::from))
}
