//! meshopt views with wrong sizes, and with truncated, changed or invented streams.

use crate::hostile::case::{Case, Expected};
use alberti_tests::gltf::Document;
use serde_json::json;

/// Returns the triangle with positions and indices in meshopt streams. Every byte is stored in
/// full, and every index is written out.
fn compressed_document() -> Document {
    let mut document = Document::single_triangle();
    let plain = document.bytes.clone();
    document.bytes.clear();
    document.json["bufferViews"] = json!([]);
    let positions = document.add_buffer_view(&attribute_stream(&plain[..36], 12));
    let indices = document.add_buffer_view(&[0xD1, 0, 4, 4, 0, 0, 0, 0]);
    for (view, count, stride, mode) in
        [(positions, 3, 12, "ATTRIBUTES"), (indices, 3, 2, "INDICES")]
    {
        let view = &mut document.json["bufferViews"][view];
        let (start, length) = (view["byteOffset"].clone(), view["byteLength"].clone());
        *view = json!({"buffer": 1, "byteLength": count * stride, "extensions": {"EXT_meshopt_compression": {
            "buffer": 0, "byteOffset": start, "byteLength": length,
            "count": count, "byteStride": stride, "mode": mode}}});
    }
    let fallback =
        json!({"byteLength": 48, "extensions": {"EXT_meshopt_compression": {"fallback": true}}});
    let streams = document.json["buffers"][0].clone();
    document.with_value("/buffers", json!([streams, fallback]))
}

/// Returns a version 0 stream with up to 16 elements, in which every group has eight bits per
/// delta.
fn attribute_stream(elements: &[u8], stride: usize) -> Vec<u8> {
    let mut stream = vec![0xA0];
    for byte in 0..stride {
        let column = elements.iter().skip(byte).step_by(stride);
        let mut before = 0u8;
        stream.push(3);
        let start = stream.len();
        for &value in column {
            let delta = value.wrapping_sub(before);
            stream.push(if delta < 0x80 { delta << 1 } else { !(delta << 1) });
            before = value;
        }
        stream.resize(start + 16, 0);
    }
    stream.resize(stream.len() + stride.max(32), 0);
    stream
}

pub fn meshopt_cases() -> Vec<Case> {
    let mut cases =
        vec![Case::from_document("meshopt: whole", &compressed_document(), Expected::LoadsClean)];
    cases.extend(number_cases());
    cases.extend(stream_cases());
    cases.extend(oversized_count_cases());
    cases
}

/// Returns cases in which every number and string in the extension is replaced by a wrong value.
fn number_cases() -> Vec<Case> {
    let wrong = [
        json!(null),
        json!("x"),
        json!(-1),
        json!(0.5),
        json!(0),
        json!(1),
        json!(3),
        json!(4),
        json!(255),
        json!(256),
        json!(260),
        json!(1u64 << 32),
        json!(u64::MAX / 12),
        json!(u64::MAX),
        json!([]),
        json!({}),
        json!("TRIANGLES"),
        json!("INDICES"),
        json!("OCTAHEDRAL"),
        json!("EXPONENTIAL"),
    ];
    let members = ["buffer", "byteOffset", "byteLength", "count", "byteStride", "mode", "filter"];
    let mut cases = Vec::new();
    for view in [0, 1] {
        for member in members {
            for wrong in &wrong {
                let place =
                    format!("/bufferViews/{view}/extensions/EXT_meshopt_compression/{member}");
                let document = compressed_document().with_value(&place, wrong.clone());
                cases.push(Case::from_document(
                    format!("{place} is {wrong}"),
                    &document,
                    Expected::Anything,
                ));
            }
        }
    }
    for extension in [json!(null), json!(7), json!("x"), json!([]), json!({})] {
        let place = "/bufferViews/0/extensions/EXT_meshopt_compression";
        let document = compressed_document().with_value(place, extension.clone());
        cases.push(Case::from_document(
            format!("{place} is {extension}"),
            &document,
            Expected::Refused,
        ));
    }
    cases
}

/// Returns cases in which the streams are truncated at every byte and every byte is changed.
fn stream_cases() -> Vec<Case> {
    let whole = compressed_document();
    let mut cases = Vec::new();
    for view in [0, 1] {
        let length =
            &whole.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"]["byteLength"];
        let place = format!("/bufferViews/{view}/extensions/EXT_meshopt_compression/byteLength");
        for end in 0..length.as_u64().unwrap_or(0) {
            let document = whole.clone().with_value(&place, json!(end));
            cases.push(Case::from_document(
                format!("{place} is {end}"),
                &document,
                Expected::Refused,
            ));
        }
    }
    for at in 0..whole.bytes.len() {
        for change in [0x01, 0x10, 0x80, 0xFF] {
            let mut document = whole.clone();
            document.bytes[at] ^= change;
            let name = format!("meshopt: byte {at} xor {change:#x}");
            cases.push(Case::from_document(name, &document, Expected::Anything));
        }
    }
    cases
}

/// Returns cases with short streams that claim to be long.
fn oversized_count_cases() -> Vec<Case> {
    let claim = |mode: &str, stream: &[u8], count: u64, expected: Expected| {
        let mut document = compressed_document();
        let view = document.add_buffer_view(stream);
        let start = document.json["bufferViews"][view]["byteOffset"].clone();
        let length = stream.len();
        let document = document
            .with_value(
                &format!("/bufferViews/{view}"),
                json!({"buffer": 1, "byteLength": count.saturating_mul(4), "extensions": {"KHR_meshopt_compression": {
                    "buffer": 0, "byteOffset": start, "byteLength": length,
                    "count": count, "byteStride": 4, "mode": mode}}}),
            )
            .with_value(
                "/accessors/1",
                json!({"bufferView": view, "componentType": 5125, "type": "SCALAR", "count": 3}),
            );
        Case::from_document(
            format!("meshopt: {count} elements in mode {mode}"),
            &document,
            expected,
        )
    };
    let mut cases = Vec::new();
    for mode in ["ATTRIBUTES", "TRIANGLES", "INDICES"] {
        for stream in [&[0xA0; 64], &[0xA1; 64], &[0xE1; 64], &[0xD1; 64]] {
            for count in [3_000, 3_000_000, 3_000_000_000, u64::MAX / 12 * 3] {
                cases.push(claim(mode, stream, count, Expected::Refused));
            }
        }
    }
    // The cheapest encoding: 4,096 bytes that declare a million identical elements.
    let mut same = vec![0b10_10_10_10; 4_096];
    same[0] = 0xA1;
    let end = same.len() - 24;
    same[end..].fill(0);
    cases.push(claim("ATTRIBUTES", &same, 256 * 4_071, Expected::Loads));
    cases
}
