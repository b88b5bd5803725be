//! A place of the world, or a vertex of a model, on its way to a pixel.

use super::chain::{Chain, planes};
use super::text::number;
use super::{Explanation, Step};
use homog::{Affine, Model as ModelSpace, Point, World};
use model::ModelInstance;
use model::{Instance, Model};

/// Tells the maps themselves, without anything that passes them.
#[must_use]
pub fn explain_chain(chain: &Chain) -> Explanation {
    let [_, screen] = chain.screen_steps(&[]);
    let steps = vec![chain.camera_step(&[]), chain.projection_step(&[]), screen];
    let verdict = "--point, --segment and --node follow something through them.".to_owned();
    Explanation {
        subject: "The chain of maps from the world to the screen".to_owned(),
        steps,
        verdict,
    }
}

/// Follows a place of the world through every stage.
#[must_use]
pub fn explain_place(chain: &Chain, place: Point<World>) -> Explanation {
    let [x, y, z] = <[f64; 3]>::from(place).map(number);
    through(chain, place, format!("The point ({x}, {y}, {z}) of the world"), Vec::new())
}

/// A vertex of a shown mesh.
#[derive(Clone, Copy, Debug)]
pub struct Vertex {
    /// The node's number in its model.
    pub node: usize,
    /// The primitive's number in the mesh of the node.
    pub primitive: usize,
    /// The vertex's number in the primitive.
    pub index: usize,
}

/// Follows a vertex of a model through every stage, as the model stands.
///
/// # Errors
/// If the model does not show such a vertex; the text says what there is.
pub fn explain_vertex(
    chain: &Chain,
    placed: &ModelInstance,
    vertex: Vertex,
) -> Result<Explanation, String> {
    let (instance, primitive) = shown_primitive(&placed.model, vertex.node, vertex.primitive)?;
    let posed = placed.model.posed(instance, primitive);
    let position = *posed.positions.get(vertex.index).ok_or_else(|| {
        let count = posed.positions.len();
        format!(
            "primitive {} has {count} vertices; there is no vertex {}",
            vertex.primitive, vertex.index
        )
    })?;
    let to_world = posed.to_model.then(placed.model_to_world);
    let mesh_point = to_point(position);
    let node = node_name(&placed.model, vertex.node);
    let world = to_world.point(mesh_point);
    let step = model_step(placed, posed.to_model, &[("", mesh_point)]);
    let subject = format!("Vertex {} of primitive {} at {node}", vertex.index, vertex.primitive);
    Ok(through(chain, world, subject, vec![step]))
}

fn through(
    chain: &Chain,
    place: Point<World>,
    subject: String,
    mut steps: Vec<Step>,
) -> Explanation {
    let clip = chain.world_to_clip().point(place);
    steps.push(chain.camera_step(&[("", place)]));
    steps.push(chain.projection_step(&[("", place)]));
    steps.push(chain.outcode_step(&[("", clip)]));
    steps.extend(chain.screen_steps(&[("", clip)]));
    let code = chain.volume().outcode(clip);
    let verdict = match chain.to_screen(clip) {
        Some(screen) if code.is_inside() => {
            let [x, y, depth] = <[f64; 3]>::from(screen).map(number);
            format!("It is inside the view volume and lands at ({x}, {y}) with depth {depth}.")
        }
        _ => format!("It is not in the picture: it is {}.", planes(code)),
    };
    Explanation { subject, steps, verdict }
}

/// The way of points of a mesh to the world.
pub(super) fn model_step(
    placed: &ModelInstance,
    to_model: Affine<ModelSpace, ModelSpace>,
    points: &[(&str, Point<ModelSpace>)],
) -> Step {
    let to_world = to_model.then(placed.model_to_world);
    let mut step = Step::new("model", "Model: from the mesh to the world", Some("HO-4, HO-5"))
        .with("node_to_model", "the nodes' transforms", to_model.rows())
        .with("model_to_world", "the model's place in the scene", placed.model_to_world.rows())
        .with("mesh_to_world", "the product", to_world.rows());
    for (name, point) in points {
        let label = |what: &str| {
            if name.is_empty() { what.to_owned() } else { format!("{what} of {name}") }
        };
        let id =
            |what: &str| if name.is_empty() { what.to_owned() } else { format!("{what}_{name}") };
        step.add(id("mesh"), label("in the mesh"), <[f64; 3]>::from(*point));
        step.add(id("world"), label("in the world"), <[f64; 3]>::from(to_world.point(*point)));
    }
    step
}

/// The first instance of a node, and one of the primitives it shows.
pub(super) fn shown_primitive(
    model: &Model,
    node: usize,
    primitive: usize,
) -> Result<(Instance, &model::Primitive), String> {
    let instance = model.shown_meshes().find(|instance| instance.node == node);
    let instance = instance.ok_or_else(|| {
        let shown: Vec<String> =
            model.shown_meshes().take(12).map(|at| node_name(model, at.node)).collect();
        format!("{} shows no mesh; these do: {}", node_name(model, node), shown.join(", "))
    })?;
    let mesh = model.nodes.get(node).and_then(|node| model.meshes.get(node.mesh?));
    let primitives = mesh.map_or(&[][..], |mesh| &mesh.primitives);
    let found = primitives.get(primitive).ok_or_else(|| {
        let name = node_name(model, node);
        format!("{name} shows {} primitives; there is no primitive {primitive}", primitives.len())
    })?;
    Ok((instance, found))
}

/// A node by its name and number.
pub(super) fn node_name(model: &Model, node: usize) -> String {
    match model.nodes.get(node).and_then(|node| node.name.as_deref()) {
        Some(name) => format!("node {node} `{name}`"),
        None => format!("node {node}"),
    }
}

pub(super) fn to_point(position: [f32; 3]) -> Point<ModelSpace> {
    Point::from(position.map(f64::from))
}
