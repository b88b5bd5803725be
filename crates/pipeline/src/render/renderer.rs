//! One picture after the other, in the memory of the first.

use super::RenderError;
use super::assemble::assemble;
use super::images::Images;
use super::occlusion::screen_space;
use super::shadows::ShadowMemory;
use super::textures::Textures;
use crate::color::SrgbEncoder;
use crate::scene::Scene;
use crate::shade::{Draw, DrawList, ScreenSpace, Shading, ShadowMap, Vertex};
use crate::{Cancel, Picture, Timings};
use raster::{Frame, Nearest};

/// Renders surfaces again and again: the same models from elsewhere, in other light, in another pose.
///
/// What the first picture has allocated the next ones use, so that but for lists of nodes and textures, for tangents, and for what
/// bends or changes its shape, nothing is allocated any more. The pictures do not depend on what was rendered before.
///
/// ```no_run
/// # use pipeline::{Origin, Picture, Renderer, Scene, Textures, Timings};
/// # let origin = Origin::bare_model("model.glb".as_ref());
/// let mut scene = Scene::resolve(&origin.0, &origin.1, &Default::default())?;
/// let models = scene.models.clone(); // they are shared, not copied
/// let textures = Textures::of(&models);
/// let (mut renderer, mut picture) = (Renderer::default(), Picture::default());
/// for step in 0..100 {
///     scene.image.background = [0.0, 0.0, 0.01 * step as f32, 1.0];
///     renderer.render(&scene, &textures, 2, &Timings::default(), &mut picture)?;
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Default)]
pub struct Renderer {
    frame: Option<Frame>,
    images: Images,
    /// No draws, but room for them.
    draws: Vec<Draw<'static>>,
    spare: Vec<Vec<Vertex>>,
    shadows: ShadowMemory,
    nearest: Vec<Nearest>,
    cancel: Cancel,
}

/// What a picture is put together in.
#[derive(Debug)]
pub(super) struct Memory<'a> {
    pub(super) frame: Frame,
    pub(super) draws: DrawList<'a>,
    pub(super) images: Images,
    /// Lists for what the vertices of draws carry.
    pub(super) spare: Vec<Vec<Vertex>>,
}

impl Renderer {
    /// The same renderer, whose pictures end early once `cancel` says so: with [`RenderError::Cancelled`], and a picture that is none.
    #[must_use]
    pub fn cancelled_by(self, cancel: Cancel) -> Self {
        Self { cancel, ..self }
    }

    /// Renders the surfaces of a scene with up to `threads` threads, whose number does not change the picture. `textures` are
    /// those of the scene's models.
    ///
    /// # Errors
    /// If the picture's size is out of range or the scene holds too much, or it was [cancelled](Self::cancelled_by).
    pub fn render(
        &mut self,
        scene: &Scene,
        textures: &Textures<'_>,
        threads: usize,
        timings: &Timings,
        picture: &mut Picture,
    ) -> Result<(), RenderError> {
        let image = scene.image;
        let shadows = || self.shadows.render(scene, textures, threads);
        if scene.lights.iter().any(|light| light.shadow().is_some()) {
            timings.measure("shadows", shadows)?;
        } else {
            self.shadows.clear();
        }
        let memory = self.lend(scene, threads)?;
        let memory = timings.measure("vertices", || assemble(scene, textures, threads, memory))?;
        let Memory { frame, draws, .. } = &memory;
        let nearest = std::mem::take(&mut self.nearest);
        let occlusion = screen_space(scene, frame, draws, threads, nearest)?;
        let shading = shading(scene, draws, frame, &self.shadows.maps, occlusion.as_ref());
        picture.resize(image.width, image.height);
        let encoder = SrgbEncoder::shared();
        timings.measure("pixels", || {
            frame.draw(&shading, image.background, threads, &mut picture.pixels, encoder);
        });
        self.nearest = occlusion.map(|space| space.nearest).unwrap_or_default();
        self.take_back(memory);
        if self.cancel.is_cancelled() { Err(RenderError::Cancelled) } else { Ok(()) }
    }

    /// The memory, with an empty frame for the scene's picture.
    pub(super) fn lend<'a>(
        &mut self,
        scene: &Scene,
        threads: usize,
    ) -> Result<Memory<'a>, RenderError> {
        let image = scene.image;
        let frame = match self.frame.take() {
            Some(mut frame) => {
                frame.restart(image.width, image.height, image.samples)?;
                frame
            }
            None => Frame::new(image.width, image.height, image.samples)?,
        };
        let draws = DrawList { draws: emptied(std::mem::take(&mut self.draws)) };
        let images = std::mem::take(&mut self.images);
        let spare = std::mem::take(&mut self.spare);
        let frame = frame.with_threads(threads).with_stop(self.cancel.flag());
        Ok(Memory { frame, draws, images, spare })
    }

    fn take_back(&mut self, memory: Memory<'_>) {
        let Memory { frame, mut draws, images, mut spare } = memory;
        // The first list that is asked for next time is the one of the first draw.
        spare.extend(draws.draws.drain(..).rev().map(|draw| draw.vertices));
        self.frame = Some(frame);
        self.images = images;
        self.draws = emptied(draws.draws);
        self.spare = spare;
    }
}

/// What the fragments of a frame are shaded with.
pub(super) fn shading<'a>(
    scene: &'a Scene,
    draws: &'a DrawList<'a>,
    frame: &Frame,
    shadows: &'a [Option<ShadowMap>],
    occlusion: Option<&'a ScreenSpace>,
) -> Shading<'a> {
    Shading {
        draws,
        lights: &scene.lights,
        shadows,
        occlusion,
        environment: scene.environment.as_deref(),
        develop: scene.develop,
        viewer: scene.shot.viewer(),
        instructions: frame.instructions(),
    }
}

/// The room of a list, for draws of other things.
fn emptied<'b>(mut draws: Vec<Draw<'_>>) -> Vec<Draw<'b>> {
    draws.clear();
    draws.into_iter().map_while(|_| None).collect()
}
