//! Captions: a line of text below a view, in a strip along the bottom of its picture.
//!
//! ```text
//!  ┌──────────────┐
//!  │              │   the view, as in a picture without the strip
//!  │              │
//!  ├┄┄┄┄┄┄┄┄┄┄┄┄┄┄┤
//!  │    Front     │   the strip, in the color of the background
//!  └──────────────┘
//! ```
//! The strip is part of the picture, so that pictures with and without captions have the same size,
//! and a caption never covers its subject.

use super::{ImageSpec, Origin};
use camera::ViewProjection;
use glam::{DMat4, DVec2};
use homog::{Clip, Projective};
use scene_file::PathStep::Field;
use scene_file::SceneError;

/// Resolves the caption of a view.
///
/// # Errors
/// Returns an error if its text is empty.
pub(super) fn resolve_caption(
    origin: &Origin,
    caption: Option<&String>,
) -> Result<Option<String>, SceneError> {
    match caption {
        Some(text) if text.trim().is_empty() => {
            let help = "write text such as \"Front\", or remove `caption`".to_owned();
            Err(origin.error_at(&[Field("caption")], "the caption has no text", Some(help)))
        }
        caption => Ok(caption.cloned()),
    }
}

impl ImageSpec {
    /// Returns the width and height in pixels of the part above the caption, which shows the view.
    pub(super) fn view_size(self) -> DVec2 {
        DVec2::new(self.width.into(), (self.height - self.caption_height).into())
    }

    /// Returns the center of the view in normalized device coordinates of the whole picture.
    pub(super) fn view_center(self) -> DVec2 {
        DVec2::new(0.0, f64::from(self.caption_height) / f64::from(self.height))
    }

    /// Returns the picture of only the view, without its caption.
    pub(super) const fn without_caption(self) -> Self {
        Self { height: self.height - self.caption_height, caption_height: 0, ..self }
    }

    /// Converts a view-projection for the part above the caption to one for the whole picture, so
    /// that the view still fills that part.
    pub(super) fn place_view(self, view: ViewProjection) -> ViewProjection {
        if self.caption_height == 0 {
            return view;
        }
        let height = self.view_size().y / f64::from(self.height);
        map_window(view, DVec2::new(1.0, height), self.view_center())
    }
}

/// Returns a view-projection with its normalized device coordinates scaled, then shifted.
pub(super) fn map_window(view: ViewProjection, scale: DVec2, shift: DVec2) -> ViewProjection {
    let map = DMat4::from_translation(shift.extend(0.0)) * DMat4::from_scale(scale.extend(1.0));
    let view_to_clip = view.view_to_clip.then(Projective::<Clip, Clip>::from_raw(map));
    ViewProjection { view_to_clip, ..view }
}
