//! Feature picker: finds vertices, edges, circles and faces of models by position, for dimensions.

use crate::WorldCircle;
use crate::circles::{CIRCLE_TOLERANCE, circles_of_chain};
use crate::edges::{FeatureEdge, WeldedSurface, WorldMesh};
use crate::mirror_symmetry::MirrorSymmetry;
use glam::DVec3;
use homog::{Bounds, Point, Vector, World};
use model::ModelInstance;
use std::sync::OnceLock;

/// The features of models in world space.
///
/// Objects are the nodes with a mesh, in the order of [`Model::mesh_instances`], one model after
/// the other. Passing `None` for `objects` selects all of them.
///
/// [`Model::mesh_instances`]: model::Model::mesh_instances
#[derive(Debug)]
pub struct FeaturePicker<'a> {
    models: &'a [ModelInstance],
    mesh: WorldMesh,
    crease_angle: f64,
    features: OnceLock<Features>,
}

/// The features of a welded surface.
#[derive(Debug)]
struct Features {
    surface: WeldedSurface,
    edges: Vec<FeatureEdge>,
    circles: Vec<(WorldCircle, u32)>,
}

/// A picked edge or face, with its point nearest to the given position.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PickedFeature {
    /// The nearest point.
    pub point: Point<World>,
    /// The unit vector along the edge, or perpendicular to the face.
    pub direction: Vector<World>,
    /// The midpoint of the edge, or the centroid of the triangle.
    pub middle: Point<World>,
}

impl<'a> FeaturePicker<'a> {
    /// Creates a picker for models. An edge between faces is a feature if it is sharper than
    /// `crease_angle`, in radians.
    #[must_use]
    pub fn new(models: &'a [ModelInstance], crease_angle: f64) -> Self {
        let mesh = WorldMesh::from_models(models);
        Self { models, mesh, crease_angle, features: OnceLock::new() }
    }

    /// Returns the features of the welded surface, which are found on the first call.
    fn features(&self) -> &Features {
        self.features.get_or_init(|| {
            let surface = WeldedSurface::new(self.models, &[], &[]);
            let edges = surface.feature_edges(self.crease_angle);
            let circles = surface.circles(&edges);
            Features { surface, edges, circles }
        })
    }

    /// Returns the bounding box of the objects, or `None` if they have no vertices.
    #[must_use]
    pub fn bounds(&self, objects: Option<&[u32]>) -> Option<Bounds<World>> {
        let points = self.vertices(objects).map(Point::from_raw);
        Bounds::from_points(points)
    }

    /// Returns the vertices of the objects' faces and lines.
    fn vertices(&self, objects: Option<&[u32]>) -> impl Iterator<Item = DVec3> {
        let faces = self.mesh.faces.iter().filter(move |face| is_wanted(objects, face.object));
        let lines = self.mesh.line_edges.iter().filter(move |line| is_wanted(objects, line.object));
        let of_faces = faces.flat_map(|face| face.vertices);
        of_faces.chain(lines.flat_map(|line| line.ends)).map(|at| self.mesh.points[at as usize])
    }

    /// Returns the vertex nearest to a point.
    #[must_use]
    pub fn nearest_vertex(
        &self,
        to: Point<World>,
        objects: Option<&[u32]>,
    ) -> Option<Point<World>> {
        let distance = |point: &DVec3| point.distance_squared(to.raw());
        let vertices = self.vertices(objects);
        vertices.min_by(|a, b| distance(a).total_cmp(&distance(b))).map(Point::from_raw)
    }

    /// Returns the edge nearest to a point: a crease or a boundary.
    #[must_use]
    pub fn nearest_edge(&self, to: Point<World>, objects: Option<&[u32]>) -> Option<PickedFeature> {
        let Features { surface, edges, .. } = self.features();
        let points = &surface.mesh().points;
        let wanted = edges.iter().filter(|edge| is_wanted(objects, edge.object));
        let picked = wanted.map(|edge| {
            let [a, b] = edge.ends.map(|end| points[end as usize]);
            let point = nearest_point_of_segment([a, b], to.raw());
            [point, (b - a).normalize_or_zero(), (a + b) * 0.5]
        });
        nearest(picked, to)
    }

    /// Returns the face nearest to a point: a triangle, which represents its plane.
    #[must_use]
    pub fn nearest_face(&self, to: Point<World>, objects: Option<&[u32]>) -> Option<PickedFeature> {
        let wanted = self.mesh.faces.iter().filter(|face| is_wanted(objects, face.object));
        let picked = wanted.map(|face| {
            let corners = face.vertices.map(|vertex| self.mesh.points[vertex as usize]);
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            let middle = corners.iter().sum::<DVec3>() / 3.0;
            [nearest_point_of_triangle(corners, to.raw()), normal.normalize_or_zero(), middle]
        });
        nearest(picked, to)
    }

    /// Returns the circle or arc whose center or circumference is nearest to a point.
    #[must_use]
    pub fn nearest_circle(&self, to: Point<World>, objects: Option<&[u32]>) -> Option<WorldCircle> {
        let circles = self.circles(objects);
        circles.min_by(|a, b| a.distance_to(to).total_cmp(&b.distance_to(to)))
    }

    /// Returns a search for planes of symmetry of all objects.
    pub fn mirror_symmetry(&self) -> MirrorSymmetry<'_> {
        let Features { surface, edges, .. } = self.features();
        MirrorSymmetry::new(surface, edges)
    }

    /// Returns the circles and arcs of the objects.
    pub fn circles(&self, objects: Option<&[u32]>) -> impl Iterator<Item = WorldCircle> {
        let circles = self.features().circles.iter();
        circles.filter(move |(_, object)| is_wanted(objects, *object)).map(|(circle, _)| *circle)
    }
}

impl WeldedSurface {
    /// Finds the circles and arcs along feature edges, each with its object.
    ///
    /// Points may be off their circle by up to 1/20,000 of the models' diagonal.
    pub(crate) fn circles(&self, edges: &[FeatureEdge]) -> Vec<(WorldCircle, u32)> {
        let tolerance = CIRCLE_TOLERANCE * self.diagonal();
        let chains = self.feature_chains(edges);
        let circles = chains.iter().flat_map(|chain| {
            let circles = circles_of_chain(chain, tolerance).into_iter();
            circles.map(|circle| (circle, chain.object))
        });
        circles.collect()
    }
}

/// Whether an object is one of the requested objects.
fn is_wanted(objects: Option<&[u32]>, object: u32) -> bool {
    objects.is_none_or(|objects| objects.contains(&object))
}

/// Returns the feature with the nearest point. Each item holds a point, a direction and a middle;
/// features without a direction are ignored.
fn nearest(picked: impl Iterator<Item = [DVec3; 3]>, to: Point<World>) -> Option<PickedFeature> {
    let distance = |feature: &[DVec3; 3]| feature[0].distance_squared(to.raw());
    let [point, direction, middle] = picked
        .filter(|[_, direction, _]| *direction != DVec3::ZERO)
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    Some(PickedFeature {
        point: Point::from_raw(point),
        direction: Vector::from_raw(direction),
        middle: Point::from_raw(middle),
    })
}

/// Returns the point of a triangle nearest to `to` (Ericson, *Real-Time Collision Detection*,
/// 5.1.5).
pub(crate) fn nearest_point_of_triangle([a, b, c]: [DVec3; 3], to: DVec3) -> DVec3 {
    let normal = (b - a).cross(c - a);
    let is_inside = |from: DVec3, side: DVec3| side.cross(to - from).dot(normal) >= 0.0;
    if normal != DVec3::ZERO && is_inside(a, b - a) && is_inside(b, c - b) && is_inside(c, a - c) {
        return to - normal * ((to - a).dot(normal) / normal.length_squared());
    }
    let sides = [[a, b], [b, c], [c, a]].map(|side| nearest_point_of_segment(side, to));
    let distance = |point: &DVec3| point.distance_squared(to);
    sides.into_iter().fold(
        a,
        |best, point| {
            if distance(&point) < distance(&best) { point } else { best }
        },
    )
}

/// Returns the point of a segment nearest to `to`.
pub(crate) fn nearest_point_of_segment([a, b]: [DVec3; 2], to: DVec3) -> DVec3 {
    let span = b - a;
    let length = span.length_squared();
    let t = if length > 0.0 { (to - a).dot(span) / length } else { 0.0 };
    a + span * t.clamp(0.0, 1.0)
}
