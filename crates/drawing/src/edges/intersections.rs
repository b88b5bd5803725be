//! Intersection edges: the segments in which faces cross each other.
//!
//! The test is that of Möller, *A fast triangle-triangle intersection test* (1997). Each triangle
//! cuts the plane of the other in a segment; both segments lie on the line in which the planes
//! meet, and their overlap is the intersection.
//!
//! ```text
//!         ╱│           c ├─────────┤ d          this triangle's segment on the common line
//!    ────╱─┼────             a ├──────────┤ b   the other's
//!       ╱  │                   ├───┤            the intersection: max(a, c) to min(b, d)
//! ```
//!
//! Triangles that are coplanar, or only touch, do not intersect. Nor do triangles so nearly
//! coplanar that the segment would be an effect of rounding: decals, and copies of a surface.

use super::seams::{BorderEdge, WeldRadii, half_surface_area};
use super::world_mesh::{Face, WorldMesh};
use crate::hidden_line::{Aabb, Bvh};
use crate::parallel::map_in_order;
use glam::DVec3;
use std::sync::atomic::{AtomicBool, Ordering};

/// Triangles nowhere farther from each other's planes than this many touching distances are
/// coplanar.
const COPLANAR_FACTOR: f64 = 512.0;

/// The least sine of the angle between planes that intersect: about one degree.
const MIN_PLANE_SINE: f64 = 1.0 / 64.0;

/// An intersection edge: its ends in the world, and the lower index of the two objects.
pub(super) type IntersectionSegment = ([DVec3; 2], u32);

/// The intersection edges of a mesh.
#[derive(Clone, Debug)]
pub(super) struct Intersections {
    /// In the order of the faces.
    pub(super) segments: Vec<IntersectionSegment>,
    /// Whether the search ended early because there were too many.
    pub(super) is_cut_off: bool,
}

/// About the greatest number of intersections that are found.
const MAX_INTERSECTIONS: usize = 1 << 22;

/// Finds all intersection edges of a mesh's faces, with up to `threads` threads.
///
/// Faces nearer than `touching` only touch. Intersections along boundaries of both faces are left
/// out, for the boundaries are drawn. Of each pair the face with the smaller box asks for the
/// larger: large faces are few wherever one looks. The work is bounded by [`Bvh::query_budget`] and
/// [`MAX_INTERSECTIONS`]; whether a bound was met is in the result.
pub(super) fn intersect_faces(
    mesh: &WorldMesh,
    (borders, weld_radii): (&[BorderEdge], &WeldRadii),
    touching: f64,
    threads: usize,
) -> Intersections {
    let mut triangles: Vec<IntersectionTriangle> =
        mesh.faces.iter().map(|face| IntersectionTriangle::from_face(mesh, face)).collect();
    for (ends, side) in borders {
        let triangle = &mut triangles[side.face as usize];
        triangle.borders[usize::from(side.side)] = true;
        triangle.border_distance = 2.0 * weld_radii.edge_radius(*ends);
    }
    let boxes: Vec<Aabb> = triangles.iter().map(|t| Aabb::from_points(t.vertices)).collect();
    let bvh = Bvh::new(&boxes, half_surface_area);
    // Each pair is tested once, by the smaller box: few large boxes overlap it.
    let size = |face: usize| (half_surface_area(boxes[face].max - boxes[face].min), face);
    let count = mesh.faces.len();
    let budget = Bvh::query_budget(count);
    let most_per_face = (MAX_INTERSECTIONS / count.max(1)).max(16);
    let is_cut_off = AtomicBool::new(false);
    let segments = map_in_order(count, threads, |range, stack: &mut Vec<u32>, segments| {
        for one in range {
            let before = segments.len();
            let visited = bvh.for_each_overlapping(&boxes[one], budget, stack, |other| {
                let other = other as usize;
                let faces = [&mesh.faces[one], &mesh.faces[other]];
                let is_asked = size(one) < size(other) && segments.len() - before < most_per_face;
                if is_asked && !shares_edge(faces) {
                    let segment = triangles[one].intersect_triangle(&triangles[other], touching);
                    let object = faces[0].object.min(faces[1].object);
                    segments.extend(segment.map(|ends| (ends, object)));
                }
            });
            if !visited || segments.len() - before >= most_per_face {
                is_cut_off.store(true, Ordering::Relaxed);
            }
        }
    });
    Intersections { segments, is_cut_off: is_cut_off.into_inner() }
}

/// Whether two faces share two vertices: neighbors meet in an edge and do not intersect.
fn shares_edge([one, other]: [&Face; 2]) -> bool {
    one.vertices.iter().filter(|vertex| other.vertices.contains(vertex)).count() > 1
}

/// A triangle with what the intersection test needs of it.
#[derive(Clone, Copy, Debug)]
struct IntersectionTriangle {
    vertices: [DVec3; 3],
    /// The unit normal.
    normal: DVec3,
    /// Which sides are boundary edges.
    borders: [bool; 3],
    /// A point nearer than this to a boundary side is on it.
    border_distance: f64,
}

impl IntersectionTriangle {
    /// The triangle of a face, without boundary sides.
    fn from_face(mesh: &WorldMesh, face: &Face) -> Self {
        let vertices = face.vertices.map(|vertex| mesh.points[vertex as usize]);
        let [a, b, c] = vertices;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        Self { vertices, normal, borders: [false; 3], border_distance: 0.0 }
    }

    /// The segment in which two triangles intersect; `None` if they do not, touch, or are coplanar.
    fn intersect_triangle(&self, other: &Self, touching: f64) -> Option<[DVec3; 2]> {
        let heights =
            [self.distances_to_plane(other, touching), other.distances_to_plane(self, touching)];
        let (ours, theirs) = (self.cut_at_zero(heights[0])?, other.cut_at_zero(heights[1])?);
        let line = self.normal.cross(other.normal);
        let is_flat =
            heights.as_flattened().iter().all(|height| height.abs() < COPLANAR_FACTOR * touching);
        if is_flat || line.length() < MIN_PLANE_SINE {
            return None;
        }
        let along = |[a, b]: [DVec3; 2]| {
            let [s, t] = [line.dot(a), line.dot(b)];
            if s <= t { [(s, a), (t, b)] } else { [(t, b), (s, a)] }
        };
        let ([a, b], [c, d]) = (along(ours), along(theirs));
        let from = if a.0 >= c.0 { a } else { c };
        let to = if b.0 <= d.0 { b } else { d };
        let is_long = to.0 > from.0 && (to.1 - from.1).length() > touching;
        let ends = [from.1, to.1];
        let is_seam = || self.runs_along_border(ends) && other.runs_along_border(ends);
        (is_long && !is_seam()).then_some(ends)
    }

    /// Whether both ends of a segment are on one boundary side.
    fn runs_along_border(&self, ends: [DVec3; 2]) -> bool {
        let is_on = |k: usize| {
            let (from, to) = (self.vertices[k], self.vertices[(k + 1) % 3]);
            let along = (to - from).normalize_or_zero();
            ends.iter().all(|&end| {
                (end - from).reject_from_normalized(along).length() < self.border_distance
            })
        };
        (0..3).any(|k| self.borders[k] && is_on(k))
    }

    /// The signed distances of the vertices from another triangle's plane, with those below
    /// `touching` made zero.
    fn distances_to_plane(&self, other: &Self, touching: f64) -> [f64; 3] {
        self.vertices.map(|vertex| {
            let height = other.normal.dot(vertex - other.vertices[0]);
            if height.abs() <= touching { 0.0 } else { height }
        })
    }

    /// The segment of the triangle where a linear function with these vertex values is zero; `None`
    /// if it has one sign.
    fn cut_at_zero(&self, heights: [f64; 3]) -> Option<[DVec3; 2]> {
        let lowest = heights.into_iter().fold(f64::INFINITY, f64::min);
        let highest = heights.into_iter().fold(f64::NEG_INFINITY, f64::max);
        if lowest >= 0.0 || highest <= 0.0 {
            return None;
        }
        let mut ends = [DVec3::ZERO; 2];
        let mut count = 0;
        for k in 0..3 {
            let (p, q) = (heights[k], heights[(k + 1) % 3]);
            let [a, b] = [self.vertices[k], self.vertices[(k + 1) % 3]];
            let end = if p == 0.0 {
                a
            } else if p * q < 0.0 {
                a + (b - a) * (p / (p - q))
            } else {
                continue;
            };
            *ends.get_mut(count)? = end;
            count += 1;
        }
        (count == 2).then_some(ends)
    }
}
