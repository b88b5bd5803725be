//! The geometry half of the pipeline: from the meshes of a scene to the primitives of a frame.

use super::RenderError;
use super::textures::Textures;
use crate::model::{AlphaMode, Instance, Material, Posed, Primitive, Topology};
use crate::scene::{Placed, Scene};
use crate::shade::{Draw, DrawList};
use clip::{Outcode, Volume, clip_segment, clip_triangle};
use glam::DVec3;
use homog::{Affine, Clip, HPoint, Model, Ndc, Normal, Point, Screen, World};
use raster::{Cover, Frame, GUARD_BAND, ScreenVertex};
use viewport::Viewport;

/// The width of lines that a file draws, in pixels: glTF gives none.
const LINE_WIDTH: f64 = 1.5;
/// The side of points that a file draws, in pixels: glTF gives none.
const POINT_SIZE: f64 = 3.0;

/// A frame ready to be drawn, and the arrays behind it.
#[derive(Debug)]
pub(super) struct Assembly<'a> {
    pub(super) frame: Frame,
    pub(super) draws: DrawList<'a>,
}

impl<'a> Assembly<'a> {
    pub(super) fn of(scene: &'a Scene, textures: &'a Textures<'a>) -> Result<Self, RenderError> {
        let image = scene.image;
        let mut assembler = Assembler {
            stage: Stage::of(scene)?,
            frame: Frame::new(image.width, image.height, image.samples)?,
            draws: DrawList::default(),
            next_id: 0,
        };
        for (number, placed) in scene.models.iter().enumerate() {
            for (instance, primitive) in placed.model.shown_primitives() {
                let texture = |n: usize| textures.chain(number, n);
                let draw = assembler.draw(placed, instance, primitive, texture)?;
                assembler.submit(&draw);
                assembler.draws.draws.push(draw.draw);
            }
        }
        Ok(Self { frame: assembler.frame, draws: assembler.draws })
    }
}

/// The way from the world to the screen.
#[derive(Debug)]
pub(super) struct Stage {
    world_to_clip: homog::Projective<World, Clip>,
    volume: Volume,
    ndc_to_screen: Affine<Ndc, Screen>,
    mirrors: bool,
}

impl Stage {
    pub(super) fn of(scene: &Scene) -> Result<Self, RenderError> {
        let (width, height) = (scene.image.width, scene.image.height);
        let viewport = Viewport::image(width, height)?;
        // Clip only what would leave the rasteriser's grid, with a pixel to spare: its tiles cut the rest (CL-4).
        let band = |side: u32| {
            let half = 0.5 * f64::from(side);
            (1.0 - (GUARD_BAND.start() + 1.0) / half).clamp(1.0, Volume::MAX_GUARD_BAND)
        };
        let volume = Volume::CHAPTER;
        let volume = volume.with_guard_band(band(width), band(height)).unwrap_or(volume);
        Ok(Self {
            world_to_clip: scene.shot.world_to_clip(),
            volume,
            ndc_to_screen: viewport.ndc_to_screen(),
            mirrors: scene.shot.mirrors(),
        })
    }

    /// Clip-space images of a primitive's vertices.
    pub(super) fn to_clip(
        &self,
        positions: &[[f32; 3]],
        model_to_world: Affine<Model, World>,
    ) -> Vec<HPoint<Clip>> {
        let model_to_clip = model_to_world.then_project(self.world_to_clip);
        positions.iter().map(|&p| model_to_clip.point(to_point(p))).collect()
    }

    /// The visible part of a line; `None` if there is none.
    pub(super) fn visible_segment(&self, ends: [HPoint<Clip>; 2]) -> Option<clip::ClippedSegment> {
        clip_segment(ends[0], ends[1], &self.volume)
    }

    /// The divide and the viewport.
    pub(super) fn to_screen(&self, point: HPoint<Clip>) -> Option<Point<Screen>> {
        Some(self.ndc_to_screen.point(point.divide()?))
    }

    fn snap(&self, point: HPoint<Clip>) -> Option<ScreenVertex> {
        ScreenVertex::snap(self.to_screen(point)?, point.w())
    }

    fn snap_all<const N: usize>(&self, points: [HPoint<Clip>; N]) -> Option<[ScreenVertex; N]> {
        all(points.map(|point| self.snap(point)))
    }
}

/// All vertices of a primitive, if none is missing.
fn all<const N: usize>(vertices: [Option<ScreenVertex>; N]) -> Option<[ScreenVertex; N]> {
    let mut found = [vertices[0]?; N];
    for (place, vertex) in found.iter_mut().zip(vertices) {
        *place = vertex?;
    }
    Some(found)
}

fn to_point(position: [f32; 3]) -> Point<Model> {
    Point::from_raw(DVec3::from_array(position.map(f64::from)))
}

/// A draw on its way into the frame, with what only the geometry stages need.
struct Submission<'a> {
    draw: Draw<'a>,
    clip: Vec<HPoint<Clip>>,
    outcodes: Vec<Outcode>,
    /// The vertices on the screen; `None` for those outside of the view volume and its guard band.
    screen: Vec<Option<ScreenVertex>>,
}

struct Assembler<'a> {
    stage: Stage,
    frame: Frame,
    draws: DrawList<'a>,
    next_id: u32,
}

/// The material of primitives that name none.
static DEFAULT_MATERIAL: std::sync::LazyLock<Material> =
    std::sync::LazyLock::new(Material::default);

impl<'a> Assembler<'a> {
    /// The vertex stage of one primitive.
    fn draw(
        &mut self,
        placed: &'a Placed,
        instance: Instance,
        primitive: &'a Primitive,
        texture: impl Fn(usize) -> Option<&'a crate::shade::MipChain<'a>>,
    ) -> Result<Submission<'a>, RenderError> {
        let model = &placed.model;
        let Posed { positions, normals, to_model } = model.posed(instance, primitive);
        let model_to_world = to_model.then(placed.model_to_world);
        let material = primitive.material.map_or(&*DEFAULT_MATERIAL, |m| &model.materials[m]);
        let clip = self.stage.to_clip(&positions, model_to_world);
        let outcodes: Vec<_> = clip.iter().map(|&point| self.stage.volume.outcode(point)).collect();
        let snap_inside = |(&point, code): (&HPoint<Clip>, &Outcode)| {
            code.is_inside().then(|| self.stage.snap(point)).flatten()
        };
        let screen = clip.iter().zip(&outcodes).map(snap_inside).collect();
        let to_place = |&p: &[f32; 3]| model_to_world.point(to_point(p)).raw().as_vec3().to_array();
        let draw = Draw {
            first_id: self.next_id,
            primitive,
            material,
            base_color_texture: material.base_color_texture.and_then(|used| texture(used.texture)),
            emissive_texture: material.emissive_texture.and_then(|used| texture(used.texture)),
            places: positions.iter().map(to_place).collect(),
            normals: normals.map(|normals| to_world(&normals, model_to_world)),
            mirrored: model_to_world.determinant() < 0.0,
        };
        let count = u32::try_from(primitive.count()).map_err(|_| RenderError::TooManyPrimitives)?;
        self.next_id = self.next_id.checked_add(count).ok_or(RenderError::TooManyPrimitives)?;
        Ok(Submission { draw, clip, outcodes, screen })
    }

    /// Clips the primitive's points, lines or triangles and adds what is left to the frame.
    fn submit(&mut self, submission: &Submission<'a>) {
        let primitive = submission.draw.primitive;
        let cover = cover_of(submission.draw.material.alpha_mode);
        let items = primitive.indices.chunks_exact(primitive.topology.corners());
        for (id, corners) in (submission.draw.first_id..).zip(items) {
            match (primitive.topology, corners) {
                (Topology::Points, &[p]) => self.point(submission, p, id, cover),
                (Topology::Lines, &[p, q]) => self.line(submission, [p, q], id, cover),
                (Topology::Triangles, &[p, q, r]) => {
                    self.triangle(submission, [p, q, r], id, cover);
                }
                _ => {}
            }
        }
    }

    fn point(&mut self, submission: &Submission<'_>, vertex: u32, id: u32, cover: Cover) {
        if let Some(center) = submission.screen[vertex as usize] {
            self.frame.point(center, POINT_SIZE, id, cover);
        }
    }

    fn line(&mut self, submission: &Submission<'_>, ends: [u32; 2], id: u32, cover: Cover) {
        let ends = ends.map(|vertex| submission.clip[vertex as usize]);
        let Some(seen) = self.stage.visible_segment(ends) else { return };
        if let Some(ends) = self.stage.snap_all([seen.start, seen.end]) {
            let places = [seen.t0 as f32, seen.t1 as f32];
            self.frame.line_piece(ends, places, LINE_WIDTH, id, cover);
        }
    }

    fn triangle(&mut self, submission: &Submission<'_>, corners: [u32; 3], id: u32, cover: Cover) {
        let points = corners.map(|vertex| submission.clip[vertex as usize]);
        let outcodes = corners.map(|vertex| submission.outcodes[vertex as usize]);
        let draw = &submission.draw;
        let faces_away = orientation(points) * self.sign_of_front(draw) <= 0.0;
        if faces_away && !draw.material.double_sided || !Outcode::rejects(&outcodes).is_inside() {
            return;
        }
        if let Some(corners) = all(corners.map(|vertex| submission.screen[vertex as usize])) {
            self.frame.triangle(corners, id, cover);
            return;
        }
        for piece in clip_triangle(points, &self.stage.volume).triangles() {
            if let Some(corners) = self.stage.snap_all(piece.map(|vertex| vertex.point)) {
                let weights = piece.map(|vertex| vertex.weights.map(|weight| weight as f32));
                self.frame.triangle_piece(corners, weights, id, cover);
            }
        }
    }

    /// 1 if fronts are counter-clockwise in the picture, −1 if they are clockwise there.
    fn sign_of_front(&self, draw: &Draw<'_>) -> f64 {
        if draw.mirrored == self.stage.mirrors { 1.0 } else { -1.0 }
    }
}

/// Positive if a triangle runs counter-clockwise in the picture (y up), without a divide: the sign is right for corners
/// behind the eye too.
fn orientation([p, q, r]: [HPoint<Clip>; 3]) -> f64 {
    let column = |point: HPoint<Clip>| DVec3::new(point.x(), point.y(), point.w());
    column(p).dot(column(q).cross(column(r)))
}

fn cover_of(mode: AlphaMode) -> Cover {
    match mode {
        AlphaMode::Opaque => Cover::Solid,
        AlphaMode::Mask { .. } => Cover::Masked,
        AlphaMode::Blend => Cover::Translucent,
    }
}

fn to_world(normals: &[[f32; 3]], model_to_world: Affine<Model, World>) -> Vec<[f32; 3]> {
    let turned = |&normal: &[f32; 3]| {
        let normal = Normal::<Model>::from_raw(DVec3::from_array(normal.map(f64::from)));
        let world = model_to_world.normal(normal).normalized();
        world.map_or([0.0; 3], |normal| normal.raw().as_vec3().to_array())
    };
    normals.iter().map(turned).collect()
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
