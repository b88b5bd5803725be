//! The ground of a frame: a translucent rectangle on which nothing but shadows is seen.

use super::RenderError;
use super::primitive_assembly::{
    DEFAULT_MATERIAL, PrimitiveAssembler, QUAD, submit_clipped_triangle,
};
use super::renderer::FrameMemory;
use crate::scene::Ground;
use homog::Affine;
use raster::Opacity;
use shade::{Draw, DrawKind, MaterialTextures, POSITION, Tangents};

impl PrimitiveAssembler<'_> {
    /// Adds the ground. It reaches behind the far plane and before the near one, which enclose the models tightly.
    pub(super) fn add_ground(&mut self, ground: Ground) -> Result<(), RenderError> {
        let first_id = self.next_id;
        self.next_id = first_id.checked_add(2).ok_or(RenderError::TooManyPrimitives)?;
        let mut stage = self.transform;
        stage.guard_band = stage.guard_band.without_near().without_far();
        let model_to_clip = stage.model_to_clip(Affine::IDENTITY);
        let vertex = |place: [f32; 3]| {
            let mut vertex = [0.0; 8];
            vertex[POSITION..POSITION + 3].copy_from_slice(&place);
            vertex
        };
        let mut vertices = self.memory.vertex_pool.pop().unwrap_or_default();
        vertices.clear();
        vertices.extend(ground.corners.map(vertex));
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
        let cull = self.cull_mode(&draw);
        let FrameMemory { mesh: images, frame, .. } = &mut self.memory;
        images.unclipped.clear(4);
        images.to_clip.clear(4);
        images.to_clip.add_all(2);
        images.project_vertices(&stage, model_to_clip, &ground.corners, 1);
        for (id, corners) in (first_id..).zip(QUAD.indices.as_chunks::<3>().0) {
            submit_clipped_triangle(
                &stage,
                images,
                frame,
                *corners,
                id,
                Opacity::Translucent,
                cull,
            );
        }
        self.memory.draws.draws.push(draw);
        Ok(())
    }
}
