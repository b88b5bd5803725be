//! Shadow casters: the depth-only pass over all triangles that are not translucent.
//!
//! | material | casts a shadow |
//! | --- | --- |
//! | opaque | always |
//! | masked (alpha test) | where alpha passes the cutoff |
//! | blended or transmissive | never; there are no colored or partial shadows |
//!
//! Points and lines do not cast shadows either. The pass has separate ids, because it skips
//! primitives.

use crate::render::RenderError;
use crate::render::context::RenderContext;
use crate::render::draw_call::DrawCall;
use crate::render::primitive_assembly::DEFAULT_MATERIAL;
use crate::render::projected_mesh::ProjectedMesh;
use crate::render::repeated_models::find_repeated;
use crate::render::screen_transform::ScreenTransform;
use crate::render::vertex_inputs::material_opacity;
use crate::render::vertex_processing::{VertexArrays, material_uv_set};
use homog::Affine;
use model::{MeshInstance, Model, ModelInstance, Primitive, TextureInfo, TextureSlot, Topology};
use raster::{CullMode, Fragment, Fragments, Frame, LANES, Opacity, SimdLevel, Surface};
use shade::{Draw, DrawKind, DrawList, MaterialTextures, MipChain, Tangents};

/// A surface for depth-only passes: it performs alpha tests and has no color.
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

/// The depth-only pass of one light.
pub(super) struct CasterPass<'a, 'b> {
    /// The transform of the light's camera.
    pub(super) transform: ScreenTransform,
    /// Vertices of one draw call.
    pub(super) mesh: &'b mut ProjectedMesh,
    /// The frame that becomes the shadow map.
    pub(super) frame: &'b mut Frame,
    /// The draw calls of masked primitives, for the alpha test.
    pub(super) draws: &'b mut DrawList<'a>,
}

/// A primitive in one instance of its mesh.
#[derive(Clone, Copy)]
struct PlacedPrimitive<'a> {
    model_instance: &'a ModelInstance,
    instance: MeshInstance,
    primitive: &'a Primitive,
}

impl<'a> CasterPass<'a, '_> {
    /// Draws the opaque and masked triangles of all models.
    ///
    /// # Errors
    /// Returns an error if the scene has more triangles than there are ids.
    pub(super) fn draw_scene(&mut self, context: &RenderContext<'a>) -> Result<(), RenderError> {
        let RenderContext { scene, textures, threads, .. } = *context;
        let mut first_id = 0_u32;
        let is_repeated = find_repeated(&scene.models, scene.style);
        for (index, model_instance) in scene.models.iter().enumerate() {
            if is_repeated[index] {
                continue;
            }
            for (instance, primitive) in model_instance.model.scene_primitives() {
                let texture =
                    |slot, used: TextureInfo| textures.mip_chain(index, slot, used.texture);
                let placed = PlacedPrimitive { model_instance, instance, primitive };
                let count = self.draw_primitive(placed, first_id, texture, threads);
                let next = u32::try_from(count).ok().and_then(|n| first_id.checked_add(n));
                first_id = next.ok_or(RenderError::TooManyPrimitives)?;
            }
        }
        Ok(())
    }

    /// Draws both faces of a primitive's triangles and returns the number of triangles, or 0 if the
    /// primitive casts no shadow. Back faces also cast shadows, because an open surface may turn
    /// only back faces toward the light.
    fn draw_primitive(
        &mut self,
        placed: PlacedPrimitive<'a>,
        first_id: u32,
        texture: impl Fn(TextureSlot, TextureInfo) -> Option<&'a MipChain<'a>>,
        threads: usize,
    ) -> usize {
        let PlacedPrimitive { model_instance, instance, primitive } = placed;
        let model = &model_instance.model;
        let material = primitive.material.map_or(&*DEFAULT_MATERIAL, |m| &model.materials[m]);
        let opacity = material_opacity(material);
        if primitive.topology != Topology::Triangles || opacity == Opacity::Translucent {
            return 0;
        }
        let skinned = model.skin_primitive(instance, primitive);
        let model_to_world = skinned.to_model.then(model_instance.model_to_world);
        let Self { transform, mesh, frame, .. } = self;
        let model_to_clip = transform.model_to_clip(model_to_world);
        mesh.cull_clusters(transform, model_to_clip, primitive, &skinned, None);
        mesh.project_vertices(transform, model_to_clip, &skinned.positions, threads);
        let cull_mode = CullMode::Nothing;
        DrawCall { transform, mesh, frame, opacity, cull_mode, point_size: 0.0 }
            .submit(primitive, first_id);
        if opacity == Opacity::Masked {
            // The alpha test does not need anisotropic filtering.
            let textures = MaterialTextures::new(material, 1, texture);
            let draw = masked_draw(model, instance, primitive, textures, mesh);
            self.draws.draws.push(Draw { first_id, ..draw });
        }
        primitive.indices.len() / 3
    }
}

/// Returns the draw call of a masked primitive: its material, and only the texture coordinates and
/// vertex colors that the alpha test reads.
fn masked_draw<'a>(
    model: &'a Model,
    instance: MeshInstance,
    primitive: &'a Primitive,
    textures: MaterialTextures<'a>,
    mesh: &ProjectedMesh,
) -> Draw<'a> {
    let material = primitive.material.map_or(&*DEFAULT_MATERIAL, |m| &model.materials[m]);
    let uv_set = material_uv_set(material, primitive);
    let uvs = uv_set.and_then(|set| model.morph_uvs(instance, primitive, set));
    let arrays = VertexArrays { positions: None, normals: None, uvs: uvs.as_deref() };
    let (count, selections) = (primitive.positions.len(), [&mesh.unclipped, &mesh.to_clip]);
    let mut vertices = Vec::new();
    arrays.write_vertices(count, selections, Affine::IDENTITY, 1, &mut vertices);
    Draw {
        first_id: 0,
        part_id: 0,
        primitive,
        material,
        textures,
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
