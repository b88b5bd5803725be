//! Buffers and buffer views, each read and, if it uses meshopt, decompressed once, on first use.
//!
//! ```text
//!  uri ────────────┐
//!                  ├─► buffer ──range──► buffer view ──meshopt──► bytes of accessors and images
//!  binary chunk ───┘
//! ```
//!
//! Each buffer and each compressed view has a [`OnceLock`], which is filled through a shared
//! reference. Slices of one buffer stay valid while another buffer is loaded, and unused buffers
//! are never read.

use super::meshopt::CompressedView;
use crate::limits::Limits;
use crate::memory_budget::MemoryBudget;
use crate::uri_resolver::UriResolver;
use gltf::json::Root;
use model::{Diagnostic, codes};
use std::sync::OnceLock;

/// The buffers of a file, loaded lazily.
///
/// Methods return slices that live as long as the borrow of this struct.
pub(super) struct Buffers<'a> {
    /// The document, whose indices have not been checked.
    root: &'a Root,
    /// Reads the files and data URIs of buffers.
    pub(super) resolver: &'a UriResolver<'a>,
    /// The binary chunk of a GLB file, which is buffer 0 if that buffer has no URI.
    binary_chunk: Option<&'a [u8]>,
    /// Buffers that have been read from files or data URIs.
    loaded: Vec<OnceLock<Vec<u8>>>,
    /// Buffer views that have been decompressed.
    decompressed: Vec<OnceLock<Vec<u8>>>,
    /// The budget for arrays and decompressed views.
    budget: MemoryBudget<'a>,
}

impl<'a> Buffers<'a> {
    /// Creates the buffers of a document whose indices have not been checked. Nothing is read yet.
    pub(super) fn new(
        root: &'a Root,
        resolver: &'a UriResolver<'a>,
        binary_chunk: Option<&'a [u8]>,
        limits: &'a Limits,
    ) -> Self {
        let loaded = root.buffers.iter().map(|_| OnceLock::new()).collect();
        let decompressed = root.buffer_views.iter().map(|_| OnceLock::new()).collect();
        Self {
            root,
            resolver,
            binary_chunk,
            loaded,
            decompressed,
            budget: MemoryBudget::new(limits),
        }
    }

    /// Charges the memory budget for an array; `pointer` is the location that declares its length.
    ///
    /// # Errors
    /// Fails if the budget, which is proportional to the size of all files, is exhausted.
    pub(super) fn charge_bytes(&self, pointer: &str, bytes: u64) -> Result<(), Diagnostic> {
        self.budget.charge_bytes(pointer, bytes, self.resolver.total_bytes())
    }

    /// Returns the bytes of a buffer view, decompressed if necessary. `user` is the pointer to the
    /// member that refers to it.
    ///
    /// # Errors
    /// Fails if the view or its buffer does not exist or cannot be read, its range is not inside
    /// the buffer, or the compressed stream is invalid.
    pub(super) fn buffer_view(
        &self,
        view: usize,
        user: &str,
    ) -> Result<BufferView<'_>, Diagnostic> {
        let Some(json) = self.root.buffer_views.get(view) else {
            let count = self.root.buffer_views.len();
            return Err(Diagnostic::unresolved_index(user, "buffer view", view, count));
        };
        let pointer = format!("/bufferViews/{view}");
        let bytes = match CompressedView::from_view(json, &pointer)? {
            Some(packed) => self.decompressed_view(view, &packed)?,
            None => {
                let start = json.byte_offset.unwrap_or_default().0;
                self.buffer_range(json.buffer.value(), start, json.byte_length.0, &pointer)?
            }
        };
        Ok(BufferView { bytes, stride: json.byte_stride.map(|stride| stride.0), pointer })
    }

    /// Returns the bytes of a compressed view. The buffer that the view itself refers to may be
    /// empty, because it is a fallback for readers without the extension.
    ///
    /// The declared length is charged to the budget before the stream is decoded. Later uses of the
    /// view are free.
    fn decompressed_view(&self, view: usize, packed: &CompressedView) -> Result<&[u8], Diagnostic> {
        let slot = &self.decompressed[view];
        if let Some(bytes) = slot.get() {
            return Ok(bytes);
        }
        let stream =
            self.buffer_range(packed.buffer, packed.offset, packed.length, &packed.pointer)?;
        self.charge_bytes(&format!("{}/count", packed.pointer), packed.decompressed_length())?;
        let bytes = packed.decompress(stream)?;
        Ok(slot.get_or_init(|| bytes))
    }

    /// Returns `length` bytes of a buffer, beginning at `start`; `user` is the location that refers
    /// to them.
    ///
    /// The whole range must exist, because a partial view would lack some of its elements.
    fn buffer_range(
        &self,
        buffer: usize,
        start: u64,
        length: u64,
        user: &str,
    ) -> Result<&[u8], Diagnostic> {
        let bytes = self.buffer_bytes(buffer, user)?;
        checked_slice(bytes, start, length).ok_or_else(|| {
            let available = bytes.len();
            let message = format!(
                "the {length}-byte range at offset {start} does not fit in the {available}-byte buffer {buffer}"
            );
            Diagnostic::invalid(user, message)
        })
    }

    /// Returns the bytes of a whole buffer, read on first use.
    ///
    /// Data beyond the declared `byteLength` is not returned. A buffer with less data than declared
    /// is accepted as long as no view extends beyond the data.
    fn buffer_bytes(&self, buffer: usize, view: &str) -> Result<&[u8], Diagnostic> {
        let (Some(json), Some(read)) = (self.root.buffers.get(buffer), self.loaded.get(buffer))
        else {
            let pointer = format!("{view}/buffer");
            return Err(Diagnostic::unresolved_index(
                &pointer,
                "buffer",
                buffer,
                self.root.buffers.len(),
            ));
        };
        let all = match (&json.uri, self.binary_chunk) {
            (None, Some(chunk)) if buffer == 0 => chunk,
            (None, _) => {
                let message = "the buffer has no data: it has neither a URI nor a binary chunk";
                return Err(Diagnostic::missing_data(&format!("/buffers/{buffer}"), message));
            }
            (Some(uri), _) => match read.get() {
                Some(bytes) => bytes,
                None => {
                    let bytes = self.resolver.read_uri(uri, &format!("/buffers/{buffer}/uri"));
                    let bytes = bytes.map_err(|diagnostic| self.soften_missing_file(diagnostic))?;
                    read.get_or_init(|| bytes)
                }
            },
        };
        let length = usize::try_from(json.byte_length.0).unwrap_or(usize::MAX);
        Ok(&all[..length.min(all.len())])
    }
}

impl Buffers<'_> {
    /// In lenient mode, turns a missing-file error into a missing-data error, so that only the
    /// items that use the file are lost.
    fn soften_missing_file(&self, diagnostic: Diagnostic) -> Diagnostic {
        let is_file = matches!(diagnostic.code, codes::IO_ERROR | codes::FORBIDDEN_PATH);
        let code =
            if self.resolver.lenient && is_file { codes::MISSING_DATA } else { diagnostic.code };
        diagnostic.with_code(code)
    }
}

/// A buffer view: a part of a buffer.
pub(super) struct BufferView<'a> {
    /// The bytes of the view, decompressed.
    pub(super) bytes: &'a [u8],
    /// Stride between elements, if the view declares one.
    pub(super) stride: Option<usize>,
    /// JSON pointer to the declaration of the view.
    pub(super) pointer: String,
}

/// Returns `length` bytes beginning at `start`, if all of them exist.
pub(super) fn checked_slice(bytes: &[u8], start: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(start).ok()?;
    let length = usize::try_from(length).ok()?;
    bytes.get(start..)?.get(..length)
}
