//! Tile binning: for each tile, the list of triangles whose bounds touch it, in submission order.
//!
//! ```text
//!   triangles ──► group 0: chunks 0 … 3   ──► bins of all tiles ┐
//!             ──► group 1: chunks 4 … 7   ──► bins of all tiles ├─► bin of a tile: group 0, 1, …
//!             ──► group 2: …              ──► bins of all tiles ┘
//! ```
//!
//! Triangles are binned in groups. Each group has its own bins and can be sorted by its own thread
//! without locks. The bin of a tile is the concatenation of its bins in all groups. This is
//! submission order, which decides at equal depth, for any number of threads.
//!
//! Binning takes two passes over the triangles of a group: time linear in triangles plus tiles plus
//! entries, without comparing triangles.

use crate::parallel::for_each_parallel;
use crate::tile_grid::TileGrid;
use crate::triangle_buffer::{CHUNK_TRIANGLES, TriangleBuffer, TriangleChunk};
use homog::PixelRect;

/// The minimum number of chunks in a group. Smaller groups would spend more on clearing bins than
/// on filling them.
const MIN_CHUNKS: usize = 4;

/// For each tile that a region touches, row by row, the triangles whose bounds touch it.
#[derive(Debug, Default)]
pub(crate) struct TileBins {
    /// The tiles that the region touches.
    grid: TileGrid,
    /// The groups in submission order.
    groups: Vec<BinGroup>,
    /// The number of groups in use. The others keep their memory for a larger frame.
    used: usize,
}

/// The bins of a run of chunks, in compressed rows: all bins in one array, with the start of each.
#[derive(Debug, Default)]
struct BinGroup {
    /// The index in `triangles` at which the bin of each tile begins; one more at the end.
    bin_starts: Vec<u32>,
    /// The index to which the next triangle of each tile is written, while they are sorted.
    write_positions: Vec<u32>,
    /// The indices of the triangles, bin by bin.
    triangles: Vec<u32>,
}

impl TileBins {
    /// Bins all triangles of a frame, reusing the memory from last time.
    ///
    /// A group has at least four times as many triangles as there are tiles, which keeps counting
    /// and clearing bins cheap compared with sorting. Bounding rectangles decide, so a thin
    /// diagonal triangle is also in bins that it only passes; there the rasterizer rejects it block
    /// by block.
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

    /// Appends the triangle indices of one tile, given its column and row in the picture.
    ///
    /// The tile must be one of the grid.
    pub(crate) fn append_tile_bin(&self, column: u32, row: u32, bin: &mut Vec<u32>) {
        let tile = self.grid.tile_index(column, row);
        for BinGroup { bin_starts, triangles, .. } in &self.groups[..self.used] {
            // Group after group: submission order.
            let (start, end) = (bin_starts[tile] as usize, bin_starts[tile + 1] as usize);
            bin.extend_from_slice(&triangles[start..end]);
        }
    }
}

impl BinGroup {
    /// Counting sort by tile: count, prefix sum, scatter. It is stable, so bins keep submission
    /// order.
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
        // The prefix sum of the counts is the start of each bin.
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
