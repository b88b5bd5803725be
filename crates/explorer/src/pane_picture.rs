//! Pane pictures, rendered whole or in bands, with buffers that are reused.

use crate::ExplorerError;
use homog::PixelRect;
use pipeline::{Monitor, Picture, RenderContext, Renderer, Scene, Textures};
use scene::Style;
use std::sync::Arc;

/// The scene of a picture, and the monitor that can cancel its rendering.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drawn<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) textures: &'a Textures<'a>,
    pub(crate) monitor: &'a Arc<dyn Monitor>,
}

impl<'a> Drawn<'a> {
    fn context(self) -> RenderContext<'a> {
        RenderContext::new(self.scene, self.textures, thread_count()).with_monitor(self.monitor)
    }
}

/// The renderer of a pane and its last whole picture.
#[derive(Debug, Default)]
pub(crate) struct PanePicture {
    renderer: Renderer,
    /// The last whole picture, with the key of its state.
    whole: Option<(String, Picture)>,
}

impl PanePicture {
    /// Renders the whole picture of a scene. `key` identifies everything that the picture depends
    /// on.
    ///
    /// # Errors
    /// Returns an error if the picture cannot be rendered.
    pub(crate) fn whole(&mut self, key: &str, drawn: Drawn<'_>) -> Result<&Picture, ExplorerError> {
        let known = self.whole.as_ref().is_some_and(|(known, _)| known == key);
        if !known {
            let mut picture = self.whole.take().map_or_else(Picture::default, |(_, old)| old);
            self.renderer.render(&drawn.context(), &mut picture)?;
            self.whole = Some((key.to_owned(), picture));
        }
        let missing = || ExplorerError::new("cannot_render", "there is no picture", "try again");
        self.whole.as_ref().map(|(_, picture)| picture).ok_or_else(missing)
    }

    /// Renders some rows of a picture, with the same bytes as in the whole picture.
    ///
    /// A picture of surfaces is rendered band by band. Any other picture, such as one with lines,
    /// is rendered once as a whole, for all bands.
    ///
    /// # Errors
    /// Returns an error if the picture cannot be rendered.
    pub(crate) fn band(
        &mut self,
        key: &str,
        drawn: Drawn<'_>,
        [from, to]: [u32; 2],
    ) -> Result<Vec<u8>, ExplorerError> {
        let known = self.whole.as_ref().is_some_and(|(known, _)| known == key);
        if known || !renders_in_bands(drawn.scene) {
            let whole = self.whole(key, drawn)?;
            let width = whole.width as usize;
            let rows = from as usize * width..to as usize * width;
            return Ok(whole.pixels[rows].as_flattened().to_vec());
        }
        let width = drawn.scene.image.width;
        let region = PixelRect { x: 0, y: from, width, height: to - from };
        let context = drawn.context();
        let mut picture = Picture::default();
        self.renderer.prepare(&context)?.render_region(region, &mut picture)?;
        Ok(picture.pixels.as_flattened().to_vec())
    }
}

/// Whether only surfaces are drawn, so that a band costs only its share of the picture.
fn renders_in_bands(scene: &Scene) -> bool {
    let has_lines = matches!(scene.style, Style::Toon | Style::XRay);
    scene.style.draws_surfaces()
        && !has_lines
        && scene.overlays.is_empty()
        && scene.insets.is_empty()
        && scene.occlusion_radius.is_none()
}

/// Returns the number of threads to render with, which does not affect any answer.
pub(crate) fn thread_count() -> usize {
    std::thread::available_parallelism().map_or(1, Into::into)
}
