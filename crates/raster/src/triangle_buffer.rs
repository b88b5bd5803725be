//! The triangle buffer: all triangles of a frame in submission order, in chunks of limited size.
//!
//! Each thread fills its own chunks, which are kept in the order of their source triangles, so the
//! order is the same for any number of threads. Chunks never move while the buffer grows, and they
//! keep their memory for the next picture.

use crate::primitive::ScreenTriangle;
use crate::tile_grid::TileRange;

/// The maximum number of triangles in a chunk, which then takes 256 KiB.
pub(crate) const CHUNK_TRIANGLES: usize = 1 << CHUNK_BITS;
const CHUNK_BITS: u32 = 12;
/// The minimum space for adding a mesh's triangles to a chunk. A smaller tail is not worth another
/// pass through the loop that fills it.
const MIN_FREE: usize = 512;

/// Consecutive triangles. The tiles that each triangle touches are in a separate list, because
/// binning reads nothing else.
#[derive(Clone, Debug, Default)]
pub(crate) struct TriangleChunk {
    triangles: Vec<ScreenTriangle>,
    /// One entry for each of the `triangles`.
    tiles: Vec<TileRange>,
}

impl TriangleChunk {
    /// Returns the tiles that each triangle touches.
    pub(crate) fn tiles(&self) -> &[TileRange] {
        &self.tiles
    }

    pub(crate) fn reserve(&mut self, count: usize) {
        self.triangles.reserve(count);
        self.tiles.reserve(count);
    }

    #[inline(always)]
    pub(crate) fn push(&mut self, triangle: ScreenTriangle, tiles: TileRange) {
        self.triangles.push(triangle);
        self.tiles.push(tiles);
    }

    fn clear(&mut self) {
        self.triangles.clear();
        self.tiles.clear();
    }
}

/// All triangles of a frame.
///
/// The upper bits of a triangle's index are the index of its chunk; the lower 12 bits are its index
/// in the chunk. Indices increase in submission order, with gaps where chunks are not full.
#[derive(Clone, Debug, Default)]
pub(crate) struct TriangleBuffer {
    chunks: Vec<TriangleChunk>,
    /// The number of chunks in use; the others are empty.
    chunks_in_use: usize,
}

impl TriangleBuffer {
    /// Returns the chunks in use, each with the index of its first triangle.
    pub(crate) fn chunks(&self) -> impl ExactSizeIterator<Item = (u32, &TriangleChunk)> {
        let numbered = self.chunks[..self.chunks_in_use].iter().enumerate();
        numbered.map(|(index, chunk)| ((index << CHUNK_BITS) as u32, chunk))
    }

    /// Returns the triangle with this index, or `None` for the background and other unused indices.
    #[inline(always)]
    pub(crate) fn get(&self, index: u32) -> Option<&ScreenTriangle> {
        let chunk = self.chunks.get((index >> CHUNK_BITS) as usize)?;
        chunk.triangles.get(index as usize % CHUNK_TRIANGLES)
    }

    /// Returns the triangle with this index, which must exist.
    #[inline(always)]
    pub(crate) fn triangle(&self, index: u32) -> &ScreenTriangle {
        &self.chunks[(index >> CHUNK_BITS) as usize].triangles[index as usize % CHUNK_TRIANGLES]
    }

    /// Removes all triangles and keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.chunks[..self.chunks_in_use].iter_mut().for_each(TriangleChunk::clear);
        self.chunks_in_use = 0;
    }

    /// Appends one triangle.
    #[inline]
    pub(crate) fn push(&mut self, triangle: ScreenTriangle, tiles: TileRange) {
        self.open_chunk(1).push(triangle, tiles);
    }

    /// Returns the last chunk, or a new one if it is nearly full, and the number of triangles that
    /// still fit.
    pub(crate) fn open_with_space(&mut self) -> (&mut TriangleChunk, usize) {
        let chunk = self.open_chunk(MIN_FREE);
        let space = CHUNK_TRIANGLES - chunk.triangles.len();
        (chunk, space)
    }

    /// Appends `count` empty chunks, for threads to fill.
    pub(crate) fn append_chunks(&mut self, count: usize) -> &mut [TriangleChunk] {
        let first = self.chunks_in_use;
        self.chunks_in_use += count;
        self.grow_chunks();
        &mut self.chunks[first..self.chunks_in_use]
    }

    /// Removes the empty chunks at or after index `first` from use by moving them to the end.
    pub(crate) fn remove_empty_chunks(&mut self, first: usize) {
        let mut filled = first;
        for index in first..self.chunks_in_use {
            if !self.chunks[index].triangles.is_empty() {
                // The order of the filled chunks does not change: it is submission order.
                self.chunks.swap(filled, index);
                filled += 1;
            }
        }
        self.chunks_in_use = filled;
    }

    /// Returns the number of chunks in use.
    pub(crate) fn chunks_in_use(&self) -> usize {
        self.chunks_in_use
    }

    /// Returns the last chunk, or a new one if it has no space for `count` more triangles.
    #[inline]
    fn open_chunk(&mut self, count: usize) -> &mut TriangleChunk {
        let is_full = |chunk: &TriangleChunk| chunk.triangles.len() + count > CHUNK_TRIANGLES;
        if self.chunks_in_use == 0 || is_full(&self.chunks[self.chunks_in_use - 1]) {
            self.chunks_in_use += 1;
            self.grow_chunks();
        }
        &mut self.chunks[self.chunks_in_use - 1]
    }

    fn grow_chunks(&mut self) {
        if self.chunks.len() < self.chunks_in_use {
            self.chunks.resize_with(self.chunks_in_use, TriangleChunk::default);
        }
    }
}
