//! `explain` tells of a point what the vectors have computed: clip space, the divide, the screen.

use crate::numbers::{close, close_all, point, point4};
use camera::ViewProjection;
use glam::DMat4;
use homog::{Point, Projective};
use pipeline::explain::{Chain, Conventions, explain_place};
use serde_json::Value;
use viewport::{DepthRange, PixelConvention, Viewport};

/// Holds the explanation of a point against a vector. `forth` is the projection in the chapter's convention, with w < 0 in
/// front of the eye if `sign` is −1; `viewport` is the one of the vector.
pub fn explained(
    (camera, forth, sign): (camera::Camera, DMat4, f64),
    viewport: &Viewport,
    world: Point<homog::World>,
    out: &Value,
) -> Result<(), String> {
    let view_projection =
        ViewProjection { camera, view_to_clip: Projective::from_raw(forth * sign) };
    let size = (viewport.area().width() as u32, viewport.area().height() as u32);
    let chain = Chain::of(&view_projection, size, Conventions::Alberti)
        .map_err(|error| error.to_string())?;
    let told = explain_place(&chain, world).to_json();
    let clip = point4(&item(&told, "clip"))?.map(|x| x * sign);
    close_all("explained clip", &clip, &point4(&out["clip"])?, 1e-11)?;
    close("explained distance", number(&told, "distance")?, number(out, "distance")?, 1e-11)?;
    if out["ndc"].is_null() {
        return Ok(());
    }
    close_all("explained ndc", &point(&item(&told, "ndc"))?, &point(&out["ndc"])?, 1e-11)?;
    let [x, y, depth] = point(&item(&told, "screen"))?;
    let theirs = point(&out["screen"])?;
    let height = viewport.area().height();
    let pixels = PixelConvention::IMAGE.to(viewport.convention(), height);
    let ours = pixels.map_err(|error| error.to_string())?.point(Point::new(x, y, 0.0));
    let longest = viewport.area().width().max(height);
    close("explained x / size", ours.x() / longest, theirs[0] / longest, 1e-11)?;
    close("explained y / size", ours.y() / longest, theirs[1] / longest, 1e-11)?;
    let z = DepthRange::ZERO_ONE.undo(depth);
    close("explained depth", viewport.depth().of(z), theirs[2], 1e-11)
}

/// The item of this name, in whichever step it is.
fn item(told: &Value, id: &str) -> Value {
    let steps = told["steps"].as_array().into_iter().flatten();
    let mut items = steps.flat_map(|step| step["items"].as_array().into_iter().flatten());
    items.find(|item| item["id"] == id).map_or(Value::Null, |item| item["value"].clone())
}

fn number(of: &Value, name: &str) -> Result<f64, String> {
    let found = if of["steps"].is_null() { of[name].clone() } else { item(of, name) };
    found.as_f64().ok_or_else(|| format!("there is no number {name}"))
}
