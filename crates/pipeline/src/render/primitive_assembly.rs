//! Primitive assembly: the geometry half of the pipeline, from the meshes of a scene to the
//! primitives and draw calls of a frame.
//!
//! Each primitive of each mesh instance is one draw call:
//!
//! ```text
//!  skinning and morphing ─► frustum culling of clusters ─► vertex transform ─► DrawCall::submit
//!                                                       └► attributes in the world ─► Draw
//! ```
//!
//! Screen positions go into the frame, and vertex attributes for shading go into the [`Draw`]. A
//! primitive id links them.

use super::RenderError;
use super::context::RenderContext;
use super::draw_call::DrawCall;
use super::renderer::FrameMemory;
use super::repeated_models::find_repeated;
use super::screen_transform::ScreenTransform;
use super::vertex_inputs::VertexInputs;
use super::vertex_processing::{VertexArrays, world_tangents};
use homog::{Affine, HPoint, Model, World};
use model::{
    Material, MeshInstance, ModelInstance, Primitive, SkinnedPrimitive, TextureInfo, TextureSlot,
};
use raster::{CullMode, Opacity};
use shade::{Draw, DrawKind, MaterialTextures, MipChain};
use std::sync::LazyLock;

/// Assembles the visible parts of a scene into an empty frame.
///
/// # Errors
/// Returns an error if the scene has more primitives than there are ids.
pub(super) fn assemble_scene<'a>(
    context: &RenderContext<'a>,
    memory: FrameMemory<'a>,
) -> Result<FrameMemory<'a>, RenderError> {
    PrimitiveAssembler::new(context, memory, None)?.assemble_all(context)
}

/// Like [`assemble_scene`], but only for the parts visible behind refracting glass: opaque
/// surfaces, the ground with its shadows, and the environment if it is visible.
pub(super) fn assemble_behind_glass<'a>(
    context: &RenderContext<'a>,
    memory: FrameMemory<'a>,
) -> Result<FrameMemory<'a>, RenderError> {
    let mut assembler = PrimitiveAssembler::new(context, memory, None)?;
    assembler.only_behind_glass = true;
    assembler.assemble_all(context)
}

/// Like [`assemble_scene`], but all primitives are opaque, masked or translucent according to
/// `opacity`, regardless of their materials.
pub(super) fn assemble_with_opacity<'a>(
    context: &RenderContext<'a>,
    memory: FrameMemory<'a>,
    opacity: Option<Opacity>,
) -> Result<FrameMemory<'a>, RenderError> {
    PrimitiveAssembler::new(context, memory, opacity)?.assemble_all(context)
}

/// The state of an assembly: transform, style, the frame so far and the next free ids.
pub(super) struct PrimitiveAssembler<'a> {
    /// The transform of the image tile.
    pub(super) transform: ScreenTransform,
    /// The eye, or the direction toward it.
    viewer: HPoint<World>,
    /// The inputs required by the style.
    inputs: VertexInputs,
    /// Whether glass, blended surfaces and the backdrop are skipped.
    only_behind_glass: bool,
    /// The maximum number of texture samples per fragment along the longer axis of its footprint.
    anisotropy: u32,
    /// The side of points in pixels.
    point_size: f64,
    /// The maximum number of threads for large meshes.
    threads: usize,
    /// The frame and its draw calls.
    pub(super) memory: FrameMemory<'a>,
    /// The id of the next point, line or triangle.
    pub(super) next_id: u32,
    /// The number of the next draw call, counting culled draw calls.
    pub(super) next_part_id: u32,
}

/// The default material of glTF 2.0 §3.9, for primitives without a material.
pub(super) static DEFAULT_MATERIAL: LazyLock<Material> = LazyLock::new(Material::default);

/// Two triangles over four vertices, for the ground, the environment and the backdrop.
pub(super) static QUAD: LazyLock<Primitive> =
    LazyLock::new(|| Primitive { indices: vec![0, 1, 2, 0, 2, 3], ..Primitive::default() });

impl<'a> PrimitiveAssembler<'a> {
    /// Starts an assembly with an empty frame. `opacity` overrides the opacity of all primitives.
    fn new(
        context: &RenderContext<'a>,
        memory: FrameMemory<'a>,
        opacity: Option<Opacity>,
    ) -> Result<Self, RenderError> {
        let RenderContext { scene, threads, .. } = *context;
        Ok(Self {
            transform: ScreenTransform::for_tile(scene, memory.tile)?,
            viewer: scene.view_projection.viewer(),
            inputs: VertexInputs::for_style(scene.style, opacity),
            only_behind_glass: false,
            anisotropy: scene.image.max_anisotropy,
            point_size: scene.image.point_size,
            threads,
            memory,
            next_id: 0,
            next_part_id: 0,
        })
    }

    /// Issues the draw calls of the models, ground, environment and backdrop.
    fn assemble_all(mut self, context: &RenderContext<'a>) -> Result<FrameMemory<'a>, RenderError> {
        let RenderContext { scene, textures, .. } = *context;
        let is_repeated = find_repeated(&scene.models, scene.style);
        for (index, model_instance) in scene.models.iter().enumerate() {
            for (instance, primitive) in model_instance.model.scene_primitives() {
                if is_repeated[index] {
                    // Ids are still allocated, so that the ids of later draw calls do not change.
                    self.allocate_ids(primitive)?;
                    continue;
                }
                let texture =
                    |slot, used: TextureInfo| textures.mip_chain(index, slot, used.texture);
                self.draw_primitive(model_instance, instance, primitive, texture)?;
            }
        }
        // A shadow would distort the values that false colors represent.
        if let Some(ground) = scene.ground.filter(|_| !scene.style.is_false_color()) {
            self.add_ground(ground)?;
        }
        if let Some(blur) = scene.image.environment_blur {
            self.add_environment(blur)?;
        }
        if let Some(backdrop) = scene.backdrop.as_ref().filter(|_| !self.only_behind_glass) {
            self.add_backdrop(backdrop, scene.image)?;
        }
        Ok(self.memory)
    }

    /// Issues the draw call of one primitive, unless it is culled entirely.
    fn draw_primitive(
        &mut self,
        model_instance: &'a ModelInstance,
        instance: MeshInstance,
        primitive: &'a Primitive,
        texture: impl Fn(TextureSlot, TextureInfo) -> Option<&'a MipChain<'a>>,
    ) -> Result<(), RenderError> {
        let model = &model_instance.model;
        let (first_id, part_id) = self.allocate_ids(primitive)?;
        let material = primitive.material.map_or(&*DEFAULT_MATERIAL, |m| &model.materials[m]);
        if self.only_behind_glass && !self.inputs.is_behind_glass(material) {
            return Ok(());
        }
        let skinned = model.skin_primitive(instance, primitive);
        let model_to_world = skinned.to_model.then(model_instance.model_to_world);
        if !self.project_primitive(primitive, material, &skinned, model_to_world) {
            return Ok(());
        }
        // The sign of the determinant indicates whether faces are mirrored, and the cube root of
        // its magnitude is the mean scale.
        let determinant = model_to_world.determinant();
        let mut draw = Draw {
            first_id,
            part_id,
            primitive,
            material,
            textures: MaterialTextures::new(material, self.anisotropy, texture),
            vertices: self.memory.vertex_pool.pop().unwrap_or_default(),
            tangents: world_tangents(
                model,
                instance,
                primitive,
                material,
                &skinned,
                model_to_world,
            ),
            is_smooth: skinned.normals.is_some() && !self.inputs.is_flat,
            uv_set: self.inputs.uv_set(material, primitive),
            colors: model.morph_colors(instance, primitive),
            kind: DrawKind::Surface,
            flips_winding: determinant < 0.0,
            world_scale: libm::cbrt(determinant.abs()) as f32,
        };
        self.submit_draw(&draw);
        let uvs = draw.uv_set.and_then(|set| model.morph_uvs(instance, primitive, set));
        self.write_attributes(&mut draw, &skinned, uvs.as_deref(), model_to_world);
        self.memory.draws.draws.push(draw);
        Ok(())
    }

    /// Allocates ids for the points, lines or triangles of a primitive. Returns the first id and
    /// the number of the draw call.
    fn allocate_ids(&mut self, primitive: &Primitive) -> Result<(u32, u32), RenderError> {
        let ids = (self.next_id, self.next_part_id);
        let count =
            u32::try_from(primitive.item_count()).map_err(|_| RenderError::TooManyPrimitives)?;
        self.next_id = ids.0.checked_add(count).ok_or(RenderError::TooManyPrimitives)?;
        self.next_part_id += 1;
        Ok(ids)
    }

    /// Culls the clusters of a primitive and transforms the vertices of the remaining clusters.
    /// Returns `false` if none remain.
    fn project_primitive(
        &mut self,
        primitive: &Primitive,
        material: &Material,
        skinned: &SkinnedPrimitive<'_>,
        model_to_world: Affine<Model, World>,
    ) -> bool {
        let culls_back_faces = !material.double_sided && !self.inputs.shows_back_faces;
        let viewer = culls_back_faces.then_some(self.viewer);
        let viewer = viewer.and_then(|viewer| viewer_in_model_space(model_to_world, viewer));
        let model_to_clip = self.transform.model_to_clip(model_to_world);
        let mesh = &mut self.memory.mesh;
        mesh.cull_clusters(&self.transform, model_to_clip, primitive, skinned, viewer);
        if mesh.unclipped.is_empty() && mesh.to_clip.is_empty() {
            return false;
        }
        let positions = &skinned.positions;
        mesh.project_vertices(&self.transform, model_to_clip, positions, self.threads);
        true
    }

    /// Adds the projected primitive to the frame.
    fn submit_draw(&mut self, draw: &Draw<'_>) {
        let cull_mode = self.cull_mode(draw);
        let FrameMemory { mesh, frame, .. } = &mut self.memory;
        let opacity = self.inputs.opacity(draw.material);
        let point_size = self.point_size;
        DrawCall { transform: &self.transform, mesh, frame, opacity, cull_mode, point_size }
            .submit(draw.primitive, draw.first_id);
    }

    /// Writes the vertex attributes needed for shading. Positions and normals are skipped if
    /// neither the lighting nor the style needs them.
    fn write_attributes(
        &self,
        draw: &mut Draw<'_>,
        skinned: &SkinnedPrimitive<'_>,
        uvs: Option<&[[f32; 2]]>,
        model_to_world: Affine<Model, World>,
    ) {
        let SkinnedPrimitive { positions, normals, .. } = skinned;
        let is_lit = self.inputs.forces_lit_inputs || draw.is_lit();
        let arrays = VertexArrays {
            positions: is_lit.then_some(&**positions),
            normals: normals.as_deref().filter(|_| is_lit && draw.is_smooth),
            uvs,
        };
        let selections = [&self.memory.mesh.unclipped, &self.memory.mesh.to_clip];
        let (count, vertices) = (positions.len(), &mut draw.vertices);
        arrays.write_vertices(count, selections, model_to_world, self.threads, vertices);
    }

    /// Returns the winding that a draw call culls. Front faces are counterclockwise in the picture
    /// unless exactly one of the model matrix and the projection reverses orientation.
    pub(super) fn cull_mode(&self, draw: &Draw<'_>) -> CullMode {
        let shows_both_faces = draw.material.double_sided || self.inputs.shows_back_faces;
        match (shows_both_faces, draw.flips_winding == self.transform.is_mirrored) {
            (true, _) => CullMode::Nothing,
            (false, true) => CullMode::Clockwise,
            (false, false) => CullMode::CounterClockwise,
        }
    }
}

/// Returns the viewer in model space, where clusters are tested against it, or `None` if the model
/// matrix is singular.
fn viewer_in_model_space(
    model_to_world: Affine<Model, World>,
    viewer: HPoint<World>,
) -> Option<HPoint<Model>> {
    Some(HPoint::from_raw(model_to_world.inverse()?.raw() * viewer.raw()))
}
