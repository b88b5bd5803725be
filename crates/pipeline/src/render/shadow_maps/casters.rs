//! What casts shadows: the triangles of a scene that let no light through.

use crate::render::RenderError;
use crate::render::Textures;
use crate::render::primitive_assembly::{DEFAULT_MATERIAL, submit_clipped_triangle};
use crate::render::projected_mesh::ProjectedMesh;
use crate::render::screen_transform::ScreenTransform;
use crate::render::vertex_inputs::material_cover;
use crate::render::vertex_processing::{VertexArrays, material_uv_set};
use crate::scene::Scene;
use homog::Affine;
use model::{MeshInstance, Model, Primitive, TextureInfo, TextureSlot, Topology};
use raster::{
    CullMode, Fragment, Fragments, Frame, LANES, MeshTriangles, Opacity, SimdLevel, Surface,
};
use shade::{Draw, DrawKind, DrawList, MaterialTextures, Tangents};

/// What of draws is there at all: their colours do not count.
pub(in crate::render) struct DepthOnly<'a, 'b>(pub(in crate::render) &'b DrawList<'a>);

impl Surface for DepthOnly<'_, '_> {
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        self.0.passes_alpha_test(fragment)
    }

    fn alpha_test_eight(&self, fragments: &Fragments<'_>) -> [bool; LANES] {
        self.0.passes_alpha_test_eight(fragments, SimdLevel::best())
    }

    fn shade(&self, _: &Fragment<'_>) -> [f32; 4] {
        [0.0; 4]
    }
}

/// Adds a scene's casters to a light's frame, both sides of them, and what masks them to the draws.
pub(super) fn draw_casters<'a>(
    scene: &'a Scene,
    textures: &'a Textures<'a>,
    stage: &ScreenTransform,
    threads: usize,
    images: &mut ProjectedMesh,
    frame: &mut Frame,
    draws: &mut DrawList<'a>,
) -> Result<(), RenderError> {
    let mut first_id = 0_u32;
    for (number, placed) in scene.models.iter().enumerate() {
        let model = &placed.model;
        for (instance, primitive) in model.scene_primitives() {
            let material = primitive.material.map_or(&*DEFAULT_MATERIAL, |m| &model.materials[m]);
            let cover = material_cover(material);
            if primitive.topology != Topology::Triangles || cover == Opacity::Translucent {
                continue;
            }
            let posed = model.skin_primitive(instance, primitive);
            let model_to_world = posed.to_model.then(placed.model_to_world);
            let model_to_clip = stage.model_to_clip(model_to_world);
            let triangles = primitive.indices.as_chunks::<3>().0;
            images.cull_clusters(stage, model_to_clip, primitive, &posed, None);
            images.project_vertices(stage, model_to_clip, &posed.positions, threads);
            for (whole, cut) in images.triangle_runs() {
                let (vertices, opacity, cull) = (&images.screen_vertices, cover, CullMode::Nothing);
                let mesh = MeshTriangles { vertices, triangles, first_id, opacity, cull };
                frame.add_mesh_runs(mesh, whole);
                let cut = cut.start.min(triangles.len())..cut.end.min(triangles.len());
                for (number, corners) in (first_id..).zip(triangles).take(cut.end).skip(cut.start) {
                    submit_clipped_triangle(
                        stage,
                        images,
                        frame,
                        *corners,
                        number,
                        cover,
                        CullMode::Nothing,
                    );
                }
            }
            if cover == Opacity::Masked {
                let texture = |slot: TextureSlot, used: TextureInfo| {
                    textures.mip_chain(number, slot, used.texture)
                };
                let maps = MaterialTextures::new(material, 1, texture);
                let mut draw = masked_draw(model, instance, primitive, maps, images);
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
fn masked_draw<'a>(
    model: &'a Model,
    instance: MeshInstance,
    primitive: &'a Primitive,
    maps: MaterialTextures<'a>,
    images: &ProjectedMesh,
) -> Draw<'a> {
    let material = primitive.material.map_or(&*DEFAULT_MATERIAL, |m| &model.materials[m]);
    let uv_set = material_uv_set(material, primitive);
    let uvs = uv_set.and_then(|set| model.morph_uvs(instance, primitive, set));
    let arrays = VertexArrays { positions: None, normals: None, uvs: uvs.as_deref() };
    let (count, selected) = (primitive.positions.len(), [&images.unclipped, &images.to_clip]);
    let mut vertices = Vec::new();
    arrays.write_vertices(count, selected, Affine::IDENTITY, 1, &mut vertices);
    Draw {
        first_id: 0,
        part_id: 0,
        primitive,
        material,
        textures: maps,
        vertices,
        tangents: Tangents::None,
        is_smooth: false,
        uv_set,
        colors: model.morph_colors(instance, primitive),
        kind: DrawKind::Surface,
        flips_winding: false,
        world_scale: 1.0,
    }
}
