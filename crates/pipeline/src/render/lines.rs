//! Line drawings of a scene: from the models to the page that every output writes.

use super::RenderError;
use crate::Timings;
use crate::color::SrgbEncoder;
use crate::drawing::{self, Ink, LineLook, Page};
use crate::scene::{Scene, Style};

/// The line drawing of a scene on a page of the picture's size, 96 pixels to the inch. Styles that show surfaces have their
/// hidden lines removed.
///
/// The number of threads does not change it.
///
/// # Errors
/// As [`render`](crate::render()).
pub fn draw(scene: &Scene, threads: usize, timings: &Timings) -> Result<Page, RenderError> {
    let look = scene.style.line_look();
    let drawing = timings.measure("lines", || drawing::draw(scene, &look.options(), threads))?;
    let page = || {
        let mut page = drawing.to_page(&look, &scene.title(), paper(scene.image.background));
        page.layers.extend(drawing::overlays(scene));
        page
    };
    Ok(timings.measure("chains", page))
}

impl Style {
    /// How its lines look.
    #[must_use]
    pub const fn line_look(self) -> LineLook {
        match self {
            Self::Shaded | Self::Flat => LineLook::REMOVED,
            Self::Wireframe => LineLook::WIREFRAME,
            Self::Lines(look) => look,
        }
    }
}

/// The background as a colour of paper; `None` if it is transparent.
fn paper(background: [f32; 4]) -> Option<Ink> {
    let [r, g, b, alpha] = SrgbEncoder::shared().pixel(background);
    (alpha == 255).then_some([r, g, b])
}
