//! Checks that `explain` reports the vectors' results for a point: clip space, the division and the
//! screen.

use crate::vectors::numbers::{assert_all_close, assert_close, parse_point, parse_point4};
use camera::ViewProjection;
use explain::{ApiConventions, TransformChain, explain_point};
use glam::DMat4;
use homog::{PixelConvention, Point, Projective};
use serde_json::Value;
use viewport::{DepthRange, Viewport};

/// Compares the explanation of a point with a vector. `forth` is the vector's projection; if `sign`
/// is −1, its w is negative in front of the eye. `viewport` is also from the vector.
pub fn check_explained(
    (camera, forth, sign): (camera::Camera, DMat4, f64),
    viewport: &Viewport,
    world: Point<homog::World>,
    out: &Value,
) -> Result<(), String> {
    let view_projection =
        ViewProjection { camera, view_to_clip: Projective::from_raw(forth * sign) };
    let size = (viewport.area().width() as u32, viewport.area().height() as u32);
    let chain = TransformChain::new(&view_projection, size, ApiConventions::Alberti)
        .map_err(|error| error.to_string())?;
    let report = explain_point(&chain, world).to_json();
    let clip = parse_point4(&json_item(&report, "clip"))?.map(|x| x * sign);
    assert_all_close("explained clip", &clip, &parse_point4(&out["clip"])?, 1e-11)?;
    assert_close(
        "explained distance",
        json_number(&report, "distance")?,
        json_number(out, "distance")?,
        1e-11,
    )?;
    if out["ndc"].is_null() {
        return Ok(());
    }
    assert_all_close(
        "explained ndc",
        &parse_point(&json_item(&report, "ndc"))?,
        &parse_point(&out["ndc"])?,
        1e-11,
    )?;
    let [x, y, depth] = parse_point(&json_item(&report, "screen"))?;
    let theirs = parse_point(&out["screen"])?;
    let height = viewport.area().height();
    let pixels = PixelConvention::IMAGE.convert_to(viewport.convention(), height);
    let ours = pixels.map_err(|error| error.to_string())?.transform_point(Point::new(x, y, 0.0));
    let longest = viewport.area().width().max(height);
    assert_close("explained x / size", ours.x() / longest, theirs[0] / longest, 1e-11)?;
    assert_close("explained y / size", ours.y() / longest, theirs[1] / longest, 1e-11)?;
    let z = DepthRange::ZERO_ONE.depth_to_ndc(depth);
    assert_close("explained depth", viewport.depth().ndc_to_depth(z), theirs[2], 1e-11)
}

/// Returns the item with this name from any step.
fn json_item(told: &Value, id: &str) -> Value {
    let steps = told["steps"].as_array().into_iter().flatten();
    let mut items = steps.flat_map(|step| step["items"].as_array().into_iter().flatten());
    items.find(|item| item["id"] == id).map_or(Value::Null, |item| item["value"].clone())
}

fn json_number(of: &Value, name: &str) -> Result<f64, String> {
    let value = if of["steps"].is_null() { of[name].clone() } else { json_item(of, name) };
    value.as_f64().ok_or_else(|| format!("missing number {name}"))
}
