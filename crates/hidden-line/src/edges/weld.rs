//! Vertex welding: merges vertices at the same position.
//!
//! Files split the vertices of a surface where texture coordinates, normals or materials change,
//! and store a copy for each side of the seam. The copies must share an index before the two faces
//! at an edge can be found. Exact copies are found in O(n log n) by sorting hashes of the
//! coordinates. Points with equal hashes are compared, so the result depends only on the
//! coordinates. Copies that differ by quantization are merged in [`seams`](super::seams).

use super::world_mesh::{Face, WorldMesh};
use glam::DVec3;

/// Replaces the index of each point with the index of the first point with equal coordinates.
///
/// ```text
///   points   0 A   1 B   2 A   3 C   4 B         representative  0  1  0  3  1
/// ```
///
/// Faces that become degenerate, and duplicates of other faces, are removed. Negative and positive
/// zero count as equal.
pub(super) fn weld_equal_vertices(mesh: &mut WorldMesh) {
    let representative = equal_points(&mesh.points);
    remap_vertices(mesh, &representative);
}

/// The maximum length of a run of equal hashes that is compared pairwise; longer runs are sorted.
const MAX_COMPARED_RUN: usize = 16;

/// Returns, for each point, the index of the first point with the same coordinates.
fn equal_points(points: &[DVec3]) -> Vec<u32> {
    let key = |(point, at): (&DVec3, u32)| u64::from(mix_coordinates(*point)) << 32 | u64::from(at);
    let mut keyed: Vec<u64> = points.iter().zip(0..).map(key).collect();
    keyed.sort_unstable();
    let mut representative: Vec<u32> = (0..points.len() as u32).collect();
    let mut sorted: Vec<u32> = Vec::new();
    for run in keyed.chunk_by(|a, b| a >> 32 == b >> 32).filter(|run| run.len() > 1) {
        sorted.clear();
        sorted.extend(run.iter().map(|key| *key as u32));
        if run.len() > MAX_COMPARED_RUN {
            let order = |at: u32| (points[at as usize] + DVec3::ZERO).to_array();
            sorted.sort_unstable_by(|&i, &j| {
                let ([a, b, c], [x, y, z]) = (order(i), order(j));
                let by_place = a.total_cmp(&x).then(b.total_cmp(&y)).then(c.total_cmp(&z));
                by_place.then(i.cmp(&j))
            });
            for pair in sorted.windows(2) {
                if points[pair[0] as usize] == points[pair[1] as usize] {
                    representative[pair[1] as usize] = representative[pair[0] as usize];
                }
            }
            continue;
        }
        for (count, &at) in sorted.iter().enumerate() {
            let is_same = |other: &&u32| points[**other as usize] == points[at as usize];
            if let Some(first) = sorted[..count].iter().find(is_same) {
                representative[at as usize] = *first;
            }
        }
    }
    representative
}

/// Returns a hash that is the same for equal points, and seldom for other points.
fn mix_coordinates(point: DVec3) -> u32 {
    // Adding zero removes negative zeros.
    let bits = (point + DVec3::ZERO).to_array().map(f64::to_bits);
    let mixed = bits.into_iter().fold(0_u64, |mixed, bits| {
        (mixed.rotate_left(23) ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15)
    });
    ((mixed ^ mixed >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 32) as u32
}

/// Replaces each vertex index `v` with `same[v]`, and removes faces and lines that become
/// degenerate.
pub(super) fn remap_vertices(mesh: &mut WorldMesh, same: &[u32]) {
    for face in &mut mesh.faces {
        face.vertices = face.vertices.map(|vertex| same[vertex as usize]);
    }
    for stroke in &mut mesh.line_edges {
        stroke.ends = stroke.ends.map(|end| same[end as usize]);
    }
    for dot in &mut mesh.dots {
        dot.point = same[dot.point as usize];
    }
    mesh.dots.sort_unstable();
    mesh.dots.dedup();
    for cut in &mut mesh.section_edges {
        let [a, b] = cut.map(|end| same[end as usize]);
        *cut = [a.min(b), a.max(b)];
    }
    mesh.section_edges.sort_unstable();
    mesh.section_edges.dedup();
    mesh.faces.retain(|Face { vertices: [a, b, c], .. }| a != b && b != c && c != a);
    mesh.line_edges.retain(|stroke| stroke.ends[0] != stroke.ends[1]);
    drop_duplicate_faces(&mut mesh.faces, mesh.points.len(), mesh.keeps_duplicates);
}

/// Removes duplicate faces: all but the first face with the same three vertices, in any
/// orientation.
///
/// Two-sided surfaces are often modeled as pairs of coincident faces. Without this step, they would
/// have creases instead of boundaries. With `by_object`, faces of different objects are not
/// duplicates.
fn drop_duplicate_faces(faces: &mut Vec<Face>, points: usize, by_object: bool) {
    let mut is_copy = vec![false; faces.len()];
    // With a counting sort by the lowest vertex, only the few faces of each vertex are compared.
    let lowest = |face: &Face| *face.vertices.iter().min().unwrap_or(&0) as usize;
    let mut starts = vec![0_u32; points + 2];
    faces.iter().for_each(|face| starts[lowest(face) + 2] += 1);
    for at in 2..starts.len() {
        starts[at] += starts[at - 1];
    }
    let mut order = vec![0_u32; faces.len()];
    for (face, index) in faces.iter().zip(0..) {
        let slot = &mut starts[lowest(face) + 1];
        order[*slot as usize] = index;
        *slot += 1;
    }
    let mut keyed: Vec<([u32; 4], u32)> = Vec::new();
    for range in starts.windows(2).filter(|range| range[1] - range[0] > 1) {
        keyed.clear();
        keyed.extend(order[range[0] as usize..range[1] as usize].iter().map(|&at| {
            let face = &faces[at as usize];
            let mut vertices = face.vertices;
            vertices.sort_unstable();
            let [a, b, c] = vertices;
            ([a, b, c, if by_object { face.object } else { 0 }], at)
        }));
        keyed.sort_unstable();
        for pair in keyed.windows(2) {
            is_copy[pair[1].1 as usize] = pair[0].0 == pair[1].0;
        }
    }
    drop((starts, order));
    let mut copies = is_copy.into_iter();
    faces.retain(|_| copies.next() != Some(true));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_points_get_the_index_of_the_first() {
        let point = |k: usize| DVec3::new((k % 7) as f64, (k % 3) as f64 * -0.0, (k % 5) as f64);
        let points: Vec<DVec3> = (0..500).map(point).collect();
        let first = |at: &DVec3| points.iter().position(|other| other == at).map(|at| at as u32);
        let expected: Vec<u32> = points.iter().filter_map(first).collect();
        assert_eq!(equal_points(&points), expected);
    }
}
