//! `pick`: explains the color of a pixel and its position in the world.

use crate::ExplorerError;
use explain::{ApiConventions, Explanation, ItemValue, TransformChain, explain_pixel};
use homog::{Point, World};
use pipeline::Scene;
use scene::Style;
use serde_json::{Value as Json, json};

/// Explains a pixel of a picture, counted from the upper left corner, and returns the nearest
/// surface point.
///
/// # Errors
/// Returns an error if the picture has no such pixel.
pub(crate) fn pick_json(
    scene: &Scene,
    conventions: ApiConventions,
    [x, y]: [u32; 2],
) -> Result<Json, ExplorerError> {
    let inset = scene.insets.iter().rev().find(|inset| {
        let rect = inset.rect;
        (rect.x..rect.x + rect.width).contains(&x) && (rect.y..rect.y + rect.height).contains(&y)
    });
    let (scene, [x, y]) = match inset {
        Some(inset) => (&inset.scene, [x - inset.rect.x, y - inset.rect.y]),
        None => (scene, [x, y]),
    };
    // A line style draws no surfaces, but the request is about a surface.
    let mut surfaces = scene.clone();
    if !scene.style.draws_surfaces() {
        surfaces.style = Style::Flat;
    }
    let image = surfaces.image;
    let height = image.height - image.caption_height;
    let failed = |message: String| {
        ExplorerError::new("nothing_there", message, "click a pixel in the picture")
    };
    let chain = TransformChain::new(&surfaces.view_projection, (image.width, height), conventions)
        .map_err(|error| failed(error.to_string()))?;
    let explanation = explain_pixel(&chain, &surfaces, x, y).map_err(failed)?;
    let position = nearest_position(&explanation, &surfaces);
    Ok(json!({
        "position": position.map(<[f64; 3]>::from),
        "explanation": explanation.to_json(),
    }))
}

/// Returns the nearest surface point of a pixel.
fn nearest_position(explanation: &Explanation, scene: &Scene) -> Option<Point<World>> {
    let fragments = explanation.steps.iter().filter(|step| step.id.ends_with("fragment"));
    let items = fragments.flat_map(|step| &step.items).filter(|item| item.id == "world");
    let points = items.filter_map(|item| match &item.value {
        ItemValue::Numbers(numbers) => Some(Point::from(<[f64; 3]>::try_from(&numbers[..]).ok()?)),
        _ => None,
    });
    let world_to_clip = scene.view_projection.world_to_clip();
    let nearness = |point: &Point<World>| {
        world_to_clip.transform_point(*point).divide().map_or(f64::NEG_INFINITY, Point::z)
    };
    points.max_by(|a, b| nearness(a).total_cmp(&nearness(b)))
}
