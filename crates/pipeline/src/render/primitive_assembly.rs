//! The geometry half of the pipeline: from the meshes of a scene to the primitives of a frame.

use super::RenderError;
use super::mip_chains::Textures;
use super::projected_mesh::ProjectedMesh;
use super::renderer::FrameMemory;
use super::screen_transform::{ScreenTransform, all_vertices};
use super::vertex_inputs::VertexInputs;
use super::vertex_processing::{VertexArrays, world_tangents};
use crate::scene::Scene;
use clip::{Outcode, clip_triangle};
use glam::DVec3;
use homog::{Affine, Clip, HPoint, Model, World};
use model::ModelInstance;
use model::{
    Material, MeshInstance, Primitive, SkinnedPrimitive, TextureInfo, TextureSlot, Topology,
};
use raster::{CullMode, Frame, MeshTriangles, Opacity, signed_area};
use shade::{Draw, DrawKind, MaterialTextures, MipChain};
use std::ops::Range;

/// The width of lines that a file draws, in pixels: glTF gives none.
const LINE_WIDTH_PIXELS: f64 = 1.5;
/// The side of points that a file draws, in pixels: glTF gives none.
const POINT_SIZE_PIXELS: f64 = 3.0;

/// Puts what may be seen of a scene into an empty frame, and says what its primitives are made of.
pub(super) fn assemble_scene<'a>(
    scene: &'a Scene,
    textures: &'a Textures<'a>,
    threads: usize,
    memory: FrameMemory<'a>,
) -> Result<FrameMemory<'a>, RenderError> {
    assemble_with_cover(scene, textures, threads, memory, None)
}

/// The same, with all primitives covering what is behind them in this way, whatever their materials say.
pub(super) fn assemble_with_cover<'a>(
    scene: &'a Scene,
    textures: &'a Textures<'a>,
    threads: usize,
    memory: FrameMemory<'a>,
    cover: Option<Opacity>,
) -> Result<FrameMemory<'a>, RenderError> {
    let mut assembler = PrimitiveAssembler {
        transform: ScreenTransform::for_tile(scene, memory.tile)?,
        viewer: scene.view_projection.viewer(),
        inputs: VertexInputs::for_style(scene.style, cover),
        anisotropy: scene.image.max_anisotropy,
        threads,
        memory,
        next_id: 0,
        next_part_id: 0,
    };
    for (number, placed) in scene.models.iter().enumerate() {
        for (instance, primitive) in placed.model.scene_primitives() {
            let texture = |slot, used: TextureInfo| textures.mip_chain(number, slot, used.texture);
            assembler.draw_primitive(placed, instance, primitive, texture)?;
        }
    }
    if let Some(ground) = scene.ground {
        assembler.add_ground(ground)?;
    }
    if let Some(blur) = scene.image.environment_blur {
        assembler.add_environment(blur)?;
    }
    if let Some(painting) = &scene.backdrop {
        assembler.add_backdrop(painting, scene.image)?;
    }
    Ok(assembler.memory)
}

pub(super) struct PrimitiveAssembler<'a> {
    pub(super) transform: ScreenTransform,
    viewer: HPoint<World>,
    inputs: VertexInputs,
    anisotropy: u32,
    threads: usize,
    pub(super) memory: FrameMemory<'a>,
    pub(super) next_id: u32,
    pub(super) next_part_id: u32,
}

/// The material of primitives that name none.
pub(super) static DEFAULT_MATERIAL: std::sync::LazyLock<Material> =
    std::sync::LazyLock::new(Material::default);

/// The triangles of the ground, or of an environment behind everything.
pub(super) static QUAD: std::sync::LazyLock<Primitive> = std::sync::LazyLock::new(|| Primitive {
    indices: vec![0, 1, 2, 0, 2, 3],
    ..Primitive::default()
});

impl<'a> PrimitiveAssembler<'a> {
    /// Adds what of one primitive may be seen to the frame, and what its vertices carry to the draws.
    fn draw_primitive(
        &mut self,
        placed: &'a ModelInstance,
        instance: MeshInstance,
        primitive: &'a Primitive,
        texture: impl Fn(TextureSlot, TextureInfo) -> Option<&'a MipChain<'a>>,
    ) -> Result<(), RenderError> {
        let model = &placed.model;
        let (first_id, part) = self.allocate_ids(primitive)?;
        let posed = model.skin_primitive(instance, primitive);
        let SkinnedPrimitive { positions, normals, to_model } = &posed;
        let model_to_world = to_model.then(placed.model_to_world);
        let model_to_clip = self.transform.model_to_clip(model_to_world);
        let material = primitive.material.map_or(&*DEFAULT_MATERIAL, |m| &model.materials[m]);
        let culls_back_faces = !material.double_sided && !self.inputs.shows_back_faces;
        let viewer = culls_back_faces.then_some(self.viewer);
        let viewer = viewer.and_then(|viewer| viewer_in_model_space(model_to_world, viewer));
        let images = &mut self.memory.mesh;
        images.cull_clusters(&self.transform, model_to_clip, primitive, &posed, viewer);
        if images.unclipped.is_empty() && images.to_clip.is_empty() {
            return Ok(());
        }
        images.project_vertices(&self.transform, model_to_clip, positions, self.threads);
        let mut draw = Draw {
            first_id,
            part_id: part,
            primitive,
            material,
            textures: MaterialTextures::new(material, self.anisotropy, texture),
            vertices: self.memory.vertex_pool.pop().unwrap_or_default(),
            tangents: world_tangents(model, instance, primitive, material, &posed, model_to_world),
            is_smooth: normals.is_some() && !self.inputs.is_flat,
            uv_set: self.inputs.uv_set(material, primitive),
            colors: model.morph_colors(instance, primitive),
            kind: DrawKind::Surface,
            flips_winding: model_to_world.determinant() < 0.0,
            world_scale: libm::cbrt(model_to_world.determinant().abs()) as f32,
        };
        self.submit_draw(&draw);
        let uvs = draw.uv_set.and_then(|set| model.morph_uvs(instance, primitive, set));
        let is_lit = self.inputs.forces_lit_inputs || draw.is_lit();
        let arrays = VertexArrays {
            positions: is_lit.then_some(&**positions),
            normals: normals.as_deref().filter(|_| is_lit && draw.is_smooth),
            uvs: uvs.as_deref(),
        };
        let ProjectedMesh { unclipped: whole, to_clip: cut, .. } = &self.memory.mesh;
        let selections = [whole, cut];
        arrays.write_vertices(
            positions.len(),
            selections,
            model_to_world,
            self.threads,
            &mut draw.vertices,
        );
        self.memory.draws.draws.push(draw);
        Ok(())
    }

    /// The name of the first point, line or triangle of the next primitive, and the number of the primitive itself.
    fn allocate_ids(&mut self, primitive: &Primitive) -> Result<(u32, u32), RenderError> {
        let numbers = (self.next_id, self.next_part_id);
        let count =
            u32::try_from(primitive.item_count()).map_err(|_| RenderError::TooManyPrimitives)?;
        self.next_id = numbers.0.checked_add(count).ok_or(RenderError::TooManyPrimitives)?;
        self.next_part_id += 1;
        Ok(numbers)
    }

    /// Adds what is selected of the primitive to the frame, in its order: runs of triangles as they are, and in between the points,
    /// lines and triangles that may have to be clipped.
    fn submit_draw(&mut self, draw: &Draw<'_>) {
        let images = std::mem::take(&mut self.memory.mesh);
        let (cover, cull) =
            (self.inputs.material_cover_in_style(draw.material), self.cull_mode(draw));
        let triangles = draw.primitive.indices.as_chunks::<3>().0;
        for (whole, cut) in images.triangle_runs() {
            let (screen, first_id) = (&images.screen_vertices, draw.first_id);
            let mesh =
                MeshTriangles { vertices: screen, triangles, first_id, opacity: cover, cull };
            self.memory.frame.add_mesh_runs(mesh, whole);
            self.clip_and_submit(draw, &images, cut, cover, cull);
        }
        self.memory.mesh = images;
    }

    /// Clips a run of points, lines or triangles and adds what is left to the frame.
    fn clip_and_submit(
        &mut self,
        draw: &Draw<'_>,
        images: &ProjectedMesh,
        run: Range<usize>,
        cover: Opacity,
        cull: CullMode,
    ) {
        if run.is_empty() {
            return;
        }
        let topology = draw.primitive.topology;
        let corners = topology.vertices_per_item();
        let indices = draw.primitive.indices.get(run.start * corners..run.end * corners);
        let elements = indices.unwrap_or_default().chunks_exact(corners);
        for (id, corners) in (draw.first_id + run.start as u32..).zip(elements) {
            match (topology, corners) {
                (Topology::Points, &[p]) => self.submit_point(images, p, id, cover),
                (Topology::Lines, &[p, q]) => self.submit_line(images, [p, q], id, cover),
                (Topology::Triangles, &[p, q, r]) => {
                    let frame = &mut self.memory.frame;
                    submit_clipped_triangle(
                        &self.transform,
                        images,
                        frame,
                        [p, q, r],
                        id,
                        cover,
                        cull,
                    );
                }
                _ => {}
            }
        }
    }

    fn submit_point(&mut self, images: &ProjectedMesh, vertex: u32, id: u32, cover: Opacity) {
        if let Some(center) = images.screen_vertices[vertex as usize] {
            self.memory.frame.add_point(center, POINT_SIZE_PIXELS, id, cover);
        }
    }

    fn submit_line(&mut self, images: &ProjectedMesh, ends: [u32; 2], id: u32, cover: Opacity) {
        let ends = ends.map(|vertex| images.clip_positions[vertex as usize]);
        let Some(visible) = self.transform.clip_line(ends) else { return };
        if let Some(ends) = self.transform.snap_vertices([visible.start, visible.end]) {
            let line_parameters = [visible.t0 as f32, visible.t1 as f32];
            self.memory.frame.add_clipped_line(ends, line_parameters, LINE_WIDTH_PIXELS, id, cover);
        }
    }

    /// Which triangles are not to be seen: the backs of surfaces with one side. Fronts run counter-clockwise in the picture,
    /// unless either the way to the world or that to the screen mirrors.
    pub(super) fn cull_mode(&self, draw: &Draw<'_>) -> CullMode {
        let shows_both_faces = draw.material.double_sided || self.inputs.shows_back_faces;
        match (shows_both_faces, draw.flips_winding == self.transform.is_mirrored) {
            (true, _) => CullMode::Nothing,
            (false, true) => CullMode::Clockwise,
            (false, false) => CullMode::CounterClockwise,
        }
    }
}

/// Clips a triangle and adds what is left of it to a frame.
pub(super) fn submit_clipped_triangle(
    stage: &ScreenTransform,
    images: &ProjectedMesh,
    frame: &mut Frame,
    vertices: [u32; 3],
    id: u32,
    cover: Opacity,
    cull: CullMode,
) {
    let ProjectedMesh { clip_positions: clip, outcodes, screen_vertices: screen, .. } = images;
    let vertices = vertices.map(|vertex| vertex as usize);
    if let Some(corners) = all_vertices(vertices.map(|vertex| screen[vertex])) {
        if passes_culling(cull, -signed_area(corners).signum() as f64) {
            frame.add_triangle(corners, id, cover);
        }
        return;
    }
    let points = vertices.map(|vertex| clip[vertex]);
    let outcodes = vertices.map(|vertex| outcodes[vertex]);
    if !Outcode::trivially_rejects(&outcodes).is_inside()
        || !passes_culling(cull, clip_space_orientation(points))
    {
        return;
    }
    for piece in clip_triangle(points, &stage.guard_band).triangles() {
        if let Some(corners) = stage.snap_vertices(piece.map(|vertex| vertex.point)) {
            let weights = piece.map(|vertex| vertex.weights.map(|weight| weight as f32));
            frame.add_clipped_triangle(corners, weights, id, cover);
        }
    }
}

/// A place of the world as it is in a model; `None` if the model is flat there.
fn viewer_in_model_space(
    model_to_world: Affine<Model, World>,
    place: HPoint<World>,
) -> Option<HPoint<Model>> {
    Some(HPoint::from_raw(model_to_world.inverse()?.raw() * place.raw()))
}

/// Whether a triangle is kept whose [`orientation`] has this sign.
fn passes_culling(cull: CullMode, orientation: f64) -> bool {
    match cull {
        CullMode::Nothing => true,
        CullMode::Clockwise => orientation > 0.0,
        CullMode::CounterClockwise => orientation < 0.0,
    }
}

/// Positive if a triangle runs counter-clockwise in the picture (y up), without a divide: the sign is right for corners
/// behind the eye too.
fn clip_space_orientation([p, q, r]: [HPoint<Clip>; 3]) -> f64 {
    let column = |point: HPoint<Clip>| DVec3::new(point.x(), point.y(), point.w());
    column(p).dot(column(q).cross(column(r)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counter_clockwise_is_positive_also_with_corners_behind_the_eye() {
        let corners =
            [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| HPoint::new(x, y, 0.0, 1.0));
        assert!(clip_space_orientation(corners) > 0.0);
        let [p, q, r] = corners;
        assert!(clip_space_orientation([p, r, q]) < 0.0);
        // A corner moved through the eye's plane, along the line from another: the surface still shows the same side.
        let behind = HPoint::from_raw(q.raw() - (r.raw() * 3.0 - q.raw() * 3.0));
        assert!(clip_space_orientation([p, behind, r]) > 0.0);
    }
}
