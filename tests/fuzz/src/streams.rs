//! Compressed geometry and images. A model is built around the bytes so that they reach their
//! decoder.
//!
//! The first bytes determine what the JSON says about the rest, so that the fuzzer can make the two
//! agree.

use crate::{glb, model};
use serde_json::{Value, json};

/// Tests a buffer view compressed with meshopt, used in a way that suits its mode.
///
/// | byte | meaning |
/// | --- | --- |
/// | 0 | mode and filter |
/// | 1 | stride in units of 4 bytes |
/// | 2, 3 | count |
/// | 4… | the stream |
pub fn meshopt(bytes: &[u8]) {
    let Some((&[kind, stride, low, high], stream)) = bytes.split_first_chunk() else { return };
    let (mode, filter) = match kind % 8 {
        0 => ("ATTRIBUTES", "NONE"),
        1 => ("ATTRIBUTES", "OCTAHEDRAL"),
        2 => ("ATTRIBUTES", "QUATERNION"),
        3 => ("ATTRIBUTES", "EXPONENTIAL"),
        4 => ("ATTRIBUTES", "COLOR"),
        5 => ("TRIANGLES", "NONE"),
        6 => ("INDICES", "NONE"),
        _ => ("ATTRIBUTES", "OTHER"),
    };
    let is_indices = matches!(mode, "TRIANGLES" | "INDICES");
    let stride =
        if is_indices { 2 + 2 * usize::from(stride & 1) } else { 4 * usize::from(stride % 65) };
    let count = usize::from(u16::from_le_bytes([low, high])) % 5000;
    let mut extension = json!({"buffer": 0, "byteLength": stream.len(), "byteStride": stride,
        "count": count, "mode": mode});
    if filter != "NONE" || kind & 8 != 0 {
        extension["filter"] = json!(filter);
    }
    let name = if kind & 16 == 0 { "EXT_meshopt_compression" } else { "KHR_meshopt_compression" };
    let mut view =
        json!({"buffer": 1, "byteLength": count * stride, "extensions": {name: extension}});
    let (accessors, primitive) = if is_indices {
        let component = if stride == 2 { 5123 } else { 5125 };
        let vertices = json!({"componentType": 5126, "type": "VEC3", "count": 1000});
        let indices =
            json!({"bufferView": 0, "componentType": component, "type": "SCALAR", "count": count});
        (json!([vertices, indices]), json!({"attributes": {"POSITION": 0}, "indices": 1}))
    } else {
        view["byteStride"] = json!(stride);
        let component = [5120, 5122, 5126][usize::from(stride >= 8) + usize::from(stride >= 12)];
        let position =
            json!({"bufferView": 0, "componentType": component, "type": "VEC3", "count": count});
        let attributes = if kind & 32 == 0 {
            json!({"POSITION": 0})
        } else {
            json!({"POSITION": 0, "NORMAL": 0})
        };
        (json!([position]), json!({"attributes": attributes, "mode": 0}))
    };
    let document = json!({
        "bufferViews": [view], "accessors": accessors, "meshes": [{"primitives": [primitive]}],
        "buffers": [{"byteLength": stream.len()},
            {"byteLength": count * stride, "extensions": {name: {"fallback": true}}}],
        "extensionsRequired": [name, "KHR_mesh_quantization"],
        "extensionsUsed": [name, "KHR_mesh_quantization"]});
    model::loaded(&whole(document, stream));
}

/// Tests a primitive compressed with Draco.
///
/// | byte | meaning |
/// | --- | --- |
/// | 0, 1 | vertex count |
/// | 2, 3 | face count |
/// | 4 | the stream's IDs for the positions (low 4 bits) and the normals (high 4 bits) |
/// | 5 | the same for the texture coordinates and the colors |
/// | 6… | the stream |
pub fn draco(bytes: &[u8]) {
    let Some((&[v0, v1, f0, f1, ids, more], stream)) = bytes.split_first_chunk() else { return };
    let vertices = u16::from_le_bytes([v0, v1]);
    let indices = 3 * usize::from(u16::from_le_bytes([f0, f1]));
    let float = |kind: &str| json!({"componentType": 5126, "type": kind, "count": vertices});
    let color =
        json!({"componentType": 5121, "type": "VEC4", "normalized": true, "count": vertices});
    let mut attributes = json!({"POSITION": 0});
    let mut numbers = json!({"POSITION": ids & 15});
    for (name, accessor, number) in
        [("NORMAL", 1, ids >> 4), ("TEXCOORD_0", 2, more & 15), ("COLOR_0", 3, more >> 4)]
    {
        // Twelve of the sixteen values are enough; the others mean that the attribute is absent.
        if number < 12 {
            attributes[name] = json!(accessor);
            numbers[name] = json!(number);
        }
    }
    let document = json!({
        "bufferViews": [{"buffer": 0, "byteLength": stream.len()}],
        "accessors": [float("VEC3"), float("VEC3"), float("VEC2"), color,
            {"componentType": 5125, "type": "SCALAR", "count": indices}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": 4,
            "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": numbers}}}]}],
        "buffers": [{"byteLength": stream.len()}],
        "extensionsRequired": ["KHR_draco_mesh_compression"],
        "extensionsUsed": ["KHR_draco_mesh_compression"]});
    model::loaded(&whole(document, stream));
}

/// Tests an image as the texture of a triangle; the first byte selects its declared type.
pub fn image(bytes: &[u8]) {
    let Some((&kind, file)) = bytes.split_first() else { return };
    let (mime, extension) = match kind % 5 {
        0 => ("image/png", ""),
        1 => ("image/jpeg", ""),
        2 => ("image/webp", "EXT_texture_webp"),
        3 => ("image/ktx2", "KHR_texture_basisu"),
        _ => ("image/any", ""),
    };
    let texture = match extension {
        "" => json!({"source": 0}),
        name => json!({"extensions": {name: {"source": 0}}}),
    };
    let mut document = json!({
        "bufferViews": [{"buffer": 0, "byteLength": file.len()}],
        "images": [{"bufferView": 0, "mimeType": mime}],
        "textures": [texture],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3,
                "sparse": {"count": 3, "indices": {"bufferView": 1, "componentType": 5121},
                    "values": {"bufferView": 2}}},
            {"componentType": 5126, "type": "VEC2", "count": 3}],
        "meshes": [{"primitives": [
            {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
        "buffers": [{"byteLength": file.len()}, {"byteLength": 40, "uri": CORNERS}]});
    document["bufferViews"].as_array_mut().into_iter().for_each(|views| {
        views.push(json!({"buffer": 1, "byteLength": 3}));
        views.push(json!({"buffer": 1, "byteOffset": 4, "byteLength": 36}));
    });
    if !extension.is_empty() {
        document["extensionsUsed"] = json!([extension]);
        document["extensionsRequired"] = json!([extension]);
    }
    model::file(&whole(document, file));
}

/// The numbers 0, 1 and 2 as bytes, one more byte, and the corners (0, 0, 0), (1, 0, 0), (0, 1, 0).
const CORNERS: &str =
    "data:application/octet-stream;base64,AAECAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA==";

/// Adds the boilerplate to a document and returns its file.
fn whole(mut document: Value, bytes: &[u8]) -> Vec<u8> {
    document["asset"] = json!({"version": "2.0"});
    document["scene"] = json!(0);
    document["scenes"] = json!([{"nodes": [0]}]);
    document["nodes"] = json!([{"mesh": 0}]);
    glb::glb(document.to_string().as_bytes(), bytes)
}
