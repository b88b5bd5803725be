//! meshopt compression of buffer views: EXT_meshopt_compression and its superset,
//! KHR_meshopt_compression.
//!
//! ```text
//!  stream ──ATTRIBUTES──► elements ──filter──► bytes    byte-wise deltas in blocks   vertex_codec
//!         ──TRIANGLES───► indices ───────────► bytes    edge and vertex FIFOs        index_codec
//!         ──INDICES─────► indices ───────────► bytes    deltas to two baselines
//!                                                                           index_sequence_codec
//! ```
//!
//! This implementation follows the text of the extensions, whose appendices define the streams byte
//! by byte. A stream does not contain its length: the JSON declares the length of the result, and a
//! stream that is too short or too long for it is invalid. Both stream versions and all filters are
//! accepted under either extension name.

mod byte_stream;
mod index_codec;
mod index_sequence_codec;
#[cfg(test)]
mod tests;
mod vertex_codec;
mod vertex_filters;

use byte_stream::StreamError;
use gltf::json::buffer::View;
use model::Diagnostic;
use serde_json::{Map, Value};

/// A compressed buffer view as declared by the extension.
#[derive(Debug)]
pub struct CompressedView {
    /// JSON pointer to the extension.
    pub pointer: String,
    /// Index of the buffer that contains the stream.
    pub buffer: usize,
    /// Offset of the stream in the buffer.
    pub offset: u64,
    /// Length of the stream in bytes.
    pub length: u64,
    /// Number of elements after decompression.
    count: usize,
    /// Size of an element in bytes after decompression.
    stride: usize,
    /// Codec and filter.
    mode: CompressionMode,
}

/// The codec of a stream.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum CompressionMode {
    Attributes(MeshoptFilter),
    Triangles,
    Indices,
}

/// The filter applied to each element of an attribute stream after decompression.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum MeshoptFilter {
    None,
    Octahedral,
    Quaternion,
    Exponential,
    Color,
}

impl CompressedView {
    /// Returns the compression of a buffer view, or `None` if it is not compressed. `view` is the
    /// pointer to the view.
    pub(crate) fn from_view(json: &View, view: &str) -> Result<Option<Self>, Diagnostic> {
        let Some(extensions) = &json.extensions else { return Ok(None) };
        let named = |name: &'static str| extensions.others.get(name).map(|value| (name, value));
        let extension =
            named("KHR_meshopt_compression").or_else(|| named("EXT_meshopt_compression"));
        let Some((name, value)) = extension else { return Ok(None) };
        let pointer = format!("{view}/extensions/{name}");
        let members = value.as_object();
        let members = members.ok_or_else(|| Diagnostic::invalid(&pointer, "expected an object"))?;
        let packed = Self::from_members(members, pointer)?;
        if packed.decompressed_length() == json.byte_length.0 {
            return Ok(Some(packed));
        }
        let Self { count, stride, .. } = packed;
        let length = json.byte_length.0;
        let message = format!(
            "{count} compressed elements of {stride} bytes do not match a \
             byteLength of {length}"
        );
        Err(Diagnostic::invalid(&format!("{view}/byteLength"), message))
    }

    /// Reads and checks the members of the extension.
    fn from_members(members: &Map<String, Value>, pointer: String) -> Result<Self, Diagnostic> {
        let integer_member = |key: &str| {
            let integer_member = members.get(key).and_then(Value::as_u64);
            let missing =
                || Diagnostic::invalid(&format!("{pointer}/{key}"), "expected an integer");
            integer_member.ok_or_else(missing)
        };
        let size = |key: &str| Ok(usize::try_from(integer_member(key)?).unwrap_or(usize::MAX));
        let offset =
            if members.contains_key("byteOffset") { integer_member("byteOffset")? } else { 0 };
        let (buffer, length) = (size("buffer")?, integer_member("byteLength")?);
        let (count, stride) = (size("count")?, size("byteStride")?);
        let mode = CompressionMode::from_members(members, &pointer)?;
        if let Err(allowed) = mode.check_stride(stride) {
            let message = format!("the stride is {stride} but must be {allowed}");
            return Err(Diagnostic::invalid(&format!("{pointer}/byteStride"), message));
        }
        if mode == CompressionMode::Triangles && !count.is_multiple_of(3) {
            let message = format!("the number of indices, {count}, is not a multiple of 3");
            return Err(Diagnostic::invalid(&format!("{pointer}/count"), message));
        }
        Ok(Self { pointer, buffer, offset, length, count, stride, mode })
    }

    /// Returns the compression of a buffer view from its JSON, or `None` if it is not compressed or
    /// not a buffer view.
    ///
    /// # Errors
    /// Fails if the extension breaks a rule.
    pub fn from_json(view: &Value, pointer: &str) -> Result<Option<Self>, Diagnostic> {
        match serde_json::from_value(view.clone()) {
            Ok(view) => Self::from_view(&view, pointer),
            Err(_) => Ok(None),
        }
    }

    /// Returns the length of the decompressed view in bytes.
    #[must_use]
    pub fn decompressed_length(&self) -> u64 {
        (self.count as u64).saturating_mul(self.stride as u64)
    }

    /// Decompresses the stream. The caller must have charged the result to the memory budget.
    ///
    /// # Errors
    /// Fails if the stream is invalid.
    pub fn decompress(&self, stream: &[u8]) -> Result<Vec<u8>, Diagnostic> {
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
    /// Reads the mode and filter.
    fn from_members(members: &Map<String, Value>, pointer: &str) -> Result<Self, Diagnostic> {
        let string_member =
            |key: &str| members.get(key).map(|value| value.as_str().unwrap_or("not a string"));
        let filter = match string_member("filter") {
            None | Some("NONE") => MeshoptFilter::None,
            Some("OCTAHEDRAL") => MeshoptFilter::Octahedral,
            Some("QUATERNION") => MeshoptFilter::Quaternion,
            Some("EXPONENTIAL") => MeshoptFilter::Exponential,
            Some("COLOR") => MeshoptFilter::Color,
            Some(other) => {
                let message = format!("unknown filter {other:?}");
                return Err(Diagnostic::invalid(&format!("{pointer}/filter"), message));
            }
        };
        match (string_member("mode"), filter) {
            (Some("ATTRIBUTES"), filter) => Ok(Self::Attributes(filter)),
            (Some("TRIANGLES"), MeshoptFilter::None) => Ok(Self::Triangles),
            (Some("INDICES"), MeshoptFilter::None) => Ok(Self::Indices),
            (Some("TRIANGLES" | "INDICES"), _) => {
                let message = "only the mode ATTRIBUTES may have a filter";
                Err(Diagnostic::invalid(&format!("{pointer}/filter"), message))
            }
            (mode, _) => {
                let message = format!(
                    "the mode must be ATTRIBUTES, TRIANGLES or INDICES, not {:?}",
                    mode.unwrap_or("")
                );
                Err(Diagnostic::invalid(&format!("{pointer}/mode"), message))
            }
        }
    }

    /// Checks the element size. The error lists the allowed sizes.
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
