//! The renderer, which draws scenes one after another and reuses its memory.

use super::RenderError;
use super::ambient_occlusion::OcclusionBuffers;
use super::context::RenderContext;
use super::image_tiles::{ImageTile, TileRegion, validate_region};
use super::prepared_scene::PreparedScene;
use super::projected_mesh::ProjectedMesh;
use super::shadow_maps::ShadowMapRenderer;
use crate::Picture;
use crate::cancel::{CancelOnly, PartMonitor};
use drawing::Warning;
use homog::PixelRect;
use raster::Frame;
use shade::{Draw, DrawList, FrameChannel, Vertex};
use std::sync::Arc;

/// Renders whole pictures: surfaces or lines, outlines, overlays and insets.
///
/// Single pictures, batches, frame sequences and pictures rendered in bands all use this renderer.
/// A second picture reuses the buffers of the first: rendering surfaces then allocates only lists
/// of nodes and textures, tangents, and skinned or morphed vertices. A picture does not depend on
/// the pictures rendered before it.
///
/// ```no_run
/// # use pipeline::{Origin, Picture, RenderContext, Renderer, Scene, Textures};
/// # let origin = Origin::from_model_path("model.glb".as_ref());
/// let mut scene = Scene::resolve(&origin.0, &origin.1, &Default::default())?;
/// let models = scene.models.clone(); // shared, not copied
/// let textures = Textures::for_models(&models);
/// let (mut renderer, mut picture) = (Renderer::default(), Picture::<u8>::default());
/// for step in 0..100 {
///     scene.image.background = [0.0, 0.0, 0.01 * step as f32, 1.0];
///     renderer.render(&RenderContext::new(&scene, &textures, 2), &mut picture)?;
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Default)]
pub struct Renderer {
    /// The buffers of the picture without its insets.
    pub(super) buffers: RenderBuffers,
    /// A renderer for each inset, in order.
    pub(super) insets: Vec<Self>,
}

impl Renderer {
    /// Renders a whole picture and returns the warnings about missing parts, without duplicates;
    /// most pictures have none. The picture is resized to the scene's image size.
    ///
    /// ```
    /// # use pipeline::scene::file::{CameraFile, LightFile};
    /// # use pipeline::Scene;
    /// # let scene = Scene::builder()
    /// #     .mesh([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]], [0, 1, 2])
    /// #     .camera(CameraFile::look_at([0.0, 0.0, 4.0], [0.0; 3]))
    /// #     .light(LightFile::directional([0.0, 0.0, -1.0], 2.0)?)
    /// #     .size(64, 48)
    /// #     .build()?;
    /// use pipeline::{Picture, RenderContext, Renderer, Textures};
    ///
    /// let textures = Textures::for_scene(&scene);
    /// let context = RenderContext::new(&scene, &textures, 2);
    /// let mut picture = Picture::<u16>::default(); // 16 bits per channel
    /// let warnings = Renderer::default().render(&context, &mut picture)?;
    /// assert!(warnings.is_empty());
    /// assert_eq!(picture.pixels.len(), 64 * 48);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if the picture's size is out of range, if the scene has too many
    /// primitives, or if rendering was canceled.
    pub fn render<C: FrameChannel>(
        &mut self,
        context: &RenderContext<'_>,
        picture: &mut Picture<C>,
    ) -> Result<Vec<Warning>, RenderError> {
        let image_rect = context.scene.image.pixel_rect();
        validate_region(context.scene.image, image_rect)?;
        let mut prepared = self.prepare(context)?;
        prepared.render_region(image_rect, picture)?;
        Ok(prepared.into_warnings())
    }

    /// Renders a whole picture with 8 bits per channel, and returns a PNG file and the warnings
    /// about missing parts.
    ///
    /// # Errors
    /// Returns the same errors as [`render`](Self::render).
    pub fn render_png(
        &mut self,
        context: &RenderContext<'_>,
    ) -> Result<(Vec<u8>, Vec<Warning>), RenderError> {
        let mut picture = Picture::<u8>::default();
        let warnings = self.render(context, &mut picture)?;
        Ok((picture.to_png(), warnings))
    }

    /// Computes the parts shared by all regions of a picture: the page of a line drawing and the
    /// layers of outlines and overlays. Shadow maps and occlusion are computed with the first
    /// region that needs them.
    ///
    /// # Errors
    /// Returns an error if the lines cannot be drawn.
    pub fn prepare<'a>(
        &'a mut self,
        context: &RenderContext<'a>,
    ) -> Result<PreparedScene<'a>, RenderError> {
        PreparedScene::new(self, *context)
    }
}

/// Buffers that are reused from picture to picture.
#[derive(Debug, Default)]
pub(super) struct RenderBuffers {
    /// The rasterizer's frame; `None` before the first picture and after an error.
    frame: Option<Frame>,
    /// Vertices of one draw call.
    mesh: ProjectedMesh,
    /// Always empty; retained for its capacity.
    draws: Vec<Draw<'static>>,
    /// Vertex lists of the last picture's draw calls.
    vertex_pool: Vec<Vec<Vertex>>,
    /// The shadow maps of the current scene and their memory.
    pub(super) shadow_maps: ShadowMapRenderer,
    /// The buffers for screen-space ambient occlusion.
    pub(super) occlusion: OcclusionBuffers,
}

/// The frame of one image tile during assembly: visibility buffer, draw calls and scratch space.
#[derive(Debug)]
pub(super) struct FrameMemory<'a> {
    /// The rasterizer's triangle and visibility buffers.
    pub(super) frame: Frame,
    /// The image tile that the frame covers entirely or partly.
    pub(super) tile: ImageTile,
    /// The draw calls so far, by ascending primitive id.
    pub(super) draws: DrawList<'a>,
    /// The vertices of the current draw call.
    pub(super) mesh: ProjectedMesh,
    /// Vertex lists for later draw calls.
    pub(super) vertex_pool: Vec<Vec<Vertex>>,
}

impl FrameMemory<'_> {
    /// Returns this frame with an optional monitor that receives its progress.
    pub(super) fn with_monitor(self, monitor: Option<PartMonitor>) -> Self {
        match monitor {
            Some(monitor) => Self { frame: self.frame.with_monitor(Arc::new(monitor)), ..self },
            None => self,
        }
    }
}

impl RenderBuffers {
    /// Takes the buffers and an empty frame for a region of a tile.
    ///
    /// A frame that does not begin at its tile's corner is newly allocated, because only
    /// [`Frame::for_region`] supports an offset.
    pub(super) fn take_frame<'a>(
        &mut self,
        context: &RenderContext<'_>,
        region: TileRegion,
    ) -> Result<FrameMemory<'a>, RenderError> {
        let samples = context.scene.image.samples;
        let ([x, y], [width, height]) = (region.offset_in_tile(), region.size());
        let frame = match self.frame.take() {
            Some(mut frame) if [x, y] == [0, 0] => {
                frame.reset(width, height, samples)?;
                frame
            }
            _ => Frame::for_region(PixelRect { x, y, width, height }, samples)?,
        };
        let frame = frame.with_threads(context.threads);
        // This monitor can only cancel. A monitor that receives progress may replace it later.
        let monitor = context.monitor.map(|monitor| CancelOnly(Arc::clone(monitor)));
        Ok(FrameMemory {
            frame: with_monitor(frame, monitor),
            tile: region.tile,
            draws: DrawList { draws: retype_empty_draws(std::mem::take(&mut self.draws)) },
            mesh: std::mem::take(&mut self.mesh),
            vertex_pool: std::mem::take(&mut self.vertex_pool),
        })
    }

    /// Takes back the buffers of a finished frame for reuse.
    pub(super) fn recycle_frame(&mut self, memory: FrameMemory<'_>) {
        let FrameMemory { frame, mut draws, mesh, mut vertex_pool, .. } = memory;
        // Reversed, so that the first draw call of the next picture gets its own list back, which
        // has the right capacity if the scene is the same.
        vertex_pool.extend(draws.draws.drain(..).rev().map(|draw| draw.vertices));
        self.frame = Some(frame);
        self.mesh = mesh;
        self.draws = retype_empty_draws(draws.draws);
        self.vertex_pool = vertex_pool;
    }
}

/// Empties a list and reuses its capacity for draws with another lifetime. In-place collection
/// reuses the allocation of `into_iter` if the item types have the same layout.
fn retype_empty_draws<'b>(mut draws: Vec<Draw<'_>>) -> Vec<Draw<'b>> {
    draws.clear();
    draws.into_iter().map_while(|_| None).collect()
}

/// Attaches a monitor, if any, to a frame.
fn with_monitor(frame: Frame, monitor: Option<CancelOnly>) -> Frame {
    match monitor {
        Some(monitor) => frame.with_monitor(Arc::new(monitor)),
        None => frame,
    }
}
