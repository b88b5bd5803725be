//! Bins: which pieces touch which tile, in the order in which they were given.
//!
//! Pieces are sorted in groups, each of which has bins of its own, so that threads can share the work. A tile's pieces are
//! those of its bin in each group, one group after the other: the order of all pieces.

use crate::grid::{Part, TILE};
use crate::pieces::{CHUNK, Pieces};
use crate::primitive::Piece;
use crate::threads::share;
use crate::vertex::SUBPIXEL_BITS;

/// The least number of chunks that a group is made of, so that its bins are worth their room.
const LEAST_CHUNKS: usize = 4;

/// For each tile that a part of a picture touches, row by row, the pieces whose bounds touch it.
#[derive(Debug, Default)]
pub(crate) struct Bins {
    grid: Grid,
    groups: Vec<Group>,
    /// How many of the groups are in use.
    used: usize,
}

/// The tiles of a part.
#[derive(Clone, Copy, Debug, Default)]
struct Grid {
    columns: (u32, u32),
    rows: (u32, u32),
}

/// The bins of a run of chunks.
#[derive(Debug, Default)]
struct Group {
    /// Where each tile's part of `pieces` begins; one more at the end.
    starts: Vec<u32>,
    /// Where the next piece of each tile goes, while they are sorted.
    next: Vec<u32>,
    pieces: Vec<u32>,
}

impl Bins {
    /// Sorts pieces into the tiles they touch, in the memory of the last time.
    pub(crate) fn sort(&mut self, pieces: &Pieces, part: Part, threads: usize) {
        self.grid = Grid { columns: part.columns(), rows: part.rows() };
        let chunks: usize = pieces.chunks().len();
        let per_group = (4 * self.grid.tiles()).div_ceil(CHUNK).max(LEAST_CHUNKS);
        self.used = chunks.div_ceil(per_group);
        if self.groups.len() < self.used {
            self.groups.resize_with(self.used, Group::default);
        }
        let grid = self.grid;
        share(threads, self.groups[..self.used].iter_mut().enumerate(), |(at, group)| {
            let chunks = || pieces.chunks().skip(at * per_group).take(per_group);
            group.sort(chunks, grid);
        });
    }

    /// Appends the pieces of the tile in the given column and row of the picture to a list, by their numbers.
    pub(crate) fn list(&self, column: u32, row: u32, pieces: &mut Vec<u32>) {
        let Grid { columns, rows } = self.grid;
        let tile = ((row - rows.0) * (columns.1 - columns.0) + column - columns.0) as usize;
        for Group { starts, pieces: sorted, .. } in &self.groups[..self.used] {
            pieces.extend_from_slice(&sorted[starts[tile] as usize..starts[tile + 1] as usize]);
        }
    }
}

impl Group {
    /// Count, then place: a counting sort keeps the order.
    fn sort<'a, I: Iterator<Item = (u32, &'a [Piece])>>(
        &mut self,
        chunks: impl Fn() -> I,
        grid: Grid,
    ) {
        let Self { starts, next, pieces } = self;
        starts.clear();
        starts.resize(grid.tiles() + 1, 0);
        for piece in chunks().flat_map(|(_, chunk)| chunk) {
            for tile in grid.tiles_of(piece) {
                starts[tile + 1] += 1;
            }
        }
        let mut sum = 0;
        for start in starts.iter_mut() {
            sum += *start;
            *start = sum;
        }
        next.clone_from(starts);
        // What was there before is overwritten.
        pieces.resize(sum as usize, 0);
        for (first, chunk) in chunks() {
            for (number, piece) in (first..).zip(chunk) {
                for tile in grid.tiles_of(piece) {
                    pieces[next[tile] as usize] = number;
                    next[tile] += 1;
                }
            }
        }
    }
}

impl Grid {
    fn tiles(self) -> usize {
        ((self.columns.1 - self.columns.0) * (self.rows.1 - self.rows.0)) as usize
    }

    /// The places of the tiles that a piece's bounds touch.
    #[inline(always)]
    fn tiles_of(self, piece: &Piece) -> impl Iterator<Item = usize> + use<> {
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
