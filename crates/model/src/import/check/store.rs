//! The bytes that a document speaks of: buffers are read, each once, and views found in them.

use super::codes;
use super::document::{Document, extension, index, integer, items, text};
use super::elements::Elements;
use super::layout::{Component, Layout};
use super::uris;
use crate::import::budget::Budget;
use crate::import::meshopt::Packed;
use crate::import::resolver::Resolver;
use serde_json::Value;
use std::cell::{Cell, OnceCell};

/// The buffers of a document.
pub(super) struct Store<'a> {
    document: &'a Document<'a>,
    resolver: &'a Resolver<'a>,
    buffers: Vec<Option<Bytes<'a>>>,
    /// The views that have been decompressed.
    unpacked: Vec<OnceCell<Option<Vec<u8>>>>,
    budget: Budget<'a>,
    spent: Cell<bool>,
}

enum Bytes<'a> {
    Chunk(&'a [u8]),
    Read(Vec<u8>),
}

impl<'a> Store<'a> {
    /// Reads all buffers. `chunk` is the binary chunk of a file that is binary.
    pub(super) fn read(
        document: &'a Document<'a>,
        resolver: &'a Resolver<'a>,
        chunk: Option<&'a [u8]>,
        is_binary: bool,
    ) -> Self {
        let unpacked = document.all("bufferViews").iter().map(|_| OnceCell::new()).collect();
        let mut store = Self {
            document,
            resolver,
            buffers: Vec::new(),
            unpacked,
            budget: Budget::new(resolver.limits),
            spent: Cell::new(false),
        };
        for (at, buffer) in document.all("buffers").iter().enumerate() {
            let bytes = store.buffer(at, buffer, chunk, is_binary);
            store.buffers.push(bytes);
        }
        store
    }

    fn buffer(
        &self,
        at: usize,
        buffer: &Value,
        chunk: Option<&'a [u8]>,
        is_binary: bool,
    ) -> Option<Bytes<'a>> {
        let findings = self.document.findings;
        let length = integer(buffer, "byteLength");
        let Some(uri) = text(buffer, "uri") else {
            let has_no_uri = buffer.is_object() && buffer.get("uri").is_none();
            let chunk = chunk.filter(|_| at == 0 && has_no_uri);
            // A buffer without data is what meshopt has for those who cannot read it.
            if chunk.is_none() && is_binary && has_no_uri && at == 0 {
                let message = "the buffer is to be the binary chunk, and there is none";
                findings.add(
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
                    format_args!("the binary chunk has {more} bytes more than the buffer");
                findings.add(
                    &codes::BUFFER_GLB_CHUNK_TOO_BIG,
                    format_args!("/buffers/{at}"),
                    message,
                );
            }
            return Some(Bytes::Chunk(chunk));
        };
        let pointer = format!("/buffers/{at}/uri");
        uris::check_buffer(uri, &pointer, is_binary, findings);
        let bytes = uris::read(self.resolver, uri, &pointer, findings)?;
        if let Some(length) = length {
            self.check_length(at, bytes.len(), length);
        }
        Some(Bytes::Read(bytes))
    }

    fn check_length(&self, at: usize, there: usize, length: u64) {
        if (there as u64) < length {
            let message = format_args!("the buffer says {length} bytes, its data has {there}");
            let pointer = format_args!("/buffers/{at}/byteLength");
            self.document.findings.add(&codes::BUFFER_BYTE_LENGTH_MISMATCH, pointer, message);
        }
    }

    /// Whether so many bytes more may be looked at; the first time they may not is told.
    pub(super) fn may_spend(&self, pointer: &str, bytes: u64) -> bool {
        if self.spent.get() {
            return false;
        }
        let charged = self.budget.charge(pointer, bytes, self.resolver.total_bytes());
        if let Err(fault) = &charged {
            self.spent.set(true);
            let message = format_args!("{}; the data from here on is not checked", fault.problem);
            let findings = self.document.findings;
            findings.add_with(&codes::LIMIT_EXCEEDED, pointer, message, &fault.remedy);
        }
        charged.is_ok()
    }

    fn bytes(&self, buffer: usize) -> Option<&[u8]> {
        match self.buffers.get(buffer)?.as_ref()? {
            Bytes::Chunk(bytes) => Some(bytes),
            Bytes::Read(bytes) => Some(bytes),
        }
    }

    /// The bytes of a view, if they are all there.
    pub(super) fn view(&self, view: usize) -> Option<&[u8]> {
        let json = self.document.all("bufferViews").get(view)?;
        let packed = ["KHR_meshopt_compression", "EXT_meshopt_compression"];
        if packed.iter().any(|name| extension(json, name).is_some()) {
            return self.unpacked.get(view)?.get_or_init(|| self.unpack(view, json)).as_deref();
        }
        let offset =
            if json.get("byteOffset").is_some() { integer(json, "byteOffset")? } else { 0 };
        self.part(index(json, "buffer")?, offset, integer(json, "byteLength")?)
    }

    fn part(&self, buffer: usize, offset: u64, length: u64) -> Option<&[u8]> {
        let start = usize::try_from(offset).ok()?;
        self.bytes(buffer)?.get(start..)?.get(..usize::try_from(length).ok()?)
    }

    /// A compressed view; what is wrong with the stream, the loader tells.
    fn unpack(&self, view: usize, json: &Value) -> Option<Vec<u8>> {
        let pointer = format!("/bufferViews/{view}");
        let json = serde_json::from_value(json.clone()).ok()?;
        let packed = Packed::of(&json, &pointer).ok()??;
        let stream = self.part(packed.buffer, packed.offset, packed.length)?;
        self.may_spend(&pointer, packed.unpacked_length()).then(|| packed.unpack(stream).ok())?
    }

    /// The elements of an accessor, if all of their bytes are there.
    pub(super) fn elements(&self, accessor: &Value, layout: Layout) -> Option<Elements<'_>> {
        let base = match layout.view {
            Some(view) => {
                let stride = self.stride(view).unwrap_or(layout.tight());
                let start = usize::try_from(layout.offset).ok()?;
                let length = usize::try_from(layout.length(stride)).ok()?;
                let bytes = self.view(view)?.get(start..)?.get(..length)?;
                Some((bytes, Some(stride).filter(|&stride| stride >= layout.size())?))
            }
            None if accessor.get("bufferView").is_some() => return None,
            None => None,
        };
        let Some(sparse) = accessor.get("sparse") else {
            return Some(Elements::new(layout, base, Vec::new(), &[]));
        };
        let indices = self.sparse_indices(sparse)?;
        let values = sparse.get("values")?;
        let offset = usize::try_from(integer(values, "byteOffset").unwrap_or(0)).ok()?;
        let length = indices.len().checked_mul(layout.tight())?;
        let length = length.saturating_sub(layout.tight() - layout.size());
        let values = self.view(index(values, "bufferView")?)?.get(offset..)?.get(..length)?;
        Some(Elements::new(layout, base, indices, values))
    }

    /// Which elements a sparse accessor replaces.
    pub(super) fn sparse_indices(&self, sparse: &Value) -> Option<Vec<u32>> {
        let json = sparse.get("indices")?;
        let component = Component::of(integer(json, "componentType")?)?;
        let offset = usize::try_from(integer(json, "byteOffset").unwrap_or(0)).ok()?;
        let count = usize::try_from(integer(sparse, "count")?).ok()?;
        let length = count.checked_mul(component.size())?;
        let bytes = self.view(index(json, "bufferView")?)?.get(offset..)?.get(..length)?;
        let pointer = "/accessors";
        self.may_spend(pointer, 4 * count as u64).then_some(())?;
        Some(bytes.chunks_exact(component.size()).map(|c| component.read(c) as u32).collect())
    }

    /// The stride that a view declares.
    pub(super) fn stride(&self, view: usize) -> Option<usize> {
        index(self.document.all("bufferViews").get(view)?, "byteStride")
    }
}

/// The rules for buffer views (glTF 2.0 §5.11).
pub(super) fn check_views(document: &Document<'_>) {
    for (at, view) in document.all("bufferViews").iter().enumerate() {
        check_view(document, at, view);
    }
}

fn check_view(document: &Document<'_>, at: usize, view: &Value) {
    let findings = document.findings;
    let offset = integer(view, "byteOffset").unwrap_or(0);
    let length = integer(view, "byteLength");
    let buffer = index(view, "buffer").and_then(|at| items(document.root, "buffers").get(at));
    let there = buffer.and_then(|buffer| integer(buffer, "byteLength"));
    if let (Some(length), Some(there)) = (length, there)
        && (offset.saturating_add(length) > there || offset >= there && offset > 0)
    {
        let member = if offset >= there { "byteOffset" } else { "byteLength" };
        let message = format_args!(
            "bytes {offset} to {offset} + {length} are not all in a buffer of {there}"
        );
        let pointer = format_args!("/bufferViews/{at}/{member}");
        findings.add(&codes::BUFFER_VIEW_TOO_LONG, pointer, message);
    }
    let Some(stride) = integer(view, "byteStride") else { return };
    let pointer = format!("/bufferViews/{at}/byteStride");
    if !stride.is_multiple_of(4) {
        let message = format_args!("{stride} is no multiple of 4");
        findings.add(&codes::VALUE_MULTIPLE_OF, &pointer, message);
    }
    if integer(view, "target") == Some(34_963) {
        let message = "a view of indices has no stride";
        findings.add(&codes::BUFFER_VIEW_INVALID_BYTE_STRIDE, &pointer, message);
    }
    if let Some(length) = length.filter(|&length| stride > length) {
        let message = format_args!("the stride is {stride}, and the view has {length} bytes");
        findings.add(&codes::BUFFER_VIEW_TOO_BIG_BYTE_STRIDE, &pointer, message);
    }
}
