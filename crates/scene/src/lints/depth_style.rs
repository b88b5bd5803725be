//! Lint for depth pictures whose near parts are as white as the background.

use super::Lint;
use crate::Origin;
use scene_file::PathStep::Field;
use scene_file::SceneFile;
use scene_file::file::{BackgroundFile, StyleFile};

/// A background is white if all three bytes of its color are at least this.
const WHITE: u8 = 0xd0;

/// Warns about the style `Depth`, white for near surfaces, over a white background.
pub(super) fn lint_white_background(origin: &Origin, file: &SceneFile) -> Option<Lint> {
    let Some(BackgroundFile::Color(color)) = &file.image.background else { return None };
    if file.style != StyleFile::Depth || color.0.iter().any(|channel| *channel < WHITE) {
        return None;
    }
    let message = "the style Depth draws near surfaces white, and this background is white too";
    let help = "choose a dark background: background: Color(\"black\")".to_owned();
    let error = origin.error_at(&[Field("image"), Field("background")], message, Some(help));
    Some(Lint { code: "depth-on-white", error })
}
