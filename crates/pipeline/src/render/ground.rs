//! The ground as a shadow catcher: a translucent rectangle that shows only shadows.
//!
//! Its fragments are black, and their alpha is the fraction of light that shadows remove; fully lit
//! fragments are transparent. Blending then darkens the background as real ground would, and the
//! edge of the rectangle stays invisible.

use super::RenderError;
use super::draw_call::DrawCall;
use super::primitive_assembly::{DEFAULT_MATERIAL, PrimitiveAssembler, QUAD};
use super::renderer::FrameMemory;
use homog::Affine;
use raster::Opacity;
use scene::Ground;
use shade::{Draw, DrawKind, MaterialTextures, POSITION, Tangents};

impl PrimitiveAssembler<'_> {
    /// Adds the draw call of the ground.
    ///
    /// The ground is not clipped against the near and far planes, because they enclose the models
    /// tightly and shadows extend beyond them.
    pub(super) fn add_ground(&mut self, ground: Ground) -> Result<(), RenderError> {
        let first_id = self.next_id;
        self.next_id = first_id.checked_add(2).ok_or(RenderError::TooManyPrimitives)?;
        let mut transform = self.transform;
        let unlimited = transform.screen.volume().without_near().without_far();
        transform.screen = transform.screen.with_volume(unlimited);
        let mut vertices = self.memory.vertex_pool.pop().unwrap_or_default();
        vertices.clear();
        vertices.extend(ground.corners.map(|position| {
            let mut vertex = [0.0; 8];
            vertex[POSITION..POSITION + 3].copy_from_slice(&position);
            vertex
        }));
        let draw = Draw {
            first_id,
            part_id: self.next_part_id,
            primitive: &QUAD,
            material: &DEFAULT_MATERIAL,
            textures: MaterialTextures::default(),
            vertices,
            tangents: Tangents::None,
            is_smooth: false,
            uv_set: None,
            colors: None,
            kind: DrawKind::ShadowCatcher,
            flips_winding: false,
            world_scale: 1.0,
        };
        let cull_mode = self.cull_mode(&draw);
        let FrameMemory { mesh, frame, .. } = &mut self.memory;
        mesh.unclipped.clear(4);
        mesh.to_clip.clear(4);
        mesh.to_clip.add_all(2);
        let world_to_clip = transform.model_to_clip(Affine::IDENTITY);
        mesh.project_vertices(&transform, world_to_clip, &ground.corners, 1);
        let opacity = Opacity::Translucent;
        DrawCall { transform: &transform, mesh, frame, opacity, cull_mode, point_size: 0.0 }
            .submit(&QUAD, first_id);
        self.memory.draws.draws.push(draw);
        Ok(())
    }
}
