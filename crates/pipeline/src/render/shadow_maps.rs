//! Shadow maps: depth maps of the scene seen from its lights, rendered by the same stages as the
//! picture (Williams, *Casting curved shadows on curved surfaces*, 1978).
//!
//! ```text
//!  light ─► LightCamera fitted to the visible part ─► depth-only draws ─► shade::ShadowMap (PCF)
//!  point light ─► six LightCameras ─► depth-only draws ─► shade::ShadowCube
//! ```

mod casters;
mod cube_fitting;
mod ground_heights;
mod light_fitting;

use super::RenderError;
use super::context::RenderContext;
use super::projected_mesh::ProjectedMesh;
use super::screen_transform::ScreenTransform;
use casters::CasterPass;
pub(super) use casters::DepthOnly;
use cube_fitting::CubeCameras;
use light_fitting::LightCamera;
use raster::{Frame, Samples};
use shade::{DrawList, GroundOcclusion, Light, LightShadow, Shadow, ShadowMap};

/// Shadow maps and the buffers for rendering them, reused from picture to picture.
#[derive(Debug, Default)]
pub(super) struct ShadowMapRenderer {
    /// The frame of the last map.
    frame: Option<Frame>,
    /// Vertices of one draw call.
    mesh: ProjectedMesh,
    /// The maps of each light, in order; empty if no light casts shadows.
    pub(super) maps: Vec<Option<LightShadow>>,
    /// The occlusion of the ground in light from all directions; `None` if the ground has no
    /// occlusion.
    pub(super) ground_occlusion: Option<GroundOcclusion>,
    /// Maps of earlier pictures, retained for their memory.
    map_pool: Vec<ShadowMap>,
}

impl ShadowMapRenderer {
    /// Discards all maps but retains their memory.
    pub(super) fn recycle_maps(&mut self) {
        // Reversed, so that the next picture's first map reuses this picture's first map.
        self.ground_occlusion = None;
        let maps = self.maps.drain(..).rev().flatten();
        self.map_pool.extend(maps.flat_map(LightShadow::into_maps));
    }

    /// Renders the maps of a scene's lights. Lights without shadows and lights that reach no
    /// triangle get `None`.
    pub(super) fn render_maps(&mut self, context: &RenderContext<'_>) -> Result<(), RenderError> {
        let scene = context.scene;
        self.recycle_maps();
        if !scene.casts_shadows() {
            return Ok(());
        }
        self.ground_occlusion = self.render_ground_occlusion(context)?;
        for light in &scene.lights {
            let maps = match light.shadow() {
                Some(shadow) => self.render_light(context, light, shadow)?,
                None => None,
            };
            self.maps.push(maps);
        }
        Ok(())
    }

    /// Renders the maps of one light, or returns `None` if the light reaches no triangle.
    fn render_light(
        &mut self,
        context: &RenderContext<'_>,
        light: &Light,
        shadow: Shadow,
    ) -> Result<Option<LightShadow>, RenderError> {
        if let Some(camera) = LightCamera::fit_to_light(context.scene, light, shadow) {
            let map = self.render_map(context, &camera)?;
            return Ok(Some(LightShadow::Map(Box::new(map))));
        }
        let Some(cameras) = CubeCameras::fit_to_light(context.scene, light, shadow) else {
            return Ok(None);
        };
        let mut faces = [const { None }; 6];
        for (map, camera) in faces.iter_mut().zip(&cameras.faces) {
            if let Some(camera) = camera {
                *map = Some(self.render_map(context, camera)?);
            }
        }
        Ok(Some(LightShadow::Cube(Box::new(cameras.to_cube(faces)))))
    }

    /// Renders one shadow map: the surfaces nearest to the light, with the alpha test.
    fn render_map(
        &mut self,
        context: &RenderContext<'_>,
        camera: &LightCamera,
    ) -> Result<ShadowMap, RenderError> {
        let [width, height] = camera.size;
        let mut frame = match self.frame.take() {
            Some(mut frame) => {
                frame.reset(width, height, Samples::One)?;
                frame
            }
            None => Frame::new(width, height, Samples::One)?,
        }
        .with_threads(context.threads);
        let transform = ScreenTransform::new(&camera.view_projection, width, height)?;
        let mut draws = DrawList::default();
        let (mesh, draw_list) = (&mut self.mesh, &mut draws);
        CasterPass { transform, mesh, frame: &mut frame, draws: draw_list }.draw_scene(context)?;
        let mut map = self.map_pool.pop().unwrap_or_default();
        map.reset(transform.world_to_screen(), camera.size, camera.center);
        map.set_penumbra(camera.penumbra, camera.depth_at_infinity);
        frame.surface_depths(&DepthOnly(&draws), context.threads, &mut map.texels);
        map.find_nearest_depths();
        self.frame = Some(frame);
        Ok(map)
    }
}
