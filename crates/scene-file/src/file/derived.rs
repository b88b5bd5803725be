//! Values derived from a scene file without loading anything: image paths and the size of the view.

use super::{BackgroundFile, EnvironmentFile, SceneFile};

/// The height of the caption strip in pixels: 12 for the text, and the rest for margins above and
/// below.
const STRIP_HEIGHT: u32 = 28;
/// The strip takes up at most the picture's height divided by this number.
const LEAST_ROWS_PER_STRIP_ROW: u32 = 4;

impl SceneFile {
    /// Returns the paths of all environment and background images and of the sheet's title block,
    /// relative to the scene's folder.
    ///
    /// Viewports may have separate background images. The caller uses the list for access checks
    /// and to detect changed files.
    pub fn image_paths(&self) -> impl Iterator<Item = &str> {
        let own = self.viewports.iter().filter_map(|viewport| viewport.background.as_ref());
        let behind = own.chain(&self.image.background).filter_map(|background| match background {
            BackgroundFile::Picture { path, .. } => Some(path.as_str()),
            _ => None,
        });
        let around = match &self.environment {
            Some(EnvironmentFile::File { path, .. }) => Some(path.as_str()),
            _ => None,
        };
        let title_block = self.sheet.as_ref().and_then(|sheet| sheet.title_block.as_deref());
        around.into_iter().chain(behind).chain(title_block)
    }

    /// Returns the height of the caption strip in pixels, or 0 without a caption.
    #[must_use]
    pub fn caption_height(&self) -> u32 {
        let most = self.image.size.1 / LEAST_ROWS_PER_STRIP_ROW;
        if self.caption.is_some() { STRIP_HEIGHT.min(most) } else { 0 }
    }

    /// Returns the width and height in pixels of the part of the picture above the caption.
    #[must_use]
    pub fn view_size(&self) -> (u32, u32) {
        let (width, height) = self.image.size;
        (width, height - self.caption_height())
    }
}
