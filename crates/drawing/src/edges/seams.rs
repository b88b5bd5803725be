//! Seams: borders of surfaces that only look like borders, because the file does not say that they belong together.
//!
//! ```text
//!   ●───────●───────●   Three faces above, two below: no side of the upper ones is a side of the lower ones. Cut at each
//!   ●────●─────●────●   other's vertices they are (T-junctions).
//! ```
//! Only borders are looked at, so that closed surfaces stay as they are, however fine.

use super::half_edges::{HalfEdge, HalfEdges};
use super::weld::remap_vertices;
use super::world_mesh::{Face, WorldMesh};
use crate::hidden_line::{Aabb, Bvh};
use glam::DVec3;

/// Points of borders nearer than this are one, in diagonals of the smaller of their objects: what quantisation to 12 bits
/// may part.
pub(super) const WELD_FRACTION: f64 = 1.0 / 4096.0;

/// An edge that one face alone has, or a part of it.
pub(super) type BorderEdge = ([u32; 2], HalfEdge);

/// Of each point the greatest distance at which it may be one with another.
#[derive(Clone, Debug)]
pub(super) struct WeldRadii(Vec<f64>);

impl WeldRadii {
    pub(super) fn from_mesh(shape: &WorldMesh) -> Self {
        let mut boxes = vec![Aabb::EMPTY; shape.objects.len()];
        let corners =
            || shape.faces.iter().flat_map(|f| f.vertices.map(|c| (c as usize, f.object)));
        for (corner, object) in corners() {
            let bounds = &mut boxes[object as usize];
            *bounds = bounds.union(Aabb::from_points([shape.points[corner]]));
        }
        let mut reach = vec![f64::INFINITY; shape.points.len()];
        for (corner, object) in corners() {
            let bounds = boxes[object as usize];
            reach[corner] = reach[corner].min((bounds.max - bounds.min).length() * WELD_FRACTION);
        }
        Self(reach)
    }

    /// The lesser of those of two ends.
    pub(super) fn edge_radius(&self, [a, b]: [u32; 2]) -> f64 {
        self.0[a as usize].min(self.0[b as usize])
    }
}

/// The edges that one face alone has.
pub(super) fn border_edges(sides: &HalfEdges) -> Vec<BorderEdge> {
    let alone = sides.edges().filter(|(_, sides)| sides.len() == 1);
    alone.map(|(ends, sides)| (ends, sides[0])).collect()
}

/// Makes points of borders that nearly coincide one. True if there were any.
pub(super) fn weld_near_borders(
    shape: &mut WorldMesh,
    borders: &[BorderEdge],
    reach: &WeldRadii,
) -> bool {
    let points = border_vertices(borders);
    let boxes: Vec<Aabb> =
        points.iter().map(|&at| Aabb::from_points([shape.points[at as usize]])).collect();
    let tree = Bvh::new(&boxes, half_surface_area);
    let mut same: Vec<u32> = (0..shape.points.len() as u32).collect();
    let mut is_taken = vec![false; points.len()];
    let mut open = Vec::new();
    let mut any = false;
    for (number, &at) in points.iter().enumerate() {
        if is_taken[number] {
            continue;
        }
        let (here, far) = (boxes[number].min, reach.0[at as usize]);
        let area = boxes[number].expanded_by(DVec3::splat(far));
        tree.for_each_overlapping(&area, usize::MAX, &mut open, |item| {
            let other = points[item as usize];
            let radius = far.min(reach.0[other as usize]);
            let is_near = (boxes[item as usize].min - here).length() <= radius;
            if item as usize > number && !is_taken[item as usize] && is_near {
                is_taken[item as usize] = true;
                same[other as usize] = at;
                any = true;
            }
        });
    }
    if any {
        remap_vertices(shape, &same);
    }
    any
}

/// Cuts borders at points of other borders that lie on them; and the triangles between each border and its parts, which have
/// a width where the points lie on it but for rounding.
pub(super) fn split_at_t_junctions(
    shape: &WorldMesh,
    borders: &[BorderEdge],
    reach: &WeldRadii,
) -> (Vec<BorderEdge>, Vec<Face>) {
    let points = border_vertices(borders);
    let position = |at: u32| shape.points[at as usize];
    let boxes: Vec<Aabb> = points.iter().map(|&at| Aabb::from_points([position(at)])).collect();
    let tree = Bvh::new(&boxes, half_surface_area);
    let (mut open, mut cuts) = (Vec::new(), Vec::new());
    let most = Bvh::query_budget(borders.len());
    let (mut parts, mut fillings) = (Vec::with_capacity(borders.len()), Vec::new());
    for &([a, b], side) in borders {
        let (from, along) = (position(a), position(b) - position(a));
        let radius = reach.edge_radius([a, b]);
        cuts.clear();
        let area = Aabb::from_points([position(a), position(b)]).expanded_by(DVec3::splat(radius));
        tree.for_each_overlapping(&area, most, &mut open, |item| {
            let (at, offset) = (points[item as usize], boxes[item as usize].min - from);
            let t = offset.dot(along) / along.length_squared();
            let is_on = t > 0.0 && t < 1.0 && (offset - along * t).length() <= radius;
            if at != a && at != b && is_on {
                cuts.push((t, at));
            }
        });
        cuts.sort_unstable_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        let neighbors =
            cuts.iter().map(|&(_, at)| at).zip(cuts.iter().skip(1).map(|&(_, at)| at).chain([b]));
        let face = shape.faces[side.face as usize];
        let filling = |(from, to)| Face { vertices: [a, from, to], ..face };
        fillings.extend(neighbors.map(filling));
        let stops = cuts.iter().map(|&(_, at)| at).chain([b]);
        parts.extend(
            stops.scan(a, |from, to| Some(border_part([std::mem::replace(from, to), to], side))),
        );
    }
    parts.sort_unstable();
    (parts, fillings)
}

/// A part of a rising edge as an edge of its own.
fn border_part([from, to]: [u32; 2], side: HalfEdge) -> BorderEdge {
    let rises = side.is_forward == (from < to);
    (
        [from.min(to), from.max(to)],
        HalfEdge { high_vertex: from.max(to), is_forward: rises, ..side },
    )
}

fn border_vertices(borders: &[BorderEdge]) -> Vec<u32> {
    let mut points: Vec<u32> = borders.iter().flat_map(|(ends, _)| *ends).collect();
    points.sort_unstable();
    points.dedup();
    points
}

/// Half the surface of a box.
pub(super) fn half_surface_area(size: DVec3) -> f64 {
    size.x * size.y + size.y * size.z + size.z * size.x
}
