//! Seam repair: closes false boundaries by near welding and by cutting edges at T-junctions.
//!
//! ```text
//!   ●───────●───────●     two faces above, three below: no side of an upper face
//!   ●────●─────●────●     is a side of a lower face until both are cut at the T-junctions
//! ```
//!
//! Only boundary edges are examined, so a closed surface stays unchanged, however fine its
//! triangles are. A boundary that is matched with a partner here is classified like any other edge;
//! a boundary without a partner is drawn.

use super::half_edges::{HalfEdge, HalfEdges};
use super::weld::remap_vertices;
use super::world_mesh::{Face, WorldMesh};
use crate::visibility::{Aabb, Bvh};
use glam::DVec3;

/// The weld radius as a fraction of an object's diagonal: 1/4096, the step of positions quantized
/// to 12 bits.
pub(super) const WELD_FRACTION: f64 = 1.0 / 4096.0;

/// The maximum number of cuts of boundary edges per boundary vertex.
const CUTS_PER_VERTEX: usize = 4;

/// A boundary edge, or a part of one between T-junctions: its ends, with the lower index first, and
/// its half-edge.
pub(super) type BorderEdge = ([u32; 2], HalfEdge);

/// The weld radius of each vertex: another boundary vertex within this distance may be the same
/// vertex.
///
/// The radius is relative to the object, because each object is quantized in its own bounding box;
/// if objects share a vertex, the smaller radius counts.
#[derive(Clone, Debug)]
pub(super) struct WeldRadii(Vec<f64>);

impl WeldRadii {
    /// Computes the radii of all vertices of a mesh; the radius of a vertex without a face is
    /// infinite.
    pub(super) fn from_mesh(mesh: &WorldMesh) -> Self {
        let mut boxes = vec![Aabb::EMPTY; mesh.objects.len()];
        let vertices =
            || mesh.faces.iter().flat_map(|f| f.vertices.map(|c| (c as usize, f.object)));
        for (vertex, object) in vertices() {
            let bounds = &mut boxes[object as usize];
            *bounds = bounds.union(Aabb::from_points([mesh.points[vertex]]));
        }
        let mut radii = vec![f64::INFINITY; mesh.points.len()];
        for (vertex, object) in vertices() {
            let bounds = boxes[object as usize];
            radii[vertex] = radii[vertex].min((bounds.max - bounds.min).length() * WELD_FRACTION);
        }
        Self(radii)
    }

    /// Returns the smaller of the radii at the two ends of an edge.
    pub(super) fn edge_radius(&self, [a, b]: [u32; 2]) -> f64 {
        self.0[a as usize].min(self.0[b as usize])
    }
}

/// Returns the edges with a single half-edge.
pub(super) fn border_edges(sides: &HalfEdges) -> Vec<BorderEdge> {
    let alone = sides.edges().filter(|(_, sides)| sides.len() == 1);
    alone.map(|(ends, sides)| (ends, sides[0])).collect()
}

/// Welds boundary vertices within each other's weld radius, and returns whether any were welded.
///
/// Vertices are visited in the order of their indices. Each vertex absorbs its unwelded neighbors,
/// found with a BVH over the points. A chain of nearby vertices does not collapse into one vertex,
/// because an absorbed vertex does not search again.
pub(super) fn weld_near_borders(
    mesh: &mut WorldMesh,
    borders: &[BorderEdge],
    radii: &WeldRadii,
) -> bool {
    let points = border_vertices(borders);
    let boxes: Vec<Aabb> =
        points.iter().map(|&vertex| Aabb::from_points([mesh.points[vertex as usize]])).collect();
    let bvh = Bvh::new(boxes.iter().copied());
    let mut representative: Vec<u32> = (0..mesh.points.len() as u32).collect();
    let mut is_taken = vec![false; points.len()];
    let mut stack = Vec::new();
    let mut has_welded = false;
    let budget = Bvh::query_budget(points.len());
    for (index, &vertex) in points.iter().enumerate() {
        if is_taken[index] {
            continue;
        }
        let (position, radius) = (boxes[index].min, radii.0[vertex as usize]);
        let area = boxes[index].expanded_by(DVec3::splat(radius));
        bvh.for_each_overlapping(&area, budget, &mut stack, |item| {
            let other = points[item as usize];
            let radius = radius.min(radii.0[other as usize]);
            let is_near = (boxes[item as usize].min - position).length() <= radius;
            if item as usize > index && !is_taken[item as usize] && is_near {
                is_taken[item as usize] = true;
                representative[other as usize] = vertex;
                has_welded = true;
            }
        });
    }
    if has_welded {
        remap_vertices(mesh, &representative);
    }
    has_welded
}

/// Cuts boundary edges at the boundary vertices on them, and returns the parts of the edges and the
/// sliver triangles in the gaps.
///
/// ```text
///       a ●─────────────● b
///          ╲───── ● ────╱
///                 p
/// ```
///
/// The edge a–b passes within the weld radius of p, so its parts are a–p and p–b. The sliver a, p,
/// b closes the gap caused by rounding. It hides lines and is cut by sections, but is never drawn.
///
/// Parts are sorted by their ends, so coincident parts of both sides of a seam are neighbors.
pub(super) fn split_at_t_junctions(
    mesh: &WorldMesh,
    borders: &[BorderEdge],
    radii: &WeldRadii,
) -> (Vec<BorderEdge>, Vec<Face>) {
    let points = border_vertices(borders);
    let position = |vertex: u32| mesh.points[vertex as usize];
    let boxes: Vec<Aabb> =
        points.iter().map(|&vertex| Aabb::from_points([position(vertex)])).collect();
    let bvh = Bvh::new(boxes.iter().copied());
    let (mut stack, mut cuts) = (Vec::new(), Vec::new());
    let budget = Bvh::query_budget(borders.len());
    // A vertex is on at most two sides of faces, unless the mesh is degenerate.
    let mut cuts_left = CUTS_PER_VERTEX * points.len();
    let (mut parts, mut fillings) = (Vec::with_capacity(borders.len()), Vec::new());
    for &([a, b], side) in borders {
        let (from, along) = (position(a), position(b) - position(a));
        let radius = radii.edge_radius([a, b]);
        cuts.clear();
        let ends = [position(a), position(b)];
        bvh.for_each_near_segment(ends, radius, budget, &mut stack, |item| {
            let (vertex, offset) = (points[item as usize], boxes[item as usize].min - from);
            let t = offset.dot(along) / along.length_squared();
            let is_on = t > 0.0 && t < 1.0 && (offset - along * t).length() <= radius;
            if vertex != a && vertex != b && is_on && cuts_left > 0 {
                cuts_left -= 1;
                cuts.push((t, vertex));
            }
        });
        cuts.sort_unstable_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        let stops = || cuts.iter().map(|&(_, vertex)| vertex).chain([b]);
        // Slivers form a fan around `a`, one for each cut and the stop after it.
        let face = mesh.faces[side.face() as usize];
        let sliver = |(from, to)| Face { vertices: [a, from, to], ..face };
        fillings.extend(stops().zip(stops().skip(1)).map(sliver));
        let ends = stops().scan(a, |from, to| Some([std::mem::replace(from, to), to]));
        parts.extend(ends.map(|ends| border_part(ends, side)));
    }
    parts.sort_unstable();
    (parts, fillings)
}

/// Returns a part of a boundary edge as a separate edge, with the orientation of the original.
fn border_part([from, to]: [u32; 2], side: HalfEdge) -> BorderEdge {
    let (low, high) = (from.min(to), from.max(to));
    let is_forward = side.is_forward() == (from < to);
    ([low, high], HalfEdge::new(high, side.face(), side.side(), is_forward))
}

/// Returns the vertices of boundary edges, sorted, without duplicates.
fn border_vertices(borders: &[BorderEdge]) -> Vec<u32> {
    let mut points: Vec<u32> = borders.iter().flat_map(|(ends, _)| *ends).collect();
    points.sort_unstable();
    points.dedup();
    points
}
