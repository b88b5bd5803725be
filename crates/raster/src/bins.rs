//! Bins: which pieces touch which tile, in the order in which they were given.

use crate::grid::{Part, TILE};
use crate::primitive::Piece;
use crate::vertex::SUBPIXEL_BITS;

/// For each tile that a part of a picture touches, row by row, the pieces whose bounds touch it.
#[derive(Debug)]
pub(crate) struct Bins {
    columns: (u32, u32),
    rows: (u32, u32),
    /// Where each tile's part of `pieces` begins; one more at the end.
    starts: Vec<u32>,
    pieces: Vec<u32>,
}

impl Bins {
    /// Sorts pieces into the tiles they touch: count, then place (a counting sort keeps the order).
    pub(crate) fn sort(pieces: &[Piece], part: Part) -> Self {
        let (columns, rows) = (part.columns(), part.rows());
        let tiles = ((columns.1 - columns.0) * (rows.1 - rows.0)) as usize;
        let mut bins = Self { columns, rows, starts: vec![0; tiles + 1], pieces: Vec::new() };
        for piece in pieces {
            for tile in bins.tiles_of(piece) {
                bins.starts[tile + 1] += 1;
            }
        }
        for tile in 1..bins.starts.len() {
            bins.starts[tile] += bins.starts[tile - 1];
        }
        let mut next = bins.starts.clone();
        bins.pieces = vec![0; bins.starts[tiles] as usize];
        for (index, piece) in pieces.iter().enumerate() {
            for tile in bins.tiles_of(piece) {
                bins.pieces[next[tile] as usize] = index as u32;
                next[tile] += 1;
            }
        }
        bins
    }

    /// The pieces of the tile in the given column and row of the picture, by their numbers.
    pub(crate) fn of(&self, column: u32, row: u32) -> &[u32] {
        let tile =
            (row - self.rows.0) * (self.columns.1 - self.columns.0) + column - self.columns.0;
        let tile = tile as usize;
        &self.pieces[self.starts[tile] as usize..self.starts[tile + 1] as usize]
    }

    /// The places of the tiles that a piece's bounds touch.
    fn tiles_of(&self, piece: &Piece) -> impl Iterator<Item = usize> + use<> {
        const TILE_BITS: u32 = SUBPIXEL_BITS + TILE.ilog2();
        let span = |[a, b, c]: [i32; 3], (begin, end): (u32, u32)| {
            let first = (a.min(b).min(c) >> TILE_BITS).max(begin as i32);
            let last = (a.max(b).max(c) >> TILE_BITS).min(end as i32 - 1);
            (first - begin as i32) as usize..(last + 1 - begin as i32).max(0) as usize
        };
        let columns = span(piece.corners.map(|v| v.x), self.columns);
        let rows = span(piece.corners.map(|v| v.y), self.rows);
        let width = (self.columns.1 - self.columns.0) as usize;
        rows.flat_map(move |row| columns.clone().map(move |column| row * width + column))
    }
}
