//! What of a frame occlusion in screen space is told from.

use super::region::sheets;
use super::shadows::Casters;
use super::stage::Stage;
use super::{RenderError, Renderer, Textures};
use crate::render::assemble::assemble;
use crate::scene::Scene;
use raster::{Frame, Nearest};
use shade::{DrawList, ScreenSpace};

/// The nearest surfaces of a frame that holds a scene, if its scene asks for occlusion; in memory that was used before.
pub(super) fn screen_space(
    scene: &Scene,
    frame: &Frame,
    draws: &DrawList<'_>,
    threads: usize,
    mut nearest: Vec<Nearest>,
) -> Result<Option<ScreenSpace>, RenderError> {
    let Some(radius) = scene.occlusion_radius else { return Ok(None) };
    if scene.image.width > raster::MAX_SIDE || scene.image.height > raster::MAX_SIDE {
        return Err(RenderError::OcclusionTooLarge);
    }
    let (width, height) = (scene.image.width, scene.image.height);
    nearest.resize(width as usize * height as usize, Nearest::NOTHING);
    frame.nearest(&Casters(draws), threads, &mut nearest);
    let stage = Stage::new(&scene.view_projection, width, height)?;
    let world_to_screen = stage.ndc_to_screen.raw() * scene.view_projection.world_to_clip().raw();
    // The middle of the view volume is near everything that is seen.
    let middle = scene.view_projection.world_to_clip().raw().inverse()
        * glam::DVec4::new(0.0, 0.0, 0.0, 1.0);
    let middle = middle.truncate() / middle.w;
    let origin = if middle.is_finite() { middle } else { scene.view_projection.camera.eye().raw() };
    let across = scene.view_projection.camera.u().raw();
    let size = [width, height];
    Ok(Some(ScreenSpace::new(nearest, size, world_to_screen, origin, across, radius)))
}

/// The same for a frame that is not there, or not all of it.
pub(super) fn whole_screen_space(
    scene: &Scene,
    textures: &Textures<'_>,
    threads: usize,
) -> Result<Option<ScreenSpace>, RenderError> {
    if scene.occlusion_radius.is_none() {
        return Ok(None);
    }
    let [whole] = sheets(scene.image, scene.image.rect())[..] else {
        return Err(RenderError::OcclusionTooLarge);
    };
    let memory = Renderer::default().lend(scene, whole, threads)?;
    let memory = assemble(scene, textures, threads, memory)?;
    screen_space(scene, &memory.frame, &memory.draws, threads, Vec::new())
}
