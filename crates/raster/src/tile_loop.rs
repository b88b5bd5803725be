//! The way through a frame: band by band, tile by tile, each filled before it is handed on.
//!
//! Tiles know nothing of each other, so threads may take them in any order: what comes of them is the same for any number.

use crate::buffer_pool::{DrawBuffers, ThreadBuffers};
use crate::parallel::for_each_with_workers;
use crate::tile_bins::TileBins;
use crate::tile_grid::{FrameRegion, TileRect};
use crate::tile_resolve::RowScratch;
use crate::tile_visibility::TileVisibility;
use crate::{Frame, Surface};

/// A tile in which the visible has been found.
pub(crate) struct FilledTile<'a, P> {
    pub(crate) tile: &'a TileVisibility,
    pub(crate) rect: TileRect,
    /// The pixels of its band: the rows of the frame that its row of tiles shows.
    pub(crate) band: &'a mut [P],
    pub(crate) scratch: &'a mut RowScratch,
}

impl Frame {
    /// Calls `begin` with each band's pixels and then `each` with every tile of it that pieces touch. Uses up to `threads` threads;
    /// a `target` that is too short has fewer bands, or shorter ones.
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
        let bands = TileRows { region: self.region, rows: self.region.tile_rows(), target };
        for_each_with_workers(&mut workers, bands, |worker, (row, band)| {
            if !self.is_canceled() {
                begin(band);
                self.for_each_tile_in_row(row, band, &bins, worker, surface, &each);
            }
        });
        self.buffers.recycle_buffers(DrawBuffers { bins, workers });
    }

    fn for_each_tile_in_row<S: Surface, P>(
        &self,
        row: u32,
        band: &mut [P],
        bins: &TileBins,
        ThreadBuffers { bin: list, tile, scratch }: &mut ThreadBuffers,
        surface: &S,
        each: &impl Fn(FilledTile<'_, P>),
    ) {
        let (left, right) = self.region.tile_columns();
        for column in left..right {
            let rect = self.region.tile_rect(column, row);
            list.clear();
            bins.append_tile_bin(column, row, list);
            if !list.is_empty() {
                tile.rasterize_bin(self, rect, list, surface);
                each(FilledTile { tile, rect, band, scratch });
            }
        }
    }
}

/// The rows of tiles of a part that are left, each with its pixels.
struct TileRows<'a, P> {
    region: FrameRegion,
    rows: (u32, u32),
    target: &'a mut [P],
}

impl<'a, P> Iterator for TileRows<'a, P> {
    type Item = (u32, &'a mut [P]);

    fn next(&mut self) -> Option<Self::Item> {
        let (row, end) = self.rows;
        if row == end {
            return None;
        }
        self.rows.0 += 1;
        let length = self.region.visible_rows(row) * self.region.width as usize;
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

impl<P> ExactSizeIterator for TileRows<'_, P> {}
