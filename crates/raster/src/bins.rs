//! Bins: which pieces touch which tile, in the order in which they were given.
//!
//! Pieces are sorted in groups, each of which has bins of its own, so that threads can share the work. A tile's pieces are
//! those of its bin in each group, one group after the other: the order of all pieces.

use crate::grid::{Grid, Part};
use crate::pieces::{CHUNK, Chunk, Pieces};
use crate::threads::share;

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
        self.grid = Grid::of(part);
        let chunks: usize = pieces.chunks().len();
        let per_group = (4 * self.grid.count()).div_ceil(CHUNK).max(LEAST_CHUNKS);
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
        let tile = self.grid.place(column, row);
        for Group { starts, pieces: sorted, .. } in &self.groups[..self.used] {
            pieces.extend_from_slice(&sorted[starts[tile] as usize..starts[tile + 1] as usize]);
        }
    }
}

impl Group {
    /// Count, then place: a counting sort keeps the order.
    fn sort<'a, I: Iterator<Item = (u32, &'a Chunk)>>(
        &mut self,
        chunks: impl Fn() -> I,
        grid: Grid,
    ) {
        let Self { starts, next, pieces } = self;
        starts.clear();
        starts.resize(grid.count() + 1, 0);
        for &tiles in chunks().flat_map(|(_, chunk)| chunk.tiles()) {
            for tile in grid.places(tiles) {
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
            for (number, &tiles) in (first..).zip(chunk.tiles()) {
                for tile in grid.places(tiles) {
                    pieces[next[tile] as usize] = number;
                    next[tile] += 1;
                }
            }
        }
    }
}
