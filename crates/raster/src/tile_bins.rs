//! Bins: which pieces touch which tile, in the order in which they were given.
//!
//! Pieces are sorted in groups, each of which has bins of its own, so that threads can share the work. A tile's pieces are
//! those of its bin in each group, one group after the other: the order of all pieces.

use crate::parallel::for_each_parallel;
use crate::tile_grid::{FrameRegion, TileGrid};
use crate::triangle_buffer::{CHUNK_TRIANGLES, TriangleBuffer, TriangleChunk};

/// The least number of chunks that a group is made of, so that its bins are worth their room.
const MIN_CHUNKS: usize = 4;

/// For each tile that a part of a picture touches, row by row, the pieces whose bounds touch it.
#[derive(Debug, Default)]
pub(crate) struct TileBins {
    grid: TileGrid,
    groups: Vec<BinGroup>,
    /// How many of the groups are in use.
    used: usize,
}

/// The bins of a run of chunks.
#[derive(Debug, Default)]
struct BinGroup {
    /// Where each tile's part of `pieces` begins; one more at the end.
    bin_starts: Vec<u32>,
    /// Where the next piece of each tile goes, while they are sorted.
    write_positions: Vec<u32>,
    triangles: Vec<u32>,
}

impl TileBins {
    /// Sorts pieces into the tiles they touch, in the memory of the last time.
    pub(crate) fn bin_triangles(
        &mut self,
        pieces: &TriangleBuffer,
        part: FrameRegion,
        threads: usize,
    ) {
        self.grid = TileGrid::new(part);
        let chunks: usize = pieces.chunks().len();
        let per_group = (4 * self.grid.count()).div_ceil(CHUNK_TRIANGLES).max(MIN_CHUNKS);
        self.used = chunks.div_ceil(per_group);
        if self.groups.len() < self.used {
            self.groups.resize_with(self.used, BinGroup::default);
        }
        let grid = self.grid;
        for_each_parallel(
            threads,
            self.groups[..self.used].iter_mut().enumerate(),
            |(at, group)| {
                let chunks = || pieces.chunks().skip(at * per_group).take(per_group);
                group.counting_sort(chunks, grid);
            },
        );
    }

    /// Appends the pieces of the tile in the given column and row of the picture to a list, by their numbers.
    pub(crate) fn append_tile_bin(&self, column: u32, row: u32, pieces: &mut Vec<u32>) {
        let tile = self.grid.tile_index(column, row);
        for BinGroup { bin_starts: starts, triangles: sorted, .. } in &self.groups[..self.used] {
            pieces.extend_from_slice(&sorted[starts[tile] as usize..starts[tile + 1] as usize]);
        }
    }
}

impl BinGroup {
    /// Count, then place: a counting sort keeps the order.
    fn counting_sort<'a, I: Iterator<Item = (u32, &'a TriangleChunk)>>(
        &mut self,
        chunks: impl Fn() -> I,
        grid: TileGrid,
    ) {
        let Self { bin_starts: starts, write_positions: next, triangles: pieces } = self;
        starts.clear();
        starts.resize(grid.count() + 1, 0);
        for &tiles in chunks().flat_map(|(_, chunk)| chunk.tiles()) {
            for tile in grid.tile_indices(tiles) {
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
                for tile in grid.tile_indices(tiles) {
                    pieces[next[tile] as usize] = number;
                    next[tile] += 1;
                }
            }
        }
    }
}
