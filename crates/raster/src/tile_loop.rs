//! The tile loop: rasterizes every tile of a frame and passes it to a callback, in parallel.
//!
//! Work is divided by rows of tiles. A row of tiles is a band of whole target rows, so bands are
//! disjoint slices that threads can write without locks. Tiles are independent: a tile depends only
//! on its own bin, so the result is the same for any number of threads.

use crate::buffer_pool::{DrawBuffers, ThreadBuffers};
use crate::parallel::for_each_with_workers;
use crate::tile_bins::TileBins;
use crate::tile_grid::{TileRect, tile_columns, tile_rect, tile_rows, visible_rows};
use crate::tile_resolve::RowScratch;
use crate::tile_visibility::TileVisibility;
use crate::{Frame, Surface};
use homog::PixelRect;
use std::sync::atomic::{AtomicU64, Ordering};

/// A tile whose visibility has been determined.
pub(crate) struct FilledTile<'a, P> {
    pub(crate) tile: &'a TileVisibility,
    pub(crate) rect: TileRect,
    /// The pixels of the tile's band: the rows of the frame in its row of tiles.
    pub(crate) band: &'a mut [P],
    pub(crate) scratch: &'a mut RowScratch,
}

impl Frame {
    /// Calls `begin` with the pixels of each band, then `each` with every tile in it that has
    /// triangles.
    ///
    /// Uses up to `threads` threads. If `target` is too short, there are fewer or shorter bands.
    /// The monitor is notified and checked for cancellation once per band, that is, about every 64
    /// pixel rows.
    pub(crate) fn for_each_tile<S: Surface, P: Send>(
        &self,
        surface: &S,
        threads: usize,
        target: &mut [P],
        begin: impl Fn(&mut [P]) + Sync,
        each: impl Fn(FilledTile<'_, P>) + Sync,
    ) {
        let DrawBuffers { mut bins, mut workers } = self.buffers.take_buffers();
        bins.bin_triangles(&self.triangles, self.region, threads);
        workers.resize_with(threads.max(1), ThreadBuffers::default);
        // One band is one work item: threads take the next one when they finish.
        let bands = Bands { region: self.region, rows: tile_rows(self.region), target };
        let (done, total) = (AtomicU64::new(0), bands.len() as u64);
        for_each_with_workers(&mut workers, bands, |worker, mut band| {
            if !self.is_canceled() {
                begin(band.pixels);
                self.for_each_tile_in_band(&mut band, &bins, worker, surface, &each);
            }
            if let Some(monitor) = &self.monitor {
                monitor.report_progress(done.fetch_add(1, Ordering::Relaxed) + 1, total);
            }
        });
        self.buffers.recycle_buffers(DrawBuffers { bins, workers });
    }

    /// Fills the tiles of one band from left to right and calls `each` with the tiles that have
    /// triangles.
    fn for_each_tile_in_band<S: Surface, P>(
        &self,
        band: &mut Band<'_, P>,
        bins: &TileBins,
        ThreadBuffers { bin, tile, scratch }: &mut ThreadBuffers,
        surface: &S,
        each: &impl Fn(FilledTile<'_, P>),
    ) {
        let (left, right) = tile_columns(self.region);
        for column in left..right {
            let rect = tile_rect(self.region, column, band.row);
            bin.clear();
            bins.append_tile_bin(column, band.row, bin);
            // If the bin is empty, there is nothing to draw: the background is already there.
            if !bin.is_empty() {
                tile.rasterize_bin(self, rect, bin, surface);
                each(FilledTile { tile, rect, band: band.pixels, scratch });
            }
        }
    }
}

/// One row of tiles with its visible pixels.
struct Band<'a, P> {
    /// The row of tiles, counted from the top of the whole picture.
    row: u32,
    pixels: &'a mut [P],
}

/// An iterator over the remaining bands of a region.
struct Bands<'a, P> {
    region: PixelRect,
    /// The next row of tiles, and one past the last.
    rows: (u32, u32),
    /// The pixels of the remaining bands.
    target: &'a mut [P],
}

impl<'a, P> Iterator for Bands<'a, P> {
    type Item = Band<'a, P>;

    fn next(&mut self) -> Option<Self::Item> {
        let (row, end) = self.rows;
        if row == end {
            return None;
        }
        self.rows.0 += 1;
        let length = visible_rows(self.region, row) * self.region.width as usize;
        let all = std::mem::take(&mut self.target);
        let (pixels, rest) = all.split_at_mut(length.min(all.len()));
        self.target = rest;
        Some(Band { row, pixels })
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let count = (self.rows.1 - self.rows.0) as usize;
        (count, Some(count))
    }
}

impl<P> ExactSizeIterator for Bands<'_, P> {}
