//! Visibility survey of a model: how many of its primitives the view volume clips or rejects.
//!
//! Ray casting during the survey decides whether the eye is inside the model: for a closed surface,
//! each ray from an interior point leaves once more than it enters.

use crate::Scene;
use clip::{Outcode, PlaneIndex, Volume, clip_point, clip_segment, clip_triangle};
use glam::DVec3;
use homog::{Clip, HPoint, Point, World};
use model::ModelInstance;
use model::{MeshInstance, Primitive};

/// Directions of the rays from the eye, in world space. Their components are unrelated, so that
/// rays almost never hit an edge or vertex of a modeled shape, where a crossing would count twice.
/// All three rays must agree.
const PROBE_DIRECTIONS: [DVec3; 3] = [
    DVec3::new(0.5773, 0.6191, 0.5324),
    DVec3::new(-0.7167, 0.3291, 0.6149),
    DVec3::new(0.2718, -0.8618, -0.4283),
];

/// Counts of a model's primitives and vertices by their position in the view volume.
#[derive(Clone, Copy, Default, Debug)]
pub(super) struct VisibilitySurvey {
    /// The number of points, lines and triangles.
    pub(super) total: usize,
    /// The number of primitives partly or wholly inside the view volume.
    pub(super) inside: usize,
    /// The number of primitives wholly outside a plane, for each of the six planes.
    pub(super) outside: [usize; 6],
    /// Vertices that only the near plane keeps out of the picture, although they are in front of
    /// the eye.
    pub(super) before_near: usize,
    /// Vertices that only the far plane keeps out of the picture.
    pub(super) behind_far: usize,
    /// The smallest and largest distances of vertices along the gaze.
    depth_range: Option<(f64, f64)>,
    /// The smallest and largest x and y of the parts inside, in a window from −1 to 1.
    window: Option<[f64; 4]>,
    /// For each ray from the eye, the number of exits minus the number of entries.
    crossings: [i64; 3],
}

impl VisibilitySurvey {
    /// Surveys every visible primitive of a model in the scene, in O(vertices + primitives). Rays
    /// from the center of projection decide whether the model encloses it.
    pub(super) fn from_model(scene: &Scene, placed: &ModelInstance) -> Self {
        let mut survey = Self::default();
        for (instance, primitive) in placed.model.scene_primitives() {
            survey.survey_primitive(scene, placed, instance, primitive);
        }
        survey
    }

    /// Combines the surveys of two models. Ray crossings are not added: an eye is inside one model
    /// or another, not inside their sum.
    pub(super) fn merge(mut self, other: &Self) -> Self {
        self.total += other.total;
        self.inside += other.inside;
        self.before_near += other.before_near;
        self.behind_far += other.behind_far;
        for (sum, count) in self.outside.iter_mut().zip(other.outside) {
            *sum += count;
        }
        if let Some(window) = other.window {
            self.extend_window(window);
        }
        if let Some((near, far)) = other.depth_range {
            self.extend_depth_range(near);
            self.extend_depth_range(far);
        }
        self
    }

    /// Whether there are primitives but none of them is in the picture.
    pub(super) fn is_unseen(&self) -> bool {
        self.total > 0 && self.inside == 0
    }

    /// Returns the smallest and largest distances of vertices along the gaze, or `None` without
    /// vertices.
    pub(super) fn depth_range(&self) -> Option<(f64, f64)> {
        self.depth_range
    }

    /// Whether the eye is inside: every ray leaves the model once more than it enters it. An open
    /// surface, or a room with faces that point inward, encloses nothing.
    pub(super) fn encloses_eye(&self) -> bool {
        self.crossings.iter().all(|count| *count >= 1)
    }

    /// Returns the width and height of the rectangle around the visible parts, as fractions of the
    /// picture's, or `None` if nothing is visible. A part that is partly behind the eye counts as
    /// filling the picture.
    pub(super) fn window_part(&self) -> Option<[f64; 2]> {
        self.window.map(|[left, bottom, right, top]| [(right - left) / 2.0, (top - bottom) / 2.0])
    }

    /// Extends the rectangle in the window to include another.
    fn extend_window(&mut self, other: [f64; 4]) {
        let own = self.window.unwrap_or(other);
        let least = [own[0].min(other[0]), own[1].min(other[1])];
        self.window = Some([least[0], least[1], own[2].max(other[2]), own[3].max(other[3])]);
    }

    /// Extends the depth range to include a distance.
    fn extend_depth_range(&mut self, distance: f64) {
        let (near, far) = self.depth_range.unwrap_or((distance, distance));
        self.depth_range = Some((near.min(distance), far.max(distance)));
    }

    /// Adds the vertices and the points, lines or triangles of a mesh primitive.
    ///
    /// Vertices are skinned and transformed once; every primitive then uses their positions and
    /// outcodes by index. A transform with a negative determinant swaps front and back faces, which
    /// `sign` undoes.
    fn survey_primitive(
        &mut self,
        scene: &Scene,
        placed: &ModelInstance,
        instance: MeshInstance,
        primitive: &Primitive,
    ) {
        let view_projection = &scene.view_projection;
        let eye = view_projection.viewer().divide();
        // The near and far planes enclose the parts that sections retain.
        let sections = if scene.style.draws_surfaces() { &[][..] } else { &scene.sections };
        let posed = placed.model.skin_primitive(instance, primitive);
        let to_world = posed.to_model.then(placed.model_to_world);
        let world: Vec<Point<World>> = posed
            .positions
            .iter()
            .map(|at| to_world.transform_point(at.map(f64::from).into()))
            .collect();
        let world_to_clip = view_projection.world_to_clip();
        let clip: Vec<HPoint<Clip>> =
            world.iter().map(|&at| world_to_clip.transform_point(at)).collect();
        let codes: Vec<Outcode> = clip.iter().map(|&at| Volume::CHAPTER.outcode(at)).collect();
        let world_to_view = view_projection.camera.world_to_view();
        let sign = if to_world.raw().determinant() < 0.0 { -1 } else { 1 };
        for item in primitive.indices.chunks_exact(primitive.topology.vertices_per_item()) {
            let item: Vec<usize> = item.iter().map(|&at| at as usize).collect();
            for &at in &item {
                let distance = -world_to_view.transform_point(world[at]).z();
                self.extend_depth_range(distance);
                if sections.iter().all(|plane| plane.evaluate(world[at]) >= 0.0) {
                    self.count_vertex(codes[at], distance);
                }
            }
            self.count_primitive(&item, &clip, &codes);
            // The signed crossings along a ray sum to 0 unless the eye is inside a closed mesh.
            if let (Some(eye), &[a, b, c]) = (eye, item.as_slice()) {
                let corners = [a, b, c].map(|at| world[at].raw() - eye.raw());
                for (count, ray) in self.crossings.iter_mut().zip(PROBE_DIRECTIONS) {
                    *count += sign * ray_crossing(ray, corners);
                }
            }
        }
    }

    /// Counts a vertex, at a distance along the gaze, that a depth plane cuts off.
    ///
    /// A vertex counts as cut only if a depth plane is the only plane that it is outside of.
    /// Vertices shared by several primitives are counted once for each.
    fn count_vertex(&mut self, code: Outcode, distance: f64) {
        if code == Outcode::INSIDE.with_plane(PlaneIndex::NEAR) && distance > 0.0 {
            self.before_near += 1;
        }
        if code == Outcode::INSIDE.with_plane(PlaneIndex::FAR) {
            self.behind_far += 1;
        }
    }

    /// Counts a point, line or triangle.
    ///
    /// Exact clipping decides, not just the outcodes: a large triangle can pass every trivial test
    /// next to a corner of the volume and still be entirely outside.
    fn count_primitive(&mut self, item: &[usize], clip: &[HPoint<Clip>], codes: &[Outcode]) {
        self.total += 1;
        let corner_codes: Vec<Outcode> = item.iter().map(|&at| codes[at]).collect();
        for plane in Outcode::trivially_rejects(&corner_codes).planes() {
            if let Some(count) = self.outside.get_mut(plane.index()) {
                *count += 1;
            }
        }
        let volume = &Volume::CHAPTER;
        let is_left = match *item {
            [a] => clip_point(clip[a], volume).is_some(),
            [a, b] => clip_segment(clip[a], clip[b], volume).is_some(),
            [a, b, c] => !clip_triangle([clip[a], clip[b], clip[c]], volume).vertices().is_empty(),
            _ => false,
        };
        self.inside += usize::from(is_left);
        for &at in item.iter().filter(|_| is_left) {
            let place = clip[at].divide().filter(|_| clip[at].w() > 0.0);
            let around = place.map(|place| [place.x(), place.y()].map(|c| c.clamp(-1.0, 1.0)));
            self.extend_window(around.map_or([-1.0, -1.0, 1.0, 1.0], |[x, y]| [x, y, x, y]));
        }
    }
}

/// Returns 1 if a ray from the origin exits through the triangle, -1 if it enters, and 0 if it
/// misses (Möller and Trumbore, 1997, with the triangle seen from the ray's origin).
///
/// Solves t d = (1 − u − v) a + u b + v c by Cramer's rule. The triangle is relative to the eye.
/// Rays parallel to its plane have a determinant of 0 and miss. A ray through an edge hits the
/// triangles on both sides of it.
fn ray_crossing(ray: DVec3, [a, b, c]: [DVec3; 3]) -> i64 {
    let (along, across) = (b - a, c - a);
    let normal = ray.cross(across);
    let determinant = along.dot(normal);
    if determinant == 0.0 {
        return 0;
    }
    let u = -a.dot(normal) / determinant;
    let rest = -a.cross(along);
    let v = ray.dot(rest) / determinant;
    let distance = across.dot(rest) / determinant;
    let hit = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0;
    // Faces are counterclockwise from the front: the ray exits through a face turned away from its
    // origin.
    match (hit, determinant < 0.0) {
        (false, _) => 0,
        (true, true) => 1,
        (true, false) => -1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::Topology;

    #[test]
    fn rays_exit_through_back_faces() {
        let corners =
            [DVec3::new(-1.0, -1.0, 2.0), DVec3::new(1.0, -1.0, 2.0), DVec3::new(0.0, 1.0, 2.0)];
        let [a, b, c] = corners;
        // Counterclockwise seen from +z: its front faces +z, away from the origin.
        assert_eq!(ray_crossing(DVec3::Z, [a, b, c]), 1);
        assert_eq!(ray_crossing(DVec3::Z, [a, c, b]), -1);
        assert_eq!(ray_crossing(-DVec3::Z, [a, b, c]), 0);
        assert_eq!(ray_crossing(DVec3::X, [a, b, c]), 0);
    }

    #[test]
    fn topologies_have_the_expected_number_of_vertices() {
        let all = [Topology::Points, Topology::Lines, Topology::Triangles];
        assert_eq!(all.map(Topology::vertices_per_item), [1, 2, 3]);
    }
}
