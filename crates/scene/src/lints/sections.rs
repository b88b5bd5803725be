//! Lint for section planes that cut nothing: all models are on one side.

use super::{Lint, Linter};
use clip::SectionPlane;
use homog::{Bounds, Point, World};
use scene_file::PathStep::{Field, Index};

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
    let mut advice = Vec::new();
    for (number, plane) in adviser.scene.sections.iter().enumerate() {
        // A plane flush with a face touches the models without cutting them.
        let section = SectionPlane::for_size(*plane, bounds.diagonal());
        let (least, most) = height_range(section, &points);
        let (code, message) = if most <= 0.0 {
            (
                "section-removes-all",
                "this section removes everything: all models are on the side its normal points to",
            )
        } else if least >= 0.0 {
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

/// Returns the smallest and largest heights of the points above a section plane.
fn height_range(section: SectionPlane<World>, points: &[Point<World>]) -> (f64, f64) {
    points
        .iter()
        .map(|&point| section.height(point))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), height| {
            (least.min(height), most.max(height))
        })
}
