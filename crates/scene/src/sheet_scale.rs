//! Scales of sheets and their views.

use super::Origin;
use scene_file::PathStep::{self, Field};
use scene_file::SceneError;
use viewport::DrawingScale;

/// The path of the sheet's scale in a scene file.
pub(super) const SCALE_PATH: [PathStep<'static>; 2] = [Field("sheet"), Field("scale")];

/// Returns the scale as a ratio of lengths on paper to lengths on the object.
pub(super) fn resolve_scale(
    origin: &Origin,
    scale: (u32, u32),
    path: &[PathStep<'_>],
) -> Result<DrawingScale, SceneError> {
    let (paper, thing) = scale;
    DrawingScale::new(paper, thing).map_err(|error| {
        let help = "write (1, 50) for 1:50".to_owned();
        origin.error_at(path, error.to_string(), Some(help))
    })
}
