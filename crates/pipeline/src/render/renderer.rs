//! One picture after the other, in the memory of the first.

use super::RenderError;
use super::ambient_occlusion::{build_full_ssao_buffer, build_ssao_buffer};
use super::image_tiles::{ImageTile, TileRegion, tile_regions};
use super::mip_chains::Textures;
use super::primitive_assembly::assemble_scene;
use super::projected_mesh::ProjectedMesh;
use super::shadow_maps::ShadowMapRenderer;
use crate::scene::{Scene, Style};
use crate::{CancelToken, Picture, Timings};
use homog::PixelRect;
use raster::{Frame, SurfaceDepth};
use shade::Channel;
use shade::{
    AmbientOcclusion, Draw, DrawList, Shading, ShadingStyle, ShadowMap, StyledShading, Vertex,
};

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
    mesh: ProjectedMesh,
    /// No draws, but room for them.
    draws: Vec<Draw<'static>>,
    vertex_pool: Vec<Vec<Vertex>>,
    shadow_maps: ShadowMapRenderer,
    nearest_surfaces: Vec<SurfaceDepth>,
    cancel: CancelToken,
}

/// What a picture is put together in.
#[derive(Debug)]
pub(super) struct FrameMemory<'a> {
    pub(super) frame: Frame,
    /// The sheet of the picture that the frame is a part of.
    pub(super) tile: ImageTile,
    pub(super) draws: DrawList<'a>,
    pub(super) mesh: ProjectedMesh,
    /// Lists for what the vertices of draws carry.
    pub(super) vertex_pool: Vec<Vec<Vertex>>,
}

impl Renderer {
    /// The same renderer, whose pictures end early once `cancel` says so: with [`RenderError::Cancelled`], and a picture that is none.
    #[must_use]
    pub fn with_cancel(self, cancel: CancelToken) -> Self {
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
        let image_rect = scene.image.pixel_rect();
        self.render_region(scene, textures, image_rect, threads, timings, picture)
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
        let is_region = region != scene.image.pixel_rect();
        let full_ssao = || build_full_ssao_buffer(scene, textures, threads);
        let occlusion = if is_region { full_ssao()? } else { None };
        self.render_shadow_maps(scene, textures, threads, timings)?;
        self.render_tiles(scene, textures, region, threads, timings, occlusion.as_ref(), picture)
    }

    /// Makes the shadow maps of a scene, which every part of its picture is shaded with: they depend on the scene and on the size of
    /// the whole picture, and not on the part.
    pub(super) fn render_shadow_maps(
        &mut self,
        scene: &Scene,
        textures: &Textures<'_>,
        threads: usize,
        timings: &Timings,
    ) -> Result<(), RenderError> {
        if scene.lights.iter().any(|light| light.shadow().is_some()) {
            timings.measure("shadows", || self.shadow_maps.render_maps(scene, textures, threads))
        } else {
            self.shadow_maps.recycle_maps();
            Ok(())
        }
    }

    /// Renders a part with the shadow maps that [were made](Self::cast_shadows) of its scene, and the nearest surfaces of the whole
    /// picture, if they are needed and the region is a part of it.
    #[expect(clippy::too_many_arguments, reason = "a region, and all that drawing it depends on")]
    pub(super) fn render_tiles<C: Channel>(
        &mut self,
        scene: &Scene,
        textures: &Textures<'_>,
        region: PixelRect,
        threads: usize,
        timings: &Timings,
        occlusion: Option<&AmbientOcclusion>,
        picture: &mut Picture<C>,
    ) -> Result<(), RenderError> {
        super::image_tiles::validate_region(scene.image, region)?;
        picture.resize(region.width, region.height);
        let parts = tile_regions(scene.image, region);
        if let [part] = parts[..] {
            let pixels = &mut picture.pixels;
            self.render_tile(scene, textures, part, threads, timings, occlusion, pixels)?;
        } else {
            for part in parts {
                let mut patch = vec![[C::default(); 4]; part.pixel_count()];
                self.render_tile(scene, textures, part, threads, timings, occlusion, &mut patch)?;
                part.copy_into_region(&patch, region, &mut picture.pixels);
            }
        }
        if self.cancel.is_cancelled() { Err(RenderError::Cancelled) } else { Ok(()) }
    }

    #[expect(clippy::too_many_arguments, reason = "a part, and all that drawing it depends on")]
    fn render_tile<C: Channel>(
        &mut self,
        scene: &Scene,
        textures: &Textures<'_>,
        part: TileRegion,
        threads: usize,
        timings: &Timings,
        occlusion: Option<&AmbientOcclusion>,
        target: &mut [[C; 4]],
    ) -> Result<(), RenderError> {
        let memory = self.take_buffers(scene, part, threads)?;
        let memory =
            timings.measure("vertices", || assemble_scene(scene, textures, threads, memory))?;
        let FrameMemory { frame, draws, .. } = &memory;
        let own_ssao = match occlusion {
            Some(_) => None,
            None => {
                let nearest = std::mem::take(&mut self.nearest_surfaces);
                build_ssao_buffer(scene, frame, draws, threads, nearest)?
            }
        };
        let ssao = occlusion.or(own_ssao.as_ref());
        let shading = fragment_shading(scene, draws, frame, &self.shadow_maps.maps, ssao);
        let background = scene.image.background;
        timings.measure("pixels", || match &style_surface(scene, &shading) {
            Some(styled) => frame.draw(styled, background, threads, target, C::encoder()),
            None => frame.draw(&shading, background, threads, target, C::encoder()),
        });
        self.nearest_surfaces = own_ssao.map(|space| space.nearest).unwrap_or_default();
        self.recycle_buffers(memory);
        Ok(())
    }

    /// The memory, with an empty frame for a part of the scene's picture.
    pub(super) fn take_buffers<'a>(
        &mut self,
        scene: &Scene,
        part: TileRegion,
        threads: usize,
    ) -> Result<FrameMemory<'a>, RenderError> {
        let samples = scene.image.samples;
        let ([x, y], [width, height]) = (part.offset_in_tile(), part.size());
        let frame = match self.frame.take() {
            Some(mut frame) if [x, y] == [0, 0] => {
                frame.reset(width, height, samples)?;
                frame
            }
            _ => Frame::for_region(PixelRect { x, y, width, height }, samples)?,
        };
        let draws = DrawList { draws: recycle_draws(std::mem::take(&mut self.draws)) };
        let images = std::mem::take(&mut self.mesh);
        let spare = std::mem::take(&mut self.vertex_pool);
        let frame = frame.with_threads(threads).with_cancel_flag(self.cancel.stop_flag());
        Ok(FrameMemory { frame, tile: part.tile, draws, mesh: images, vertex_pool: spare })
    }

    fn recycle_buffers(&mut self, memory: FrameMemory<'_>) {
        let FrameMemory { frame, mut draws, mesh: images, vertex_pool: mut spare, .. } = memory;
        // The first list that is asked for next time is the one of the first draw.
        spare.extend(draws.draws.drain(..).rev().map(|draw| draw.vertices));
        self.frame = Some(frame);
        self.mesh = images;
        self.draws = recycle_draws(draws.draws);
        self.vertex_pool = spare;
    }
}

/// What the fragments of a frame are shaded with.
pub(super) fn fragment_shading<'a>(
    scene: &'a Scene,
    draws: &'a DrawList<'a>,
    frame: &Frame,
    shadows: &'a [Option<ShadowMap>],
    occlusion: Option<&'a AmbientOcclusion>,
) -> Shading<'a> {
    Shading {
        draws,
        backdrop: scene.backdrop.as_deref(),
        lights: &scene.lights,
        shadows,
        occlusion,
        environment: scene.environment.as_deref(),
        tone_mapper: scene.tone_mapper,
        viewer: scene.view_projection.viewer(),
        simd_level: frame.simd_level(),
    }
}

/// The surfaces of a style that looks otherwise than materials have it.
pub(super) fn style_surface<'a>(
    scene: &Scene,
    shading: &'a Shading<'a>,
) -> Option<StyledShading<'a>> {
    let camera = scene.view_projection.camera;
    let look = match scene.style {
        Style::Gouraud => ShadingStyle::Gouraud,
        Style::Clay => ShadingStyle::Clay,
        Style::Matcap => ShadingStyle::Matcap,
        Style::Normals => ShadingStyle::Normals,
        Style::Depth => {
            let world_to_view = camera.world_to_view();
            let (mut near, mut far) = (f64::INFINITY, f64::NEG_INFINITY);
            for point in scene.world_points() {
                let depth = -world_to_view.transform_point(point).z();
                (near, far) = (near.min(depth), far.max(depth));
            }
            // What is behind the eye is not seen.
            ShadingStyle::Depth { near: near.max(0.0) as f32, far: far as f32 }
        }
        Style::UvChecker => ShadingStyle::UvChecker,
        Style::Ids => ShadingStyle::Ids,
        Style::Toon => ShadingStyle::Toon,
        Style::XRay => ShadingStyle::XRay,
        Style::Shaded | Style::Flat | Style::Wireframe | Style::Lines(_) => return None,
    };
    let view = [camera.u(), camera.v(), camera.w()].map(|axis| axis.raw().as_vec3().to_array());
    let eye = camera.eye().raw().as_vec3().to_array();
    Some(StyledShading { shading, style: look, world_to_view: view, eye_position: eye })
}

/// The room of a list, for draws of other things.
fn recycle_draws<'b>(mut draws: Vec<Draw<'_>>) -> Vec<Draw<'b>> {
    draws.clear();
    draws.into_iter().map_while(|_| None).collect()
}
