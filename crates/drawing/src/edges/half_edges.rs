//! The edges between welded points, each with the faces that end there.

use super::world_mesh::Face;

/// A side of a face.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct HalfEdge {
    /// The end with the greater number.
    pub(super) high_vertex: u32,
    pub(super) face: u32,
    /// Which side of the face it is.
    pub(super) side: u8,
    /// Whether the face runs from the end with the lesser number to the other.
    pub(super) is_forward: bool,
}

/// The sides of all faces, sorted by their ends.
#[derive(Clone, Debug, Default)]
pub(super) struct HalfEdges {
    /// Where in `all` the sides of each point begin that have it as their end with the lesser number.
    starts: Vec<u32>,
    half_edges: Vec<HalfEdge>,
}

impl HalfEdges {
    pub(super) fn new(faces: &[Face], points: usize) -> Self {
        let mut starts = vec![0_u32; points + 2];
        let low = |[a, b]: [u32; 2]| a.min(b) as usize;
        for face in faces {
            face_sides(face).into_iter().for_each(|ends| starts[low(ends) + 2] += 1);
        }
        for at in 2..starts.len() {
            starts[at] += starts[at - 1];
        }
        let none = HalfEdge { high_vertex: 0, face: 0, side: 0, is_forward: false };
        let mut half_edges = vec![none; faces.len() * 3];
        for (face, number) in faces.iter().zip(0..) {
            for (ends, side) in face_sides(face).into_iter().zip(0..) {
                let slot = &mut starts[low(ends) + 1];
                let [from, to] = ends;
                half_edges[*slot as usize] = HalfEdge {
                    high_vertex: from.max(to),
                    face: number,
                    side,
                    is_forward: from < to,
                };
                *slot += 1;
            }
        }
        for window in starts.windows(2) {
            half_edges[window[0] as usize..window[1] as usize].sort_unstable();
        }
        Self { starts, half_edges }
    }

    /// The edges in the order of their ends, each with its sides.
    pub(super) fn edges(&self) -> impl Iterator<Item = ([u32; 2], &[HalfEdge])> {
        self.starts.windows(2).zip(0..).flat_map(|(range, low)| {
            let here = &self.half_edges[range[0] as usize..range[1] as usize];
            let edges = here.chunk_by(|a, b| a.high_vertex == b.high_vertex);
            edges.map(move |sides| ([low, sides[0].high_vertex], sides))
        })
    }
}

fn face_sides(face: &Face) -> [[u32; 2]; 3] {
    let [a, b, c] = face.vertices;
    [[a, b], [b, c], [c, a]]
}
