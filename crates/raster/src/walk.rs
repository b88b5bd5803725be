//! The way through a frame: band by band, tile by tile, each filled before it is handed on.
//!
//! Tiles know nothing of each other, so threads may take them in any order: what comes of them is the same for any number.

use crate::bins::Bins;
use crate::grid::{Part, TileRect};
use crate::memory::{Memory, Worker};
use crate::resolve::Scratch;
use crate::threads::share_among;
use crate::tile::Tile;
use crate::{Frame, Surface};

/// A tile in which the visible has been found.
pub(crate) struct Filled<'a, P> {
    pub(crate) tile: &'a Tile,
    pub(crate) rect: TileRect,
    /// The pixels of its band: the rows of the frame that its row of tiles shows.
    pub(crate) band: &'a mut [P],
    pub(crate) scratch: &'a mut Scratch,
}

impl Frame {
    /// Calls `begin` with each band's pixels and then `each` with every tile of it that pieces touch. Uses up to `threads` threads;
    /// a `target` that is too short has fewer bands, or shorter ones.
    pub(crate) fn each_tile<S: Surface, P: Send>(
        &self,
        surface: &S,
        threads: usize,
        target: &mut [P],
        begin: impl Fn(&mut [P]) + Sync,
        each: impl Fn(Filled<'_, P>) + Sync,
    ) {
        let Memory { mut bins, mut workers } = self.kept.take();
        bins.sort(&self.pieces, self.part, threads);
        workers.resize_with(threads.max(1), Worker::default);
        let bands = Bands { part: self.part, rows: self.part.rows(), target };
        share_among(&mut workers, bands, |worker, (row, band)| {
            if !self.is_stopped() {
                begin(band);
                self.each_tile_of(row, band, &bins, worker, surface, &each);
            }
        });
        self.kept.put(Memory { bins, workers });
    }

    fn each_tile_of<S: Surface, P>(
        &self,
        row: u32,
        band: &mut [P],
        bins: &Bins,
        Worker { list, tile, scratch }: &mut Worker,
        surface: &S,
        each: &impl Fn(Filled<'_, P>),
    ) {
        let (left, right) = self.part.columns();
        for column in left..right {
            let rect = self.part.tile(column, row);
            list.clear();
            bins.list(column, row, list);
            if !list.is_empty() {
                tile.fill(self, rect, list, surface);
                each(Filled { tile, rect, band, scratch });
            }
        }
    }
}

/// The rows of tiles of a part that are left, each with its pixels.
struct Bands<'a, P> {
    part: Part,
    rows: (u32, u32),
    target: &'a mut [P],
}

impl<'a, P> Iterator for Bands<'a, P> {
    type Item = (u32, &'a mut [P]);

    fn next(&mut self) -> Option<Self::Item> {
        let (row, end) = self.rows;
        if row == end {
            return None;
        }
        self.rows.0 += 1;
        let length = self.part.rows_of(row) * self.part.width as usize;
        let all = std::mem::take(&mut self.target);
        let (band, rest) = all.split_at_mut(length.min(all.len()));
        self.target = rest;
        Some((row, band))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let count = (self.rows.1 - self.rows.0) as usize;
        (count, Some(count))
    }
}

impl<P> ExactSizeIterator for Bands<'_, P> {}
