//! Explains a triangle: how it is clipped, and its area and winding on the screen (CL-3, RA-1).
//!
//! Clipping cuts the triangle at each plane in turn (Sutherland and Hodgman, 1974), in homogeneous
//! coordinates before the divide. A vertex of the result is a blend of a, b and c; attributes are
//! interpolated with the same weights.
//!
//! ```text
//!       b                 3───4          up to nine vertices: each of the six
//!      ╱ ╲       ──►     ╱     ╲         planes can add one
//!     a───c             1───────2
//! ```

use super::plain_text::format_number;
use super::point::{describe_node, find_shown_primitive, model_point, model_step};
use super::transform_chain::{TransformChain, describe_outcode};
use super::{Explanation, Step};
use clip::{ClippedPolygon, clip_triangle};
use glam::DVec2;
use model::ModelInstance;
use model::Topology;

/// Follows a triangle of a model through every stage.
///
/// Vertices keep the labels a, b, c through the transforms; vertices of the clipped polygon are
/// numbered from 1. The area of the visible part is measured in square pixels, before sampling.
///
/// # Errors
/// Returns an error if the model does not show such a triangle. The message lists the shown nodes
/// or counts the primitives or triangles.
pub fn explain_triangle(
    chain: &TransformChain,
    model_instance: &ModelInstance,
    node: usize,
    primitive: usize,
    triangle_index: usize,
) -> Result<Explanation, String> {
    let (instance, shown) = find_shown_primitive(&model_instance.model, node, primitive)?;
    if shown.topology != Topology::Triangles {
        return Err(format!("primitive {primitive} has points or lines, not triangles"));
    }
    let triangles = shown.indices.as_chunks::<3>().0;
    let count = triangles.len();
    let indices = *triangles.get(triangle_index).ok_or_else(|| {
        let missing = format!("there is no triangle {triangle_index}");
        format!("{missing}: primitive {primitive} has {count}, numbered from 0")
    })?;
    let skinned = model_instance.model.skin_primitive(instance, shown);
    let mesh = indices.map(|at| model_point(skinned.positions[at as usize]));
    let to_world = skinned.to_model.then(model_instance.model_to_world);
    let world = mesh.map(|point| to_world.transform_point(point));
    let named = [("a", world[0]), ("b", world[1]), ("c", world[2])];
    let clip = world.map(|point| chain.world_to_clip().transform_point(point));
    let clipped = clip_triangle(clip, &chain.clip_volume());
    let mut steps = vec![
        model_step(
            model_instance,
            skinned.to_model,
            &[("a", mesh[0]), ("b", mesh[1]), ("c", mesh[2])],
        ),
        chain.camera_step(&named),
        chain.projection_step(&named),
        chain.outcode_step(&[("a", clip[0]), ("b", clip[1]), ("c", clip[2])]),
        clip_step(&clipped),
    ];
    let verdict = if clipped.is_empty() {
        format!("None of it is in the picture: {}.", rejection_reason(clipped.outcomes.rejected))
    } else {
        let names: Vec<String> = (1..=clipped.vertices().len()).map(|n| n.to_string()).collect();
        let corners: Vec<_> = names
            .iter()
            .zip(clipped.vertices())
            .map(|(name, at)| (name.as_str(), at.point))
            .collect();
        steps.extend(chain.screen_steps(&corners));
        let area = screen_area(chain, &clipped);
        steps.push(area_step(area));
        format!(
            "After clipping, it has {} corners and covers {} pixels.",
            clipped.vertices().len(),
            format_number(area.abs())
        )
    };
    let [a, b, c] = indices;
    let at = describe_node(&model_instance.model, node);
    let subject = format!(
        "Triangle {triangle_index} (vertices {a}, {b}, {c}) of primitive {primitive} at {at}"
    );
    Ok(Explanation { subject, steps, verdict })
}

/// Returns the reason why nothing of a triangle remains after clipping.
fn rejection_reason(rejected: clip::Outcode) -> String {
    if rejected.is_inside() {
        return "a corner is not a finite point".to_owned();
    }
    describe_outcode(rejected).replacen("outside", "it is rejected by", 1)
}

/// Returns the clipping step: the planes, and the clipped polygon's vertices with their weights.
///
/// The weights of a vertex sum to 1 and are affine in the world, since clipping comes before the
/// divide. The weights 1, 0, 0 mean the vertex a; two nonzero weights mean a point on an edge.
fn clip_step(left: &ClippedPolygon) -> Step {
    let mut step = Step::new("clip", "Clipping, in homogeneous space", Some("CL-3"))
        .with_item("cut", "cut by", plane_list(left.outcomes.clipped, "no plane"))
        .with_item("rejected", "rejected by", plane_list(left.outcomes.rejected, "no plane"));
    for (number, corner) in (1..).zip(left.vertices()) {
        step.add_item(
            format!("corner_{number}"),
            format!("corner {number}, clip"),
            <[f64; 4]>::from(corner.point),
        );
        step.add_item(
            format!("weights_{number}"),
            format!("corner {number}, weights of a, b, c"),
            corner.weights,
        );
    }
    step
}

/// Lists the planes of an outcode, or returns `none`.
fn plane_list(code: clip::Outcode, none: &str) -> String {
    if code.is_inside() {
        return none.to_owned();
    }
    let names: Vec<String> = code.planes().map(|plane| plane.to_string()).collect();
    names.join(", ")
}

/// Returns the signed area on the screen in pixels (shoelace formula): positive if the vertices run
/// clockwise, with y down.
///
/// A = ½ Σ (xᵢ yᵢ₊₁ − xᵢ₊₁ yᵢ). The clipped polygon is convex and has w > 0, so all vertices count.
fn screen_area(chain: &TransformChain, left: &ClippedPolygon) -> f64 {
    let corners: Vec<DVec2> = left
        .vertices()
        .iter()
        .filter_map(|corner| chain.project_to_screen(corner.point))
        .map(|screen| DVec2::new(screen.x(), screen.y()))
        .collect();
    let ring = corners.iter().zip(corners.iter().cycle().skip(1));
    0.5 * ring.map(|(p, q)| p.perp_dot(*q)).sum::<f64>()
}

/// Returns the step with the area and winding on the screen.
///
/// The direction is described by axes rather than as clockwise, because y points up in some
/// conventions and down in others.
fn area_step(area: f64) -> Step {
    let orientation = match area {
        area if area > 0.0 => "from +x toward +y",
        area if area < 0.0 => "from +y toward +x",
        _ => "not at all: it is seen edge-on",
    };
    Step::new("raster", "Coverage: the signed area", Some("RA-1"))
        .with_item("area", "area in pixels", area)
        .with_item("turn", "the corners turn", orientation)
}
