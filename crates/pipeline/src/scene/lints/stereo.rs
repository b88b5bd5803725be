//! Lint of stereo pairs without depth: eyes that see the same.

use super::{Lint, Linter};
use crate::scene::syntax::PathStep::Field;

/// Positions in the two pictures that differ by less than this many pixels look equal.
const LEAST_PARALLAX: f64 = 1.0;

/// A stereo pair whose parallax varies by less than a pixel over all vertices: a flat picture.
///
/// The parallax of a point is the distance between its images in both eyes' pictures. Were it the
/// same for all points, the scene would stand before or behind the screen, as flat as a card.
pub(super) fn lint_flat_stereo(adviser: &Linter<'_>) -> Option<Lint> {
    adviser.file.stereo.as_ref()?;
    let [left, right] = adviser.scene.insets.as_slice() else { return None };
    let eyes = [left, right].map(|eye| eye.scene.view_projection.world_to_clip());
    let width = f64::from(left.rect.width);
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for point in adviser.scene.world_points() {
        let images = eyes.map(|eye| eye.transform_point(point));
        if images.iter().any(|image| image.w() <= 0.0) {
            continue;
        }
        let [Some(left), Some(right)] = images.map(homog::HPoint::divide) else { continue };
        let parallax = (right.x() - left.x()) * 0.5 * width;
        (least, most) = (least.min(parallax), most.max(parallax));
    }
    let depth = most - least;
    if !depth.is_finite() || depth >= LEAST_PARALLAX {
        return None;
    }
    let message = format!(
        "the stereo pair shows no depth: the eyes' pictures differ by {depth:.2} pixels from the nearest to the farthest point"
    );
    let help = "set a larger eye_distance, or leave it out: a thirtieth of the convergence";
    let error = adviser.origin.error_at(&[Field("stereo")], message, Some(help.to_owned()));
    Some(Lint { code: "flat-stereo", error })
}
