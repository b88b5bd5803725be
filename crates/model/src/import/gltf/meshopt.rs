//! Buffer views compressed by meshopt: EXT_meshopt_compression, and KHR_meshopt_compression, which is a superset.
//!
//! ```text
//!  stream ──ATTRIBUTES──► elements ──filter──► the view's bytes      deltas byte by byte, in blocks
//!         ──TRIANGLES───► indices ───────────►                       edges and vertices seen lately
//!         ──INDICES─────► indices ───────────►                       differences to one of two earlier indices
//! ```
//!
//! Written after the text of the two extensions, whose appendices define the streams byte by byte. A stream has no
//! lengths of its own: how long the result is, the JSON says, and a stream that ends earlier or later is invalid. Both
//! names accept both versions of the streams and all filters.

mod byte_stream;
mod index_codec;
mod index_sequence_codec;
#[cfg(test)]
mod tests;
mod vertex_codec;
mod vertex_filters;

use crate::diagnostic::Diagnostic;
use byte_stream::StreamError;
use gltf::json::buffer::View;
use serde_json::{Map, Value};

/// What an extension says of a compressed view.
#[derive(Debug)]
pub(crate) struct CompressedView {
    /// Where it says so.
    pub(crate) pointer: String,
    /// The buffer with the stream.
    pub(crate) buffer: usize,
    /// The stream's first byte in it.
    pub(crate) offset: u64,
    /// The stream's bytes.
    pub(crate) length: u64,
    count: usize,
    stride: usize,
    mode: CompressionMode,
}

/// How a stream is to be read, and what is done to its elements then.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum CompressionMode {
    Attributes(MeshoptFilter),
    Triangles,
    Indices,
}

/// What is done to each element of a stream of attributes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum MeshoptFilter {
    None,
    Octahedral,
    Quaternion,
    Exponential,
    Color,
}

impl CompressedView {
    /// What a view says of its compression, if it is compressed; `view` is the pointer to it.
    pub(crate) fn from_view(json: &View, view: &str) -> Result<Option<Self>, Diagnostic> {
        let Some(extensions) = &json.extensions else { return Ok(None) };
        let named = |name: &'static str| extensions.others.get(name).map(|value| (name, value));
        let found = named("KHR_meshopt_compression").or_else(|| named("EXT_meshopt_compression"));
        let Some((name, value)) = found else { return Ok(None) };
        let pointer = format!("{view}/extensions/{name}");
        let members = value.as_object();
        let members = members.ok_or_else(|| Diagnostic::invalid(&pointer, "an object is due"))?;
        let packed = Self::from_members(members, pointer)?;
        if packed.decompressed_length() == json.byte_length.0 {
            return Ok(Some(packed));
        }
        let Self { count, stride, .. } = packed;
        let length = json.byte_length.0;
        let problem =
            format!("{count} elements of {stride} bytes are compressed, not {length} bytes");
        Err(Diagnostic::invalid(&format!("{view}/byteLength"), problem))
    }

    fn from_members(members: &Map<String, Value>, pointer: String) -> Result<Self, Diagnostic> {
        let number = |key: &str| {
            let number = members.get(key).and_then(Value::as_u64);
            let due = || Diagnostic::invalid(&format!("{pointer}/{key}"), "an integer is due");
            number.ok_or_else(due)
        };
        let size = |key: &str| Ok(usize::try_from(number(key)?).unwrap_or(usize::MAX));
        let offset = if members.contains_key("byteOffset") { number("byteOffset")? } else { 0 };
        let (buffer, length) = (size("buffer")?, number("byteLength")?);
        let (count, stride) = (size("count")?, size("byteStride")?);
        let mode = CompressionMode::from_members(members, &pointer)?;
        if let Err(allowed) = mode.check_stride(stride) {
            let problem = format!("the stride is {stride} and must be {allowed}");
            return Err(Diagnostic::invalid(&format!("{pointer}/byteStride"), problem));
        }
        if mode == CompressionMode::Triangles && !count.is_multiple_of(3) {
            let problem = format!("{count} indices are no triangles");
            return Err(Diagnostic::invalid(&format!("{pointer}/count"), problem));
        }
        Ok(Self { pointer, buffer, offset, length, count, stride, mode })
    }

    /// How many bytes the decompressed view has.
    pub(crate) fn decompressed_length(&self) -> u64 {
        (self.count as u64).saturating_mul(self.stride as u64)
    }

    /// The bytes of the view; the caller has made sure that there may be so many.
    pub(crate) fn decompress(&self, stream: &[u8]) -> Result<Vec<u8>, Diagnostic> {
        let Self { count, stride, .. } = *self;
        let unpacked = match self.mode {
            CompressionMode::Attributes(filter) => {
                vertex_codec::decode_vertices(stream, count, stride).map(|mut bytes| {
                    filter.apply_filter(&mut bytes, stride);
                    bytes
                })
            }
            CompressionMode::Triangles => index_codec::decode_triangles(stream, count, stride),
            CompressionMode::Indices => {
                index_sequence_codec::decode_index_sequence(stream, count, stride)
            }
        };
        unpacked.map_err(|error: StreamError| Diagnostic::invalid(&self.pointer, error.to_string()))
    }
}

impl CompressionMode {
    fn from_members(members: &Map<String, Value>, pointer: &str) -> Result<Self, Diagnostic> {
        let word = |key: &str| members.get(key).map(|value| value.as_str().unwrap_or("no string"));
        let filter = match word("filter") {
            None | Some("NONE") => MeshoptFilter::None,
            Some("OCTAHEDRAL") => MeshoptFilter::Octahedral,
            Some("QUATERNION") => MeshoptFilter::Quaternion,
            Some("EXPONENTIAL") => MeshoptFilter::Exponential,
            Some("COLOR") => MeshoptFilter::Color,
            Some(other) => {
                let problem = format!("the filter {other:?} is not known");
                return Err(Diagnostic::invalid(&format!("{pointer}/filter"), problem));
            }
        };
        match (word("mode"), filter) {
            (Some("ATTRIBUTES"), filter) => Ok(Self::Attributes(filter)),
            (Some("TRIANGLES"), MeshoptFilter::None) => Ok(Self::Triangles),
            (Some("INDICES"), MeshoptFilter::None) => Ok(Self::Indices),
            (Some("TRIANGLES" | "INDICES"), _) => {
                let problem = "only the mode ATTRIBUTES may have a filter";
                Err(Diagnostic::invalid(&format!("{pointer}/filter"), problem))
            }
            (mode, _) => {
                let problem = format!(
                    "the mode must be ATTRIBUTES, TRIANGLES or INDICES, not {:?}",
                    mode.unwrap_or("")
                );
                Err(Diagnostic::invalid(&format!("{pointer}/mode"), problem))
            }
        }
    }

    /// Whether elements may have so many bytes; if not, how many they may have.
    fn check_stride(self, stride: usize) -> Result<(), &'static str> {
        let fits = |fits: bool, allowed| if fits { Ok(()) } else { Err(allowed) };
        match self {
            Self::Triangles | Self::Indices => fits(matches!(stride, 2 | 4), "2 or 4"),
            Self::Attributes(MeshoptFilter::Octahedral | MeshoptFilter::Color) => {
                fits(matches!(stride, 4 | 8), "4 or 8")
            }
            Self::Attributes(MeshoptFilter::Quaternion) => fits(stride == 8, "8"),
            Self::Attributes(MeshoptFilter::None | MeshoptFilter::Exponential) => {
                let fitting = stride.is_multiple_of(4) && (4..=256).contains(&stride);
                fits(fitting, "a multiple of 4 from 4 to 256")
            }
        }
    }
}
