//! Classifies the triangles of a scene against its view volume: inside, clipped or outside (CL-1,
//! CL-3).

use camera::ViewProjection;
use clip::{Outcode, PlaneIndex, Volume, clip_triangle};
use homog::{Affine, Bounds, Clip, HPoint, Model as ModelSpace, Point, Projective, World};
use model::{MeshInstance, ModelInstance, Topology};
use std::collections::BTreeMap;

/// The maximum number of triangles drawn in the panes next to the main picture.
const MAX_DRAWN: usize = 10_000;
/// The maximum number of triangles for which every triangle is classified.
const MAX_COUNTED: usize = 300_000;
/// The number of cells along the longest side of the first vertex-merging grid.
const FIRST_GRID: f64 = 96.0;

/// The distance up to which a point counts as part of a triangle, as a fraction of its size.
const NEXT_TO: f64 = 1e-3;

/// A triangle in world space.
pub(crate) type WorldTriangle = [Point<World>; 3];

/// The triangles of models in world space.
#[derive(Debug)]
pub(crate) struct WorldTriangles {
    /// The number of triangles in the models.
    pub(crate) count: usize,
    /// The classified triangles: all of them, or only the drawn triangles of very large models.
    pub(crate) counted: Vec<WorldTriangle>,
    /// A smaller set for drawing; `None` if the classified triangles are drawn.
    reduced: Option<Vec<WorldTriangle>>,
    /// The primitives in the order of their triangles.
    parts: Vec<Part>,
}

/// A primitive with triangles.
#[derive(Debug)]
struct Part {
    /// The number of triangles up to the end of this primitive.
    end: usize,
    /// The transform of the primitive's node and model.
    mesh_to_world: Affine<ModelSpace, World>,
}

impl WorldTriangles {
    /// Collects the triangles of models.
    pub(crate) fn new(models: &[ModelInstance]) -> Self {
        let parts = list_parts(models);
        let count = parts.last().map_or(0, |part| part.end);
        let reduced = (count > MAX_DRAWN).then(|| merge_vertices(models));
        match reduced {
            Some(few) if count > MAX_COUNTED => Self { count, counted: few, reduced: None, parts },
            reduced => {
                let mut counted = Vec::with_capacity(count);
                visit_triangles(models, &mut |triangle| counted.push(triangle));
                Self { count, counted, reduced, parts }
            }
        }
    }

    /// Whether fewer triangles are drawn than the models contain.
    pub(crate) fn is_reduced(&self) -> bool {
        self.drawn().len() < self.count
    }

    /// Returns the transform of the primitive whose surface contains a point, or of the first
    /// primitive if none does; `None` without triangles.
    pub(crate) fn mesh_to_world_at(
        &self,
        point: Point<World>,
    ) -> Option<Affine<ModelSpace, World>> {
        let near = |(at, triangle): (usize, &WorldTriangle)| {
            Some((distance_on_triangle(triangle, point)?, at))
        };
        let hits = self.counted.iter().enumerate().filter_map(near);
        let at = hits.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, at)| at);
        // A simplified model does not record which primitive a triangle belongs to.
        let at = at.filter(|_| self.counted.len() == self.count);
        let part = self.parts.iter().find(|part| part.end > at.unwrap_or(0))?;
        Some(part.mesh_to_world)
    }

    /// Returns the drawn triangles.
    pub(crate) fn drawn(&self) -> &[WorldTriangle] {
        self.reduced.as_deref().unwrap_or(&self.counted)
    }
}

/// Returns the distance between a point and a triangle's plane if the point is on the triangle.
fn distance_on_triangle(triangle: &WorldTriangle, point: Point<World>) -> Option<f64> {
    let [a, b, c] = *triangle;
    let (ab, ac, ap) = (b - a, c - a, point - a);
    let normal = ab.cross(ac);
    let size = normal.length();
    let distance = ap.dot(normal).abs() / size;
    let [u, v] = [ap.cross(ac), ab.cross(ap)].map(|part| part.dot(normal) / (size * size));
    let is_inside = u >= -NEXT_TO && v >= -NEXT_TO && u + v <= 1.0 + NEXT_TO;
    // Picked points are only as precise as the depth buffer.
    let is_near = distance <= NEXT_TO * libm::sqrt(size);
    (is_inside && is_near).then_some(distance)
}

/// Lists the primitives with triangles, in the order of [`visit_triangles`].
fn list_parts(models: &[ModelInstance]) -> Vec<Part> {
    let mut end = 0;
    let mut parts = Vec::new();
    for placed in models {
        for (instance, primitive) in placed.model.scene_primitives() {
            if primitive.topology == Topology::Triangles && !primitive.indices.is_empty() {
                end += primitive.indices.len() / 3;
                let to_model = placed.model.skin_primitive(instance, primitive).to_model;
                parts.push(Part { end, mesh_to_world: to_model.then(placed.model_to_world) });
            }
        }
    }
    parts
}

/// Visits the triangles of models. A list of all triangles of a large model would not fit in a
/// page's memory.
fn visit_triangles(models: &[ModelInstance], visit: &mut dyn FnMut(WorldTriangle)) {
    for placed in models {
        for instance in placed.model.mesh_instances() {
            visit_triangles_of_mesh(placed, instance, visit);
        }
    }
}

fn visit_triangles_of_mesh(
    placed: &ModelInstance,
    instance: MeshInstance,
    visit: &mut dyn FnMut(WorldTriangle),
) {
    let model = &placed.model;
    let mesh = model.nodes[instance.node].mesh.and_then(|mesh| model.meshes.get(mesh));
    let primitives = mesh.map_or(&[][..], |mesh| &mesh.primitives);
    for primitive in primitives.iter().filter(|it| it.topology == Topology::Triangles) {
        let skinned = model.skin_primitive(instance, primitive);
        let to_world = skinned.to_model.then(placed.model_to_world);
        let corner = |index: &u32| {
            let position = skinned.positions[*index as usize];
            to_world.transform_point(Point::from(position.map(f64::from)))
        };
        for triangle in primitive.indices.as_chunks::<3>().0 {
            visit(triangle.each_ref().map(corner));
        }
    }
}

/// A cell of the vertex-merging grid.
type Cell = [i32; 3];

/// Simplifies triangles: all vertices in a grid cell are replaced by the first vertex, and
/// triangles that lose a corner disappear (vertex clustering; Rossignac and Borrel 1993).
fn merge_vertices(models: &[ModelInstance]) -> Vec<WorldTriangle> {
    let Some(bounds) = Bounds::from_points(model::world_points(models)) else { return Vec::new() };
    let size = bounds.max() - bounds.min();
    let longest = size.x().max(size.y()).max(size.z());
    let mut cells = FIRST_GRID;
    loop {
        let kept = merge_in_grid(models, bounds.min(), longest / cells);
        if kept.len() <= MAX_DRAWN || cells < 4.0 {
            return kept.into_values().collect();
        }
        cells *= 0.7;
    }
}

/// Returns the triangles whose corners are in three different cells of this size, one triangle for
/// each triple of cells.
fn merge_in_grid(
    models: &[ModelInstance],
    origin: Point<World>,
    step: f64,
) -> BTreeMap<[Cell; 3], WorldTriangle> {
    let mut first: BTreeMap<Cell, Point<World>> = BTreeMap::new();
    let mut kept: BTreeMap<[Cell; 3], WorldTriangle> = BTreeMap::new();
    visit_triangles(models, &mut |triangle| {
        let merged = triangle.map(|point| {
            let offset = point - origin;
            let cell = [offset.x(), offset.y(), offset.z()].map(|c| (c / step) as i32);
            (cell, *first.entry(cell).or_insert(point))
        });
        let [(a, p), (b, q), (c, r)] = merged;
        if a != b && b != c && c != a {
            let mut key = [a, b, c];
            key.sort_unstable();
            kept.entry(key).or_insert([p, q, r]);
        }
    });
    kept
}

/// The effect of clipping on a triangle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Containment {
    Inside,
    Clipped,
    Outside,
}

/// How many triangles are inside, clipped and outside, in total and by plane.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Survey {
    pub(crate) inside: usize,
    pub(crate) clipped: usize,
    pub(crate) outside: usize,
    /// The number of triangles that each plane clips: left, right, bottom, top, near and far. A
    /// triangle may be counted under several planes.
    pub(crate) clipped_by: [usize; 6],
    /// The number of triangles entirely outside each plane, in the same order.
    pub(crate) outside_of: [usize; 6],
    /// The number of triangles with a corner behind the eye.
    pub(crate) behind_eye: usize,
}

/// Returns the corners of a triangle in clip space.
pub(crate) fn project(
    world_to_clip: &Projective<World, Clip>,
    triangle: &WorldTriangle,
) -> [HPoint<Clip>; 3] {
    triangle.map(|point| world_to_clip.transform_point(point))
}

/// Returns the effect of clipping on a triangle in clip space and the planes that cause it.
pub(crate) fn classify(corners: [HPoint<Clip>; 3]) -> (Containment, Outcode) {
    let codes = corners.map(|corner| Volume::CHAPTER.outcode(corner));
    if Outcode::trivially_accepts(&codes) {
        return (Containment::Inside, Outcode::INSIDE);
    }
    let clipped = clip_triangle(corners, &Volume::CHAPTER);
    match clipped.is_empty() {
        true => (Containment::Outside, clipped.outcomes.rejected),
        false => (Containment::Clipped, clipped.outcomes.clipped),
    }
}

impl Survey {
    /// Counts the triangles.
    pub(crate) fn new(view: &ViewProjection, triangles: &[WorldTriangle]) -> Self {
        let mut survey = Self::default();
        let world_to_clip = view.world_to_clip();
        for triangle in triangles {
            survey.add_triangle(project(&world_to_clip, triangle));
        }
        survey
    }

    fn add_triangle(&mut self, corners: [HPoint<Clip>; 3]) {
        let (containment, planes) = classify(corners);
        self.behind_eye += usize::from(corners.iter().any(|corner| corner.w() <= 0.0));
        let by_plane = match containment {
            Containment::Inside => {
                self.inside += 1;
                return;
            }
            Containment::Clipped => {
                self.clipped += 1;
                &mut self.clipped_by
            }
            Containment::Outside => {
                self.outside += 1;
                &mut self.outside_of
            }
        };
        for (count, plane) in by_plane.iter_mut().zip(PlaneIndex::BOX) {
            *count += usize::from(planes.contains(plane));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use import::MemoryFolder;
    use std::fmt::Write as _;
    use std::sync::Arc;

    /// Returns a grid of `side` × `side` squares on the unit square, loaded from OBJ.
    fn grid(side: usize) -> ModelInstance {
        let mut obj = String::new();
        let row = side + 1;
        for vertex in 0..row * row {
            let [x, y] = [vertex % row, vertex / row].map(|at| at as f64 / side as f64);
            let _ = writeln!(obj, "v {x} {y} 0");
        }
        for square in 0..side * side {
            let a = square / side * row + square % side + 1;
            let _ = writeln!(
                obj,
                "f {} {} {}\nf {} {} {}",
                a,
                a + 1,
                a + row,
                a + 1,
                a + row + 1,
                a + row
            );
        }
        let mut folder = MemoryFolder::default();
        assert!(folder.insert("grid.obj", obj.into_bytes()));
        let model = import::load_from_memory(&folder, "grid.obj", &Default::default());
        ModelInstance { model: Arc::new(model.expect("a model")), model_to_world: Affine::IDENTITY }
    }

    fn area(triangles: &[WorldTriangle]) -> f64 {
        let area = |[a, b, c]: &WorldTriangle| 0.5 * (*b - *a).cross(*c - *a).length();
        triangles.iter().map(area).sum()
    }

    #[test]
    fn small_models_are_drawn_completely() {
        let triangles = WorldTriangles::new(&[grid(10)]);
        assert_eq!((triangles.count, triangles.drawn().len()), (200, 200));
        assert!(!triangles.is_reduced());
    }

    #[test]
    fn simplified_large_models_keep_their_area() {
        let triangles = WorldTriangles::new(&[grid(150)]);
        assert_eq!((triangles.count, triangles.counted.len()), (45_000, 45_000));
        assert!(triangles.is_reduced() && triangles.drawn().len() <= MAX_DRAWN);
        assert!((area(triangles.drawn()) - 1.0).abs() < 0.06, "{}", area(triangles.drawn()));
    }
}
