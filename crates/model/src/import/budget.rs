//! How much memory the arrays that a file asks for may take.

use super::error::{Fault, FaultKind};
use super::limits::Limits;
use std::cell::Cell;

/// Arrays may take so many bytes however small the files are.
const FREE_BYTES: u64 = 16 << 20;

/// Counts the bytes of all arrays; see [`Limits::array_bytes`] and [`Limits::array_growth`].
#[derive(Debug)]
pub(super) struct Budget<'a> {
    limits: &'a Limits,
    made: Cell<u64>,
}

impl<'a> Budget<'a> {
    pub(super) fn new(limits: &'a Limits) -> Self {
        Self { limits, made: Cell::new(0) }
    }

    /// Counts an array that is about to be made. `pointer` is the member that says how long it is, `files` the bytes of
    /// all files that have been read.
    pub(super) fn charge(&self, pointer: &str, bytes: u64, files: u64) -> Result<(), Fault> {
        let made = self.made.get().saturating_add(bytes);
        self.made.set(made);
        let what = format!("the arrays take {made} bytes up to here");
        let Limits { array_bytes, array_growth, .. } = *self.limits;
        if made > array_bytes {
            return Err(Fault::limit(pointer, &what, "array_bytes", array_bytes));
        }
        if made.saturating_sub(FREE_BYTES) > files.saturating_mul(array_growth) {
            let problem = format!("{what}, more than {array_growth} times the files");
            let remedy = Fault::raise("array_growth");
            return Err(Fault::new(FaultKind::Limit, pointer, problem, &remedy));
        }
        Ok(())
    }
}
