//! Lint for a ground plane that intersects the models.

use super::{Lint, Linter};
use homog::Bounds;
use scene_file::PathStep::Field;
use scene_file::file::GroundFile;

/// Models may sink into the ground by this fraction of their height.
const SUNK: f64 = 0.01;

/// Warns if the ground is above the lowest point of the models.
pub(super) fn lint_high_ground(adviser: &Linter<'_>) -> Option<Lint> {
    let Some(GroundFile::Shadow { height: Some(height), .. }) = adviser.file.ground else {
        return None;
    };
    let bounds = Bounds::from_points(adviser.scene.world_points())?;
    let (height, bottom) = (height.value(), bounds.min().y());
    if height <= bottom + SUNK * bounds.size().raw().y {
        return None;
    }
    let message = format!(
        "the ground at height {height} is above the lowest point of the models, at {bottom:.4}"
    );
    let help = "remove `height`, so that the ground touches the models".to_owned();
    let path = [Field("ground"), Field("height")];
    let error = adviser.origin.error_at(&path, message, Some(help));
    Some(Lint { code: "ground-above-models", error })
}
