//! Pieces in the order in which they were given, in chunks of limited size.
//!
//! Threads fill chunks of their own, which then stand in the order of what they were filled from: so the order is the same for
//! any number of threads. Chunks never move while they grow, and keep their memory for the next picture.

use crate::grid::Tiles;
use crate::primitive::Piece;

/// The most pieces of a chunk: 256 KiB of them.
pub(crate) const CHUNK: usize = 1 << CHUNK_BITS;
const CHUNK_BITS: u32 = 12;
/// A chunk with less room than this takes no more triangles of a mesh.
const LEAST_ROOM: usize = 512;

/// Some pieces that follow one another, and beside each the tiles that it touches: sorting into bins looks at nothing else.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chunk {
    pieces: Vec<Piece>,
    tiles: Vec<Tiles>,
}

impl Chunk {
    /// The tiles of each piece.
    pub(crate) fn tiles(&self) -> &[Tiles] {
        &self.tiles
    }

    pub(crate) fn reserve(&mut self, count: usize) {
        self.pieces.reserve(count);
        self.tiles.reserve(count);
    }

    #[inline(always)]
    pub(crate) fn push(&mut self, piece: Piece, tiles: Tiles) {
        self.pieces.push(piece);
        self.tiles.push(tiles);
    }

    fn clear(&mut self) {
        self.pieces.clear();
        self.tiles.clear();
    }
}

/// All pieces of a frame. A piece's number tells its chunk and its place there; numbers rise in the order of the pieces.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pieces {
    chunks: Vec<Chunk>,
    /// How many of the chunks are in use; the others are empty.
    used: usize,
}

impl Pieces {
    /// The chunks that are in use, each with the number of its first piece.
    pub(crate) fn chunks(&self) -> impl ExactSizeIterator<Item = (u32, &Chunk)> {
        let numbered = self.chunks[..self.used].iter().enumerate();
        numbered.map(|(at, chunk)| ((at << CHUNK_BITS) as u32, chunk))
    }

    #[inline(always)]
    pub(crate) fn get(&self, number: u32) -> Option<&Piece> {
        self.chunks.get((number >> CHUNK_BITS) as usize)?.pieces.get(number as usize % CHUNK)
    }

    /// The piece with this number, which must be one.
    #[inline(always)]
    pub(crate) fn at(&self, number: u32) -> &Piece {
        &self.chunks[(number >> CHUNK_BITS) as usize].pieces[number as usize % CHUNK]
    }

    /// Takes all pieces out again and keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.chunks[..self.used].iter_mut().for_each(Chunk::clear);
        self.used = 0;
    }

    /// Appends one piece.
    #[inline]
    pub(crate) fn push(&mut self, piece: Piece, tiles: Tiles) {
        self.open(1).push(piece, tiles);
    }

    /// A chunk behind all pieces, with room for some more, and how many.
    pub(crate) fn room(&mut self) -> (&mut Chunk, usize) {
        let chunk = self.open(LEAST_ROOM);
        let room = CHUNK - chunk.pieces.len();
        (chunk, room)
    }

    /// So many empty chunks behind all pieces.
    pub(crate) fn fresh(&mut self, count: usize) -> &mut [Chunk] {
        let first = self.used;
        self.used += count;
        self.grow();
        &mut self.chunks[first..self.used]
    }

    /// Puts empty chunks behind the others.
    pub(crate) fn close_up(&mut self, from: usize) {
        let mut kept = from;
        for at in from..self.used {
            if !self.chunks[at].pieces.is_empty() {
                self.chunks.swap(kept, at);
                kept += 1;
            }
        }
        self.used = kept;
    }

    /// How many chunks are in use.
    pub(crate) fn used(&self) -> usize {
        self.used
    }

    #[inline]
    fn open(&mut self, room: usize) -> &mut Chunk {
        let is_full = |chunk: &Chunk| chunk.pieces.len() + room > CHUNK;
        if self.used == 0 || is_full(&self.chunks[self.used - 1]) {
            self.used += 1;
            self.grow();
        }
        &mut self.chunks[self.used - 1]
    }

    fn grow(&mut self) {
        if self.chunks.len() < self.used {
            self.chunks.resize_with(self.used, Chunk::default);
        }
    }
}
