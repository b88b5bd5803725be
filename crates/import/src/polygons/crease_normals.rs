//! Vertex normals by crease angle or smoothing group, for triangles with welded positions.
//!
//! The normal of a corner is the sum of the normals of all triangles around the vertex that can be
//! reached from the corner's triangle across smooth edges. Each normal is weighted by the
//! triangle's angle at the vertex (Thürmer and Wüthrich 1998), so the sum does not depend on how
//! flat faces are triangulated. The reached triangles form a group; a vertex with several is split.
//!
//! An edge is smooth if exactly two triangles share it and meet the [`Smoothing`] condition;
//! boundaries, non-manifold edges and edges of triangles without area are creases. If all triangles
//! around a vertex are within half the crease angle of their mean, they form one group, regardless
//! of their edges. Most vertices of fine meshes therefore need no edge search.

use glam::{DVec3, Vec3};

/// The condition for smoothing the edge between two triangles.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Smoothing<'a> {
    /// The angle between the triangle normals is at most this many degrees.
    CreaseAngle(f64),
    /// Both triangles are in the same nonzero smoothing group. The slice contains the group of each
    /// triangle.
    Groups(&'a [u32]),
}

/// Vertex normals, and the vertex copies that they require.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct CreaseNormals {
    /// Vertex indices of the triangles. Indices beyond the original positions are new vertices.
    /// Original vertices that were in use remain in use.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// For each new vertex in order, the vertex it is a copy of.
    pub(crate) copies: Vec<u32>,
    /// Unit normals of all vertices, original and new.
    pub(crate) normals: Vec<[f32; 3]>,
}

/// The amount by which the cosine between two normals may be below the cosine of the crease angle.
///
/// It allows for rounded coordinates, so that all edges of a twelve-sided prism, whose side normals
/// are 30° apart, are treated alike.
const COSINE_TOLERANCE: f32 = 1e-5;

/// Maximum deviation in degrees from the mean normal at a vertex. Beyond it, triangles are grouped
/// by their edges.
const MAX_SMOOTH_DEGREES: f64 = 45.0;

impl CreaseNormals {
    /// Computes the normals of triangles in which equal positions share a vertex.
    ///
    /// The result depends only on the arguments. The time is linear in the number of triangles,
    /// apart from a factor that is logarithmic in the maximum number of triangles at a vertex.
    /// Indices must be valid for the positions, and there must be fewer than 2³² vertices after
    /// splitting.
    pub(crate) fn compute(
        positions: &[[f32; 3]],
        triangles: Vec<[u32; 3]>,
        smoothing: Smoothing<'_>,
    ) -> Self {
        let faces: Vec<Face> =
            triangles.iter().map(|corners| Face::new(positions, *corners)).collect();
        let smooth = SmoothVertices::find(positions.len(), &triangles, &faces, smoothing);
        let mut result = Self { triangles, copies: Vec::new(), normals: smooth.normals };
        if smooth.others == 0 {
            return result;
        }
        let around = CornersByVertex::new(positions.len(), &result.triangles);
        let limit = SmoothEdges::new(smoothing, &faces);
        let mut fans = VertexFans::default();
        for vertex in (0..positions.len()).filter(|vertex| !smooth.is_smooth[*vertex]) {
            let corners = around.corners_of(vertex);
            if !corners.is_empty() {
                fans.group_corners(&result.triangles, corners, &limit);
                result.assign_normals(vertex as u32, corners, &mut fans, &faces);
            }
        }
        result
    }

    /// Assigns a normal to each group of corners at a vertex. All groups but the first get a new
    /// vertex.
    fn assign_normals(
        &mut self,
        vertex: u32,
        corners: &[u32],
        fans: &mut VertexFans,
        faces: &[Face],
    ) {
        fans.sums.clear();
        fans.sums.resize(corners.len(), (Vec3::ZERO, vertex));
        for (&corner, &root) in corners.iter().zip(&fans.roots) {
            let (face, k) = (&faces[corner as usize / 3], corner as usize % 3);
            fans.sums[root as usize].0 += face.weighted_normal(k);
        }
        // The first group keeps the vertex, so that smooth meshes need no copies.
        let mut is_first = true;
        for (at, &root) in fans.roots.iter().enumerate().filter(|(at, root)| *at == **root as usize)
        {
            let unit = unit_or_z(fans.sums[at].0).to_array();
            if std::mem::take(&mut is_first) {
                self.normals[vertex as usize] = unit;
            } else {
                fans.sums[root as usize].1 = self.normals.len() as u32;
                self.copies.push(vertex);
                self.normals.push(unit);
            }
        }
        for (&corner, &root) in corners.iter().zip(&fans.roots) {
            self.triangles[corner as usize / 3][corner as usize % 3] = fans.sums[root as usize].1;
        }
    }
}

/// The normals of vertices around which the surface is nearly flat.
struct SmoothVertices {
    /// The unit normals of all vertices, final only for smooth vertices.
    normals: Vec<[f32; 3]>,
    /// Whether each vertex is smooth.
    is_smooth: Vec<bool>,
    /// The number of vertices that are not smooth.
    others: usize,
}

impl SmoothVertices {
    /// Finds the vertices whose triangles are all within half the crease angle, and within 45°, of
    /// the sum of their weighted normals. The normals of these triangles differ by at most the
    /// crease angle, and none of them sticks out. With smoothing groups, no vertex qualifies.
    fn find(
        vertices: usize,
        triangles: &[[u32; 3]],
        faces: &[Face],
        smoothing: Smoothing<'_>,
    ) -> Self {
        let Smoothing::CreaseAngle(degrees) = smoothing else {
            let normals = vec![[0.0, 0.0, 1.0]; vertices];
            return Self { normals, is_smooth: vec![false; vertices], others: vertices };
        };
        let mut normals = vec![[0.0; 3]; vertices];
        for (corners, face) in triangles.iter().zip(faces) {
            for (k, &vertex) in corners.iter().enumerate() {
                let sum = &mut normals[vertex as usize];
                *sum = (Vec3::from(*sum) + face.weighted_normal(k)).to_array();
            }
        }
        for normal in &mut normals {
            *normal = unit_or_z(Vec3::from(*normal)).to_array();
        }
        let within = (0.5 * degrees).clamp(0.0, MAX_SMOOTH_DEGREES);
        let least = libm::cos(within.to_radians()) as f32;
        let mut is_smooth = vec![true; vertices];
        for (corners, face) in triangles.iter().zip(faces) {
            // Triangles without area have no direction to compare.
            if face.normal == Vec3::ZERO {
                continue;
            }
            for &vertex in corners {
                let cosine = face.normal.dot(Vec3::from(normals[vertex as usize]));
                is_smooth[vertex as usize] &= cosine >= least;
            }
        }
        let others = is_smooth.iter().filter(|is_smooth| !**is_smooth).count();
        Self { normals, is_smooth, others }
    }
}

/// Returns the direction of a vector, or +z if it has none.
fn unit_or_z(sum: Vec3) -> Vec3 {
    sum.try_normalize().unwrap_or(Vec3::Z)
}

/// The normal and angles of a triangle.
#[derive(Clone, Copy, Debug)]
struct Face {
    /// The unit normal, or zero if the triangle has no area.
    normal: Vec3,
    /// The angles at the first two corners in radians; all three add up to π.
    angles: [f32; 2],
}

impl Face {
    /// Computes the normal and angles of the triangle with these corners.
    ///
    /// This uses double precision, because single precision would lose small triangles far from the
    /// origin and overflow for large triangles.
    fn new(positions: &[[f32; 3]], corners: [u32; 3]) -> Self {
        let [a, b, c] = corners.map(|at| DVec3::from(positions[at as usize].map(f64::from)));
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let cross = ab.cross(c - a);
        let square = cross.length_squared();
        if square <= 0.0 {
            return Self { normal: Vec3::ZERO, angles: [0.0; 2] };
        }
        let normal = (cross / square.sqrt()).as_vec3();
        let (u, v, w) = (ab.length_squared(), bc.length_squared(), ca.length_squared());
        let at_a = (-ab.dot(ca) / (u * w).sqrt()) as f32;
        let at_b = (-ab.dot(bc) / (u * v).sqrt()) as f32;
        Self { normal, angles: [arc_cosine(at_a), arc_cosine(at_b)] }
    }

    /// Returns the normal weighted by the angle at corner 0, 1 or 2.
    fn weighted_normal(&self, corner: usize) -> Vec3 {
        let [a, b] = self.angles;
        self.normal * [a, b, (std::f32::consts::PI - a - b).max(0.0)][corner]
    }
}

/// Returns the arc cosine in radians to within 7 · 10⁻⁵ (Abramowitz and Stegun 4.4.45), which is
/// accurate enough for weights.
fn arc_cosine(cosine: f32) -> f32 {
    let x = cosine.abs().min(1.0);
    let series = 1.570_728_8 + x * (-0.212_114_4 + x * (0.074_261 + x * -0.018_729_3));
    let angle = (1.0 - x).sqrt() * series;
    if cosine < 0.0 { std::f32::consts::PI - angle } else { angle }
}

/// The corners at each vertex. Corner 3 t + k is the k-th corner of triangle t.
struct CornersByVertex {
    /// For each vertex, the end of its corners in the list, or the start until they are filled in.
    ends: Vec<u32>,
    /// The corners, sorted by vertex and then by triangle.
    corners: Vec<u32>,
}

impl CornersByVertex {
    /// Sorts the corners by vertex with a counting sort.
    fn new(vertices: usize, triangles: &[[u32; 3]]) -> Self {
        let mut ends = vec![0u32; vertices + 1];
        let all = triangles.as_flattened();
        all.iter().for_each(|&vertex| ends[vertex as usize + 1] += 1);
        let mut sum = 0;
        for end in &mut ends {
            sum += *end;
            *end = sum;
        }
        // Each start advances to the end as the corners are filled in.
        let mut corners = vec![0u32; all.len()];
        for (corner, &vertex) in all.iter().enumerate() {
            let slot = &mut ends[vertex as usize];
            corners[*slot as usize] = corner as u32;
            *slot += 1;
        }
        Self { ends, corners }
    }

    /// Returns the corners at a vertex.
    fn corners_of(&self, vertex: usize) -> &[u32] {
        let start = vertex.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.corners[start as usize..self.ends[vertex] as usize]
    }
}

/// The part of the smooth edge rule that depends on the two triangles.
struct SmoothEdges<'a> {
    /// The triangles.
    faces: &'a [Face],
    /// The minimum cosine between the normals of two triangles, or `None` for groups.
    cosine: Option<f32>,
    /// The smoothing groups of the triangles.
    groups: &'a [u32],
}

impl<'a> SmoothEdges<'a> {
    /// Creates the rule for triangles with a given smoothing.
    fn new(smoothing: Smoothing<'a>, faces: &'a [Face]) -> Self {
        match smoothing {
            Smoothing::CreaseAngle(degrees) => {
                let cosine = libm::cos(degrees.clamp(0.0, 180.0).to_radians()) as f32;
                Self { faces, cosine: Some(cosine - COSINE_TOLERANCE), groups: &[] }
            }
            Smoothing::Groups(groups) => Self { faces, cosine: None, groups },
        }
    }

    /// Returns whether the shared edge of two triangles with area is smooth.
    fn joins(&self, one: u32, other: u32) -> bool {
        let (one, other) = (one as usize, other as usize);
        if let Some(least) = self.cosine {
            return self.faces[one].normal.dot(self.faces[other].normal) >= least;
        }
        let group = |at: usize| self.groups.get(at).copied().unwrap_or(0);
        group(one) != 0 && group(one) == group(other)
    }

    /// Returns whether a triangle has an area.
    fn has_area(&self, triangle: u32) -> bool {
        self.faces[triangle as usize].normal != Vec3::ZERO
    }
}

/// Groups the corners around one vertex. The buffers are reused for each vertex.
#[derive(Default)]
struct VertexFans {
    /// For each corner at the vertex, the index of the first corner of its group.
    roots: Vec<u32>,
    /// The edges at the vertex: the vertex at the other end, and a corner whose triangle has the
    /// edge.
    edges: Vec<(u32, u32)>,
    /// For the first corner of each group, the sum of weighted normals, and the group's vertex.
    sums: Vec<(Vec3, u32)>,
}

impl VertexFans {
    /// Groups the corners at a vertex that are connected by smooth edges.
    ///
    /// Every triangle has two edges at the vertex; sorting all edges by their other ends makes
    /// equal edges adjacent. Triangles without area have no edges and join the first group.
    fn group_corners(&mut self, triangles: &[[u32; 3]], corners: &[u32], smooth: &SmoothEdges<'_>) {
        self.roots.clear();
        self.roots.extend(0..corners.len() as u32);
        self.edges.clear();
        for (at, &corner) in corners.iter().enumerate() {
            let (triangle, k) = (triangles[corner as usize / 3], corner as usize % 3);
            if !smooth.has_area(corner / 3) {
                continue;
            }
            self.edges.push((triangle[(k + 1) % 3], at as u32));
            self.edges.push((triangle[(k + 2) % 3], at as u32));
        }
        self.edges.sort_unstable();
        let edges = std::mem::take(&mut self.edges);
        for run in edges.chunk_by(|one, other| one.0 == other.0) {
            if let [(_, one), (_, other)] = *run
                && smooth.joins(corners[one as usize] / 3, corners[other as usize] / 3)
            {
                let (one, other) = (self.find_root(one), self.find_root(other));
                // The smaller index becomes the root, regardless of the order of the edges.
                self.roots[one.max(other) as usize] = one.min(other);
            }
        }
        self.edges = edges;
        let has_area = |corner: &u32| smooth.has_area(corner / 3);
        let first = corners.iter().position(has_area).unwrap_or(0) as u32;
        for (at, corner) in corners.iter().enumerate() {
            self.roots[at] = if has_area(corner) { self.find_root(at as u32) } else { first };
        }
    }

    /// Finds the first corner of a group, with path halving.
    fn find_root(&mut self, mut at: u32) -> u32 {
        while self.roots[at as usize] != at {
            let next = self.roots[at as usize];
            self.roots[at as usize] = self.roots[next as usize];
            at = next;
        }
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a strip of `count` rectangles, each turned by `degrees` from the previous one about
    /// the z axis.
    fn bent_strip(count: usize, degrees: f64) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
        let (mut at, mut positions, mut triangles) = (DVec3::ZERO, Vec::new(), Vec::new());
        for step in 0..=count {
            positions.push(at.as_vec3().to_array());
            positions.push((at + DVec3::Z).as_vec3().to_array());
            let turn = (degrees * step as f64).to_radians();
            at += DVec3::new(libm::cos(turn), libm::sin(turn), 0.0);
        }
        for step in 0..count as u32 {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| 2 * step + k);
            triangles.extend([[a, c, b], [b, c, d]]);
        }
        (positions, triangles)
    }

    fn crease(positions: &[[f32; 3]], triangles: Vec<[u32; 3]>, degrees: f64) -> CreaseNormals {
        CreaseNormals::compute(positions, triangles, Smoothing::CreaseAngle(degrees))
    }

    #[test]
    fn edges_up_to_the_crease_angle_are_smooth() {
        for (turn, limit, copies) in
            [(29.9, 30.0, 0), (30.0, 30.0, 0), (30.1, 30.0, 2), (90.0, 30.0, 2), (90.0, 90.0, 0)]
        {
            let (positions, triangles) = bent_strip(2, turn);
            let result = crease(&positions, triangles, limit);
            assert_eq!(result.copies.len(), copies, "{turn} with limit {limit}");
            assert_eq!(result.normals.len(), positions.len() + copies);
        }
    }

    #[test]
    fn smooth_normals_are_the_mean_of_the_faces() {
        let (positions, triangles) = bent_strip(2, 20.0);
        let result = crease(&positions, triangles, 30.0);
        // The first face points along −y. At the bend, the angles of each face add up to 90°.
        let turned = |degrees: f64| {
            let angle = degrees.to_radians();
            Vec3::new(libm::sin(angle) as f32, -libm::cos(angle) as f32, 0.0)
        };
        for (vertex, degrees) in [(0, 0.0), (1, 0.0), (2, 10.0), (3, 10.0), (4, 20.0), (5, 20.0)] {
            let normal = Vec3::from(result.normals[vertex]);
            assert!((normal - turned(degrees)).length() < 1e-4, "{vertex}: {normal}");
        }
    }

    #[test]
    fn a_cube_has_three_normals_at_each_corner() {
        let positions: Vec<[f32; 3]> =
            (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|bit| bit as f32)).collect();
        let quads =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles: Vec<[u32; 3]> =
            quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let flat = crease(&positions, triangles.clone(), 30.0);
        assert_eq!((flat.normals.len(), flat.copies.len()), (24, 16));
        for (given, now) in triangles.iter().zip(&flat.triangles) {
            let corner =
                |at: u32| flat.copies.get((at as usize).wrapping_sub(8)).copied().unwrap_or(at);
            assert_eq!(*given, now.map(corner));
            let [a, b, c] = now.map(|at| flat.normals[at as usize]);
            assert!(a == b && b == c && a.iter().filter(|x| x.abs() == 1.0).count() == 1, "{a:?}");
        }
        // Weighted by angle, the three faces count equally, however they are triangulated.
        let round = crease(&positions, triangles, 180.0);
        for (position, normal) in positions.iter().zip(&round.normals) {
            let outward = (Vec3::from(*position) - 0.5).normalize();
            assert!((Vec3::from(*normal) - outward).length() < 1e-4, "{normal:?}");
        }
    }

    #[test]
    fn non_manifold_edges_are_creases() {
        let (mut positions, mut triangles) = bent_strip(2, 0.0);
        assert_eq!(crease(&positions, triangles.clone(), 180.0).copies.len(), 0);
        // Add a third face at the edge between the two rectangles.
        positions.push([1.0, 1.0, 0.0]);
        triangles.push([2, 3, 6]);
        assert_eq!(crease(&positions, triangles, 180.0).copies.len(), 4);
    }

    #[test]
    fn triangles_without_area_do_not_affect_normals() {
        let (positions, mut triangles) = bent_strip(2, 20.0);
        let normals = crease(&positions, triangles.clone(), 30.0).normals;
        triangles.insert(0, [2, 2, 3]);
        triangles.push([3, 2, 3]);
        assert_eq!(crease(&positions, triangles, 30.0).normals, normals);
        let lone = crease(&positions, vec![[0, 0, 0]], 30.0);
        assert_eq!(lone.normals, vec![[0.0, 0.0, 1.0]; 6]);
    }

    #[test]
    fn smoothing_groups_replace_the_crease_angle() {
        let (positions, triangles) = bent_strip(2, 60.0);
        let copies = |groups: &[u32]| {
            let smoothing = Smoothing::Groups(groups);
            CreaseNormals::compute(&positions, triangles.clone(), smoothing).copies.len()
        };
        assert_eq!(copies(&[1, 1, 1, 1]), 0);
        assert_eq!(copies(&[1, 1, 2, 2]), 2);
        // Group 0 is flat, so every corner has its own vertex.
        assert_eq!(copies(&[0, 0, 0, 0]), 12 - 6);
        assert_eq!(copies(&[]), 12 - 6);
    }

    #[test]
    fn very_small_and_large_triangles_have_normals() {
        for size in [1e-40, 1e-30, 1e30, 3e38] {
            let positions = [[0.0, 0.0, 0.0], [size, 0.0, 0.0], [0.0, size, 0.0]];
            let result = crease(&positions, vec![[0, 1, 2]], 30.0);
            assert_eq!(result.normals, [[0.0, 0.0, 1.0]; 3], "{size}");
        }
    }

    #[test]
    fn a_vertex_with_many_triangles_is_processed_quickly() {
        let count = 100_000u32;
        let rim = (0..count).map(|at| [at as f32, (at % 2) as f32 * 1e6, 1.0]);
        let positions: Vec<[f32; 3]> = std::iter::once([0.0; 3]).chain(rim).collect();
        let triangles: Vec<[u32; 3]> = (1..count).map(|at| [0, at, at + 1]).collect();
        let result = crease(&positions, triangles, 0.0);
        assert!(result.copies.len() > 100_000);
    }

    #[test]
    fn arc_cosines_are_accurate() {
        for step in -1000..=1000 {
            let cosine = step as f32 / 1000.0;
            let error = f64::from(arc_cosine(cosine)) - libm::acos(f64::from(cosine));
            assert!(error.abs() < 7.1e-5, "{cosine}: {error}");
        }
    }
}
