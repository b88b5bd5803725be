//! Intersection edges: the segments where faces cross each other.
//!
//! The test is from Möller, *A fast triangle-triangle intersection test* (1997). Each triangle cuts
//! the plane of the other in a segment. Both segments are on the line where the planes meet, and
//! their overlap is the intersection.
//!
//! ```text
//!         ╱│           c ├─────────┤ d          this triangle's segment on the common line
//!    ────╱─┼────             a ├──────────┤ b   the other's
//!       ╱  │                   ├───┤            the intersection: max(a, c) to min(b, d)
//! ```
//!
//! Triangles that are coplanar, or only touch, do not intersect. Neither do triangles that are
//! nearly coplanar, such as decals or copies of a surface: the segment would be a rounding
//! artifact.

use super::seams::{BorderEdge, WeldRadii};
use super::world_mesh::{Face, WorldMesh};
use crate::parallel::map_in_order;
use crate::visibility::{Aabb, Bvh, DepthCover, ScreenBox};
use glam::DVec3;
use raster::Workers;
use std::cell::OnceCell;
use std::sync::atomic::{AtomicBool, Ordering};

/// Two triangles are coplanar if no vertex is farther than this many touching distances from the
/// other triangle's plane.
const COPLANAR_FACTOR: f64 = 512.0;

/// The minimum sine of the angle between the planes of intersecting faces, for about one degree.
const MIN_PLANE_SINE: f64 = 1.0 / 64.0;

/// An intersection edge: its ends in the world and the lower of the two object indices.
pub(super) type IntersectionSegment = ([DVec3; 2], u32);

/// The intersection edges of a mesh.
#[derive(Clone, Debug)]
pub(super) struct Intersections {
    /// The segments, in the order of the faces.
    pub(super) segments: Vec<IntersectionSegment>,
    /// Whether the search ended early because there were too many intersections.
    pub(super) is_cut_off: bool,
}

/// The approximate maximum number of intersections for any number of faces.
const MAX_INTERSECTIONS: usize = 1 << 22;
/// The approximate maximum number of intersections per face, on average. An ordinary model has few,
/// but in a triangle soup nearly every pair intersects.
const INTERSECTIONS_PER_FACE: usize = 64;

/// The limits of a search for intersections.
#[derive(Clone, Copy, Debug)]
pub(super) struct SearchBounds<'a> {
    /// The distance within which faces are considered only to touch.
    pub(super) touching: f64,
    /// The cover of a view; intersections that it hides are skipped.
    pub(super) cover: Option<&'a DepthCover>,
    /// Whether to allow any number of intersections.
    pub(super) is_unlimited: bool,
}

/// Two intersecting faces, with the smaller face first, and their common segment.
type IntersectingPair = ([u32; 2], IntersectionSegment);

/// Finds all intersection edges of a mesh's faces, on several threads.
///
/// The first items of `bvh` are the faces. Intersections along boundaries of both faces are
/// skipped, because the boundaries themselves are drawn. Each pair of leaves in the hierarchy is
/// compared once. Unless `is_unlimited` is set, the work is bounded by [`Bvh::query_budget`] and
/// [`MAX_INTERSECTIONS`]; the result records whether a bound was reached.
pub(super) fn intersect_faces(
    mesh: &WorldMesh,
    bvh: &Bvh,
    borders: &[BorderEdge],
    weld_radii: &WeldRadii,
    SearchBounds { touching, cover, is_unlimited }: SearchBounds<'_>,
    workers: Workers<'_>,
) -> Intersections {
    // Skipping hidden faces reduces the number of comparisons.
    let in_sight = cover.map(|cover| FacesInSight::new(mesh, cover));
    let of_view = in_sight.as_ref().map(|in_sight| {
        let items = in_sight.items.iter();
        Bvh::new(items.map(|item| Aabb::around_triangle(in_sight.corners(mesh, *item))))
    });
    let bvh = of_view.as_ref().unwrap_or(bvh);
    let leaves = bvh.leaf_nodes();
    let most = (INTERSECTIONS_PER_FACE * mesh.faces.len()).min(MAX_INTERSECTIONS);
    let [most, budget] = match is_unlimited {
        true => [usize::MAX; 2],
        false => [most, Bvh::query_budget(leaves.len())],
    };
    // In a view, several parts of two faces may find the same segment, so the limit is higher.
    let least = if in_sight.is_some() { 1024 } else { 256 };
    let search = IntersectionSearch {
        mesh,
        borders: FaceBorders::new(borders, weld_radii),
        touching,
        most_per_leaf: (most / leaves.len().max(1)).max(least),
        in_sight,
    };
    let is_cut_off = AtomicBool::new(false);
    let mut pairs: Vec<IntersectingPair> =
        map_in_order(leaves.len(), workers, |range, memory: &mut LeafMemory, pairs| {
            for &leaf in &leaves[range] {
                let LeafMemory { stack, own, bounds } = memory;
                own.clear();
                let (first, mut is_complete) = (pairs.len(), true);
                let visited = bvh.for_each_later_leaf(leaf, budget, stack, |items, is_own| {
                    if pairs.len() - first >= search.most_per_leaf {
                        is_complete = false;
                    } else if is_own {
                        own.extend(search.leaf_triangles(items, None));
                        *bounds = own.iter().map(|triangle| triangle.bounds).reduce(Aabb::union);
                        search.intersect_own(own, pairs);
                    } else if let Some(bounds) = bounds {
                        search.intersect_other(own, bounds, items, pairs);
                    }
                });
                if !visited || !is_complete {
                    is_cut_off.store(true, Ordering::Relaxed);
                }
            }
        });
    pairs.sort_by_key(|(faces, _)| *faces);
    // Several parts of two faces may have found the same segment.
    pairs.dedup_by_key(|(faces, _)| *faces);
    let segments = pairs.into_iter().map(|(_, segment)| segment).collect();
    Intersections { segments, is_cut_off: is_cut_off.into_inner() }
}

/// Whether two faces share two vertices: neighbors meet at an edge and do not intersect.
fn shares_edge([one, other]: [&Face; 2]) -> bool {
    one.vertices.iter().filter(|vertex| other.vertices.contains(vertex)).count() > 1
}

/// Scratch memory for the search from one leaf, reused for the next.
#[derive(Default)]
struct LeafMemory {
    /// Hierarchy nodes still to visit.
    stack: Vec<u32>,
    /// The triangles of the leaf; `bounds` is their bounding box.
    own: Vec<IntersectionTriangle>,
    bounds: Option<Aabb>,
}

/// A search for intersections, with its inputs.
struct IntersectionSearch<'a> {
    mesh: &'a WorldMesh,
    borders: FaceBorders,
    touching: f64,
    /// The approximate maximum number of intersections of a leaf's faces with faces of later
    /// leaves.
    most_per_leaf: usize,
    /// The faces visible to the viewer, if there is only one viewer; they are the items of the
    /// hierarchy.
    in_sight: Option<FacesInSight<'a>>,
}

/// A face index, and the index of the compared part, or `None` for the whole face.
#[derive(Clone, Copy, Debug)]
struct FacePart {
    face: u32,
    part: Option<u32>,
}

/// The faces of a mesh that one viewer may see; long faces are divided into parts.
struct FacesInSight<'a> {
    cover: &'a DepthCover,
    /// The face, or part of a face, of each item.
    items: Vec<FacePart>,
    parts: Vec<[DVec3; 3]>,
}

impl<'a> FacesInSight<'a> {
    fn new(mesh: &WorldMesh, cover: &'a DepthCover) -> Self {
        let mut in_sight = Self { cover, items: Vec::new(), parts: Vec::new() };
        let mut visible = Vec::new();
        for face in 0..mesh.faces.len() as u32 {
            let whole = mesh.triangle(face);
            cover.add_visible_parts(whole, &mut visible);
            for part in visible.drain(..) {
                let index = in_sight.parts.len() as u32;
                let index = (part != whole).then_some(index);
                in_sight.items.push(FacePart { face, part: index });
                in_sight.parts.extend((part != whole).then_some(part));
            }
        }
        in_sight
    }

    /// Returns the corners of the visible part of a face.
    fn corners(&self, mesh: &WorldMesh, visible: FacePart) -> [DVec3; 3] {
        let FacePart { face, part } = visible;
        part.map_or_else(|| mesh.triangle(face), |part| self.parts[part as usize])
    }

    /// Whether the overlap of two triangles on the screen is hidden.
    fn hide_pair(&self, pair: [&IntersectionTriangle; 2]) -> bool {
        let image = |triangle: &IntersectionTriangle| {
            let part = triangle.part.map(|part| &self.parts[part as usize]);
            let find = || self.cover.image_of(part.unwrap_or(&triangle.vertices));
            *triangle.image.get_or_init(find)
        };
        let [one, other] = pair.map(image);
        one.zip(other).is_some_and(|(one, other)| self.cover.hides(&one.intersection(&other)))
    }
}

impl IntersectionSearch<'_> {
    /// Returns the faces in a leaf, without its fillings. If `within` is specified, returns only
    /// the faces whose boxes overlap it.
    fn leaf_triangles(
        &self,
        items: &[u32],
        within: Option<&Aabb>,
    ) -> impl Iterator<Item = IntersectionTriangle> {
        let faces = items.iter().filter_map(move |&item| match &self.in_sight {
            Some(in_sight) => Some(in_sight.items[item as usize]),
            None => ((item as usize) < self.mesh.faces.len())
                .then_some(FacePart { face: item, part: None }),
        });
        faces.filter_map(move |compared| {
            let vertices = self.mesh.triangle(compared.face);
            let seen = compared.part.zip(self.in_sight.as_ref());
            let corners = seen.map_or(vertices, |(part, in_sight)| in_sight.parts[part as usize]);
            let bounds = Aabb::around_triangle(corners);
            let is_near = within.is_none_or(|within| within.intersects(&bounds));
            is_near.then(|| IntersectionTriangle::new(compared, vertices, bounds))
        })
    }

    /// Intersects the triangles of a leaf with each other.
    fn intersect_own(&self, own: &[IntersectionTriangle], pairs: &mut Vec<IntersectingPair>) {
        for (at, one) in own.iter().enumerate() {
            pairs.extend(own[at + 1..].iter().filter_map(|other| self.intersect_pair(one, other)));
        }
    }

    /// Intersects the triangles of a leaf, within a box, with the triangles of another leaf.
    fn intersect_other(
        &self,
        own: &[IntersectionTriangle],
        bounds: &Aabb,
        items: &[u32],
        pairs: &mut Vec<IntersectingPair>,
    ) {
        for other in self.leaf_triangles(items, Some(bounds)) {
            pairs.extend(own.iter().filter_map(|one| self.intersect_pair(one, &other)));
        }
    }

    /// Intersects two triangles, starting with the triangle that has the smaller box.
    fn intersect_pair(
        &self,
        a: &IntersectionTriangle,
        b: &IntersectionTriangle,
    ) -> Option<IntersectingPair> {
        let is_apart = !a.bounds.intersects(&b.bounds)
            || a.is_beside_plane(b, self.touching)
            || b.is_beside_plane(a, self.touching);
        let is_out_of_sight =
            || self.in_sight.as_ref().is_some_and(|in_sight| in_sight.hide_pair([a, b]));
        if is_apart || is_out_of_sight() {
            return None;
        }
        let faces = [a, b].map(|triangle| &self.mesh.faces[triangle.face as usize]);
        if shares_edge(faces) {
            return None;
        }
        // The whole faces are measured, so that their parts find the same segment.
        let size = |triangle: &IntersectionTriangle| {
            let around = Aabb::around_triangle(triangle.vertices);
            (around.half_surface_area(), triangle.face)
        };
        let (one, other) = if size(a) < size(b) { (a, b) } else { (b, a) };
        let ends = one.intersect_triangle(other, self.touching)?;
        // In a triangle soup, most pairs intersect where they are hidden. Such pairs are not
        // counted.
        if self.in_sight.as_ref().is_some_and(|in_sight| in_sight.cover.hides_segment(ends)) {
            return None;
        }
        let is_seam = [one, other].iter().all(|triangle| self.borders.have_segment(triangle, ends));
        let object = faces[0].object.min(faces[1].object);
        (!is_seam).then_some(([one.face, other.face], (ends, object)))
    }
}

/// The boundary sides of faces.
struct FaceBorders(Vec<FaceBorder>);

/// A boundary side of a face.
#[derive(Clone, Copy)]
struct FaceBorder {
    face: u32,
    side: u8,
    /// The maximum distance at which points are considered to be on the side.
    distance: f64,
}

impl FaceBorders {
    /// Collects the sides that contain at least one of the given boundary edges.
    fn new(borders: &[BorderEdge], weld_radii: &WeldRadii) -> Self {
        let border = |(ends, side): &BorderEdge| FaceBorder {
            face: side.face(),
            side: side.side(),
            distance: 2.0 * weld_radii.edge_radius(*ends),
        };
        let mut sides: Vec<FaceBorder> = borders.iter().map(border).collect();
        sides.sort_by_key(|border| border.face);
        Self(sides)
    }

    /// Whether both ends of a segment are on the same boundary side of a triangle.
    fn have_segment(&self, triangle: &IntersectionTriangle, ends: [DVec3; 2]) -> bool {
        let first = self.0.partition_point(|border| border.face < triangle.face);
        let here = &self.0[first..];
        let count = here.iter().take_while(|border| border.face == triangle.face).count();
        // All sides of a triangle use one distance, taken from its last part.
        let distance = here[..count].last().map_or(0.0, |border| border.distance);
        here[..count].iter().any(|border| {
            let k = usize::from(border.side);
            let (from, to) = (triangle.vertices[k], triangle.vertices[(k + 1) % 3]);
            let along = (to - from).normalize_or_zero();
            ends.iter().all(|&end| (end - from).reject_from_normalized(along).length() < distance)
        })
    }
}

/// A triangle with its data for the intersection test.
#[derive(Clone, Debug)]
struct IntersectionTriangle {
    face: u32,
    /// The index of the compared part, or `None` for the whole face.
    part: Option<u32>,
    vertices: [DVec3; 3],
    /// The bounding box of the part.
    bounds: Aabb,
    /// The unit normal.
    normal: DVec3,
    /// The image of the part, computed on demand, or `None` if the part has no image.
    image: OnceCell<Option<ScreenBox>>,
}

impl IntersectionTriangle {
    fn new(compared: FacePart, vertices: [DVec3; 3], bounds: Aabb) -> Self {
        let FacePart { face, part } = compared;
        let [a, b, c] = vertices;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        Self { face, part, vertices, bounds, normal, image: OnceCell::new() }
    }

    /// Whether all vertices are on one side of another triangle's plane, up to `touching`.
    ///
    /// Most comparisons end with this test.
    fn is_beside_plane(&self, other: &Self, touching: f64) -> bool {
        let heights = self.vertices.map(|vertex| other.normal.dot(vertex - other.vertices[0]));
        let [p, q, r] = heights.map(|height| height >= -touching);
        let [u, v, w] = heights.map(|height| height <= touching);
        p && q && r || u && v && w
    }

    /// Returns the segment where two triangles intersect. Returns `None` if they do not intersect,
    /// only touch, or are coplanar.
    fn intersect_triangle(&self, other: &Self, touching: f64) -> Option<[DVec3; 2]> {
        let our_heights = self.distances_to_plane(other, touching);
        let ours = self.cut_at_zero(our_heights)?;
        let their_heights = other.distances_to_plane(self, touching);
        let theirs = other.cut_at_zero(their_heights)?;
        let heights = [our_heights, their_heights];
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
        is_long.then_some([from.1, to.1])
    }

    /// Returns the signed distances of the vertices from another triangle's plane; distances up to
    /// `touching` become zero.
    fn distances_to_plane(&self, other: &Self, touching: f64) -> [f64; 3] {
        self.vertices.map(|vertex| {
            let height = other.normal.dot(vertex - other.vertices[0]);
            if height.abs() <= touching { 0.0 } else { height }
        })
    }

    /// Returns the segment of the triangle where a linear function with the given vertex values is
    /// zero, or `None` if its sign does not change.
    fn cut_at_zero(&self, heights: [f64; 3]) -> Option<[DVec3; 2]> {
        if heights.iter().all(|height| *height >= 0.0)
            || heights.iter().all(|height| *height <= 0.0)
        {
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
