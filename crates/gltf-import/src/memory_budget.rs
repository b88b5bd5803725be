//! The memory budget for the arrays that a file declares, which defends against decompression
//! bombs.
//!
//! Two limits apply: an absolute limit, and a limit relative to the bytes that have been read. The
//! relative limit catches small files that declare a lot of data; an ordinary model's arrays are at
//! most a few times as large as its files, even if these are compressed. Bytes are charged before
//! an array is allocated and never refunded, because the arrays live as long as the model.

use super::limits::Limits;
use model::{Diagnostic, codes};
use std::cell::Cell;

/// Bytes that arrays may take regardless of file sizes.
const FREE_ARRAY_BYTES: u64 = 16 << 20;

/// A running total of array bytes; see [`Limits::array_bytes`] and [`Limits::array_growth`].
#[derive(Debug)]
pub struct MemoryBudget<'a> {
    /// The absolute and relative limits.
    limits: &'a Limits,
    /// Bytes that have been charged for all arrays, as a saturating sum.
    allocated: Cell<u64>,
}

impl<'a> MemoryBudget<'a> {
    /// Creates a budget with nothing charged.
    #[must_use]
    pub fn new(limits: &'a Limits) -> Self {
        Self { limits, allocated: Cell::new(0) }
    }

    /// Charges an array before it is allocated.
    ///
    /// `pointer` is the location that declares its length, and `files` is the number of bytes in
    /// all files read so far.
    ///
    /// # Errors
    /// Returns [`codes::LIMIT_EXCEEDED`] if the arrays exceed a limit.
    pub fn charge_bytes(&self, pointer: &str, bytes: u64, files: u64) -> Result<(), Diagnostic> {
        let made = self.allocated.get().saturating_add(bytes);
        self.allocated.set(made);
        let what = format!("the arrays take {made} bytes so far");
        let Limits { array_bytes, array_growth, .. } = *self.limits;
        if made > array_bytes {
            return Err(Diagnostic::limit_exceeded(pointer, &what, "array_bytes", array_bytes));
        }
        if made.saturating_sub(FREE_ARRAY_BYTES) > files.saturating_mul(array_growth) {
            let message = format!("{what}, more than {array_growth} times the size of the files");
            let help = Diagnostic::raise_limit_help("array_growth");
            return Err(Diagnostic::error(codes::LIMIT_EXCEEDED, pointer, message, &help));
        }
        Ok(())
    }
}
