//! Inputs for screen-space ambient occlusion: the nearest surface at each pixel of the picture.
//!
//! `shade::AmbientOcclusion` computes the occlusion. It reads the depths of neighboring pixels, so
//! it needs the depth buffer of the whole picture even if only a region is rendered.

use super::RenderError;
use super::context::RenderContext;
use super::image_tiles::tile_regions;
use super::primitive_assembly::assemble_scene;
use super::renderer::{FrameMemory, RenderBuffers};
use super::screen_transform::{ScreenTransform, volume_center};
use super::shadow_maps::DepthOnly;
use glam::{DMat4, DVec4};
use raster::SurfaceDepth;
use scene::Ground;
use shade::{AmbientOcclusion, ScreenSpace};

/// Occlusion buffers that are reused from picture to picture.
#[derive(Debug, Default)]
pub(super) struct OcclusionBuffers {
    /// The depth buffer.
    nearest: Vec<SurfaceDepth>,
    /// The occlusion of the last picture.
    pub(super) last: Option<AmbientOcclusion>,
}

/// Computes the ambient occlusion of a frame that holds the whole picture, or returns `None` if the
/// scene has no ambient occlusion.
///
/// `buffers` provides memory to reuse: a depth buffer and the last picture's occlusion.
///
/// # Errors
/// Returns an error if the picture is larger than the rasterizer's grid.
pub(super) fn compute_occlusion(
    context: &RenderContext<'_>,
    memory: &FrameMemory<'_>,
    buffers: &mut OcclusionBuffers,
) -> Result<Option<AmbientOcclusion>, RenderError> {
    let (scene, frame) = (context.scene, &memory.frame);
    let Some(radius) = scene.occlusion_radius else { return Ok(None) };
    let size @ [width, height] = context.image_size();
    if width > raster::MAX_SIDE || height > raster::MAX_SIDE {
        return Err(RenderError::OcclusionTooLarge);
    }
    let OcclusionBuffers { nearest, last } = buffers;
    // The buffer is cleared first, because `resize` keeps existing depths.
    nearest.clear();
    nearest.resize(width as usize * height as usize, SurfaceDepth::EMPTY);
    frame.surface_depths(&DepthOnly(&memory.draws), context.threads, nearest);
    let view = &scene.view_projection;
    let world_to_screen = ScreenTransform::new(view, width, height)?.world_to_screen();
    let offset = scene.image.samples.first_offset();
    if let Some(ground) = scene.ground {
        add_ground(ground, world_to_screen, offset, width as usize, nearest);
    }
    let origin = volume_center(view);
    let across = view.camera.u().raw() * radius;
    let viewer = view.viewer().into();
    let space = ScreenSpace::new(size, offset, world_to_screen, origin, viewer, across);
    let simd_level = frame.simd_level();
    Ok(Some(AmbientOcclusion::compute(nearest, space, simd_level, context.threads, last.take())))
}

/// Adds the ground to a depth buffer that lacks translucent surfaces. The ground occludes other
/// surfaces and is occluded by them.
fn add_ground(
    ground: Ground,
    world_to_screen: DMat4,
    [offset_x, offset_y]: [f32; 2],
    width: usize,
    nearest: &mut [SurfaceDepth],
) {
    let height = f64::from(ground.corners[0][1]);
    // Planes are transformed by the inverse transpose; depth is linear on the screen.
    let plane = world_to_screen.inverse().transpose() * DVec4::new(0.0, 1.0, 0.0, -height);
    let screen_to_world = world_to_screen.inverse();
    for (index, nearest) in nearest.iter_mut().enumerate() {
        let x = (index % width) as f64 + f64::from(offset_x);
        let y = (index / width) as f64 + f64::from(offset_y);
        let depth = -(plane.x * x + plane.y * y + plane.w) / plane.z;
        let is_ahead = screen_to_world.row(3).dot(DVec4::new(x, y, depth, 1.0)) > 0.0;
        if is_ahead && depth > 0.0 && depth < 1.0 && depth as f32 > nearest.depth {
            *nearest = SurfaceDepth { depth: depth as f32, ..SurfaceDepth::EMPTY };
        }
    }
}

/// Computes the ambient occlusion of the whole picture in a separate frame, for use when only a
/// region is rendered.
///
/// # Errors
/// Returns an error if the picture is larger than one image tile, or if the scene has too many
/// primitives.
pub(super) fn compute_full_occlusion(
    context: &RenderContext<'_>,
) -> Result<Option<AmbientOcclusion>, RenderError> {
    let image = context.scene.image;
    if context.scene.occlusion_radius.is_none() {
        return Ok(None);
    }
    let [whole] = tile_regions(image, image.pixel_rect())[..] else {
        return Err(RenderError::OcclusionTooLarge);
    };
    let memory = RenderBuffers::default().take_frame(context, whole)?;
    let memory = assemble_scene(context, memory)?;
    compute_occlusion(context, &memory, &mut OcclusionBuffers::default())
}
