//! The geometry half of the pipeline: from the meshes of a scene to the primitives of a frame.

use super::RenderError;
use super::images::Images;
use super::needs::Needs;
use super::renderer::Memory;
use super::stage::{Stage, all};
use super::textures::Textures;
use super::vertices::{Parts, tangents};
use crate::scene::Scene;
use clip::{Outcode, clip_triangle};
use glam::DVec3;
use homog::{Affine, Clip, HPoint, Model, World};
use model::ModelInstance;
use model::{Instance, Material, Posed, Primitive, TextureSlot, TextureUse, Topology};
use raster::{Cover, Cull, Frame, signed_area};
use shade::{Draw, Maps, MipChain, Role};
use std::ops::Range;

/// The width of lines that a file draws, in pixels: glTF gives none.
const LINE_WIDTH: f64 = 1.5;
/// The side of points that a file draws, in pixels: glTF gives none.
const POINT_SIZE: f64 = 3.0;

/// Puts what may be seen of a scene into an empty frame, and says what its primitives are made of.
pub(super) fn assemble<'a>(
    scene: &'a Scene,
    textures: &'a Textures<'a>,
    threads: usize,
    memory: Memory<'a>,
) -> Result<Memory<'a>, RenderError> {
    assemble_as(scene, textures, threads, memory, None)
}

/// The same, with all primitives covering what is behind them in this way, whatever their materials say.
pub(super) fn assemble_as<'a>(
    scene: &'a Scene,
    textures: &'a Textures<'a>,
    threads: usize,
    memory: Memory<'a>,
    cover: Option<Cover>,
) -> Result<Memory<'a>, RenderError> {
    let mut assembler = Assembler {
        stage: Stage::of(scene, memory.sheet)?,
        viewer: scene.view_projection.viewer(),
        needs: Needs::of(scene.style, cover),
        anisotropy: scene.image.anisotropy,
        threads,
        memory,
        next_id: 0,
        next_part: 0,
    };
    for (number, placed) in scene.models.iter().enumerate() {
        for (instance, primitive) in placed.model.shown_primitives() {
            let texture = |slot, used: TextureUse| textures.chain(number, slot, used.texture);
            assembler.draw(placed, instance, primitive, texture)?;
        }
    }
    if let Some(ground) = scene.ground {
        assembler.ground(ground)?;
    }
    if let Some(blur) = scene.image.backdrop {
        assembler.backdrop(blur)?;
    }
    if let Some(painting) = &scene.painting {
        assembler.painting(painting, scene.image)?;
    }
    Ok(assembler.memory)
}

pub(super) struct Assembler<'a> {
    pub(super) stage: Stage,
    viewer: HPoint<World>,
    needs: Needs,
    anisotropy: u32,
    threads: usize,
    pub(super) memory: Memory<'a>,
    pub(super) next_id: u32,
    pub(super) next_part: u32,
}

/// The material of primitives that name none.
pub(super) static DEFAULT_MATERIAL: std::sync::LazyLock<Material> =
    std::sync::LazyLock::new(Material::default);

/// The triangles of the ground, or of an environment behind everything.
pub(super) static BACKDROP: std::sync::LazyLock<Primitive> = std::sync::LazyLock::new(|| {
    Primitive { indices: vec![0, 1, 2, 0, 2, 3], ..Primitive::default() }
});

impl<'a> Assembler<'a> {
    /// Adds what of one primitive may be seen to the frame, and what its vertices carry to the draws.
    fn draw(
        &mut self,
        placed: &'a ModelInstance,
        instance: Instance,
        primitive: &'a Primitive,
        texture: impl Fn(TextureSlot, TextureUse) -> Option<&'a MipChain<'a>>,
    ) -> Result<(), RenderError> {
        let model = &placed.model;
        let (first_id, part) = self.numbers(primitive)?;
        let posed = model.posed(instance, primitive);
        let Posed { positions, normals, to_model } = &posed;
        let model_to_world = to_model.then(placed.model_to_world);
        let model_to_clip = self.stage.model_to_clip(model_to_world);
        let material = primitive.material.map_or(&*DEFAULT_MATERIAL, |m| &model.materials[m]);
        let one_sided = !material.double_sided && !self.needs.backs;
        let viewer = one_sided.then_some(self.viewer);
        let viewer = viewer.and_then(|viewer| seen_from(model_to_world, viewer));
        let images = &mut self.memory.images;
        images.select(&self.stage, model_to_clip, primitive, &posed, viewer);
        if images.whole.is_empty() && images.cut.is_empty() {
            return Ok(());
        }
        images.project(&self.stage, model_to_clip, positions, self.threads);
        let mut draw = Draw {
            first_id,
            part,
            primitive,
            material,
            maps: Maps::of(material, self.anisotropy, texture),
            vertices: self.memory.spare.pop().unwrap_or_default(),
            tangents: tangents(model, instance, primitive, material, &posed, model_to_world),
            smooth: normals.is_some() && !self.needs.is_flat,
            uv_set: self.needs.uv_set(material, primitive),
            colors: model.posed_colors(instance, primitive),
            role: Role::Surface,
            mirrored: model_to_world.determinant() < 0.0,
            scale: libm::cbrt(model_to_world.determinant().abs()) as f32,
        };
        self.submit(&draw);
        let uvs = draw.uv_set.and_then(|set| model.posed_uvs(instance, primitive, set));
        let is_lit = self.needs.all || draw.is_lit();
        let parts = Parts {
            positions: is_lit.then_some(&**positions),
            normals: normals.as_deref().filter(|_| is_lit && draw.smooth),
            uvs: uvs.as_deref(),
        };
        let Images { whole, cut, .. } = &self.memory.images;
        let selections = [whole, cut];
        parts.vertices(
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
    fn numbers(&mut self, primitive: &Primitive) -> Result<(u32, u32), RenderError> {
        let numbers = (self.next_id, self.next_part);
        let count = u32::try_from(primitive.count()).map_err(|_| RenderError::TooManyPrimitives)?;
        self.next_id = numbers.0.checked_add(count).ok_or(RenderError::TooManyPrimitives)?;
        self.next_part += 1;
        Ok(numbers)
    }

    /// Adds what is selected of the primitive to the frame, in its order: runs of triangles as they are, and in between the points,
    /// lines and triangles that may have to be clipped.
    fn submit(&mut self, draw: &Draw<'_>) {
        let images = std::mem::take(&mut self.memory.images);
        let (cover, cull) = (self.needs.cover(draw.material), self.cull(draw));
        let triangles = draw.primitive.indices.as_chunks::<3>().0;
        for (whole, cut) in images.runs() {
            let (screen, first_id) = (&images.screen, draw.first_id);
            self.memory.frame.mesh_part(screen, triangles, whole, first_id, cover, cull);
            self.clipped(draw, &images, cut, cover, cull);
        }
        self.memory.images = images;
    }

    /// Clips a run of points, lines or triangles and adds what is left to the frame.
    fn clipped(
        &mut self,
        draw: &Draw<'_>,
        images: &Images,
        run: Range<usize>,
        cover: Cover,
        cull: Cull,
    ) {
        if run.is_empty() {
            return;
        }
        let topology = draw.primitive.topology;
        let corners = topology.corners();
        let indices = draw.primitive.indices.get(run.start * corners..run.end * corners);
        let items = indices.unwrap_or_default().chunks_exact(corners);
        for (id, corners) in (draw.first_id + run.start as u32..).zip(items) {
            match (topology, corners) {
                (Topology::Points, &[p]) => self.point(images, p, id, cover),
                (Topology::Lines, &[p, q]) => self.line(images, [p, q], id, cover),
                (Topology::Triangles, &[p, q, r]) => {
                    let frame = &mut self.memory.frame;
                    triangle(&self.stage, images, frame, [p, q, r], id, cover, cull);
                }
                _ => {}
            }
        }
    }

    fn point(&mut self, images: &Images, vertex: u32, id: u32, cover: Cover) {
        if let Some(center) = images.screen[vertex as usize] {
            self.memory.frame.point(center, POINT_SIZE, id, cover);
        }
    }

    fn line(&mut self, images: &Images, ends: [u32; 2], id: u32, cover: Cover) {
        let ends = ends.map(|vertex| images.clip[vertex as usize]);
        let Some(seen) = self.stage.visible_segment(ends) else { return };
        if let Some(ends) = self.stage.snap_all([seen.start, seen.end]) {
            let places = [seen.t0 as f32, seen.t1 as f32];
            self.memory.frame.line_piece(ends, places, LINE_WIDTH, id, cover);
        }
    }

    /// Which triangles are not to be seen: the backs of surfaces with one side. Fronts run counter-clockwise in the picture,
    /// unless either the way to the world or that to the screen mirrors.
    pub(super) fn cull(&self, draw: &Draw<'_>) -> Cull {
        let both = draw.material.double_sided || self.needs.backs;
        match (both, draw.mirrored == self.stage.mirrors) {
            (true, _) => Cull::Nothing,
            (false, true) => Cull::Clockwise,
            (false, false) => Cull::CounterClockwise,
        }
    }
}

/// Clips a triangle and adds what is left of it to a frame.
pub(super) fn triangle(
    stage: &Stage,
    images: &Images,
    frame: &mut Frame,
    vertices: [u32; 3],
    id: u32,
    cover: Cover,
    cull: Cull,
) {
    let Images { clip, outcodes, screen, .. } = images;
    let vertices = vertices.map(|vertex| vertex as usize);
    if let Some(corners) = all(vertices.map(|vertex| screen[vertex])) {
        if is_kept(cull, -signed_area(corners).signum() as f64) {
            frame.triangle(corners, id, cover);
        }
        return;
    }
    let points = vertices.map(|vertex| clip[vertex]);
    let outcodes = vertices.map(|vertex| outcodes[vertex]);
    if !Outcode::rejects(&outcodes).is_inside() || !is_kept(cull, orientation(points)) {
        return;
    }
    for piece in clip_triangle(points, &stage.volume).triangles() {
        if let Some(corners) = stage.snap_all(piece.map(|vertex| vertex.point)) {
            let weights = piece.map(|vertex| vertex.weights.map(|weight| weight as f32));
            frame.triangle_piece(corners, weights, id, cover);
        }
    }
}

/// A place of the world as it is in a model; `None` if the model is flat there.
fn seen_from(model_to_world: Affine<Model, World>, place: HPoint<World>) -> Option<HPoint<Model>> {
    Some(HPoint::from_raw(model_to_world.inverse()?.raw() * place.raw()))
}

/// Whether a triangle is kept whose [`orientation`] has this sign.
fn is_kept(cull: Cull, orientation: f64) -> bool {
    match cull {
        Cull::Nothing => true,
        Cull::Clockwise => orientation > 0.0,
        Cull::CounterClockwise => orientation < 0.0,
    }
}

/// Positive if a triangle runs counter-clockwise in the picture (y up), without a divide: the sign is right for corners
/// behind the eye too.
fn orientation([p, q, r]: [HPoint<Clip>; 3]) -> f64 {
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
        assert!(orientation(corners) > 0.0);
        let [p, q, r] = corners;
        assert!(orientation([p, r, q]) < 0.0);
        // A corner moved through the eye's plane, along the line from another: the surface still shows the same side.
        let behind = HPoint::from_raw(q.raw() - (r.raw() * 3.0 - q.raw() * 3.0));
        assert!(orientation([p, behind, r]) > 0.0);
    }
}
