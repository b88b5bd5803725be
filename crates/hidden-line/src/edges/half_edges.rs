//! Half-edge table: the sides of all faces, sorted by their end vertices.
//!
//! Each edge of a welded mesh is a run of half-edges with the same two ends: one for a boundary,
//! two on a manifold surface, more where surfaces join. A counting sort by the lower end builds the
//! table in linear time; comparisons are needed only among the few half-edges of each vertex.

use super::world_mesh::Face;

/// One side of a face, packed into eight bytes, because a mesh has three times as many sides as
/// faces.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct HalfEdge {
    /// The end with the higher index; the lower end is implied by the position in the table.
    pub(super) high_vertex: u32,
    /// The face index, two bits for the side, and one bit for the direction.
    packed: u32,
}

impl HalfEdge {
    /// Creates a half-edge for a side of a face; side 0 runs from the first vertex to the second,
    /// and so on. A half-edge runs forward if the face traverses it from the lower end to the
    /// higher. On an oriented manifold, the two half-edges of an edge run in opposite directions.
    pub(super) fn new(high_vertex: u32, face: u32, side: u8, is_forward: bool) -> Self {
        Self { high_vertex, packed: face << 3 | u32::from(side) << 1 | u32::from(is_forward) }
    }

    /// Returns the index of the face.
    pub(super) const fn face(self) -> u32 {
        self.packed >> 3
    }

    /// Returns the side of the face, from 0 to 2.
    pub(super) const fn side(self) -> u8 {
        (self.packed >> 1 & 3) as u8
    }

    /// Whether the face traverses the edge from the lower end to the higher.
    pub(super) const fn is_forward(self) -> bool {
        self.packed & 1 == 1
    }
}

/// The half-edges of all faces, sorted by their ends.
#[derive(Clone, Debug, Default)]
pub(super) struct HalfEdges {
    /// The index in `half_edges` of the first half-edge with each vertex as its lower end.
    starts: Vec<u32>,
    /// The half-edges, sorted by lower end, higher end, face and side.
    half_edges: Vec<HalfEdge>,
}

impl HalfEdges {
    /// Builds the table for faces whose vertex indices are below `points`.
    ///
    /// Uses a counting sort: counts the half-edges of each lower end, turns the counts into start
    /// indices, places each half-edge, then sorts the run of each vertex.
    pub(super) fn new(faces: &[Face], points: usize) -> Self {
        let mut starts = vec![0_u32; points + 2];
        let low = |[a, b]: [u32; 2]| a.min(b) as usize;
        for face in faces {
            face_sides(face).into_iter().for_each(|ends| starts[low(ends) + 2] += 1);
        }
        for at in 2..starts.len() {
            starts[at] += starts[at - 1];
        }
        let none = HalfEdge::new(0, 0, 0, false);
        let mut half_edges = vec![none; faces.len() * 3];
        for (face, index) in faces.iter().zip(0..) {
            for (ends, side) in face_sides(face).into_iter().zip(0..) {
                let slot = &mut starts[low(ends) + 1];
                let [from, to] = ends;
                half_edges[*slot as usize] = HalfEdge::new(from.max(to), index, side, from < to);
                *slot += 1;
            }
        }
        for window in starts.windows(2) {
            half_edges[window[0] as usize..window[1] as usize].sort_unstable();
        }
        Self { starts, half_edges }
    }

    /// Returns the edges, sorted by their ends, each with its half-edges.
    pub(super) fn edges(&self) -> impl Iterator<Item = ([u32; 2], &[HalfEdge])> {
        self.starts.windows(2).zip(0..).flat_map(|(range, low)| {
            let here = &self.half_edges[range[0] as usize..range[1] as usize];
            let edges = here.chunk_by(|a, b| a.high_vertex == b.high_vertex);
            edges.map(move |sides| ([low, sides[0].high_vertex], sides))
        })
    }
}

/// Returns the three sides of a face as pairs of vertices.
fn face_sides(face: &Face) -> [[u32; 2]; 3] {
    let [a, b, c] = face.vertices;
    [[a, b], [b, c], [c, a]]
}
