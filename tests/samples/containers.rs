//! File containers: JSON with data URIs, JSON with files in the same folder, and intact and broken
//! binary containers.

use super::{Sample, textured_quad, triangle};
use crate::gltf::{Document, encode_png};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::json;

/// Returns all samples that concern containers and URIs.
pub(super) fn container_samples() -> Vec<Sample> {
    let mut samples = json_files();
    samples.extend(broken_containers());
    samples.extend(broken_uris());
    samples
}

/// Returns the JSON of a document whose buffer is at a URI.
fn json_with_buffer(document: &Document, uri: &str) -> Vec<u8> {
    let mut document = document.clone();
    document.json["buffers"][0]["uri"] = json!(uri);
    document.json.to_string().into_bytes()
}

/// Returns a base64 data URI.
fn data_uri(mime_type: &str, bytes: &[u8]) -> String {
    format!("data:{mime_type};base64,{}", STANDARD.encode(bytes))
}

/// Returns valid `.gltf` files.
fn json_files() -> Vec<Sample> {
    let plain = triangle();
    let embedded = data_uri("application/octet-stream", &plain.bytes);
    let material = json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}});
    let mut picture_beside = textured_quad(&material);
    picture_beside.json["images"] = json!([{"uri": "textures/gray.png"}]);
    let mut picture_embedded = textured_quad(&material);
    picture_embedded.json["images"] = json!([{"uri": data_uri("image/png", &encode_png(2, 2))}]);
    let gltf = |name: &str, document: &Document, uri: &str, triangles| {
        Sample::valid(name, "model.gltf", json_with_buffer(document, uri), triangles)
    };
    vec![
        gltf("data-uri", &plain, &embedded, 1),
        gltf("buffer-beside", &plain, "model.bin", 1).beside("model.bin", plain.bytes.clone()),
        gltf("escaped uri", &plain, "my%20buffer.bin", 1)
            .beside("my buffer.bin", plain.bytes.clone()),
        gltf("ünï cödé", &plain, "Größe.bin", 1).beside("Größe.bin", plain.bytes.clone()),
        gltf("picture-beside", &picture_beside, "model.bin", 2)
            .beside("model.bin", picture_beside.bytes.clone())
            .beside("textures/gray.png", encode_png(2, 2)),
        gltf("picture-embedded", &picture_embedded, "model.bin", 2)
            .beside("model.bin", picture_embedded.bytes.clone()),
    ]
}

/// A change to a container's bytes.
type Damage = fn(&mut Vec<u8>);

/// Returns binary files with a wrong header or wrong chunks.
fn broken_containers() -> Vec<Sample> {
    let damages: [(&str, Damage, &[&str]); 8] = [
        ("glb-of-version-1", |file| file[4] = 1, &["GLB_INVALID_VERSION"]),
        ("glb-header-cut-off", |file| file.truncate(9), &["GLB_UNEXPECTED_END_OF_HEADER"]),
        ("glb-cut-off", |file| file.truncate(file.len() - 8), &["GLB_LENGTH_MISMATCH"]),
        ("glb-longer-than-the-file", |file| file[8] += 4, &["GLB_LENGTH_MISMATCH"]),
        (
            "glb-binary-chunk-first",
            |file| file[16..20].copy_from_slice(b"BIN\0"),
            &["GLB_DUPLICATE_CHUNK", "GLB_UNEXPECTED_FIRST_CHUNK"],
        ),
        ("glb-unaligned-chunk", |file| file[12] -= 1, &["GLB_CHUNK_LENGTH_UNALIGNED"]),
        ("glb-not-json", |file| file[20] = b'[', &["INVALID_JSON"]),
        ("glb-not-utf-8", |file| file[22] = 0xFF, &["INVALID_JSON"]),
    ];
    let damaged = |(name, damage, errors): (&str, Damage, &[&str])| {
        let mut file = triangle().to_glb();
        damage(&mut file);
        Sample::broken(name, "model.glb", file, errors)
    };
    let texts: [(&str, &[u8], &str); 5] = [
        ("empty-file", b"", "NOT_GLTF"),
        ("json-cut-off", b"{\"asset\": {\"version\"", "INVALID_JSON"),
        ("json-array", b"[1, 2, 3]", "TYPE_MISMATCH"),
        ("json-without-asset", b"{}", "UNDEFINED_PROPERTY"),
        ("version-1", b"{\"asset\": {\"version\": \"1.0\"}}", "UNKNOWN_ASSET_MAJOR_VERSION"),
    ];
    let text = |(name, text, error): (&str, &[u8], &str)| {
        Sample::broken(name, "model.gltf", text.to_vec(), &[error])
    };
    damages.into_iter().map(damaged).chain(texts.into_iter().map(text)).collect()
}

/// Returns files whose URIs cannot be resolved.
fn broken_uris() -> Vec<Sample> {
    let cases = [
        ("missing-buffer-file", "missing.bin", "IO_ERROR"),
        ("invalid-base64", "data:application/octet-stream;base64,!!!!", "INVALID_URI"),
        (
            "short-buffer",
            "data:application/octet-stream;base64,AAAA",
            "BUFFER_BYTE_LENGTH_MISMATCH",
        ),
    ];
    let sample = |(name, uri, error): (&str, &str, &str)| {
        Sample::broken(name, "model.gltf", json_with_buffer(&triangle(), uri), &[error])
    };
    cases.into_iter().map(sample).collect()
}
