//! Lint for section planes that cut nothing: all models are on one side.

use super::{Lint, Linter};
use homog::{Bounds, Point, World};
use scene_file::PathStep::{Field, Index};

/// Distances up to this fraction of the models' diagonal count as touching.
const TOUCHING: f64 = 1e-9;

/// Warns about sections that remove all models or touch none of them.
///
/// The planes' normals point to the half that is retained, so points at negative distances are
/// removed. Each plane is examined separately: planes that remove everything only in combination
/// are not detected.
pub(super) fn lint_idle_sections(adviser: &Linter<'_>) -> Vec<Lint> {
    if adviser.scene.sections.is_empty() {
        return Vec::new();
    }
    let points = adviser.scene.world_points();
    let Some(bounds) = Bounds::from_points(points.iter().copied()) else { return Vec::new() };
    // A plane flush with a face touches the models without cutting them.
    let tolerance = TOUCHING * bounds.diagonal();
    let mut advice = Vec::new();
    for (number, plane) in adviser.scene.sections.iter().enumerate() {
        let (least, most) = distance_range(plane, &points);
        let (code, message) = if most <= tolerance {
            (
                "section-removes-all",
                "this section removes everything: all models are on the side its normal points to",
            )
        } else if least >= -tolerance {
            (
                "section-misses",
                "this section cuts nothing: no model is on the side its normal points to",
            )
        } else {
            continue;
        };
        let [x, y, z] = bounds.center().raw().to_array();
        let help =
            format!("move it into the models, for example with point: ({x:.3}, {y:.3}, {z:.3})");
        let path = [Field("sections"), Index(number)];
        let error = adviser.origin.error_at(&path, message, Some(help));
        advice.push(Lint { code, error });
    }
    advice
}

/// Returns the smallest and largest signed distances of the points from a plane.
fn distance_range(plane: &homog::Plane<World>, points: &[Point<World>]) -> (f64, f64) {
    points
        .iter()
        .map(|&point| plane.evaluate(point))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), distance| {
            (least.min(distance), most.max(distance))
        })
}
