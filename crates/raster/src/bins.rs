//! Bins: which pieces touch which tile, in the order in which they were given.

use crate::primitive::Piece;
use crate::vertex::SUBPIXEL_BITS;

/// The side of a tile in pixels: its depth and names stay in the nearest caches while it is filled.
pub(crate) const TILE: u32 = 64;

/// For each tile of a picture, row by row, the pieces whose bounds touch it.
#[derive(Debug)]
pub(crate) struct Bins {
    columns: u32,
    /// Where each tile's part of `pieces` begins; one more at the end.
    starts: Vec<u32>,
    pieces: Vec<u32>,
}

impl Bins {
    /// Sorts the pieces of a picture into its tiles: count, then place (a counting sort keeps the order).
    pub(crate) fn sort(pieces: &[Piece], width: u32, height: u32) -> Self {
        let (columns, rows) = (width.div_ceil(TILE), height.div_ceil(TILE));
        let mut starts = vec![0_u32; (columns * rows) as usize + 1];
        for piece in pieces {
            for tile in tiles_of(piece, columns, rows) {
                starts[tile + 1] += 1;
            }
        }
        for tile in 1..starts.len() {
            starts[tile] += starts[tile - 1];
        }
        let mut next = starts.clone();
        let mut sorted = vec![0_u32; starts.last().map_or(0, |&n| n as usize)];
        for (index, piece) in pieces.iter().enumerate() {
            for tile in tiles_of(piece, columns, rows) {
                sorted[next[tile] as usize] = index as u32;
                next[tile] += 1;
            }
        }
        Self { columns, starts, pieces: sorted }
    }

    /// The pieces of the tile in the given column and row, by their numbers.
    pub(crate) fn of(&self, column: u32, row: u32) -> &[u32] {
        let tile = (row * self.columns + column) as usize;
        &self.pieces[self.starts[tile] as usize..self.starts[tile + 1] as usize]
    }
}

/// The numbers of the tiles that a piece's bounds touch.
fn tiles_of(piece: &Piece, columns: u32, rows: u32) -> impl Iterator<Item = usize> {
    let span = |values: [i32; 3], count: u32| {
        let tile = |grid: i32| i64::from(grid >> SUBPIXEL_BITS).div_euclid(i64::from(TILE));
        let [a, b, c] = values;
        let first = tile(a.min(b).min(c)).max(0);
        let last = tile(a.max(b).max(c)).min(i64::from(count) - 1);
        (first, last + 1)
    };
    let (left, right) = span(piece.corners.map(|v| v.x), columns);
    let (top, bottom) = span(piece.corners.map(|v| v.y), rows);
    (top..bottom).flat_map(move |row| {
        (left..right).map(move |column| (row * i64::from(columns) + column) as usize)
    })
}
