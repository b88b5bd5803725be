//! Pieces in the order in which they were given, in chunks of limited size.
//!
//! Threads fill chunks of their own, which then stand in the order of what they were filled from: so the order is the same for
//! any number of threads. Chunks never move while they grow, and keep their memory for the next picture.

use crate::primitive::ScreenTriangle;
use crate::tile_grid::TileRange;

/// The most pieces of a chunk: 256 KiB of them.
pub(crate) const CHUNK_TRIANGLES: usize = 1 << CHUNK_BITS;
const CHUNK_BITS: u32 = 12;
/// A chunk with less room than this takes no more triangles of a mesh.
const MIN_FREE: usize = 512;

/// Some pieces that follow one another, and beside each the tiles that it touches: sorting into bins looks at nothing else.
#[derive(Clone, Debug, Default)]
pub(crate) struct TriangleChunk {
    triangles: Vec<ScreenTriangle>,
    tiles: Vec<TileRange>,
}

impl TriangleChunk {
    /// The tiles of each piece.
    pub(crate) fn tiles(&self) -> &[TileRange] {
        &self.tiles
    }

    pub(crate) fn reserve(&mut self, count: usize) {
        self.triangles.reserve(count);
        self.tiles.reserve(count);
    }

    #[inline(always)]
    pub(crate) fn push(&mut self, piece: ScreenTriangle, tiles: TileRange) {
        self.triangles.push(piece);
        self.tiles.push(tiles);
    }

    fn clear(&mut self) {
        self.triangles.clear();
        self.tiles.clear();
    }
}

/// All pieces of a frame. A piece's number tells its chunk and its place there; numbers rise in the order of the pieces.
#[derive(Clone, Debug, Default)]
pub(crate) struct TriangleBuffer {
    chunks: Vec<TriangleChunk>,
    /// How many of the chunks are in use; the others are empty.
    chunks_in_use: usize,
}

impl TriangleBuffer {
    /// The chunks that are in use, each with the number of its first piece.
    pub(crate) fn chunks(&self) -> impl ExactSizeIterator<Item = (u32, &TriangleChunk)> {
        let numbered = self.chunks[..self.chunks_in_use].iter().enumerate();
        numbered.map(|(at, chunk)| ((at << CHUNK_BITS) as u32, chunk))
    }

    #[inline(always)]
    pub(crate) fn get(&self, number: u32) -> Option<&ScreenTriangle> {
        self.chunks
            .get((number >> CHUNK_BITS) as usize)?
            .triangles
            .get(number as usize % CHUNK_TRIANGLES)
    }

    /// The piece with this number, which must be one.
    #[inline(always)]
    pub(crate) fn triangle(&self, number: u32) -> &ScreenTriangle {
        &self.chunks[(number >> CHUNK_BITS) as usize].triangles[number as usize % CHUNK_TRIANGLES]
    }

    /// Takes all pieces out again and keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.chunks[..self.chunks_in_use].iter_mut().for_each(TriangleChunk::clear);
        self.chunks_in_use = 0;
    }

    /// Appends one piece.
    #[inline]
    pub(crate) fn push(&mut self, piece: ScreenTriangle, tiles: TileRange) {
        self.open_chunk(1).push(piece, tiles);
    }

    /// A chunk behind all pieces, with room for some more, and how many.
    pub(crate) fn open_with_space(&mut self) -> (&mut TriangleChunk, usize) {
        let chunk = self.open_chunk(MIN_FREE);
        let room = CHUNK_TRIANGLES - chunk.triangles.len();
        (chunk, room)
    }

    /// So many empty chunks behind all pieces.
    pub(crate) fn append_chunks(&mut self, count: usize) -> &mut [TriangleChunk] {
        let first = self.chunks_in_use;
        self.chunks_in_use += count;
        self.grow_chunks();
        &mut self.chunks[first..self.chunks_in_use]
    }

    /// Puts empty chunks behind the others.
    pub(crate) fn remove_empty_chunks(&mut self, from: usize) {
        let mut kept = from;
        for at in from..self.chunks_in_use {
            if !self.chunks[at].triangles.is_empty() {
                self.chunks.swap(kept, at);
                kept += 1;
            }
        }
        self.chunks_in_use = kept;
    }

    /// How many chunks are in use.
    pub(crate) fn chunks_in_use(&self) -> usize {
        self.chunks_in_use
    }

    #[inline]
    fn open_chunk(&mut self, room: usize) -> &mut TriangleChunk {
        let is_full = |chunk: &TriangleChunk| chunk.triangles.len() + room > CHUNK_TRIANGLES;
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
