//! The ground of a frame: a translucent rectangle on which nothing but shadows is seen.

use super::RenderError;
use super::assemble::{Assembler, BACKDROP, DEFAULT_MATERIAL, triangle};
use super::renderer::Memory;
use crate::scene::Ground;
use homog::Affine;
use raster::Cover;
use shade::{Draw, Maps, PLACE, Role, Tangents};

impl Assembler<'_> {
    /// Adds the ground. It reaches behind the far plane and before the near one, which enclose the models tightly.
    pub(super) fn ground(&mut self, ground: Ground) -> Result<(), RenderError> {
        let first_id = self.next_id;
        self.next_id = first_id.checked_add(2).ok_or(RenderError::TooManyPrimitives)?;
        let mut stage = self.stage;
        stage.volume = stage.volume.without_near().without_far();
        let model_to_clip = stage.model_to_clip(Affine::IDENTITY);
        let vertex = |place: [f32; 3]| {
            let mut vertex = [0.0; 8];
            vertex[PLACE..PLACE + 3].copy_from_slice(&place);
            vertex
        };
        let mut vertices = self.memory.spare.pop().unwrap_or_default();
        vertices.clear();
        vertices.extend(ground.corners.map(vertex));
        let draw = Draw {
            first_id,
            part: self.next_part,
            primitive: &BACKDROP,
            material: &DEFAULT_MATERIAL,
            maps: Maps::default(),
            vertices,
            tangents: Tangents::None,
            smooth: false,
            uv_set: None,
            colors: None,
            role: Role::Ground,
            mirrored: false,
            scale: 1.0,
        };
        let cull = self.cull(&draw);
        let Memory { images, frame, .. } = &mut self.memory;
        images.whole.clear(4);
        images.cut.clear(4);
        images.cut.add_all(2);
        images.project(&stage, model_to_clip, &ground.corners, 1);
        for (id, corners) in (first_id..).zip(BACKDROP.indices.as_chunks::<3>().0) {
            triangle(&stage, images, frame, *corners, id, Cover::Translucent, cull);
        }
        self.memory.draws.draws.push(draw);
        Ok(())
    }
}
