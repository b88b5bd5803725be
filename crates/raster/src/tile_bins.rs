//! Tile binning: for each tile, the list of triangles whose bounds touch it, in submission order.
//!
//! ```text
//!   triangles ──► group 0: chunks 0 … 3   ──► bins of all tiles ┐
//!             ──► group 1: chunks 4 … 7   ──► bins of all tiles ├─► bin of a tile: group 0, 1, …
//!             ──► group 2: …              ──► bins of all tiles ┘
//! ```
//!
//! Triangles are binned in groups. Each group has its own bins and can be sorted by its own thread
//! without locks. The bin of a tile is the concatenation of its bins in all groups. For any number
//! of threads, it is in submission order, which breaks depth ties.
//!
//! Binning makes two passes over the triangles of a group. Its time is linear in the number of
//! triangles, tiles and entries, because triangles are never compared.

use crate::parallel::for_each_parallel;
use crate::tile_grid::TileGrid;
use crate::triangle_buffer::{CHUNK_TRIANGLES, TriangleBuffer, TriangleChunk};
use homog::PixelRect;

/// The minimum number of chunks in a group. Smaller groups would spend more on clearing bins than
/// on filling them.
const MIN_CHUNKS: usize = 4;

/// For each tile that a region touches, row by row, the triangles whose bounds touch the tile.
#[derive(Debug, Default)]
pub(crate) struct TileBins {
    /// The tiles that the region touches.
    grid: TileGrid,
    /// The groups in submission order.
    groups: Vec<BinGroup>,
    /// The number of groups in use. The others keep their memory for a larger frame.
    used: usize,
}

/// The bins of a run of chunks in compressed-row form: one array of all bins, and the start of each
/// bin.
#[derive(Debug, Default)]
struct BinGroup {
    /// The index in `triangles` at which the bin of each tile begins, plus one entry for the end.
    bin_starts: Vec<u32>,
    /// The index at which the next triangle of each tile is written during sorting.
    write_positions: Vec<u32>,
    /// The indices of the triangles, bin by bin.
    triangles: Vec<u32>,
}

impl TileBins {
    /// Bins all triangles of a frame, reusing memory from the previous call.
    ///
    /// A group has at least four times as many triangles as there are tiles, which keeps counting
    /// and clearing bins cheap compared with sorting. Triangles are binned by bounding rectangle,
    /// so a thin diagonal triangle is also in the bins of tiles that it misses; there the
    /// rasterizer rejects it block by block.
    pub(crate) fn bin_triangles(
        &mut self,
        triangles: &TriangleBuffer,
        region: PixelRect,
        threads: usize,
    ) {
        self.grid = TileGrid::new(region);
        // The size of a group depends only on the frame, not on the number of threads.
        let chunks: usize = triangles.chunks().len();
        let per_group = (4 * self.grid.count()).div_ceil(CHUNK_TRIANGLES).max(MIN_CHUNKS);
        self.used = chunks.div_ceil(per_group);
        if self.groups.len() < self.used {
            self.groups.resize_with(self.used, BinGroup::default);
        }
        let grid = self.grid;
        let groups = self.groups[..self.used].iter_mut().enumerate();
        for_each_parallel(threads, groups, |(index, group)| {
            let chunks = || triangles.chunks().skip(index * per_group).take(per_group);
            group.counting_sort(chunks, grid);
        });
    }

    /// Appends the triangle indices of the tile at a column and row of the picture.
    ///
    /// The tile must be in the grid.
    pub(crate) fn append_tile_bin(&self, column: u32, row: u32, bin: &mut Vec<u32>) {
        let tile = self.grid.tile_index(column, row);
        for BinGroup { bin_starts, triangles, .. } in &self.groups[..self.used] {
            // Group by group, which is submission order.
            let (start, end) = (bin_starts[tile] as usize, bin_starts[tile + 1] as usize);
            bin.extend_from_slice(&triangles[start..end]);
        }
    }
}

impl BinGroup {
    /// Sorts triangles by tile with a counting sort: count, prefix sum, scatter. It is stable, so
    /// bins keep submission order.
    fn counting_sort<'a, I: Iterator<Item = (u32, &'a TriangleChunk)>>(
        &mut self,
        chunks: impl Fn() -> I,
        grid: TileGrid,
    ) {
        let Self { bin_starts, write_positions, triangles } = self;
        // Count the triangles of each tile, one entry ahead.
        bin_starts.clear();
        bin_starts.resize(grid.count() + 1, 0);
        for &tiles in chunks().flat_map(|(_, chunk)| chunk.tiles()) {
            for tile in grid.tile_indices(tiles) {
                bin_starts[tile + 1] += 1;
            }
        }
        // The prefix sums of the counts are the starts of the bins.
        let mut sum = 0;
        for start in bin_starts.iter_mut() {
            sum += *start;
            *start = sum;
        }
        write_positions.clone_from(bin_starts);
        // Scatter. Every entry is overwritten, so entries from the last frame need not be cleared.
        triangles.resize(sum as usize, 0);
        for (first, chunk) in chunks() {
            for (index, &tiles) in (first..).zip(chunk.tiles()) {
                for tile in grid.tile_indices(tiles) {
                    triangles[write_positions[tile] as usize] = index;
                    write_positions[tile] += 1;
                }
            }
        }
    }
}
