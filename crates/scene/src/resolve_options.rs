//! Resolution options, which are set by the caller and not by the scene file.

use super::Origin;
use import::ImportOptions;
use scene_file::PathStep::Field;
use scene_file::{SceneError, SceneFile};

/// The maximum number of pixels that a scene may request: 16,384 x 16,384.
const MAX_PIXELS: u64 = 1 << 28;

/// Options for resolving a scene.
#[derive(Clone, Debug, Default)]
pub struct ResolveOptions {
    /// Import options for models. Paths in a scene file may lead out of its folder into the folders
    /// that `allow_outside` lists.
    pub import: ImportOptions,
    /// Whether the picture may have more than 2²⁸ pixels. Set this only for sizes that a person
    /// chose, because one line in a scene file is enough to request hours of work.
    pub allow_large_picture: bool,
    /// Whether lines are drawn without work limits, so that they are exact even where hundreds of
    /// surfaces overlap.
    pub unlimited_lines: bool,
}

impl ResolveOptions {
    /// Returns the default options, with these import options.
    #[must_use]
    pub fn with_import(import: ImportOptions) -> Self {
        Self { import, ..Self::default() }
    }

    /// Rejects a picture of more than [`MAX_PIXELS`], unless larger pictures are allowed.
    pub(super) fn check_pixels(&self, origin: &Origin, file: &SceneFile) -> Result<(), SceneError> {
        let (width, height) = file.image.size;
        // Longer sides have a separate error.
        let is_possible = width.max(height) <= crate::MAX_IMAGE_SIDE;
        if self.allow_large_picture
            || !is_possible
            || u64::from(width) * u64::from(height) <= MAX_PIXELS
        {
            return Ok(());
        }
        let message = format!(
            "the picture has {width} x {height} pixels; a scene may request at most {MAX_PIXELS}"
        );
        let help = format!("`--size {width}x{height}` on the command line renders it anyway");
        Err(origin.error_at(&[Field("image"), Field("size")], message, Some(help)))
    }
}
