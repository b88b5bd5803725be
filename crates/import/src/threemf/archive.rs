//! Zip archives (APPNOTE 6.3.10): the central directory, and stored or deflated entries.
//!
//! Supports only what 3MF needs, without encryption, other compression methods or multi-volume
//! archives. Nothing is written to disk: entry names are compared with other names and never used
//! as paths. Decompressed data is limited both by the size that the directory declares and by the
//! memory budget, so no archive can exceed the limits.

use fdeflate::Decompressor;
use gltf_import::MemoryBudget;
use model::{Diagnostic, codes};
use std::borrow::Cow;

/// The maximum number of entries in an archive. 3MF packages for the largest print beds have a few
/// hundred.
const MAX_ENTRIES: u64 = 65_536;
/// Size of a local entry header without the name and extra field.
const LOCAL_HEADER: usize = 30;
/// Size of a central directory record without the name, extra field and comment.
const DIRECTORY_RECORD: usize = 46;
/// Size of the end record without the comment.
const END_RECORD: usize = 22;

/// An entry of the central directory.
#[derive(Debug)]
pub(super) struct Entry {
    /// The name as stored in the archive, but with `/` between folders.
    pub(super) name: String,
    /// Whether the entry is protected by a password.
    is_encrypted: bool,
    /// The compression method: 0 for stored, 8 for deflated.
    method: u16,
    /// Checksum of the content.
    crc: u32,
    /// Number of compressed bytes in the archive.
    compressed: u64,
    /// Number of bytes of the content.
    size: u64,
    /// Offset of the local header.
    offset: u64,
}

/// An archive in memory.
#[derive(Debug)]
pub(super) struct Archive<'a> {
    bytes: &'a [u8],
    /// The entries in directory order, without folders.
    pub(super) entries: Vec<Entry>,
}

impl<'a> Archive<'a> {
    /// Reads the central directory of an archive.
    ///
    /// # Errors
    /// Fails if the archive is truncated, is not a zip archive, or has too many entries.
    pub(super) fn from_bytes(bytes: &'a [u8]) -> Result<Self, Diagnostic> {
        let (mut at, count) = find_directory(bytes).ok_or_else(|| {
            let message = "the zip archive has no directory: it is truncated";
            Diagnostic::error(codes::INVALID_DATA, "", message, "save or download the file again")
        })?;
        if count > MAX_ENTRIES {
            let message =
                format!("the zip archive has {count} entries; at most {MAX_ENTRIES} are allowed");
            return Err(Diagnostic::error(codes::LIMIT_EXCEEDED, "", message, "use another file"));
        }
        let mut entries = Vec::new();
        for _ in 0..count {
            let Some((entry, next)) = read_entry(bytes, at) else {
                let message = "the directory of the zip archive is broken";
                return Err(Diagnostic::invalid(&format!("byte {at}"), message));
            };
            if !entry.name.ends_with('/') {
                entries.push(entry);
            }
            at = next;
        }
        Ok(Self { bytes, entries })
    }

    /// Returns the size of the whole archive in bytes.
    pub(super) const fn byte_count(&self) -> u64 {
        self.bytes.len() as u64
    }

    /// Reads the content of an entry.
    ///
    /// # Errors
    /// Fails if the entry is encrypted, broken or larger than the budget, or if it uses an
    /// unsupported compression method.
    pub(super) fn read_entry(
        &self,
        entry: &Entry,
        budget: &MemoryBudget<'_>,
    ) -> Result<Cow<'a, [u8]>, Diagnostic> {
        let location = entry.name.as_str();
        if entry.is_encrypted {
            return Err(Diagnostic::error(
                codes::MISSING_DATA,
                location,
                "the archive entry is encrypted",
                "save the file without a password",
            ));
        }
        let broken = |message: &str| Diagnostic::invalid(location, message);
        let data = self.compressed_bytes(entry).ok_or_else(|| broken("the entry is truncated"))?;
        let content = match entry.method {
            0 => Cow::Borrowed(data),
            8 => {
                // The declared size is charged before memory is allocated.
                budget.charge_bytes(location, entry.size, self.bytes.len() as u64)?;
                let size = usize::try_from(entry.size).unwrap_or(usize::MAX);
                inflate(data, size).map(Cow::Owned).map_err(|message| broken(&message))?
            }
            method => {
                let message = format!("the entry uses the unsupported compression method {method}");
                let help = "save the file with deflate compression, which 3MF uses";
                return Err(Diagnostic::error(codes::MISSING_DATA, location, message, help));
            }
        };
        if content.len() as u64 != entry.size || crc32fast::hash(&content) != entry.crc {
            return Err(broken("the content does not match the checksum in the archive"));
        }
        Ok(content)
    }

    /// Returns the bytes of an entry as stored in the archive.
    fn compressed_bytes(&self, entry: &Entry) -> Option<&'a [u8]> {
        let local = self.bytes.get(usize::try_from(entry.offset).ok()?..)?;
        if !local.starts_with(b"PK\x03\x04") {
            return None;
        }
        let begin = LOCAL_HEADER + read_u16(local, 26)? as usize + read_u16(local, 28)? as usize;
        let end = begin.checked_add(usize::try_from(entry.compressed).ok()?)?;
        local.get(begin..end)
    }
}

/// Decompresses deflated data (RFC 1951) of known size.
///
/// This uses the decoder for PNG images. It expects a zlib frame (RFC 1950) around the data: two
/// bytes before it and a checksum after it, which is ignored because the archive has its own
/// checksum.
fn inflate(data: &[u8], size: usize) -> Result<Vec<u8>, String> {
    // One byte of deflated data expands to at most 1,032 bytes.
    if size / 1032 > data.len() {
        let packed = data.len();
        return Err(format!(
            "the entry declares {size} bytes, too many for {packed} compressed bytes"
        ));
    }
    let framed = [&[0x78, 0x01], data, &[0; 4]].concat();
    let mut decoder = Decompressor::new();
    decoder.ignore_adler32();
    let mut content = vec![0; size];
    let (mut read, mut written) = (0, 0);
    while !decoder.is_done() {
        let (consumed, produced) = decoder
            .read(&framed[read..], &mut content, written, true)
            .map_err(|error| format!("the deflate data of the entry is broken: {error:?}"))?;
        (read, written) = (read + consumed, written + produced);
        // No progress: the data ends too early.
        if consumed == 0 && produced == 0 {
            break;
        }
    }
    match decoder.is_done() && written == size {
        true => Ok(content),
        false => Err("the entry does not have the size that the archive declares".to_owned()),
    }
}

/// Returns the offset of the central directory and its number of entries.
///
/// The end record is searched for backward, because a comment may follow it.
fn find_directory(bytes: &[u8]) -> Option<(usize, u64)> {
    let last = bytes.len().checked_sub(END_RECORD)?;
    let first = last.saturating_sub(usize::from(u16::MAX));
    let end = (first..=last).rev().find(|&at| bytes[at..].starts_with(b"PK\x05\x06"))?;
    let record = &bytes[end..];
    let (count, offset) = (read_u16(record, 10)?, read_u32(record, 16)?);
    if count != u32::from(u16::MAX) && offset != u32::MAX {
        return Some((offset as usize, u64::from(count)));
    }
    // Zip64 has a separate end record, with a locator just before this one.
    let locator = bytes.get(end.checked_sub(20)?..end)?;
    if !locator.starts_with(b"PK\x06\x07") {
        return Some((offset as usize, u64::from(count)));
    }
    let record = bytes.get(usize::try_from(read_u64(locator, 8)?).ok()?..)?;
    if !record.starts_with(b"PK\x06\x06") {
        return None;
    }
    Some((usize::try_from(read_u64(record, 48)?).ok()?, read_u64(record, 32)?))
}

/// Reads the central directory record at an offset; returns it with the next record's offset.
fn read_entry(bytes: &[u8], at: usize) -> Option<(Entry, usize)> {
    let record = bytes.get(at..)?;
    if !record.starts_with(b"PK\x01\x02") {
        return None;
    }
    let (name_length, extra_length) =
        (read_u16(record, 28)? as usize, read_u16(record, 30)? as usize);
    let comment_length = read_u16(record, 32)? as usize;
    let extra_at = DIRECTORY_RECORD + name_length;
    let name = record.get(DIRECTORY_RECORD..extra_at)?;
    let extra = record.get(extra_at..extra_at + extra_length)?;
    let fields = [read_u32(record, 24)?, read_u32(record, 20)?, read_u32(record, 42)?];
    let [size, compressed, offset] = zip64_fields(fields, extra)?;
    let entry = Entry {
        name: String::from_utf8_lossy(name).replace('\\', "/"),
        is_encrypted: read_u16(record, 8)? & 1 != 0,
        method: read_u16(record, 10)? as u16,
        crc: read_u32(record, 16)?,
        compressed,
        size,
        offset,
    };
    Some((entry, at + extra_at + extra_length + comment_length))
}

/// Returns the values of 32-bit fields. A field whose bits are all set has its value in the extra
/// field with id 1.
fn zip64_fields(fields: [u32; 3], mut extra: &[u8]) -> Option<[u64; 3]> {
    let mut wide: &[u8] = &[];
    while let (Some(id), Some(length)) = (read_u16(extra, 0), read_u16(extra, 2)) {
        let end = 4 + length as usize;
        let Some(field) = extra.get(4..end) else { break };
        if id == 1 {
            wide = field;
        }
        extra = &extra[end..];
    }
    let mut values = fields.map(u64::from);
    for value in values.iter_mut().filter(|value| **value == u64::from(u32::MAX)) {
        *value = read_u64(wide, 0)?;
        wide = &wide[8..];
    }
    Some(values)
}

/// Reads the little-endian number at an offset.
fn read_u16(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|&b| u32::from(u16::from_le_bytes(b)))
}

/// Reads the little-endian number at an offset.
fn read_u32(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|&b| u32::from_le_bytes(b))
}

/// Reads the little-endian number at an offset.
fn read_u64(bytes: &[u8], at: usize) -> Option<u64> {
    bytes.get(at..)?.first_chunk().map(|&b| u64::from_le_bytes(b))
}
