//! Cluster culling: runs of triangles in a mesh that are drawn or culled together.
//!
//! ```text
//!    ╲ │ ╱   normals of the cluster's triangles within a cone
//!     ╲│╱
//!   ┌──●──┐  bounding box: outside the frustum?           cone: all faces turned away?
//!   └─────┘
//! ```
//!
//! Much of a large mesh is outside the picture or faces away. A cluster is a run of consecutive
//! triangles with their bounding box and a cone around their normals. One test decides for all of
//! them (Shirman and Abi-Ezzi, *The Cone of Normals Technique*, 1993). Triangles keep their order
//! and their ids, so culling never changes the picture.

use core::ops::Range;
use glam::DVec3;
use homog::{HPoint, Space};

/// The maximum number of triangles in a cluster: few enough for tight bounds, and enough to make
/// the test cheap per triangle.
const CLUSTER_TRIANGLES: usize = 64;
/// The margin of the cone test, relative to the distance to the viewer. It is needed because single
/// precision and vertex snapping may flip a face that is seen edge-on.
const CONE_MARGIN: f64 = 1e-3;

/// The clusters of a mesh, in the order of its triangles, in the space of its positions.
///
/// They remain valid until the positions change.
#[derive(Clone, Debug, Default)]
pub struct Clusters {
    list: Vec<Cluster>,
}

/// A run of consecutive triangles, their bounding box and the cone of their normals.
#[derive(Clone, Copy, Debug)]
pub struct Cluster {
    triangles: [u32; 2],
    vertices: [u32; 2],
    bounds: [[f32; 3]; 2],
    /// The axis of the cone around the normals, times the cosine of its half angle; zero if no
    /// half-space contains the normals.
    cone_axis: [f32; 3],
}

impl Clusters {
    /// Builds the clusters of a mesh. Triangles with an out-of-range vertex index are ignored.
    ///
    /// Without `cones`, no cluster is ever [back-facing](Cluster::is_back_facing), and building
    /// takes half the time.
    #[must_use]
    pub fn build(positions: &[[f32; 3]], triangles: &[[u32; 3]], cones: bool) -> Self {
        let starts = (0..triangles.len()).step_by(CLUSTER_TRIANGLES);
        let cluster = |start: usize| {
            let end = (start + CLUSTER_TRIANGLES).min(triangles.len());
            Cluster::from_triangles(positions, &triangles[start..end], start, cones)
        };
        Self { list: starts.map(cluster).collect() }
    }

    /// Returns the clusters in the order of their triangles.
    #[must_use]
    pub fn as_slice(&self) -> &[Cluster] {
        &self.list
    }

    /// Returns the bounding box of the mesh as minimum and maximum coordinates, or [∞, −∞] if the
    /// mesh is empty.
    #[must_use]
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        self.list.iter().fold(EMPTY_BOUNDS, |bounds, cluster| union_bounds(bounds, &cluster.bounds))
    }
}

/// The bounding box of an empty set of points.
const EMPTY_BOUNDS: [[f32; 3]; 2] = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];

impl Cluster {
    fn from_triangles(
        positions: &[[f32; 3]],
        triangles: &[[u32; 3]],
        start: usize,
        cone: bool,
    ) -> Self {
        let mut bounds = EMPTY_BOUNDS;
        let (mut first, mut last) = (u32::MAX, 0);
        let mut normals = TriangleNormals::default();
        for &[a, b, c] in triangles {
            let corner = |vertex: u32| positions.get(vertex as usize).copied();
            let corners = [corner(a), corner(b), corner(c)];
            if let [Some(p), Some(q), Some(r)] = corners {
                (first, last) = (first.min(a.min(b).min(c)), last.max(a.max(b).max(c) + 1));
                bounds = union_bounds(
                    bounds,
                    &[
                        min_coordinates(p, min_coordinates(q, r)),
                        max_coordinates(p, max_coordinates(q, r)),
                    ],
                );
            }
            if cone {
                normals.add_triangle(corners);
            }
        }
        let end = start + triangles.len();
        Self {
            triangles: [start as u32, end as u32],
            vertices: [first.min(last), last],
            bounds,
            cone_axis: normals.normal_cone(),
        }
    }

    /// Returns the range of the triangles' indices in the mesh.
    #[must_use]
    pub fn triangles(&self) -> Range<usize> {
        self.triangles[0] as usize..self.triangles[1] as usize
    }

    /// Returns the range of vertex indices that the triangles use.
    #[must_use]
    pub fn vertices(&self) -> Range<usize> {
        self.vertices[0] as usize..self.vertices[1] as usize
    }

    /// Returns the bounding box: the minimum and maximum coordinates of the vertices.
    #[must_use]
    pub const fn bounds(&self) -> [[f32; 3]; 2] {
        self.bounds
    }

    /// Returns whether all triangles of the cluster certainly face away from the viewer, for
    /// back-face culling.
    ///
    /// The viewer is an eye point, or the direction toward the viewer as a point at infinity. Front
    /// faces are counterclockwise.
    ///
    /// For a viewer `e` and a vertex `p`, a triangle with normal `n` faces away if n · (e − e_w p)
    /// < 0. The box bounds every `p`, and the cone every `n`. The dot product is at most its value
    /// at the center of the box, for the nearest normal of the cone, plus the radius of the box.
    #[must_use]
    pub fn is_back_facing<S: Space>(&self, viewer: HPoint<S>) -> bool {
        let axis = DVec3::from_array(self.cone_axis.map(f64::from));
        let cosine = axis.length();
        if cosine == 0.0 {
            return false;
        }
        let axis = axis / cosine;
        let [least, greatest] = self.bounds.map(|corner| DVec3::from_array(corner.map(f64::from)));
        let (eye, w) = (viewer.raw().truncate(), viewer.w());
        // The vector from the center of the box. In a parallel projection, w is 0, and this is the
        // direction to the viewer.
        let to_viewer = eye - (least + greatest) * (0.5 * w);
        let radius = (greatest - least).length() * (0.5 * w.abs());
        let along = to_viewer.dot(axis);
        let across = (to_viewer.length_squared() - along * along).max(0.0).sqrt();
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        // The cosine of the difference between two angles from the axis. The angle to the viewer
        // exceeds a right angle, and the angle to the border of the cone does not.
        let greatest = along * cosine + across * sine + radius;
        along < 0.0 && greatest < -CONE_MARGIN * to_viewer.length()
    }
}

/// Returns the union of two bounding boxes.
#[inline(always)]
fn union_bounds([low, high]: [[f32; 3]; 2], other: &[[f32; 3]; 2]) -> [[f32; 3]; 2] {
    [min_coordinates(low, other[0]), max_coordinates(high, other[1])]
}

#[inline(always)]
fn min_coordinates(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    // In this form, each comparison is a single instruction; `f32::min` takes several to handle
    // NaN.
    [0, 1, 2].map(|k| if a[k] < b[k] { a[k] } else { b[k] })
}

#[inline(always)]
fn max_coordinates(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|k| if a[k] > b[k] { a[k] } else { b[k] })
}

/// The unit normals of a cluster's triangles.
struct TriangleNormals {
    list: [[f32; 3]; CLUSTER_TRIANGLES],
    count: usize,
    /// Whether every triangle has a normal that single precision can represent.
    are_known: bool,
}

impl Default for TriangleNormals {
    fn default() -> Self {
        Self { list: [[0.0; 3]; CLUSTER_TRIANGLES], count: 0, are_known: true }
    }
}

impl TriangleNormals {
    #[inline(always)]
    fn add_triangle(&mut self, corners: [Option<[f32; 3]>; 3]) {
        let ([Some(p), Some(q), Some(r)], true) = (corners, self.are_known) else {
            self.are_known = false;
            return;
        };
        let (a, b) = (subtract(q, p), subtract(r, p));
        // The length of the cross product of two edges is twice the area.
        let normal =
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        let squared = dot(normal, normal);
        // In thinner triangles, rounding of the cross product would rotate the normal.
        self.are_known &= squared > dot(a, a) * dot(b, b) * 1e-6 && squared.is_normal();
        let inv_length = 1.0 / squared.sqrt();
        self.list[self.count] = normal.map(|coordinate| coordinate * inv_length);
        self.count += 1;
    }

    /// Returns the axis of the cone around the normals, times the cosine of its half angle. The
    /// result is zero if the cone is at least as wide as a half-space or if a normal is unknown.
    ///
    /// The axis is the mean of the normals. A minimal cone would cull slightly more but would cost
    /// much more.
    fn normal_cone(&self) -> [f32; 3] {
        let list = if self.are_known { &self.list[..self.count] } else { &[] };
        let sum = list.iter().fold([0.0; 3], |sum, normal| [0, 1, 2].map(|k| sum[k] + normal[k]));
        let length = dot(sum, sum).sqrt();
        if length < 0.5 {
            return [0.0; 3];
        }
        let axis = sum.map(|coordinate| coordinate / length);
        let cosine = list.iter().fold(1.0_f32, |least, &normal| least.min(dot(normal, axis)));
        let cosine = (cosine - CONE_MARGIN as f32).max(0.0);
        axis.map(|coordinate| coordinate * cosine)
    }
}

#[inline(always)]
fn subtract(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The part of a mesh to draw: runs of its triangles and the vertices that they need.
#[derive(Clone, Debug, Default)]
pub struct MeshSelection {
    /// Runs of triangles in order, with gaps between them.
    triangle_runs: Vec<Range<usize>>,
    /// For each block of [`VERTEX_BLOCK`] vertices, whether they are needed.
    vertex_blocks: Vec<bool>,
}

/// The number of vertices in a block, the unit of vertex selection: eight vectors of eight lanes.
const VERTEX_BLOCK: usize = 64;

impl MeshSelection {
    /// Clears the selection and prepares it for a mesh with `vertices` vertices.
    pub fn clear(&mut self, vertices: usize) {
        self.triangle_runs.clear();
        self.vertex_blocks.clear();
        self.vertex_blocks.resize(vertices.div_ceil(VERTEX_BLOCK), false);
    }

    /// Adds a cluster. Clusters must be added in the order of their triangles.
    pub fn add_cluster(&mut self, cluster: &Cluster) {
        let triangles = cluster.triangles();
        match self.triangle_runs.last_mut() {
            Some(last) if last.end == triangles.start => last.end = triangles.end,
            _ => self.triangle_runs.push(triangles),
        }
        let Range { start, end } = cluster.vertices();
        if let Some(blocks) =
            self.vertex_blocks.get_mut(start / VERTEX_BLOCK..end.div_ceil(VERTEX_BLOCK))
        {
            blocks.fill(true);
        }
    }

    /// Selects all `triangles` triangles of the mesh and all of its vertices.
    pub fn add_all(&mut self, triangles: usize) {
        self.triangle_runs.clear();
        self.triangle_runs.extend((triangles > 0).then_some(0..triangles));
        self.vertex_blocks.fill(true);
    }

    /// Returns whether no triangle is selected.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.triangle_runs.is_empty()
    }

    /// Returns the selected triangles as runs of indices in the mesh, in order.
    #[must_use]
    pub fn triangles(&self) -> &[Range<usize>] {
        &self.triangle_runs
    }

    /// Returns the needed vertices in the range `among` as runs of indices, in order and relative
    /// to `among.start`.
    ///
    /// `among` must begin at a multiple of the block size, 64.
    pub fn vertices_within(&self, among: Range<usize>) -> impl Iterator<Item = Range<usize>> {
        let first = among.start / VERTEX_BLOCK;
        let blocks =
            self.vertex_blocks.get(first..among.end.div_ceil(VERTEX_BLOCK)).unwrap_or_default();
        let runs = blocks.chunk_by(|one, next| one == next);
        let ranges = runs.scan(0, move |next, run| {
            let start = *next;
            *next += run.len();
            Some((run[0], start * VERTEX_BLOCK..(*next * VERTEX_BLOCK).min(among.len())))
        });
        ranges.filter_map(|(is_needed, run)| is_needed.then_some(run))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homog::Model;
    use proptest::prelude::*;

    /// Builds a sphere of rings and spokes whose front faces point outward; the triangles at the
    /// poles are degenerate.
    fn ball(rings: u32, spokes: u32) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
        let place = |ring: u32, spoke: u32| {
            let angle =
                |part: u32, of: u32| f64::from(part) / f64::from(of) * core::f64::consts::PI;
            let (down, round) = (angle(ring, rings), 2.0 * angle(spoke, spokes));
            let (radius, height) = (libm::sin(down), libm::cos(down));
            [radius * libm::sin(round), height, radius * libm::cos(round)].map(|c| c as f32)
        };
        let positions =
            (0..=rings).flat_map(|ring| (0..=spokes).map(move |spoke| place(ring, spoke)));
        let at = |ring: u32, spoke: u32| ring * (spokes + 1) + spoke;
        let quads = (0..rings).flat_map(|ring| (0..spokes).map(move |spoke| (ring, spoke)));
        let triangles = quads.flat_map(|(ring, spoke)| {
            let [a, b] = [at(ring, spoke), at(ring + 1, spoke)];
            [[a, b, b + 1], [a, b + 1, a + 1]]
        });
        (positions.collect(), triangles.collect())
    }

    fn faces(positions: &[[f32; 3]], corners: [u32; 3], viewer: HPoint<Model>) -> f64 {
        let [p, q, r] = corners.map(|k| DVec3::from_array(positions[k as usize].map(f64::from)));
        (q - p).cross(r - p).dot(viewer.raw().truncate() - p * viewer.w())
    }

    proptest! {
        #[test]
        fn culled_clusters_contain_only_back_faces(
            direction in prop::array::uniform3(-1.0..1.0_f64), w in 0.0..1.0_f64,
        ) {
            let (positions, triangles) = ball(60, 400);
            let clusters = Clusters::build(&positions, &triangles, true);
            let [x, y, z] = direction;
            let viewer = HPoint::<Model>::new(x, y, z, if w < 0.3 { 0.0 } else { w - 0.3 });
            let mut away = 0;
            for cluster in clusters.as_slice().iter().filter(|c| c.is_back_facing(viewer)) {
                away += cluster.triangles().len();
                for &corners in &triangles[cluster.triangles()] {
                    prop_assert!(faces(&positions, corners, viewer) < 0.0);
                }
            }
            let backs = triangles.iter().filter(|&&t| faces(&positions, t, viewer) < 0.0).count();
            // Seen from infinity, half of the sphere faces away, most of it in whole clusters.
            prop_assert!(viewer.w() > 0.0 || 10 * away >= 6 * backs, "{away} of {backs}");
        }
    }

    #[test]
    fn clusters_contain_all_triangles_and_their_vertices() {
        let (positions, triangles) = ball(9, 31);
        let clusters = Clusters::build(&positions, &triangles, true);
        let mut next = 0;
        for cluster in clusters.as_slice() {
            assert_eq!(cluster.triangles().start, next);
            next = cluster.triangles().end;
            let [least, greatest] = cluster.bounds();
            for &vertex in triangles[cluster.triangles()].as_flattened() {
                assert!(cluster.vertices().contains(&(vertex as usize)));
                let position = positions[vertex as usize];
                assert!((0..3).all(|k| (least[k]..=greatest[k]).contains(&position[k])));
            }
        }
        assert_eq!(next, triangles.len());
    }

    #[test]
    fn out_of_range_vertex_indices_are_ignored() {
        let clusters = Clusters::build(&[[1.0; 3]], &[[0, 7, 9], [0, 0, 0]], true);
        let [cluster] = clusters.as_slice() else { panic!("expected one cluster") };
        assert_eq!((cluster.vertices(), cluster.bounds()), (0..1, [[1.0; 3]; 2]));
        assert!(!cluster.is_back_facing(HPoint::<Model>::new(0.0, 0.0, 1.0, 0.0)));
        assert!(Clusters::build(&[], &[], true).as_slice().is_empty());
        assert_eq!(Clusters::build(&[], &[[0; 3]], true).as_slice()[0].vertices(), 0..0);
    }

    #[test]
    fn selections_consist_of_triangle_runs_and_vertex_blocks() {
        let (positions, triangles) = ball(20, 50);
        let clusters = Clusters::build(&positions, &triangles, true);
        let mut selection = MeshSelection::default();
        selection.clear(positions.len());
        assert!(selection.is_empty());
        for at in [3, 4, 9] {
            selection.add_cluster(&clusters.as_slice()[at]);
        }
        assert_eq!(selection.triangles(), [192..320, 576..640]);
        let all: Vec<_> = selection.vertices_within(0..positions.len()).collect();
        for at in [3, 4, 9] {
            let needed = clusters.as_slice()[at].vertices();
            assert!(all.iter().any(|run| run.start <= needed.start && needed.end <= run.end));
        }
        // Two parts of the mesh yield the same vertices as the whole.
        let parts = [0..512, 512..positions.len()].map(|part| {
            let runs: Vec<_> = selection.vertices_within(part.clone()).collect();
            runs.iter().flat_map(|run| run.start + part.start..run.end + part.start).collect()
        });
        let [first, second]: [Vec<usize>; 2] = parts;
        assert_eq!([first, second].concat(), all.into_iter().flatten().collect::<Vec<_>>());
    }
}
