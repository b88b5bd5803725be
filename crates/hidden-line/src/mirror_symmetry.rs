//! Mirror symmetry of models, based on their surfaces rather than on their triangles.
//!
//! Models are symmetric about a plane if both conditions hold:
//! - the mirror image of each vertex is on a face;
//! - the mirror images of the ends and the middle of each feature edge are on feature edges.
//!
//! The triangulation of flat faces therefore does not matter. Round faces must be divided
//! symmetrically, or so finely that the difference is within the tolerance.

use crate::circles::CIRCLE_TOLERANCE;
use crate::edges::{FeatureEdge, WeldedSurface};
use crate::feature_picker::{nearest_point_of_segment, nearest_point_of_triangle};
use crate::visibility::{Aabb, Bvh, TriangleMesh};
use glam::DVec3;
use homog::{Point, Vector, World};

/// Directions are the same, up to sign, if the cosine of their angle is within this of ±1.
const SAME_COSINE: f64 = 1e-12;

/// A search for planes of symmetry.
#[derive(Debug)]
pub struct MirrorSymmetry<'a> {
    surface: &'a WeldedSurface,
    edges: &'a [FeatureEdge],
    edge_bvh: Bvh,
    /// The vertices of the faces.
    vertices: Vec<u32>,
    /// The maximum distance of mirror images from their counterparts, in world units.
    tolerance: f64,
    /// The directions requested so far, with their results.
    known: Vec<(DVec3, Option<Point<World>>)>,
}

impl<'a> MirrorSymmetry<'a> {
    /// Prepares a search on a surface with the given creases and boundaries.
    pub(crate) fn new(surface: &'a WeldedSurface, edges: &'a [FeatureEdge]) -> Self {
        let points = &surface.mesh().points;
        let ends = |edge: &FeatureEdge| edge.ends.map(|end| points[end as usize]);
        let faces = 0..surface.triangle_count();
        let mut vertices: Vec<u32> = faces.flat_map(|face| surface.vertex_indices(face)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        Self {
            surface,
            edges,
            edge_bvh: Bvh::new(edges.iter().map(|edge| Aabb::from_points(ends(edge)))),
            vertices,
            tolerance: CIRCLE_TOLERANCE * surface.diagonal(),
            known: Vec::new(),
        }
    }

    /// Returns a point of the plane of symmetry perpendicular to a unit vector, or `None` if the
    /// models have no such plane.
    pub fn plane_across(&mut self, direction: Vector<World>) -> Option<Point<World>> {
        let direction = direction.raw();
        let is_same = |known: DVec3| known.dot(direction).abs() > 1.0 - SAME_COSINE;
        if let Some((_, point)) = self.known.iter().find(|(known, _)| is_same(*known)) {
            return *point;
        }
        let point = self.middle_along(direction).filter(|&middle| self.mirrors(middle, direction));
        let point = point.map(Point::from_raw);
        self.known.push((direction, point));
        point
    }

    /// Returns the midpoint of the extent along a direction, or `None` if there are no faces.
    fn middle_along(&self, direction: DVec3) -> Option<DVec3> {
        let points = self.vertices.iter().map(|&vertex| self.surface.position(vertex));
        let by_height = |a: &DVec3, b: &DVec3| a.dot(direction).total_cmp(&b.dot(direction));
        let lowest = points.clone().min_by(by_height)?;
        Some((lowest + points.max_by(by_height)?) * 0.5)
    }

    /// Whether the models are symmetric about the plane through a point, perpendicular to
    /// `direction`.
    fn mirrors(&self, middle: DVec3, direction: DVec3) -> bool {
        let mirror = |point: DVec3| point - direction * (2.0 * (point - middle).dot(direction));
        let mut open = Vec::new();
        let mut vertices = self.vertices.iter().map(|&vertex| self.surface.position(vertex));
        let mut edges = self.edges.iter().flat_map(|edge| {
            let [a, b] = edge.ends.map(|end| self.surface.position(end));
            [a, b, (a + b) * 0.5]
        });
        edges.all(|point| self.is_on_edge(mirror(point), &mut open))
            && vertices.all(|point| self.is_on_face(mirror(point), &mut open))
    }

    /// Whether a point is on a feature edge.
    fn is_on_edge(&self, point: DVec3, open: &mut Vec<u32>) -> bool {
        let mut is_on = false;
        self.edge_bvh.for_each_overlapping(&self.around(point), usize::MAX, open, |edge| {
            let ends = self.edges[edge as usize].ends.map(|end| self.surface.position(end));
            is_on |= self.is_near(nearest_point_of_segment(ends, point), point);
        });
        is_on
    }

    /// Whether a point is on a face.
    fn is_on_face(&self, point: DVec3, open: &mut Vec<u32>) -> bool {
        let mut is_on = false;
        let faces = self.surface.face_bvh();
        faces.for_each_overlapping(&self.around(point), usize::MAX, open, |face| {
            let corners = self.surface.vertex_indices(face).map(|at| self.surface.position(at));
            is_on |= self.is_near(nearest_point_of_triangle(corners, point), point);
        });
        is_on
    }

    /// Returns the search box around a point.
    fn around(&self, point: DVec3) -> Aabb {
        Aabb::from_points([point]).expanded_by(DVec3::splat(self.tolerance))
    }

    fn is_near(&self, a: DVec3, b: DVec3) -> bool {
        a.distance_squared(b) <= self.tolerance * self.tolerance
    }
}
