//! What drawing a frame needs besides the frame, kept from one drawing to the next so that it is allocated once.

use crate::bins::Bins;
use crate::resolve::Scratch;
use crate::tile::Tile;
use std::sync::{Mutex, PoisonError};

/// The memory of a drawing.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    pub(crate) bins: Bins,
    pub(crate) workers: Vec<Worker>,
}

/// What a thread needs to draw tiles.
#[derive(Debug, Default)]
pub(crate) struct Worker {
    /// The pieces of the tile.
    pub(crate) list: Vec<u32>,
    pub(crate) tile: Tile,
    pub(crate) scratch: Scratch,
}

/// Memory that waits for the next drawing. A frame that is drawn twice at once, or is a clone, begins with none.
#[derive(Debug, Default)]
pub(crate) struct Kept(Mutex<Memory>);

impl Kept {
    pub(crate) fn take(&self) -> Memory {
        std::mem::take(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    pub(crate) fn put(&self, memory: Memory) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = memory;
    }
}

impl Clone for Kept {
    fn clone(&self) -> Self {
        Self::default()
    }
}
