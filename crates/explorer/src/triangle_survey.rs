//! The triangles of a scene against its view volume: inside, clipped, outside (CL-1, CL-3).

use camera::ViewProjection;
use clip::{Outcode, PlaneIndex, Volume, clip_triangle};
use homog::{Bounds, Clip, HPoint, Point, World};
use model::{ModelInstance, Topology};
use std::collections::BTreeMap;

/// The most triangles that are drawn in the panes around the picture.
const MAX_DRAWN: usize = 10_000;
/// The most triangles that are counted one by one.
const MAX_COUNTED: usize = 300_000;
/// The cells of the first grid that vertices are merged in, along the longest side.
const FIRST_GRID: f64 = 96.0;

/// A triangle in the world.
pub(crate) type WorldTriangle = [Point<World>; 3];

/// The triangles of models in the world.
#[derive(Debug)]
pub(crate) struct WorldTriangles {
    /// How many the models have.
    pub(crate) count: usize,
    /// Those that are counted: all, or of very large models those that are drawn.
    pub(crate) counted: Vec<WorldTriangle>,
    /// Fewer of them to draw; `None` if all are few.
    reduced: Option<Vec<WorldTriangle>>,
}

impl WorldTriangles {
    /// Collects the triangles of models.
    pub(crate) fn new(models: &[ModelInstance]) -> Self {
        let mut all = Vec::new();
        models.iter().for_each(|model| collect_triangles(model, &mut all));
        let count = all.len();
        let reduced = (count > MAX_DRAWN).then(|| merge_vertices(&all));
        match reduced {
            Some(few) if count > MAX_COUNTED => Self { count, counted: few, reduced: None },
            reduced => Self { count, counted: all, reduced },
        }
    }

    /// Whether fewer triangles are drawn than the models have.
    pub(crate) fn is_reduced(&self) -> bool {
        self.drawn().len() < self.count
    }

    /// Those that are drawn.
    pub(crate) fn drawn(&self) -> &[WorldTriangle] {
        self.reduced.as_deref().unwrap_or(&self.counted)
    }
}

fn collect_triangles(placed: &ModelInstance, triangles: &mut Vec<WorldTriangle>) {
    let model = &placed.model;
    for instance in model.mesh_instances() {
        let Some(mesh) = model.nodes[instance.node].mesh else { continue };
        for primitive in &model.meshes[mesh].primitives {
            if primitive.topology != Topology::Triangles {
                continue;
            }
            let skinned = model.skin_primitive(instance, primitive);
            let to_world = skinned.to_model.then(placed.model_to_world);
            let corner = |index: &u32| {
                let position = skinned.positions[*index as usize];
                to_world.transform_point(Point::from(position.map(f64::from)))
            };
            let corners = primitive.indices.as_chunks::<3>().0.iter();
            triangles.extend(corners.map(|[a, b, c]| [a, b, c].map(corner)));
        }
    }
}

/// Fewer triangles of the same shape: vertices of one cell of a grid become the first of them, and
/// triangles that lose a corner vanish (vertex clustering; Rossignac and Borrel 1993).
fn merge_vertices(triangles: &[WorldTriangle]) -> Vec<WorldTriangle> {
    let Some(bounds) = Bounds::from_points(triangles.iter().flatten().copied()) else {
        return Vec::new();
    };
    let (min, size) = (bounds.min(), bounds.max() - bounds.min());
    let longest = size.x().max(size.y()).max(size.z());
    let mut cells = FIRST_GRID;
    loop {
        let step = longest / cells;
        let mut first: BTreeMap<[i32; 3], Point<World>> = BTreeMap::new();
        let mut merged = |point: &Point<World>| {
            let offset = *point - min;
            let cell = [offset.x(), offset.y(), offset.z()].map(|c| (c / step) as i32);
            (cell, *first.entry(cell).or_insert(*point))
        };
        let mut kept: BTreeMap<[[i32; 3]; 3], WorldTriangle> = BTreeMap::new();
        for triangle in triangles {
            let [(a, p), (b, q), (c, r)] = triangle.each_ref().map(&mut merged);
            if a != b && b != c && c != a {
                let mut key = [a, b, c];
                key.sort_unstable();
                kept.entry(key).or_insert([p, q, r]);
            }
        }
        if kept.len() <= MAX_DRAWN || cells < 4.0 {
            return kept.into_values().collect();
        }
        cells *= 0.7;
    }
}

/// What clipping does to a triangle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Containment {
    Inside,
    Clipped,
    Outside,
}

/// How many triangles are inside, clipped and outside, and by which planes.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Survey {
    pub(crate) inside: usize,
    pub(crate) clipped: usize,
    pub(crate) outside: usize,
    /// By the planes left, right, bottom, top, near, far; a triangle may count for several.
    pub(crate) clipped_by: [usize; 6],
    /// Wholly outside of one plane, in the same order.
    pub(crate) outside_of: [usize; 6],
    /// Triangles with a corner behind the eye.
    pub(crate) behind_eye: usize,
}

/// The corners of a triangle in clip space.
pub(crate) fn project(view: &ViewProjection, triangle: &WorldTriangle) -> [HPoint<Clip>; 3] {
    let world_to_clip = view.world_to_clip();
    triangle.map(|point| world_to_clip.transform_point(point))
}

/// What clipping does to a triangle of clip space, and the planes that do it.
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
        for triangle in triangles {
            survey.add_triangle(project(view, triangle));
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
