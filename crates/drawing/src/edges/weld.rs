//! Vertex welding: vertices at the same position become one.
//!
//! Files split the vertices of a surface where texture coordinates, normals or materials change,
//! and give each side of the seam a copy. To find the two faces at an edge the copies must share an
//! index. Exact copies are found by sorting, in O(n log n) and without a hash, so the result
//! depends on nothing but the coordinates. Copies that differ by quantization are left to
//! [`seams`](super::seams).

use super::world_mesh::{Face, WorldMesh};
use glam::DVec3;

/// Gives all points with exactly equal coordinates one index, that of the first of them.
///
/// ```text
///   points   0 A   1 B   2 A   3 C   4 B         representative  0  1  0  3  1
/// ```
///
/// Faces that lose a vertex by it, and duplicates of other faces, are removed. Negative and
/// positive zero are equal coordinates but not neighbors in the total order; such points stay apart
/// until near welding.
pub(super) fn weld_equal_vertices(mesh: &mut WorldMesh) {
    let sorted_order = sort_by_position(&mesh.points);
    let mut representative: Vec<u32> = (0..mesh.points.len() as u32).collect();
    for pair in sorted_order.windows(2) {
        let [a, b] = [pair[0], pair[1]].map(|at| at as usize);
        if mesh.points[a] == mesh.points[b] {
            representative[b] = representative[a];
        }
    }
    remap_vertices(mesh, &representative);
}

/// The indices of the points sorted by x, y, z and index.
fn sort_by_position(points: &[DVec3]) -> Vec<u32> {
    let mut keyed: Vec<([f64; 3], u32)> =
        points.iter().zip(0..).map(|(point, at)| (point.to_array(), at)).collect();
    keyed.sort_unstable_by(|(a, i), (b, j)| {
        let order = a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]));
        order.then(a[2].total_cmp(&b[2])).then(i.cmp(j))
    });
    keyed.into_iter().map(|(_, at)| at).collect()
}

/// Replaces each vertex index `v` by `same[v]`, and removes faces and lines that degenerate by it.
pub(super) fn remap_vertices(mesh: &mut WorldMesh, same: &[u32]) {
    for face in &mut mesh.faces {
        face.vertices = face.vertices.map(|vertex| same[vertex as usize]);
    }
    for stroke in &mut mesh.line_edges {
        stroke.ends = stroke.ends.map(|end| same[end as usize]);
    }
    for cut in &mut mesh.section_edges {
        let [a, b] = cut.map(|end| same[end as usize]);
        *cut = [a.min(b), a.max(b)];
    }
    mesh.section_edges.sort_unstable();
    mesh.section_edges.dedup();
    mesh.faces.retain(|Face { vertices: [a, b, c], .. }| a != b && b != c && c != a);
    mesh.line_edges.retain(|stroke| stroke.ends[0] != stroke.ends[1]);
    drop_duplicate_faces(&mut mesh.faces, mesh.keeps_duplicates);
}

/// Removes all but the first of faces with the same three vertices, whatever their orientation.
///
/// Two-sided surfaces are often modeled as two coincident faces; drawn as two they would have
/// creases and no boundaries. With `by_object` faces of different objects are not duplicates of
/// each other.
fn drop_duplicate_faces(faces: &mut Vec<Face>, by_object: bool) {
    let mut keyed: Vec<(([u32; 3], u32), u32)> = faces
        .iter()
        .zip(0..)
        .map(|(face, at)| {
            let mut vertices = face.vertices;
            vertices.sort_unstable();
            ((vertices, if by_object { face.object } else { 0 }), at)
        })
        .collect();
    keyed.sort_unstable();
    let mut is_copy = vec![false; faces.len()];
    for pair in keyed.windows(2) {
        is_copy[pair[1].1 as usize] = pair[0].0 == pair[1].0;
    }
    let mut copies = is_copy.into_iter();
    faces.retain(|_| copies.next() != Some(true));
}
