//! Lints for stereo pairs: eyes with the same picture, and eyes too far apart for their pictures to
//! be fused.

use super::{Lint, Linter};
use homog::{Bounds, Point};
use scene_file::PathStep::Field;

/// Positions in the two pictures are treated as equal if they differ by less than this many pixels.
const LEAST_PARALLAX: f64 = 1.0;
/// Eyes farther apart than this fraction of the distance to an object cannot fuse its images,
/// because they would see it from directions 14° apart. The rule in stereography is a thirtieth.
const WIDEST_BASE: f64 = 0.25;

/// Warns about a stereo pair whose parallax varies by less than a pixel over all vertices: a flat
/// picture.
///
/// The parallax of a point is the distance from its left to its right image. If it were the same
/// for all points, the scene would look like a flat card in front of or behind the screen.
pub(super) fn lint_flat_stereo(adviser: &Linter<'_>) -> Option<Lint> {
    adviser.file.stereo.as_ref()?;
    let [left, right] = adviser.scene.insets.as_slice() else { return None };
    let eyes = [left, right].map(|eye| eye.scene.view_projection.world_to_clip());
    let width = f64::from(left.rect.width);
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for point in adviser.scene.world_points() {
        let images = eyes.map(|eye| eye.transform_point(point));
        // Points behind an eye have no image.
        if images.iter().any(|image| image.w() <= 0.0) {
            continue;
        }
        let [Some(left), Some(right)] = images.map(homog::HPoint::divide) else { continue };
        // Normalized device coordinates are 2 wide, hence the factor ½.
        let parallax = (right.x() - left.x()) * 0.5 * width;
        (least, most) = (least.min(parallax), most.max(parallax));
    }
    let depth = most - least;
    // Infinite if no point is in front of both eyes.
    if !depth.is_finite() || depth >= LEAST_PARALLAX {
        return None;
    }
    let message = format!(
        "the stereo pair shows no depth: the eyes' pictures differ by {depth:.2} pixels from the nearest to the farthest point"
    );
    let help = "set a larger eye_distance, or remove it to use a thirtieth of the convergence";
    let error = adviser.origin.error_at(&[Field("stereo")], message, Some(help.to_owned()));
    Some(Lint { code: "flat-stereo", error })
}

/// Warns about a stereo pair whose eyes are too far apart for the distance of the models. An
/// example is an eye distance of 65 in a scene in meters, meant as the 65 millimeters between human
/// eyes.
pub(super) fn lint_wide_stereo(adviser: &Linter<'_>) -> Option<Lint> {
    adviser.file.stereo.as_ref()?;
    let [left, right] = adviser.scene.insets.as_slice() else { return None };
    let eye_of = |scene: &crate::Scene| scene.view_projection.viewer().divide();
    let base = (eye_of(&right.scene)?.raw() - eye_of(&left.scene)?.raw()).length();
    let center = Bounds::from_points(adviser.scene.world_points())?.center();
    let camera = adviser.scene.view_projection.camera;
    let away = -camera.world_to_view().transform_point(Point::from_raw(center.raw())).z();
    if away <= 0.0 || base <= WIDEST_BASE * away {
        return None;
    }
    let message = format!(
        "the eyes are {base:.4} apart and the models {away:.4} away: the two pictures cannot be fused"
    );
    let help = format!(
        "lengths are in the scene's units, which are meters in glTF: remove eye_distance, or set it to {:.4}, a thirtieth of the distance",
        away / 30.0
    );
    let path = [Field("stereo"), Field("eye_distance")];
    let error = adviser.origin.error_at(&path, message, Some(help));
    Some(Lint { code: "wide-stereo", error })
}
