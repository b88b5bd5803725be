//! What of a frame occlusion in screen space is told from.

use super::image_tiles::tile_regions;
use super::screen_transform::ScreenTransform;
use super::shadow_maps::DepthOnly;
use super::{RenderError, Renderer, Textures};
use crate::render::primitive_assembly::assemble_scene;
use crate::scene::Scene;
use raster::{Frame, SurfaceDepth};
use shade::{AmbientOcclusion, DrawList};

/// The nearest surfaces of a frame that holds a scene, if its scene asks for occlusion; in memory that was used before.
pub(super) fn build_ssao_buffer(
    scene: &Scene,
    frame: &Frame,
    draws: &DrawList<'_>,
    threads: usize,
    mut nearest: Vec<SurfaceDepth>,
) -> Result<Option<AmbientOcclusion>, RenderError> {
    let Some(radius) = scene.occlusion_radius else { return Ok(None) };
    if scene.image.width > raster::MAX_SIDE || scene.image.height > raster::MAX_SIDE {
        return Err(RenderError::OcclusionTooLarge);
    }
    let (width, height) = (scene.image.width, scene.image.height);
    nearest.resize(width as usize * height as usize, SurfaceDepth::EMPTY);
    frame.surface_depths(&DepthOnly(draws), threads, &mut nearest);
    let stage = ScreenTransform::new(&scene.view_projection, width, height)?;
    let world_to_screen = stage.ndc_to_screen.raw() * scene.view_projection.world_to_clip().raw();
    // The middle of the view volume is near everything that is seen.
    let center = scene.view_projection.world_to_clip().raw().inverse()
        * glam::DVec4::new(0.0, 0.0, 0.0, 1.0);
    let center = center.truncate() / center.w;
    let origin = if center.is_finite() { center } else { scene.view_projection.camera.eye().raw() };
    let right = scene.view_projection.camera.u().raw();
    let size = [width, height];
    Ok(Some(AmbientOcclusion::new(nearest, size, world_to_screen, origin, right, radius)))
}

/// The same for a frame that is not there, or not all of it.
pub(super) fn build_full_ssao_buffer(
    scene: &Scene,
    textures: &Textures<'_>,
    threads: usize,
) -> Result<Option<AmbientOcclusion>, RenderError> {
    if scene.occlusion_radius.is_none() {
        return Ok(None);
    }
    let [whole] = tile_regions(scene.image, scene.image.pixel_rect())[..] else {
        return Err(RenderError::OcclusionTooLarge);
    };
    let memory = Renderer::default().take_buffers(scene, whole, threads)?;
    let memory = assemble_scene(scene, textures, threads, memory)?;
    build_ssao_buffer(scene, &memory.frame, &memory.draws, threads, Vec::new())
}
