//! A triangle: what each plane cut, what polygon is left, which side it shows (CL-3, RA-1).

use super::chain::{Chain, planes};
use super::place::{model_step, node_name, shown_primitive, to_point};
use super::text::number;
use super::{Explanation, Step};
use clip::{ClippedPolygon, clip_triangle};
use glam::DVec2;
use model::ModelInstance;
use model::Topology;

/// Follows a triangle of a model through every stage.
///
/// # Errors
/// If the model does not show such a triangle; the text says what there is.
pub fn explain_triangle(
    chain: &Chain,
    placed: &ModelInstance,
    node: usize,
    primitive: usize,
    number_of: usize,
) -> Result<Explanation, String> {
    let (instance, shown) = shown_primitive(&placed.model, node, primitive)?;
    if shown.topology != Topology::Triangles {
        return Err(format!("primitive {primitive} has no triangles, but points or lines"));
    }
    let triangles = shown.indices.as_chunks::<3>().0;
    let indices = *triangles.get(number_of).ok_or_else(|| {
        let count = triangles.len();
        format!("primitive {primitive} has {count} triangles; there is no triangle {number_of}")
    })?;
    let posed = placed.model.posed(instance, shown);
    let mesh = indices.map(|at| to_point(posed.positions[at as usize]));
    let to_world = posed.to_model.then(placed.model_to_world);
    let world = mesh.map(|point| to_world.point(point));
    let named = [("a", world[0]), ("b", world[1]), ("c", world[2])];
    let clip = world.map(|point| chain.world_to_clip().point(point));
    let left = clip_triangle(clip, &chain.volume());
    let mut steps = vec![
        model_step(placed, posed.to_model, &[("a", mesh[0]), ("b", mesh[1]), ("c", mesh[2])]),
        chain.camera_step(&named),
        chain.projection_step(&named),
        chain.outcode_step(&[("a", clip[0]), ("b", clip[1]), ("c", clip[2])]),
        clip_step(&left),
    ];
    let verdict = if left.is_empty() {
        format!("None of it is in the picture: {}.", planes(left.fates.rejected))
    } else {
        let names: Vec<String> = (1..=left.vertices().len()).map(|n| n.to_string()).collect();
        let corners: Vec<_> =
            names.iter().zip(left.vertices()).map(|(name, at)| (name.as_str(), at.point)).collect();
        steps.extend(chain.screen_steps(&corners));
        let area = screen_area(chain, &left);
        steps.push(area_step(area));
        format!(
            "{} corners are left; it covers {} pixels.",
            left.vertices().len(),
            number(area.abs())
        )
    };
    let [a, b, c] = indices;
    let at = node_name(&placed.model, node);
    let subject =
        format!("Triangle {number_of} (vertices {a}, {b}, {c}) of primitive {primitive} at {at}");
    Ok(Explanation { subject, steps, verdict })
}

fn clip_step(left: &ClippedPolygon) -> Step {
    let mut step = Step::new("clip", "Clipping, in homogeneous space", Some("CL-3"))
        .with("cut", "cut by", planes_or(left.fates.cut, "no plane"))
        .with("rejected", "rejected by", planes_or(left.fates.rejected, "no plane"));
    for (number, corner) in (1..).zip(left.vertices()) {
        step.add(
            format!("corner_{number}"),
            format!("corner {number}, clip"),
            <[f64; 4]>::from(corner.point),
        );
        step.add(
            format!("weights_{number}"),
            format!("corner {number}, of a, b, c"),
            corner.weights,
        );
    }
    step
}

fn planes_or(code: clip::Outcode, none: &str) -> String {
    if code.is_inside() {
        return none.to_owned();
    }
    let names: Vec<String> = code.planes().map(|plane| plane.to_string()).collect();
    names.join(", ")
}

/// The area on the screen in pixels: positive if the corners run clockwise as the picture is seen with y down.
fn screen_area(chain: &Chain, left: &ClippedPolygon) -> f64 {
    let corners: Vec<DVec2> = left
        .vertices()
        .iter()
        .filter_map(|corner| chain.to_screen(corner.point))
        .map(|screen| DVec2::new(screen.x(), screen.y()))
        .collect();
    let ring = corners.iter().zip(corners.iter().cycle().skip(1));
    0.5 * ring.map(|(p, q)| p.perp_dot(*q)).sum::<f64>()
}

fn area_step(area: f64) -> Step {
    let turn = match area {
        area if area > 0.0 => "from +x towards +y",
        area if area < 0.0 => "from +y towards +x",
        _ => "not at all: it is seen edge-on",
    };
    Step::new("raster", "Coverage: the signed area", Some("RA-1"))
        .with("area", "area in pixels", area)
        .with("turn", "its corners turn", turn)
}
