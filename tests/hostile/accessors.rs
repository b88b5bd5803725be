//! Accessors and views with wrong counts, offsets, lengths and strides.

use crate::hostile::case::{Case, Expected};
use alberti_tests::gltf::{Document, float_bytes};
use serde_json::{Value, json};

pub fn accessor_cases() -> Vec<Case> {
    let mut cases = number_cases();
    cases.extend(stride_cases());
    cases.extend(sparse_cases());
    cases.extend(value_cases());
    cases.extend(zero_cases());
    cases
}

/// Returns cases in which every number in accessors, views and buffers is replaced by wrong
/// numbers.
fn number_cases() -> Vec<Case> {
    let wrong = [
        json!(0),
        json!(1),
        json!(2),
        json!(4),
        json!(35),
        json!(36),
        json!(37),
        json!(65_535),
        json!(4_000_000_000u64),
        json!(4_294_967_295u64),
        json!(4_294_967_296u64),
        json!(u64::MAX / 12),
        json!(u64::MAX - 1),
        json!(u64::MAX),
        json!(1e300),
        json!(-1),
        json!(0.5),
        json!(1u64 << 40),
    ];
    let members = [
        "/accessors/0/count",
        "/accessors/0/byteOffset",
        "/accessors/0/bufferView",
        "/accessors/0/componentType",
        "/accessors/1/count",
        "/accessors/1/byteOffset",
        "/accessors/1/bufferView",
        "/bufferViews/0/byteLength",
        "/bufferViews/0/byteOffset",
        "/bufferViews/0/byteStride",
        "/bufferViews/0/buffer",
        "/buffers/0/byteLength",
        "/bufferViews/1/byteLength",
        "/bufferViews/1/byteOffset",
        "/bufferViews/1/byteStride",
        "/accessors/0/sparse/count",
        "/accessors/0/sparse/indices/bufferView",
        "/accessors/0/sparse/indices/byteOffset",
        "/accessors/0/sparse/values/bufferView",
        "/accessors/0/sparse/values/byteOffset",
        "/meshes/0/primitives/0/indices",
        "/meshes/0/primitives/0/attributes/POSITION",
        "/meshes/0/primitives/0/attributes/NORMAL",
        "/meshes/0/primitives/0/mode",
        "/meshes/0/primitives/0/material",
    ];
    let spoil = |(member, value): (&str, &Value)| {
        let document = Document::with_all_members().with_value(member, value.clone());
        Case::from_document(format!("{member} is {value}"), &document, Expected::Anything)
    };
    members
        .into_iter()
        .flat_map(|member| wrong.iter().map(move |value| (member, value)))
        .map(spoil)
        .collect()
}

/// Returns cases with every stride from 0 to 300 over positions that fit three elements of stride
/// 252.
fn stride_cases() -> Vec<Case> {
    let stride = |stride: usize| {
        let mut document = Document::single_triangle();
        let bytes = vec![0; 2 * 252 + 12];
        let accessor = json!({"componentType": 5126, "type": "VEC3", "count": 3});
        let number = document.add_accessor(&bytes, accessor);
        let view = document.json["accessors"][number]["bufferView"].clone();
        document.json["bufferViews"][view.as_u64().unwrap_or(0) as usize]["byteStride"] =
            json!(stride);
        document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(number);
        let expected =
            if (12..=252).contains(&stride) { Expected::LoadsClean } else { Expected::Refused };
        Case::from_document(format!("stride {stride}"), &document, expected)
    };
    (0..=300).map(stride).collect()
}

fn sparse_cases() -> Vec<Case> {
    let case = |name: &str, indices: &[u8], sparse: Value, expected: Expected| {
        let mut document = Document::single_triangle();
        let at = document.add_buffer_view(indices);
        let values = document.add_buffer_view(&float_bytes(&[9.0; 6]));
        let mut sparse = sparse;
        sparse["indices"] = json!({"bufferView": at, "componentType": 5121});
        sparse["values"] = json!({"bufferView": values});
        Case::from_document(
            format!("sparse: {name}"),
            &document.with_value("/accessors/0/sparse", sparse),
            expected,
        )
    };
    let refused = |text: &str| Expected::Says(text.to_owned());
    vec![
        case("two of three", &[0, 2], json!({"count": 2}), Expected::LoadsClean),
        case("none", &[], json!({"count": 0}), Expected::Loads),
        case(
            "out of range",
            &[0, 3],
            json!({"count": 2}),
            refused(
                "/accessors/0/sparse/indices: the sparse index 3 is out of range for a count of \
                 3; export the file again",
            ),
        ),
        case("falling", &[2, 0], json!({"count": 2}), Expected::Loads),
        case("doubled", &[1, 1], json!({"count": 2}), Expected::Loads),
        case("too many", &[0, 1], json!({"count": 3}), Expected::Refused),
        case("far too many", &[0, 1], json!({"count": u64::MAX}), Expected::Refused),
    ]
}

/// Returns cases with invalid positions and with indices that are out of range.
fn value_cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for wrong in
        [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN, f32::MIN_POSITIVE, 1e-45]
    {
        for accessor in [0, 2, 3, 6, 7, 8] {
            for word in 0..6 {
                let mut document = Document::with_all_members();
                let view = document.json["accessors"][accessor]["bufferView"].as_u64().unwrap_or(0);
                let start = document.json["bufferViews"][view as usize]["byteOffset"]
                    .as_u64()
                    .unwrap_or(0) as usize;
                if let Some(bytes) = document.bytes.get_mut(start + 4 * word..start + 4 * word + 4)
                {
                    bytes.copy_from_slice(&wrong.to_le_bytes());
                }
                cases.push(Case::from_document(
                    format!("accessor {accessor}, word {word} is {wrong}"),
                    &document,
                    Expected::Anything,
                ));
            }
        }
    }
    for index in [3u16, 4, 255, 256, u16::MAX] {
        for place in 0..3 {
            for mode in 0..=7 {
                let mut document = Document::single_triangle()
                    .with_value("/meshes/0/primitives/0/mode", json!(mode));
                document.bytes[36 + 2 * place..38 + 2 * place]
                    .copy_from_slice(&index.to_le_bytes());
                let expected = if mode == 7 { Expected::Refused } else { Expected::Loads };
                cases.push(Case::from_document(
                    format!("index {place} is {index} in mode {mode}"),
                    &document,
                    expected,
                ));
            }
        }
    }
    cases
}

/// Returns cases with accessors that are read as zeros because they have no data. The number of
/// zeros must be limited.
fn zero_cases() -> Vec<Case> {
    let case = |count: u64, expected: Expected| {
        let mut document = Document::single_triangle().without_value("/accessors/0/bufferView");
        document.json["accessors"][0]["count"] = json!(count);
        let document = document.without_value("/meshes/0/primitives/0/indices");
        Case::from_document(format!("{count} zeros"), &document, expected)
    };
    let grown = |bytes: u64| {
        Expected::Says(format!(
            "/accessors/0/count: the arrays take {bytes} bytes so far, more than 64 times the \
             size of the files; \
             raise the limit `array_growth` (--max-array-growth) if you trust the file"
        ))
    };
    let large = |bytes: u64| {
        Expected::Says(format!(
            "/accessors/0/count: the arrays take {bytes} bytes so far, more than the limit of \
             4294967296; \
             raise the limit `array_bytes` (--max-array-bytes) if you trust the file"
        ))
    };
    vec![
        case(3, Expected::LoadsClean),
        case(1_000_000, Expected::LoadsClean),
        case(5_000_000, grown(20_000_000)),
        case(4_000_000_000, large(16_000_000_000)),
        case(u64::MAX, large(u64::MAX)),
    ]
}
