//! Inputs of screen-space ambient occlusion: the nearest surface of each pixel of the picture.
//!
//! The occlusion itself is `shade::AmbientOcclusion`; it reads depths of neighboring pixels, and so
//! needs the depth buffer of the whole picture even where a region of it is rendered.

use super::RenderError;
use super::context::RenderContext;
use super::image_tiles::tile_regions;
use super::primitive_assembly::assemble_scene;
use super::renderer::{FrameMemory, RenderBuffers};
use super::screen_transform::ScreenTransform;
use super::shadow_maps::DepthOnly;
use raster::SurfaceDepth;
use shade::AmbientOcclusion;

/// The depth buffer of a frame that holds the whole picture, written into `nearest`; `None` if the
/// scene has no ambient occlusion.
///
/// # Errors
/// If the picture is larger than the rasterizer's grid.
pub(super) fn build_ssao_buffer(
    context: &RenderContext<'_>,
    memory: &FrameMemory<'_>,
    mut nearest: Vec<SurfaceDepth>,
) -> Result<Option<AmbientOcclusion>, RenderError> {
    let scene = context.scene;
    let Some(radius) = scene.occlusion_radius else { return Ok(None) };
    let size @ [width, height] = context.image_size();
    if width > raster::MAX_SIDE || height > raster::MAX_SIDE {
        return Err(RenderError::OcclusionTooLarge);
    }
    nearest.resize(width as usize * height as usize, SurfaceDepth::EMPTY);
    memory.frame.surface_depths(&DepthOnly(&memory.draws), context.threads, &mut nearest);
    let view = &scene.view_projection;
    let world_to_screen = ScreenTransform::new(view, width, height)?.world_to_screen();
    // Positions are reconstructed from depths in f32 relative to this point. The center of the view
    // volume is near everything visible, so that few bits are lost.
    let center = view.world_to_clip().raw().inverse() * glam::DVec4::new(0.0, 0.0, 0.0, 1.0);
    let center = center.truncate() / center.w;
    let origin = if center.is_finite() { center } else { view.camera.eye().raw() };
    let right = view.camera.u().raw();
    Ok(Some(AmbientOcclusion::new(nearest, size, world_to_screen, origin, right, radius)))
}

/// The depth buffer of the whole picture for rendering a region of it: a frame of its own, with
/// depths only.
///
/// # Errors
/// If the picture is larger than one image tile, or the scene has too many primitives.
pub(super) fn build_full_ssao_buffer(
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
    build_ssao_buffer(context, &memory, Vec::new())
}
