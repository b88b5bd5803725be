//! Explains a pixel: its fragments with weights and colors, and the transform chain of the nearest
//! surface point.
//!
//! The fragments come from the renderer itself ([`inspect_pixel`]): the pixel is rendered again
//! with a recording surface. Several fragments mean an edge in the pixel or translucent layers.
//!
//! ```text
//!  pixel (x, y) ─► fragments: primitive, barycentric weights, linear color ─► resolve ─► sRGB
//!                     └─ nearest surface point ─► camera, projection, outcodes, divide, viewport
//! ```
//! Weights are perspective-correct: they blend vertex attributes in the world, not on the screen.

use super::point::{describe_node, model_point};
use super::transform_chain::TransformChain;
use super::{Explanation, Step};
use homog::{Point, World};
use model::Topology;
use pipeline::render::{FragmentSource, PixelFragments, ShadedFragment, inspect_pixel};
use scene::Scene;

/// Explains the color of a pixel; x and y count from the upper left corner.
///
/// The nearest fragment is the one with the largest depth in the pipeline's own volume, independent
/// of the conventions of `chain`: reversed or flipped depth would otherwise select the farthest.
///
/// # Errors
/// Returns an error if there is no such pixel or if the picture has no shaded pixels.
pub fn explain_pixel(
    chain: &TransformChain,
    scene: &Scene,
    x: u32,
    y: u32,
) -> Result<Explanation, String> {
    let pixel =
        inspect_pixel(scene, x, y).map_err(|error| error.to_string())?.ok_or_else(|| {
            let (width, height) = (scene.image.width, scene.image.height);
            if x < width && y < height {
                "line drawings have no shaded pixels: choose another style".to_owned()
            } else {
                format!("the pixel ({x}, {y}) is outside the {width} x {height} picture")
            }
        })?;
    let mut steps = Vec::new();
    steps.extend(
        pixel.fragments.iter().enumerate().map(|(at, seen)| fragment_step(scene, at, seen)),
    );
    let positions = pixel.fragments.iter().filter_map(|seen| fragment_position(scene, seen));
    let nearest = positions
        .map(|position| (chain.nearness(position), position))
        .max_by(|(a, _), (b, _)| a.total_cmp(b))
        .map(|(_, position)| position);
    if let Some(position) = nearest {
        let clip = chain.world_to_clip().transform_point(position);
        steps.push(chain.camera_step(&[("", position)]));
        steps.push(chain.projection_step(&[("", position)]));
        steps.push(chain.outcode_step(&[("", clip)]));
        steps.extend(chain.screen_steps(&[("", clip)]));
    }
    steps.push(color_step(&pixel));
    let subject = format!("The pixel in column {x}, row {y} from the top");
    Ok(Explanation { subject, steps, verdict: pixel_verdict(&pixel) })
}

/// Returns the step for a fragment: source primitive, weights, color and world position.
///
/// A fragment without a source comes from the environment, backdrop or ground and has no position.
/// The color is linear RGB, premultiplied by alpha.
fn fragment_step(scene: &Scene, at: usize, seen: &ShadedFragment) -> Step {
    let title = match seen.source {
        Some(owner) => format!("Visible: {}", source_name(scene, owner)),
        None => "Visible: the background or ground".to_owned(),
    };
    let mut step =
        Step::new(if at == 0 { "fragment" } else { "other_fragment" }, title, Some("RA-1, IN-2"))
            .with_item("weights", "weights of the vertices", seen.weights.map(f64::from))
            .with_item("color", "linear color, premultiplied by alpha", seen.color.map(f64::from));
    if let Some(position) = fragment_position(scene, seen) {
        step.add_item("world", "position in the world", <[f64; 3]>::from(position));
    }
    step
}

/// Describes the primitive of a fragment in words.
///
/// `triangle 12 of primitive 0 at node 3 of model 0`: `--triangle` and `--node` accept these
/// indices, so a reader can ask about that triangle or node next.
fn source_name(scene: &Scene, owner: FragmentSource) -> String {
    let FragmentSource { model, node, primitive, element: item } = owner;
    let Some(model_instance) = scene.models.get(model) else { return String::new() };
    let what = match find_primitive(scene, owner).map(|primitive| primitive.topology) {
        Some(Topology::Points) => "point",
        Some(Topology::Lines) => "line",
        _ => "triangle",
    };
    let node = describe_node(&model_instance.model, node);
    format!(
        "{what} {item} of primitive {primitive} at {node} of model {model} `{}`",
        model_instance.model.name
    )
}

/// Finds the glTF primitive that a fragment comes from; `None` if an index is out of range.
fn find_primitive(scene: &Scene, owner: FragmentSource) -> Option<&model::Primitive> {
    let model = &scene.models.get(owner.model)?.model;
    let mesh = model.meshes.get(model.nodes.get(owner.node)?.mesh?)?;
    mesh.primitives.get(owner.primitive)
}

/// Returns the world position of a fragment: the triangle's vertices, blended by the weights.
///
/// p = w₀ p₀ + w₁ p₁ + w₂ p₂, with the vertices skinned and mapped to world space in f64. The
/// weights are f32, so the position is accurate to about 1e-7 of the triangle's size. Points and
/// lines have no barycentric weights and give `None`.
fn fragment_position(scene: &Scene, seen: &ShadedFragment) -> Option<Point<World>> {
    let owner = seen.source?;
    let model_instance = scene.models.get(owner.model)?;
    let primitive =
        find_primitive(scene, owner).filter(|shown| shown.topology == Topology::Triangles)?;
    let corners = primitive.indices.as_chunks::<3>().0.get(owner.element)?;
    let instance = model_instance.model.mesh_instances().find(|at| at.node == owner.node)?;
    let skinned = model_instance.model.skin_primitive(instance, primitive);
    let to_world = skinned.to_model.then(model_instance.model_to_world);
    let mut position = glam::DVec3::ZERO;
    for (corner, weight) in corners.iter().zip(seen.weights) {
        let corner = skinned.positions.get(*corner as usize)?;
        position += to_world.transform_point(model_point(*corner)).raw() * f64::from(weight);
    }
    Some(Point::from_raw(position))
}

/// Returns the step with the resolved color of the pixel.
///
/// Samples are averaged in linear light; an average of sRGB values would darken edges. The result
/// has 8 bits per channel and straight alpha, as in a PNG file.
fn color_step(makeup: &PixelFragments) -> Step {
    let [r, g, b, alpha] = makeup.color;
    Step::new("pixel", "The pixel: samples resolved in linear light, then sRGB", Some("RA-2"))
        .with_item("srgb", "red, green, blue, alpha (0 to 255)", makeup.color.map(f64::from))
        .with_item("hex", "in hexadecimal", format!("#{r:02x}{g:02x}{b:02x}, alpha {alpha}"))
}

/// States the result in a sentence.
///
/// Names the color in hexadecimal and the number of distinct fragments: more than one means an
/// antialiased edge or blending.
fn pixel_verdict(makeup: &PixelFragments) -> String {
    let [r, g, b, alpha] = makeup.color;
    let what = match makeup.fragments.len() {
        0 => "only the background is visible".to_owned(),
        1 => "one surface is visible".to_owned(),
        count => format!("{count} surfaces contribute to it"),
    };
    format!("The pixel is #{r:02x}{g:02x}{b:02x} with alpha {alpha}: {what}.")
}
