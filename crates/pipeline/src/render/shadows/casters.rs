//! What casts shadows: the triangles of a scene that let no light through.

use crate::render::RenderError;
use crate::render::Textures;
use crate::render::assemble::{DEFAULT_MATERIAL, triangle};
use crate::render::images::Images;
use crate::render::needs::cover_of;
use crate::render::stage::Stage;
use crate::render::vertices::{Parts, uv_set};
use crate::scene::Scene;
use homog::Affine;
use model::{Instance, Model, Primitive, TextureSlot, TextureUse, Topology};
use raster::{Cover, Cull, Fragment, Fragments, Frame, Instructions, Surface, WIDE};
use shade::{Draw, DrawList, Maps, Role, Tangents};

/// What of draws is there at all: their colours do not count.
pub(in crate::render) struct Casters<'a, 'b>(pub(in crate::render) &'b DrawList<'a>);

impl Surface for Casters<'_, '_> {
    fn keeps(&self, fragment: &Fragment<'_>) -> bool {
        self.0.keeps(fragment)
    }

    fn keeps_eight(&self, fragments: &Fragments<'_>) -> [bool; WIDE] {
        self.0.keeps_eight(fragments, Instructions::best())
    }

    fn shade(&self, _: &Fragment<'_>) -> [f32; 4] {
        [0.0; 4]
    }
}

/// Adds a scene's casters to a light's frame, both sides of them, and what masks them to the draws.
pub(super) fn add_casters<'a>(
    scene: &'a Scene,
    textures: &'a Textures<'a>,
    stage: &Stage,
    threads: usize,
    images: &mut Images,
    frame: &mut Frame,
    draws: &mut DrawList<'a>,
) -> Result<(), RenderError> {
    let mut first_id = 0_u32;
    for (number, placed) in scene.models.iter().enumerate() {
        let model = &placed.model;
        for (instance, primitive) in model.shown_primitives() {
            let material = primitive.material.map_or(&*DEFAULT_MATERIAL, |m| &model.materials[m]);
            let cover = cover_of(material);
            if primitive.topology != Topology::Triangles || cover == Cover::Translucent {
                continue;
            }
            let posed = model.posed(instance, primitive);
            let model_to_world = posed.to_model.then(placed.model_to_world);
            let model_to_clip = stage.model_to_clip(model_to_world);
            let triangles = primitive.indices.as_chunks::<3>().0;
            images.select(stage, model_to_clip, primitive, &posed, None);
            images.project(stage, model_to_clip, &posed.positions, threads);
            for (whole, cut) in images.runs() {
                let screen = &images.screen;
                frame.mesh_part(screen, triangles, whole, first_id, cover, Cull::Nothing);
                let cut = cut.start.min(triangles.len())..cut.end.min(triangles.len());
                for (number, corners) in (first_id..).zip(triangles).take(cut.end).skip(cut.start) {
                    triangle(stage, images, frame, *corners, number, cover, Cull::Nothing);
                }
            }
            if cover == Cover::Masked {
                let texture = |slot: TextureSlot, used: TextureUse| {
                    textures.chain(number, slot, used.texture)
                };
                let maps = Maps::of(material, 1, texture);
                let mut draw = masked(model, instance, primitive, maps, images);
                draw.first_id = first_id;
                draws.draws.push(draw);
            }
            let count = u32::try_from(triangles.len()).ok();
            let next = count.and_then(|count| first_id.checked_add(count));
            first_id = next.ok_or(RenderError::TooManyPrimitives)?;
        }
    }
    Ok(())
}

/// What tells where a masked primitive is: its material, with the texture coordinates and the colours of its vertices.
fn masked<'a>(
    model: &'a Model,
    instance: Instance,
    primitive: &'a Primitive,
    maps: Maps<'a>,
    images: &Images,
) -> Draw<'a> {
    let material = primitive.material.map_or(&*DEFAULT_MATERIAL, |m| &model.materials[m]);
    let uv_set = uv_set(material, primitive);
    let uvs = uv_set.and_then(|set| model.posed_uvs(instance, primitive, set));
    let parts = Parts { positions: None, normals: None, uvs: uvs.as_deref() };
    let (count, selected) = (primitive.positions.len(), [&images.whole, &images.cut]);
    let mut vertices = Vec::new();
    parts.vertices(count, selected, Affine::IDENTITY, 1, &mut vertices);
    Draw {
        first_id: 0,
        part: 0,
        primitive,
        material,
        maps,
        vertices,
        tangents: Tangents::None,
        smooth: false,
        uv_set,
        colors: model.posed_colors(instance, primitive),
        role: Role::Surface,
        mirrored: false,
        scale: 1.0,
    }
}
