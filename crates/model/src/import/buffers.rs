//! The bytes of the file's buffers and buffer views, each read, and decompressed, once and when it is first needed.

use super::budget::Budget;
use super::error::{Fault, FaultKind};
use super::limits::Limits;
use super::meshopt::Packed;
use super::resolver::Resolver;
use gltf::json::Root;
use std::sync::OnceLock;

/// The buffers of a file.
pub(super) struct Buffers<'a> {
    root: &'a Root,
    pub(super) resolver: &'a Resolver<'a>,
    /// The binary chunk of the file itself.
    chunk: Option<&'a [u8]>,
    /// What has been read from elsewhere.
    read: Vec<OnceLock<Vec<u8>>>,
    /// The views that have been decompressed.
    unpacked: Vec<OnceLock<Vec<u8>>>,
    budget: Budget<'a>,
}

impl<'a> Buffers<'a> {
    pub(super) fn new(
        root: &'a Root,
        resolver: &'a Resolver<'a>,
        chunk: Option<&'a [u8]>,
        limits: &'a Limits,
    ) -> Self {
        let read = root.buffers.iter().map(|_| OnceLock::new()).collect();
        let unpacked = root.buffer_views.iter().map(|_| OnceLock::new()).collect();
        Self { root, resolver, chunk, read, unpacked, budget: Budget::new(limits) }
    }

    /// Counts an array that is about to be made; `pointer` is the member that says how long it is.
    pub(super) fn charge(&self, pointer: &str, bytes: u64) -> Result<(), Fault> {
        self.budget.charge(pointer, bytes, self.resolver.total_bytes())
    }

    /// The bytes of a buffer view, and its stride if it has one. `user` is the pointer to the member that names it.
    pub(super) fn view(&self, view: usize, user: &str) -> Result<View<'_>, Fault> {
        let Some(json) = self.root.buffer_views.get(view) else {
            let count = self.root.buffer_views.len();
            return Err(Fault::unresolved(user, "buffer view", view, count));
        };
        let pointer = format!("/bufferViews/{view}");
        let bytes = match Packed::of(json, &pointer)? {
            Some(packed) => self.unpacked(view, &packed)?,
            None => {
                let start = json.byte_offset.unwrap_or_default().0;
                self.part(json.buffer.value(), start, json.byte_length.0, &pointer)?
            }
        };
        Ok(View { bytes, stride: json.byte_stride.map(|stride| stride.0), pointer })
    }

    /// The bytes of a compressed view. The buffer that the view itself names need not have any.
    fn unpacked(&self, view: usize, packed: &Packed) -> Result<&[u8], Fault> {
        let slot = &self.unpacked[view];
        if let Some(bytes) = slot.get() {
            return Ok(bytes);
        }
        let stream = self.part(packed.buffer, packed.offset, packed.length, &packed.pointer)?;
        self.charge(&format!("{}/count", packed.pointer), packed.unpacked_length())?;
        let bytes = packed.unpack(stream)?;
        Ok(slot.get_or_init(|| bytes))
    }

    /// So many bytes of a buffer; `user` is the pointer to what names it.
    fn part(&self, buffer: usize, start: u64, length: u64, user: &str) -> Result<&[u8], Fault> {
        let bytes = self.buffer(buffer, user)?;
        slice(bytes, start, length).ok_or_else(|| {
            let there = bytes.len();
            let problem = format!(
                "bytes {start} to {start} + {length} are not all in buffer {buffer}, which has {there}"
            );
            Fault::invalid(user, problem)
        })
    }

    fn buffer(&self, buffer: usize, view: &str) -> Result<&[u8], Fault> {
        let (Some(json), Some(read)) = (self.root.buffers.get(buffer), self.read.get(buffer))
        else {
            let pointer = format!("{view}/buffer");
            return Err(Fault::unresolved(&pointer, "buffer", buffer, self.root.buffers.len()));
        };
        let all = match (&json.uri, self.chunk) {
            (None, Some(chunk)) if buffer == 0 => chunk,
            (None, _) => {
                let problem = "the buffer has no data: no URI, and no binary chunk for it";
                return Err(Fault::no_data(&format!("/buffers/{buffer}"), problem));
            }
            (Some(uri), _) => match read.get() {
                Some(bytes) => bytes,
                None => {
                    let bytes = self.resolver.read(uri, &format!("/buffers/{buffer}/uri"));
                    let bytes = bytes.map_err(|fault| self.softened(fault))?;
                    read.get_or_init(|| bytes)
                }
            },
        };
        let length = usize::try_from(json.byte_length.0).unwrap_or(usize::MAX);
        Ok(&all[..length.min(all.len())])
    }
}

impl Buffers<'_> {
    /// A file that is missing is no reason to stop for a reader who is lenient: its data is missing, and no more.
    fn softened(&self, fault: Fault) -> Fault {
        let is_file = matches!(fault.kind, FaultKind::Unreadable | FaultKind::Forbidden);
        let kind = if self.resolver.lenient && is_file { FaultKind::NoData } else { fault.kind };
        Fault { kind, ..fault }
    }
}

/// A part of a buffer.
pub(super) struct View<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) stride: Option<usize>,
    /// Where it is declared.
    pub(super) pointer: String,
}

/// The `length` bytes from `start` on, if they are all there.
pub(super) fn slice(bytes: &[u8], start: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(start).ok()?;
    let length = usize::try_from(length).ok()?;
    bytes.get(start..)?.get(..length)
}
