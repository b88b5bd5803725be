//! Depth plane lints: near and far planes that clip models, and near planes that waste depth
//! resolution.

use super::{Lint, Linter};
use files::counted;
use scene_file::PathStep::{Field, Index};
use scene_file::file::{ProjectionFile, ViewFile};

/// A near plane is wasteful if the nearest vertex is this many times farther away. Resolution at a
/// distance is inversely proportional to the near distance, so about two decimal digits are lost.
const WASTEFUL_DEPTH_RATIO: f64 = 100.0;

/// Warns about models that are partly visible and are cut by the near or far plane within the
/// window.
///
/// Vertices that other planes also reject are not counted: the sides of the picture may cut off
/// parts of a model, but depth planes rarely should.
pub(super) fn lint_depth_clipping(adviser: &Linter<'_>) -> Vec<Lint> {
    let mut advice = Vec::new();
    let models = adviser.survey_models().into_iter();
    for (_, instance, survey) in models.filter(|(_, _, survey)| survey.inside > 0) {
        let sides = [("near", survey.before_near), ("far", survey.behind_far)];
        for (plane, vertices) in sides.into_iter().filter(|(_, vertices)| *vertices > 0) {
            let vertices = counted(vertices, "vertex", "vertices");
            let message = format!(
                "the {plane} plane cuts off {vertices} of {}",
                adviser.model_name(instance)
            );
            let (near, far) = survey.depth_range().unwrap_or_default();
            let help = if plane == "near" {
                format!("it begins {near:.4} in front of the eye: set `near` to less than that")
            } else {
                format!("it ends {far:.4} in front of the eye: remove `far`, or set it to more")
            };
            let fault = adviser.origin.error_at(&plane_path(adviser, plane), message, Some(help));
            let code = if plane == "near" { "cut-by-near" } else { "cut-by-far" };
            advice.push(Lint { code, error: fault });
        }
    }
    advice
}

/// Warns about a perspective whose near plane is far in front of everything. Such a plane wastes
/// depth resolution on empty space, since most depth steps are just beyond the near plane (ZP-1).
///
/// There is only one warning per scene, with the distance of the nearest vertex. The suggested near
/// plane is 1% closer.
pub(super) fn lint_depth_range(adviser: &Linter<'_>) -> Option<Lint> {
    let near = near_distance(adviser)?;
    let spans = adviser.surveys.iter().filter_map(super::VisibilitySurvey::depth_range);
    let nearest = spans.map(|(nearest, _)| nearest).fold(f64::INFINITY, f64::min);
    if !nearest.is_finite() || nearest < WASTEFUL_DEPTH_RATIO * near {
        return None;
    }
    let times = nearest / near;
    let message = format!(
        "the near plane at {near} is {times:.0} times closer than the nearest surface, at {nearest:.4}, which wastes depth precision"
    );
    let help = format!("remove `near`, or set it to {:.4}", 0.99 * nearest);
    let fault = adviser.origin.error_at(&plane_path(adviser, "near"), message, Some(help));
    Some(Lint { code: "wasteful-depth-range", error: fault })
}

/// Returns the distance of the near plane, if the projection is a perspective that looks straight
/// ahead.
///
/// It is read from the matrix: on the near plane of the chapter's volume z_clip = w. With the rows
/// (…, z, d) and (0, 0, −1, 0) and a point at distance n ahead, −z n + d = n, so n = d / (1 + z).
fn near_distance(adviser: &Linter<'_>) -> Option<f64> {
    let rows = adviser.scene.view_projection.view_to_clip.rows();
    let [.., [_, _, z, depth], last] = rows;
    // Where z = w: depth - z·n = n.
    (last == [0.0, 0.0, -1.0, 0.0]).then(|| depth / (1.0 + z))
}

/// Returns the path of the value to underline: the plane's own field, the model's camera, or the
/// whole camera if the planes are automatic.
fn plane_path<'a>(adviser: &Linter<'_>, plane: &'a str) -> Vec<scene_file::PathStep<'a>> {
    let given = matches!(
        adviser.file.camera.projection,
        Some(
            ProjectionFile::Perspective { .. }
                | ProjectionFile::Orthographic { .. }
                | ProjectionFile::Frustum { .. }
                | ProjectionFile::ApexMovedFrustum { .. }
                | ProjectionFile::Intrinsics { .. }
        )
    );
    match adviser.file.camera.view {
        _ if given => vec![Field("camera"), Field("projection"), Field(plane)],
        ViewFile::FromModel(_) => vec![Field("camera"), Field("view"), Index(0)],
        _ => vec![Field("camera")],
    }
}
