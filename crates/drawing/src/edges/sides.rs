//! The edges between welded points, each with the faces that end there.

use super::gather::Face;

/// A side of a face.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct Side {
    /// The end with the greater number.
    pub(super) high: u32,
    pub(super) face: u32,
    /// Which side of the face it is.
    pub(super) number: u8,
    /// Whether the face runs from the end with the lesser number to the other.
    pub(super) rises: bool,
}

/// The sides of all faces, sorted by their ends.
#[derive(Clone, Debug, Default)]
pub(super) struct Sides {
    /// Where in `all` the sides of each point begin that have it as their end with the lesser number.
    starts: Vec<u32>,
    all: Vec<Side>,
}

impl Sides {
    pub(super) fn of(faces: &[Face], points: usize) -> Self {
        let mut starts = vec![0_u32; points + 2];
        let low = |[a, b]: [u32; 2]| a.min(b) as usize;
        for face in faces {
            ends(face).into_iter().for_each(|ends| starts[low(ends) + 2] += 1);
        }
        for at in 2..starts.len() {
            starts[at] += starts[at - 1];
        }
        let none = Side { high: 0, face: 0, number: 0, rises: false };
        let mut all = vec![none; faces.len() * 3];
        for (face, number) in faces.iter().zip(0..) {
            for (ends, side) in ends(face).into_iter().zip(0..) {
                let place = &mut starts[low(ends) + 1];
                let [from, to] = ends;
                all[*place as usize] =
                    Side { high: from.max(to), face: number, number: side, rises: from < to };
                *place += 1;
            }
        }
        for window in starts.windows(2) {
            all[window[0] as usize..window[1] as usize].sort_unstable();
        }
        Self { starts, all }
    }

    /// The edges in the order of their ends, each with its sides.
    pub(super) fn edges(&self) -> impl Iterator<Item = ([u32; 2], &[Side])> {
        self.starts.windows(2).zip(0..).flat_map(|(range, low)| {
            let here = &self.all[range[0] as usize..range[1] as usize];
            let edges = here.chunk_by(|a, b| a.high == b.high);
            edges.map(move |sides| ([low, sides[0].high], sides))
        })
    }
}

fn ends(face: &Face) -> [[u32; 2]; 3] {
    let [a, b, c] = face.corners;
    [[a, b], [b, c], [c, a]]
}
