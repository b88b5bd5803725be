//! The wireframe style: every edge once, hidden or not, clipped before the divide (PL-2).

use super::RenderError;
use super::stage::Stage;
use crate::model::{Posed, Primitive, Topology};
use crate::scene::Scene;

/// The width of lines in pixels.
pub(super) const LINE_WIDTH: f32 = 1.25;

/// A line of the screen, its ends in pixels.
pub(super) type Segment = [(f32, f32); 2];

/// A dark or a light ink (linear, multiplied by alpha), whichever is farther from the background.
pub(super) fn ink([r, g, b, alpha]: [f32; 4]) -> [f32; 4] {
    let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b + (1.0 - alpha);
    if luminance > 0.18 { [0.012, 0.018, 0.03, 1.0] } else { [0.85, 0.88, 0.92, 1.0] }
}

/// The visible parts of all edges of a scene.
pub(super) fn segments(scene: &Scene) -> Result<Vec<Segment>, RenderError> {
    let stage = Stage::of(scene)?;
    let mut segments = Vec::new();
    for placed in &scene.models {
        for (instance, primitive) in placed.model.shown_primitives() {
            let Posed { positions, to_model, .. } = placed.model.posed(instance, primitive);
            let points = stage.to_clip(&positions, to_model.then(placed.model_to_world));
            let visible = edges(primitive, &positions).into_iter().filter_map(|[a, b]| {
                let seen = stage.visible_segment([points[a as usize], points[b as usize]])?;
                let screen = |point| {
                    stage.to_screen(point).map(|screen| (screen.x() as f32, screen.y() as f32))
                };
                Some([screen(seen.start)?, screen(seen.end)?])
            });
            segments.extend(visible);
        }
    }
    Ok(segments)
}

/// The edges of a primitive, as pairs of vertices. An edge that two triangles share is there once, also where the
/// triangles have vertices of their own at the same places.
fn edges(primitive: &Primitive, positions: &[[f32; 3]]) -> Vec<[u32; 2]> {
    let sides: Vec<[u32; 2]> = match primitive.topology {
        Topology::Points => return Vec::new(),
        Topology::Lines => primitive.indices.as_chunks::<2>().0.to_vec(),
        Topology::Triangles => {
            let triangles = primitive.indices.as_chunks::<3>().0;
            triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect()
        }
    };
    // −0 and 0 are the same place; adding 0 makes them the same bits.
    let key =
        |vertex: u32| positions[vertex as usize].map(|coordinate| (coordinate + 0.0).to_bits());
    let mut keyed: Vec<_> =
        sides
            .into_iter()
            .map(|[a, b]| {
                if key(a) <= key(b) {
                    ([key(a), key(b)], [a, b])
                } else {
                    ([key(b), key(a)], [b, a])
                }
            })
            .collect();
    keyed.sort_unstable();
    keyed.dedup_by_key(|(places, _)| *places);
    keyed.into_iter().map(|(_, edge)| edge).collect()
}
