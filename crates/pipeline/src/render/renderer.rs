//! One picture after the other, in the memory of the first.

use super::RenderError;
use super::assemble::assemble;
use super::images::Images;
use super::occlusion::{screen_space, whole_screen_space};
use super::region::{PartOfSheet, Sheet, sheets};
use super::shadows::ShadowMemory;
use super::textures::Textures;
use crate::scene::{Scene, Style};
use crate::{Cancel, Picture, Timings};
use homog::PixelRect;
use raster::{Frame, Nearest};
use shade::Channel;
use shade::{Draw, DrawList, Look, ScreenSpace, Shading, ShadowMap, Styled, Vertex};

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
/// let (mut renderer, mut picture) = (Renderer::default(), Picture::<u8>::default());
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
    /// The sheet of the picture that the frame is a part of.
    pub(super) sheet: Sheet,
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
    pub fn render<C: Channel>(
        &mut self,
        scene: &Scene,
        textures: &Textures<'_>,
        threads: usize,
        timings: &Timings,
        picture: &mut Picture<C>,
    ) -> Result<(), RenderError> {
        let whole = scene.image.rect();
        self.render_region(scene, textures, whole, threads, timings, picture)
    }

    /// Renders a part of the picture of a scene. Its pixels are those that the whole picture has there, bit for bit.
    ///
    /// # Errors
    /// If the region is empty, too large, or not in the picture, or the scene holds too much, or it was
    /// [cancelled](Self::cancelled_by).
    pub fn render_region<C: Channel>(
        &mut self,
        scene: &Scene,
        textures: &Textures<'_>,
        region: PixelRect,
        threads: usize,
        timings: &Timings,
        picture: &mut Picture<C>,
    ) -> Result<(), RenderError> {
        let is_part = region != scene.image.rect();
        let whole = || whole_screen_space(scene, textures, threads);
        let occlusion = if is_part { whole()? } else { None };
        self.cast_shadows(scene, textures, threads, timings)?;
        self.render_part(scene, textures, region, threads, timings, occlusion.as_ref(), picture)
    }

    /// Makes the shadow maps of a scene, which every part of its picture is shaded with: they depend on the scene and on the size of
    /// the whole picture, and not on the part.
    pub(super) fn cast_shadows(
        &mut self,
        scene: &Scene,
        textures: &Textures<'_>,
        threads: usize,
        timings: &Timings,
    ) -> Result<(), RenderError> {
        if scene.lights.iter().any(|light| light.shadow().is_some()) {
            timings.measure("shadows", || self.shadows.render(scene, textures, threads))
        } else {
            self.shadows.clear();
            Ok(())
        }
    }

    /// Renders a part with the shadow maps that [were made](Self::cast_shadows) of its scene, and the nearest surfaces of the whole
    /// picture, if they are needed and the region is a part of it.
    #[expect(clippy::too_many_arguments, reason = "a region, and all that drawing it depends on")]
    pub(super) fn render_part<C: Channel>(
        &mut self,
        scene: &Scene,
        textures: &Textures<'_>,
        region: PixelRect,
        threads: usize,
        timings: &Timings,
        occlusion: Option<&ScreenSpace>,
        picture: &mut Picture<C>,
    ) -> Result<(), RenderError> {
        super::region::check_region(scene.image, region)?;
        picture.resize(region.width, region.height);
        let parts = sheets(scene.image, region);
        if let [part] = parts[..] {
            let pixels = &mut picture.pixels;
            self.draw_part(scene, textures, part, threads, timings, occlusion, pixels)?;
        } else {
            for part in parts {
                let mut patch = vec![[C::default(); 4]; part.area()];
                self.draw_part(scene, textures, part, threads, timings, occlusion, &mut patch)?;
                part.put(&patch, region, &mut picture.pixels);
            }
        }
        if self.cancel.is_cancelled() { Err(RenderError::Cancelled) } else { Ok(()) }
    }

    #[expect(clippy::too_many_arguments, reason = "a part, and all that drawing it depends on")]
    fn draw_part<C: Channel>(
        &mut self,
        scene: &Scene,
        textures: &Textures<'_>,
        part: PartOfSheet,
        threads: usize,
        timings: &Timings,
        occlusion: Option<&ScreenSpace>,
        target: &mut [[C; 4]],
    ) -> Result<(), RenderError> {
        let memory = self.lend(scene, part, threads)?;
        let memory = timings.measure("vertices", || assemble(scene, textures, threads, memory))?;
        let Memory { frame, draws, .. } = &memory;
        let own = match occlusion {
            Some(_) => None,
            None => {
                let nearest = std::mem::take(&mut self.nearest);
                screen_space(scene, frame, draws, threads, nearest)?
            }
        };
        let space = occlusion.or(own.as_ref());
        let shading = shading(scene, draws, frame, &self.shadows.maps, space);
        let background = scene.image.background;
        timings.measure("pixels", || match &styled(scene, &shading) {
            Some(styled) => frame.draw(styled, background, threads, target, C::encoder()),
            None => frame.draw(&shading, background, threads, target, C::encoder()),
        });
        self.nearest = own.map(|space| space.nearest).unwrap_or_default();
        self.take_back(memory);
        Ok(())
    }

    /// The memory, with an empty frame for a part of the scene's picture.
    pub(super) fn lend<'a>(
        &mut self,
        scene: &Scene,
        part: PartOfSheet,
        threads: usize,
    ) -> Result<Memory<'a>, RenderError> {
        let samples = scene.image.samples;
        let ([x, y], [width, height]) = (part.corner(), part.size());
        let frame = match self.frame.take() {
            Some(mut frame) if [x, y] == [0, 0] => {
                frame.restart(width, height, samples)?;
                frame
            }
            _ => Frame::part([x, y], [width, height], samples)?,
        };
        let draws = DrawList { draws: emptied(std::mem::take(&mut self.draws)) };
        let images = std::mem::take(&mut self.images);
        let spare = std::mem::take(&mut self.spare);
        let frame = frame.with_threads(threads).with_stop(self.cancel.flag());
        Ok(Memory { frame, sheet: part.sheet, draws, images, spare })
    }

    fn take_back(&mut self, memory: Memory<'_>) {
        let Memory { frame, mut draws, images, mut spare, .. } = memory;
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
        painting: scene.painting.as_deref(),
        lights: &scene.lights,
        shadows,
        occlusion,
        environment: scene.environment.as_deref(),
        develop: scene.develop,
        viewer: scene.view_projection.viewer(),
        instructions: frame.instructions(),
    }
}

/// The surfaces of a style that looks otherwise than materials have it.
pub(super) fn styled<'a>(scene: &Scene, shading: &'a Shading<'a>) -> Option<Styled<'a>> {
    let camera = scene.view_projection.camera;
    let look = match scene.style {
        Style::Gouraud => Look::Gouraud,
        Style::Clay => Look::Clay,
        Style::Matcap => Look::Matcap,
        Style::Normals => Look::Normals,
        Style::Depth => {
            let world_to_view = camera.world_to_view();
            let (mut near, mut far) = (f64::INFINITY, f64::NEG_INFINITY);
            for point in scene.world_points() {
                let depth = -world_to_view.point(point).z();
                (near, far) = (near.min(depth), far.max(depth));
            }
            // What is behind the eye is not seen.
            Look::Depth { near: near.max(0.0) as f32, far: far as f32 }
        }
        Style::UvChecker => Look::UvChecker,
        Style::Ids => Look::Ids,
        Style::Toon => Look::Toon,
        Style::XRay => Look::XRay,
        Style::Shaded | Style::Flat | Style::Wireframe | Style::Lines(_) => return None,
    };
    let view = [camera.u(), camera.v(), camera.w()].map(|axis| axis.raw().as_vec3().to_array());
    let eye = camera.eye().raw().as_vec3().to_array();
    Some(Styled { shading, look, view, eye })
}

/// The room of a list, for draws of other things.
fn emptied<'b>(mut draws: Vec<Draw<'_>>) -> Vec<Draw<'b>> {
    draws.clear();
    draws.into_iter().map_while(|_| None).collect()
}
