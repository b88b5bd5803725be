//! The pictures that lights have of a scene: shadow maps, rendered by the same stages as the picture itself.

mod casters;
mod light_fitting;

use super::RenderError;
use super::projected_mesh::ProjectedMesh;
use super::screen_transform::ScreenTransform;
use crate::scene::Scene;
pub(super) use casters::DepthOnly;
use casters::draw_casters;
use light_fitting::LightCamera;
use raster::{Frame, Samples};
use shade::{Draw, DrawList, ShadowMap};

/// What shadow maps are made in, kept from picture to picture.
#[derive(Debug, Default)]
pub(super) struct ShadowMapRenderer {
    frame: Option<Frame>,
    mesh: ProjectedMesh,
    /// The map of each light that casts shadows; as many as there are lights, or none.
    pub(super) maps: Vec<Option<ShadowMap>>,
    /// Maps that are not used at the moment.
    map_pool: Vec<ShadowMap>,
}

impl ShadowMapRenderer {
    /// Takes all maps out and keeps their memory.
    pub(super) fn recycle_maps(&mut self) {
        // The first map that is asked for next time is the one of the first light.
        self.map_pool.extend(self.maps.drain(..).rev().flatten());
    }

    /// Makes the maps of a scene's lights with up to `threads` threads, whose number does not change them.
    pub(super) fn render_maps<'a>(
        &mut self,
        scene: &'a Scene,
        textures: &'a super::Textures<'a>,
        threads: usize,
    ) -> Result<(), RenderError> {
        self.recycle_maps();
        if scene.lights.iter().all(|light| light.shadow().is_none()) {
            return Ok(());
        }
        for light in &scene.lights {
            let fit =
                light.shadow().and_then(|shadow| LightCamera::fit_to_light(scene, light, shadow));
            let map = match fit {
                Some(fit) => Some(self.render_map(scene, textures, &fit, threads)?),
                None => None,
            };
            self.maps.push(map);
        }
        Ok(())
    }

    fn render_map<'a>(
        &mut self,
        scene: &'a Scene,
        textures: &'a super::Textures<'a>,
        fit: &LightCamera,
        threads: usize,
    ) -> Result<ShadowMap, RenderError> {
        let [width, height] = fit.size;
        let mut frame = match self.frame.take() {
            Some(mut frame) => {
                frame.reset(width, height, Samples::One)?;
                frame
            }
            None => Frame::new(width, height, Samples::One)?,
        }
        .with_threads(threads);
        let stage = ScreenTransform::new(&fit.view_projection, width, height)?;
        let mut draws = DrawList { draws: Vec::<Draw<'a>>::new() };
        draw_casters(scene, textures, &stage, threads, &mut self.mesh, &mut frame, &mut draws)?;
        let mut map = self.map_pool.pop().unwrap_or_default();
        let to_screen = stage.ndc_to_screen.raw();
        map.reset(to_screen * fit.view_projection.world_to_clip().raw(), fit.size, fit.center);
        map.set_penumbra(fit.penumbra, fit.depth_at_infinity);
        frame.surface_depths(&DepthOnly(&draws), threads, &mut map.texels);
        self.frame = Some(frame);
        Ok(map)
    }
}
