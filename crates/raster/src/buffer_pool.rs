//! What drawing a frame needs besides the frame, kept from one drawing to the next so that it is allocated once.

use crate::tile_bins::TileBins;
use crate::tile_resolve::RowScratch;
use crate::tile_visibility::TileVisibility;
use std::sync::{Mutex, PoisonError};

/// The memory of a drawing.
#[derive(Debug, Default)]
pub(crate) struct DrawBuffers {
    pub(crate) bins: TileBins,
    pub(crate) workers: Vec<ThreadBuffers>,
}

/// What a thread needs to draw tiles.
#[derive(Debug, Default)]
pub(crate) struct ThreadBuffers {
    /// The pieces of the tile.
    pub(crate) bin: Vec<u32>,
    pub(crate) tile: TileVisibility,
    pub(crate) scratch: RowScratch,
}

/// Memory that waits for the next drawing. A frame that is drawn twice at once, or is a clone, begins with none.
#[derive(Debug, Default)]
pub(crate) struct BufferPool(Mutex<DrawBuffers>);

impl BufferPool {
    pub(crate) fn take_buffers(&self) -> DrawBuffers {
        std::mem::take(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    pub(crate) fn recycle_buffers(&self, memory: DrawBuffers) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = memory;
    }
}

impl Clone for BufferPool {
    fn clone(&self) -> Self {
        Self::default()
    }
}
