//! The buffer pool of a frame, which keeps the memory used for drawing until the next drawing.
//!
//! The bins and tiles of a picture take a few megabytes. With the pool, a frame that is drawn
//! repeatedly, as in an animation, allocates nothing after the first drawing (a test checks this).

use crate::tile_bins::TileBins;
use crate::tile_resolve::RowScratch;
use crate::tile_visibility::TileVisibility;
use std::sync::{Mutex, PoisonError};

/// The buffers of one drawing.
#[derive(Debug, Default)]
pub(crate) struct DrawBuffers {
    pub(crate) bins: TileBins,
    /// The buffers of each thread.
    pub(crate) workers: Vec<ThreadBuffers>,
}

/// The buffers that a thread needs to draw tiles.
#[derive(Debug, Default)]
pub(crate) struct ThreadBuffers {
    /// The indices of the triangles that touch the tile.
    pub(crate) bin: Vec<u32>,
    pub(crate) tile: TileVisibility,
    pub(crate) scratch: RowScratch,
}

/// Buffers kept for the next drawing.
///
/// A cloned frame, or a second drawing of a frame at the same time, starts with empty buffers.
#[derive(Debug, Default)]
pub(crate) struct BufferPool(Mutex<DrawBuffers>);

impl BufferPool {
    /// Takes the buffers out of the pool, or returns empty buffers if they are in use.
    pub(crate) fn take_buffers(&self) -> DrawBuffers {
        std::mem::take(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Returns buffers to the pool.
    pub(crate) fn recycle_buffers(&self, buffers: DrawBuffers) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = buffers;
    }
}

impl Clone for BufferPool {
    fn clone(&self) -> Self {
        Self::default()
    }
}
