//! Reads each buffer once, and resolves buffer views within it.
//!
//! A [`BufferStore`] lends slices and never copies a buffer. A request returns `None` if any of its
//! bytes are missing. Checks skip such data, because the missing bytes already have a diagnostic.

use super::codes;
use super::document::{
    CheckedDocument, array_items, extension_object, index_member, integer_member, string_member,
};
use super::elements::AccessorElements;
use super::layout::{AccessorLayout, ComponentType};
use super::uris;
use gltf_import::CompressedView;
use gltf_import::MemoryBudget;
use gltf_import::UriResolver;
use serde_json::Value;
use std::cell::{Cell, OnceCell};

/// The buffers and decompressed buffer views of a document, and the budget for reading them.
///
/// Time and memory are limited in two ways. The resolver limits how many bytes are read from URIs.
/// Decoding and visiting elements is charged to `budget`, which is proportional to the actual size
/// of the files.
pub(super) struct BufferStore<'a> {
    document: &'a CheckedDocument<'a>,
    resolver: &'a UriResolver<'a>,
    /// The bytes of each buffer, or `None` if they cannot be read.
    buffers: Vec<Option<BufferBytes<'a>>>,
    /// The buffer views compressed with meshopt, decompressed on first use.
    decompressed: Vec<OnceCell<Option<Vec<u8>>>>,
    /// The number of bytes that may be read or decoded, proportional to the size of the files.
    budget: MemoryBudget<'a>,
    /// Whether the budget has been exceeded; if so, nothing more is read.
    exhausted: Cell<bool>,
}

/// The bytes of a buffer.
///
/// The binary chunk is borrowed from the GLB, which is entirely in memory.
enum BufferBytes<'a> {
    /// The binary chunk of a GLB.
    Chunk(&'a [u8]),
    /// The content of a file or a decoded data URI.
    Read(Vec<u8>),
}

impl<'a> BufferStore<'a> {
    /// Reads all buffers; `chunk` is the binary chunk of a GLB.
    ///
    /// A buffer that cannot be read is reported and has no bytes. Buffer views are decompressed
    /// later, on first use, because an unused view need not be valid.
    pub(super) fn load_buffers(
        document: &'a CheckedDocument<'a>,
        resolver: &'a UriResolver<'a>,
        chunk: Option<&'a [u8]>,
        is_binary: bool,
    ) -> Self {
        let unpacked = document.root_array("bufferViews").iter().map(|_| OnceCell::new()).collect();
        let mut store = Self {
            document,
            resolver,
            buffers: Vec::new(),
            decompressed: unpacked,
            budget: MemoryBudget::new(resolver.limits),
            exhausted: Cell::new(false),
        };
        for (at, buffer) in document.root_array("buffers").iter().enumerate() {
            let bytes = store.load_buffer(at, buffer, chunk, is_binary);
            store.buffers.push(bytes);
        }
        store
    }

    /// Reads one buffer from its URI or the binary chunk.
    ///
    /// The first buffer, if it has no URI, is the binary chunk. Padding may make the chunk up to
    /// three bytes longer than the buffer.
    ///
    /// The declared `byteLength` must not be greater than the length of the data. If it is,
    /// `BUFFER_BYTE_LENGTH_MISMATCH` is reported, and the available bytes are still used.
    fn load_buffer(
        &self,
        at: usize,
        buffer: &Value,
        chunk: Option<&'a [u8]>,
        is_binary: bool,
    ) -> Option<BufferBytes<'a>> {
        let diagnostics = self.document.diagnostics;
        let length = integer_member(buffer, "byteLength");
        let Some(uri) = string_member(buffer, "uri") else {
            let has_no_uri = buffer.is_object() && buffer.get("uri").is_none();
            let chunk = chunk.filter(|_| at == 0 && has_no_uri);
            // A buffer without data may be the fallback buffer of EXT_meshopt_compression.
            if chunk.is_none() && is_binary && has_no_uri && at == 0 {
                let message = "the buffer refers to the binary chunk, but there is none";
                diagnostics.add(
                    &codes::BUFFER_MISSING_GLB_DATA,
                    format_args!("/buffers/{at}"),
                    message,
                );
            }
            let (chunk, length) = (chunk?, length?);
            self.check_length(at, chunk.len(), length);
            if chunk.len() as u64 > length.saturating_add(3) {
                let more = chunk.len() as u64 - length;
                let message =
                    format_args!("the binary chunk is {more} bytes larger than the buffer");
                diagnostics.add(
                    &codes::BUFFER_GLB_CHUNK_TOO_BIG,
                    format_args!("/buffers/{at}"),
                    message,
                );
            }
            return Some(BufferBytes::Chunk(chunk));
        };
        let pointer = format!("/buffers/{at}/uri");
        uris::check_buffer_uri(uri, &pointer, is_binary, diagnostics);
        let bytes = uris::read_uri(self.resolver, uri, &pointer, diagnostics)?;
        if let Some(length) = length {
            self.check_length(at, bytes.len(), length);
        }
        Some(BufferBytes::Read(bytes))
    }

    /// Reports data that is shorter than the declared `byteLength`; both lengths are in bytes.
    fn check_length(&self, at: usize, available: usize, length: u64) {
        if (available as u64) < length {
            let message =
                format_args!("byteLength is {length}, but the length of the data is {available}");
            let pointer = format_args!("/buffers/{at}/byteLength");
            self.document.diagnostics.add(&codes::BUFFER_BYTE_LENGTH_MISMATCH, pointer, message);
        }
    }

    /// Charges bytes to the budget, and returns whether they may be read.
    ///
    /// Once the budget is exceeded, this is reported and nothing more is read, so that a hostile
    /// file cannot prolong the validation. The first refusal is final even if a smaller request
    /// would still fit, so that the report does not depend on which later requests happen to be
    /// small.
    pub(super) fn charge_budget(&self, pointer: &str, bytes: u64) -> bool {
        if self.exhausted.get() {
            return false;
        }
        let charged = self.budget.charge_bytes(pointer, bytes, self.resolver.total_bytes());
        if let Err(fault) = &charged {
            self.exhausted.set(true);
            let message = format_args!("{}; data from here on is not validated", fault.message);
            let diagnostics = self.document.diagnostics;
            diagnostics.add_with_help(
                &codes::LIMIT_EXCEEDED,
                pointer,
                message,
                fault.help.as_deref().unwrap_or_default(),
            );
        }
        charged.is_ok()
    }

    /// Returns all bytes of a buffer, or `None` if it does not exist or could not be read.
    fn buffer_bytes(&self, buffer: usize) -> Option<&[u8]> {
        match self.buffers.get(buffer)?.as_ref()? {
            BufferBytes::Chunk(bytes) => Some(bytes),
            BufferBytes::Read(bytes) => Some(bytes),
        }
    }

    /// Returns the bytes of a buffer view, if all of them are present.
    ///
    /// A view compressed with EXT_meshopt_compression or KHR_meshopt_compression is decompressed on
    /// first use and stored. The `buffer` of the view itself is a fallback for readers without the
    /// extension and may have no data.
    pub(super) fn view_bytes(&self, view: usize) -> Option<&[u8]> {
        let json = self.document.root_array("bufferViews").get(view)?;
        let packed = ["KHR_meshopt_compression", "EXT_meshopt_compression"];
        if packed.iter().any(|name| extension_object(json, name).is_some()) {
            return self
                .decompressed
                .get(view)?
                .get_or_init(|| self.decompress_view(view, json))
                .as_deref();
        }
        let offset =
            if json.get("byteOffset").is_some() { integer_member(json, "byteOffset")? } else { 0 };
        self.buffer_range(
            index_member(json, "buffer")?,
            offset,
            integer_member(json, "byteLength")?,
        )
    }

    /// Returns a range of a buffer that starts at `offset`, or `None` if it is not entirely inside
    /// the buffer.
    ///
    /// Offset and length come from the file and may exceed the address space of a 32-bit machine.
    fn buffer_range(&self, buffer: usize, offset: u64, length: u64) -> Option<&[u8]> {
        let start = usize::try_from(offset).ok()?;
        self.buffer_bytes(buffer)?.get(start..)?.get(..usize::try_from(length).ok()?)
    }

    /// Decompresses a meshopt buffer view. Returns `None` if the stream is invalid or the budget is
    /// exceeded.
    ///
    /// The loader uses the same decoder and reports errors in the stream. The decompressed length
    /// is an untrusted declaration, so it is charged before anything is allocated.
    fn decompress_view(&self, view: usize, json: &Value) -> Option<Vec<u8>> {
        let pointer = format!("/bufferViews/{view}");
        let packed = CompressedView::from_json(json, &pointer).ok()??;
        let stream = self.buffer_range(packed.buffer, packed.offset, packed.length)?;
        self.charge_budget(&pointer, packed.decompressed_length())
            .then(|| packed.decompress(stream).ok())?
    }

    /// Returns the elements of an accessor, if all their bytes are present.
    ///
    /// A missing part has already been reported elsewhere, so the data is skipped to avoid
    /// follow-up diagnostics. The layers of an accessor are resolved in this order:
    ///
    /// ```text
    ///  buffer view   count elements at its stride, or zeros without a view
    ///  sparse        some of them replaced: indices and values, tightly packed
    /// ```
    ///
    /// The last packed element needs no padding after it, not even if it is a matrix with small
    /// components.
    pub(super) fn accessor_elements(
        &self,
        accessor: &Value,
        layout: AccessorLayout,
    ) -> Option<AccessorElements<'_>> {
        let base = match layout.buffer_view {
            Some(view) => {
                let stride = self.view_stride(view).unwrap_or(layout.packed_stride());
                let start = usize::try_from(layout.byte_offset).ok()?;
                let length = usize::try_from(layout.byte_length(stride)).ok()?;
                let bytes = self.view_bytes(view)?.get(start..)?.get(..length)?;
                Some((bytes, Some(stride).filter(|&stride| stride >= layout.element_size())?))
            }
            None if accessor.get("bufferView").is_some() => return None,
            None => None,
        };
        let Some(sparse) = accessor.get("sparse") else {
            return Some(AccessorElements::new(layout, base, Vec::new(), &[]));
        };
        let indices = self.sparse_indices(sparse)?;
        let values = sparse.get("values")?;
        let offset = usize::try_from(integer_member(values, "byteOffset").unwrap_or(0)).ok()?;
        let length = indices.len().checked_mul(layout.packed_stride())?;
        let length = length.saturating_sub(layout.packed_stride() - layout.element_size());
        let values =
            self.view_bytes(index_member(values, "bufferView")?)?.get(offset..)?.get(..length)?;
        Some(AccessorElements::new(layout, base, indices, values))
    }

    /// Returns the indices of a sparse accessor, if all their bytes are present (glTF 2.0
    /// §3.6.2.3).
    ///
    /// The indices are always converted to 32 bits. The conversion is charged to the budget,
    /// because many accessors may share the same bytes.
    pub(super) fn sparse_indices(&self, sparse: &Value) -> Option<Vec<u32>> {
        let json = sparse.get("indices")?;
        let component = ComponentType::from_gl_constant(integer_member(json, "componentType")?)?;
        let offset = usize::try_from(integer_member(json, "byteOffset").unwrap_or(0)).ok()?;
        let count = usize::try_from(integer_member(sparse, "count")?).ok()?;
        let length = count.checked_mul(component.byte_size())?;
        let bytes =
            self.view_bytes(index_member(json, "bufferView")?)?.get(offset..)?.get(..length)?;
        let pointer = "/accessors";
        self.charge_budget(pointer, 4 * count as u64).then_some(())?;
        Some(
            bytes
                .chunks_exact(component.byte_size())
                .map(|c| component.read_number(c) as u32)
                .collect(),
        )
    }

    /// Returns the `byteStride` of a buffer view in bytes, or `None` for tightly packed elements.
    pub(super) fn view_stride(&self, view: usize) -> Option<usize> {
        index_member(self.document.root_array("bufferViews").get(view)?, "byteStride")
    }
}

/// Validates all buffer views (glTF 2.0 §5.11).
pub(super) fn check_buffer_views(document: &CheckedDocument<'_>) {
    for (at, view) in document.root_array("bufferViews").iter().enumerate() {
        check_buffer_view(document, at, view);
    }
}

/// Validates the range and stride of one buffer view.
///
/// The stride must be a multiple of four, absent for indices, and no greater than the length of the
/// view. The range is compared with the declared length of the buffer, not with its data, so that a
/// truncated file yields one diagnostic for the buffer and none for its views.
fn check_buffer_view(document: &CheckedDocument<'_>, at: usize, view: &Value) {
    let diagnostics = document.diagnostics;
    let offset = integer_member(view, "byteOffset").unwrap_or(0);
    let length = integer_member(view, "byteLength");
    let buffer =
        index_member(view, "buffer").and_then(|at| array_items(document.root, "buffers").get(at));
    let available = buffer.and_then(|buffer| integer_member(buffer, "byteLength"));
    if let (Some(length), Some(available)) = (length, available)
        && (offset.saturating_add(length) > available || offset >= available && offset > 0)
    {
        let member = if offset >= available { "byteOffset" } else { "byteLength" };
        let message = format_args!(
            "the {length}-byte range at offset {offset} does not fit in the {available}-byte buffer"
        );
        let pointer = format_args!("/bufferViews/{at}/{member}");
        diagnostics.add(&codes::BUFFER_VIEW_TOO_LONG, pointer, message);
    }
    let Some(stride) = integer_member(view, "byteStride") else { return };
    let pointer = format!("/bufferViews/{at}/byteStride");
    if !stride.is_multiple_of(4) {
        let message = format_args!("{stride} is not a multiple of 4");
        diagnostics.add(&codes::VALUE_MULTIPLE_OF, &pointer, message);
    }
    if integer_member(view, "target") == Some(34_963) {
        let message = "a buffer view of indices must not have a byteStride";
        diagnostics.add(&codes::BUFFER_VIEW_INVALID_BYTE_STRIDE, &pointer, message);
    }
    if let Some(length) = length.filter(|&length| stride > length) {
        let message = format_args!("byteStride {stride} exceeds the byteLength {length}");
        diagnostics.add(&codes::BUFFER_VIEW_TOO_BIG_BYTE_STRIDE, &pointer, message);
    }
}
