//! Draco mesh compression (KHR_draco_mesh_compression): indices and attributes in one stream.
//!
//! The `draco-core` crate decodes the stream, within limits derived from the accessors. Its result
//! is not trusted: counts are checked against the accessors, and indices against the number of
//! vertices. The accessors of a compressed primitive usually have no bytes; [`DracoData`] supplies
//! them.
//!
//! ```text
//!  primitive.attributes  POSITION: accessor 3      count and format
//!  extension.attributes  POSITION: id 0            the attribute in the stream
//!  extension.bufferView  ──► stream ──decode──► bytes for accessor 3
//! ```
//!
//! The compression is transparent to attribute readers: [`DracoData::attach_data`] replaces the
//! bytes of a resolved accessor. Without the `draco` feature, a compressed primitive is reported as
//! missing data.

use super::accessor::AccessorReader;
use super::elements::{ResolvedAccessor, StridedBytes};
use gltf::json::mesh::{Primitive, Semantic};
use model::Diagnostic;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// The extension's name, as in `extensionsUsed`.
const EXTENSION: &str = "KHR_draco_mesh_compression";

/// Decoded contents of a stream.
///
/// The bytes have the component type of the accessor, so that they are converted like the bytes of
/// any other accessor.
#[derive(Debug, Default)]
pub(super) struct DracoData {
    /// Vertex indices of triangles.
    pub(super) indices: Vec<u32>,
    /// Tightly packed elements for each accessor that the stream has data for.
    attributes: BTreeMap<usize, Vec<u8>>,
}

impl DracoData {
    /// Attaches the decoded bytes to an accessor if the stream has data for it.
    ///
    /// The stride is the element size, because decoded elements are tightly packed. Vertex
    /// attributes are never matrices, whose columns would need padding.
    pub(super) fn attach_data<'a>(
        &'a self,
        elements: ResolvedAccessor<'a>,
    ) -> ResolvedAccessor<'a> {
        let Some(bytes) = self.attributes.get(&elements.accessor) else { return elements };
        let stride = elements.element_type.multiplicity() * elements.component_type.size();
        ResolvedAccessor { data: Some(StridedBytes { bytes, stride }), ..elements }
    }

    /// Returns whether the stream has data for an accessor.
    pub(super) fn has_accessor(&self, accessor: usize) -> bool {
        self.attributes.contains_key(&accessor)
    }
}

/// Returns the extension object of a primitive, if it is compressed.
fn draco_extension(json: &Primitive) -> Option<&Value> {
    json.extensions.as_ref()?.others.get(EXTENSION)
}

/// A compressed stream, with the counts that the accessors declare.
///
/// Everything that the decoder needs is validated before this struct is built.
#[cfg_attr(not(feature = "draco"), allow(dead_code, reason = "only the decoder reads the fields"))]
struct DracoStream<'a> {
    source: &'a AccessorReader<'a>,
    bytes: &'a [u8],
    /// The accessors of the primitive, each with the id of the attribute in the stream.
    attributes: Vec<(usize, u32)>,
    /// Number of vertices according to the accessors.
    vertices: usize,
    /// The accessor of the indices, and the number of indices.
    indices: Option<(usize, usize)>,
    /// JSON pointer to the extension.
    pointer: String,
}

/// Decodes the stream of a primitive, or returns `None` if the primitive is not compressed.
///
/// Tangents are decoded only if `tangents` is true, and no custom attribute except `custom` is
/// decoded. `pointer` is the location of the primitive.
///
/// # Errors
/// Fails if a member of the extension is missing, an accessor is invalid, the counts of the
/// attributes differ, or the stream is malformed.
pub(super) fn decode_draco(
    source: &AccessorReader<'_>,
    json: &Primitive,
    tangents: bool,
    custom: Option<&Semantic>,
    pointer: &str,
) -> Result<Option<DracoData>, Diagnostic> {
    let Some(extension) = draco_extension(json) else { return Ok(None) };
    let pointer = format!("{pointer}/extensions/{EXTENSION}");
    let view = extension.get("bufferView").and_then(Value::as_u64);
    let ids = extension.get("attributes").and_then(Value::as_object);
    let (Some(view), Some(ids)) = (view, ids) else {
        return Err(Diagnostic::invalid(&pointer, "`bufferView` and `attributes` are required"));
    };
    let view = usize::try_from(view).unwrap_or(usize::MAX);
    let bytes = source.buffers.buffer_view(view, &format!("{pointer}/bufferView"))?.bytes;
    let attributes = stream_attributes(json, ids, tangents, custom, &pointer)?;
    // Counts are compared first, because they limit the memory that decoding takes.
    let mut vertices = None;
    for &(accessor, _) in &attributes {
        let count = source.resolve_accessor(accessor, &pointer)?.count;
        if *vertices.get_or_insert(count) != count {
            let message = "the attributes of a primitive must have the same number of elements";
            return Err(Diagnostic::invalid(&format!("/accessors/{accessor}/count"), message));
        }
    }
    let indices = json.indices.map(|accessor| accessor.value());
    let indices = indices.map(|at| source.resolve_accessor(at, &pointer).map(|e| (at, e.count)));
    let stream = DracoStream {
        source,
        bytes,
        attributes,
        vertices: vertices.unwrap_or(0),
        indices: indices.transpose()?,
        pointer,
    };
    stream.decode_mesh().map(Some)
}

/// Returns the accessor of each attribute to read, and its id in the stream.
///
/// Attributes without an id are not in the stream: they are uncompressed or absent. Custom
/// attributes other than `custom` and unneeded tangents are skipped to save decoding time.
fn stream_attributes(
    json: &Primitive,
    ids: &Map<String, Value>,
    tangents: bool,
    custom: Option<&Semantic>,
    pointer: &str,
) -> Result<Vec<(usize, u32)>, Diagnostic> {
    use gltf::json::validation::Checked::Valid;
    let mut attributes = Vec::new();
    for (semantic, accessor) in &json.attributes {
        // Attributes that do not affect the picture are not decoded.
        let Valid(semantic) = semantic else { continue };
        let is_skipped = match semantic {
            Semantic::Extras(_) => custom != Some(semantic),
            Semantic::Tangents => !tangents,
            _ => false,
        };
        if is_skipped {
            continue;
        }
        let name = semantic.to_string();
        let Some(id) = ids.get(&name) else { continue };
        let id = id.as_u64().and_then(|id| u32::try_from(id).ok()).ok_or_else(|| {
            Diagnostic::invalid(&format!("{pointer}/attributes/{name}"), "expected an integer")
        })?;
        attributes.push((accessor.value(), id));
    }
    Ok(attributes)
}

#[cfg(not(feature = "draco"))]
impl DracoStream<'_> {
    /// Rejects every stream as missing data, because the `draco` feature is disabled.
    fn decode_mesh(self) -> Result<DracoData, Diagnostic> {
        Err(Diagnostic::missing_data(
            &self.pointer,
            "the data is compressed with Draco, which is not supported",
        ))
    }
}

#[cfg(feature = "draco")]
mod decoder {
    use super::{Diagnostic, DracoData, DracoStream};
    use draco_core::{
        DataType, DecodeLimits, DecoderBuffer, Mesh, MeshDecoder, PointAttribute, PointIndex,
    };
    use files::counted;
    use gltf::json::accessor::ComponentType;
    use std::collections::BTreeMap;

    impl DracoStream<'_> {
        /// Decodes the stream and checks its counts against the accessors.
        ///
        /// The memory budget is charged first, with 16 bytes per vertex per attribute. The
        /// decoder's limits are set from the accessors, so a stream cannot create more vertices
        /// than they declare.
        ///
        /// # Errors
        /// Fails if the stream is malformed, or its counts of vertices, indices or components do
        /// not match the accessors.
        pub(super) fn decode_mesh(self) -> Result<DracoData, Diagnostic> {
            for &(accessor, _) in &self.attributes {
                self.source.charge_array(accessor, self.vertices, 16)?;
            }
            let faces = self.indices.map(|(_, count)| count as u64 / 3);
            let mut mesh = Mesh::new();
            let limits = DecodeLimits::default()
                .with_max_points(self.vertices as u64)
                .with_max_faces(faces.unwrap_or(self.source.limits.array_bytes / 12))
                .with_max_decoded_bytes(self.source.limits.array_bytes);
            let mut buffer = DecoderBuffer::new(self.bytes).with_limits(limits);
            MeshDecoder::new().decode(&mut buffer, &mut mesh).map_err(|error| {
                let message = format!("invalid Draco stream: {}", error.message());
                Diagnostic::invalid(&self.pointer, message)
            })?;
            if mesh.num_points() != self.vertices {
                let actual = counted(mesh.num_points(), "vertex", "vertices");
                let promised = self.vertices;
                let message = format!(
                    "the stream has {actual}, but the accessors \
                     declare {promised}"
                );
                return Err(Diagnostic::invalid(&self.pointer, message));
            }
            let indices = self.decode_indices(&mesh)?;
            let mut attributes = BTreeMap::new();
            for &(accessor, id) in &self.attributes {
                attributes.insert(accessor, self.decode_attribute(&mesh, accessor, id)?);
            }
            Ok(DracoData { indices, attributes })
        }

        /// Returns the vertex indices of the faces. Fails if the accessor declares a different
        /// number.
        ///
        /// If the primitive has no index accessor but the stream contains faces, their indices are
        /// used.
        fn decode_indices(&self, mesh: &Mesh) -> Result<Vec<u32>, Diagnostic> {
            let actual = 3 * mesh.num_faces();
            if let Some((accessor, count)) = self.indices
                && actual != count
            {
                let message =
                    format!("the accessor has {count} indices, but the Draco stream has {actual}");
                return Err(Diagnostic::invalid(&format!("/accessors/{accessor}/count"), message));
            }
            let accessor = self.indices.map_or(0, |(accessor, _)| accessor);
            self.source.charge_array(accessor, actual, 4)?;
            Ok(mesh.faces().iter().flatten().map(|&PointIndex(index)| index).collect())
        }

        /// Returns the elements of an attribute in the format of its accessor.
        ///
        /// The bytes are little-endian, as in a buffer.
        ///
        /// # Errors
        /// Fails if the stream has no attribute with this id, the number of components differs, or
        /// a vertex has no value.
        fn decode_attribute(
            &self,
            mesh: &Mesh,
            accessor: usize,
            id: u32,
        ) -> Result<Vec<u8>, Diagnostic> {
            let elements = self.source.resolve_accessor(accessor, &self.pointer)?;
            let (shape, component) = (elements.element_type, elements.component_type);
            let invalid = |message: String| Err(Diagnostic::invalid(&self.pointer, message));
            let Some(attribute) = mesh.attribute_by_unique_id(id) else {
                return invalid(format!("the stream has no attribute {id}"));
            };
            let (actual, expected) =
                (usize::from(attribute.num_components()), shape.multiplicity());
            if actual != expected {
                return invalid(format!(
                    "the component count of attribute {id} is {actual}, not {expected}"
                ));
            }
            let mut bytes = Vec::with_capacity(self.vertices * expected * component.size());
            for vertex in 0..self.vertices {
                match attribute_value(attribute, vertex) {
                    Some(value) => {
                        append_converted(&mut bytes, value, attribute.data_type(), component);
                    }
                    None => {
                        return invalid(format!("attribute {id} has no value for vertex {vertex}"));
                    }
                }
            }
            Ok(bytes)
        }
    }

    /// Returns the bytes of an attribute at a vertex.
    ///
    /// Draco stores each distinct value once and maps vertices to values. All offsets are checked,
    /// because they come from the stream.
    fn attribute_value(attribute: &PointAttribute, vertex: usize) -> Option<&[u8]> {
        let vertex = PointIndex(u32::try_from(vertex).ok()?);
        let at = attribute.mapped_index(vertex).0 as usize;
        let size = usize::from(attribute.num_components()) * attribute.data_type().byte_length();
        let start = at.checked_mul(usize::try_from(attribute.byte_stride()).ok()?)?;
        attribute.buffer().data().get(start..)?.get(..size)
    }

    /// Appends a value, converted to the component type of the accessor; the types almost always
    /// match.
    ///
    /// Numbers are converted by value with saturation and not rescaled, because the decoder has
    /// already dequantized them.
    fn append_converted(bytes: &mut Vec<u8>, value: &[u8], from: DataType, to: ComponentType) {
        let same = match to {
            ComponentType::I8 => from == DataType::Int8,
            ComponentType::U8 => from == DataType::Uint8,
            ComponentType::I16 => from == DataType::Int16,
            ComponentType::U16 => from == DataType::Uint16,
            ComponentType::U32 => from == DataType::Uint32,
            ComponentType::F32 => from == DataType::Float32,
        };
        if same {
            bytes.extend(value);
            return;
        }
        for word in value.chunks_exact(from.byte_length().max(1)) {
            let number = read_number(word, from);
            match to {
                ComponentType::I8 => bytes.extend((number as i8).to_le_bytes()),
                ComponentType::U8 => bytes.extend((number as u8).to_le_bytes()),
                ComponentType::I16 => bytes.extend((number as i16).to_le_bytes()),
                ComponentType::U16 => bytes.extend((number as u16).to_le_bytes()),
                ComponentType::U32 => bytes.extend((number as u32).to_le_bytes()),
                ComponentType::F32 => bytes.extend((number as f32).to_le_bytes()),
            }
        }
    }

    /// Reads a little-endian number of any Draco type.
    ///
    /// Missing high bytes are treated as zeros. Types not listed here are read as unsigned
    /// integers.
    fn read_number(word: &[u8], kind: DataType) -> f64 {
        let mut bytes = [0; 8];
        for (to, &from) in bytes.iter_mut().zip(word) {
            *to = from;
        }
        let [a, b, c, d, ..] = bytes;
        match kind {
            DataType::Int8 => f64::from(a.cast_signed()),
            DataType::Int16 => f64::from(i16::from_le_bytes([a, b])),
            DataType::Int32 => f64::from(i32::from_le_bytes([a, b, c, d])),
            DataType::Int64 => i64::from_le_bytes(bytes) as f64,
            DataType::Float32 => f64::from(f32::from_le_bytes([a, b, c, d])),
            DataType::Float64 => f64::from_le_bytes(bytes),
            _ => u64::from_le_bytes(bytes) as f64,
        }
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        #[test]
        fn numbers_are_converted_by_value() {
            let cases: [(&[u8], DataType, ComponentType, &[u8]); 6] = [
                (&[1, 2], DataType::Uint16, ComponentType::U16, &[1, 2]),
                (&[0xFF], DataType::Int8, ComponentType::I16, &[0xFF, 0xFF]),
                (&[0xFF], DataType::Uint8, ComponentType::U16, &[0xFF, 0]),
                (&[3, 0, 0, 0], DataType::Int32, ComponentType::F32, &3.0f32.to_le_bytes()),
                (&[0, 0, 0x80, 0x40], DataType::Float32, ComponentType::U8, &[4]),
                (&[0xFF, 0xFF, 1, 0], DataType::Uint32, ComponentType::U8, &[0xFF]),
            ];
            for (value, from, to, expected) in cases {
                let mut bytes = Vec::new();
                append_converted(&mut bytes, value, from, to);
                assert_eq!(bytes, expected, "{from:?} as {to:?}");
            }
        }
    }
}
