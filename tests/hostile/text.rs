//! JSON that is deep, large, oddly encoded or not JSON; unknown versions and extensions.

use crate::hostile::case::{Case, Expected};
use alberti_tests::gltf::Document;
use scene_models::glb::encode_glb;
use serde_json::{Value, json};

fn text_case(name: &str, text: impl Into<Vec<u8>>, expected: Expected) -> Case {
    Case::new(format!("text: {name}"), text.into(), expected)
}

fn refusal_containing(text: &str) -> Expected {
    Expected::Says(text.to_owned())
}

/// Returns the text of a valid document with one additional member.
fn triangle_with_member(member: &str) -> String {
    format!(r#"{{"asset": {{"version": "2.0"}}, {member}}}"#)
}

/// Returns all cases that concern the text of a file.
pub fn text_cases() -> Vec<Case> {
    let mut cases = encoding_cases();
    cases.extend(json_cases());
    cases.extend(version_cases());
    cases.extend(extension_cases());
    cases.extend(container_cases());
    cases
}

/// Returns cases with empty files, other formats, and encodings other than UTF-8.
fn encoding_cases() -> Vec<Case> {
    let utf16: Vec<u8> = "\u{FEFF}{}".encode_utf16().flat_map(u16::to_le_bytes).collect();
    vec![
        text_case("empty", "", refusal_containing("the file is empty; use a .gltf or .glb file")),
        text_case(
            "blanks",
            " \n\t ",
            refusal_containing("the file is empty; use a .gltf or .glb file"),
        ),
        text_case(
            "not glTF",
            "solid cube",
            refusal_containing(
                "this is not a glTF file: it starts neither with { nor with glTF; use a .gltf or .glb file",
            ),
        ),
        text_case("UTF-16", utf16, refusal_containing("the text is in UTF-16; save it as UTF-8")),
        text_case(
            "byte order mark",
            format!("\u{FEFF}{}", triangle_with_member(r#""nodes": []"#)),
            Expected::LoadsClean,
        ),
        text_case(
            "not UTF-8",
            b"{\"asset\": {\"version\": \"2.0\xFF\"}}".to_vec(),
            Expected::Refused,
        ),
    ]
}

/// Returns cases with deep, long and malformed JSON.
fn json_cases() -> Vec<Case> {
    let deep = |n: usize| {
        triangle_with_member(&format!(r#""extras": {}{}"#, "[".repeat(n), "]".repeat(n)))
    };
    vec![
        text_case("119 deep", deep(119), Expected::LoadsClean),
        text_case("120 deep", deep(120), Expected::Refused),
        text_case("100,000 deep", deep(100_000), Expected::Refused),
        text_case("100,000 open", "[{".repeat(50_000), Expected::Refused),
        text_case("100,000 open objects", "{\"a\":".repeat(100_000), Expected::Refused),
        text_case(
            "20,000,000 values",
            triangle_with_member(&format!(r#""extras": [{}0]"#, "0,".repeat(20_000_000))),
            refusal_containing(
                "the JSON has 20000023 values, more than the limit of 16000000; raise the limit `json_values` (--max-json-values) if you trust the file",
            ),
        ),
        text_case(
            "one long string",
            triangle_with_member(&format!(r#""extras": "{}""#, "x".repeat(4_000_000))),
            Expected::LoadsClean,
        ),
        text_case(
            "an unterminated string",
            triangle_with_member(&format!(r#""extras": "{}\"#, "x".repeat(1000))),
            Expected::Refused,
        ),
        text_case("NaN", triangle_with_member(r#""extras": NaN"#), Expected::Refused),
        text_case("1e999", triangle_with_member(r#""extras": 1e999"#), Expected::Refused),
        text_case(
            "a long number",
            triangle_with_member(&format!(r#""extras": {}"#, "9".repeat(100_000))),
            Expected::Refused,
        ),
        text_case("an extra comma", triangle_with_member(r#""nodes": [],"#), Expected::Refused),
        text_case(
            "a duplicate member",
            triangle_with_member(r#""nodes": [], "nodes": [{}]"#),
            Expected::Anything,
        ),
        text_case(
            "data after the end",
            format!("{} {{}}", triangle_with_member(r#""nodes": []"#)),
            Expected::Refused,
        ),
        text_case("an array", "[]", Expected::Refused),
        text_case(
            "comments",
            format!("// hello\n{}", triangle_with_member(r#""nodes": []"#)),
            Expected::Refused,
        ),
    ]
}

fn version_cases() -> Vec<Case> {
    let version = |value: Value, expected: Expected| {
        let name = format!("version {value}");
        Case::from_document(
            name,
            &Document::single_triangle().with_value("/asset", value),
            expected,
        )
    };
    let unknown = |member: &str, version: &str| {
        refusal_containing(&format!(
            "/asset/{member}: the file is glTF {version}, but only glTF 2.0 is supported; \
             convert it to glTF 2.0"
        ))
    };
    let missing = refusal_containing(
        "/asset/version: the glTF version is missing; check that this is a glTF file; \
         a glTF 2.0 file contains \"asset\": {\"version\": \"2.0\"}",
    );
    vec![
        version(json!({"version": "1.0"}), unknown("version", "1.0")),
        version(json!({"version": "3.0"}), unknown("version", "3.0")),
        version(json!({"version": "20.0"}), unknown("version", "20.0")),
        version(json!({"version": "2.0", "minVersion": "2.1"}), unknown("minVersion", "2.1")),
        version(json!({"version": "2.1"}), Expected::LoadsClean),
        version(json!({}), missing),
        version(json!({"version": 2.0}), Expected::Refused),
        version(json!("2.0"), Expected::Refused),
    ]
}

fn extension_cases() -> Vec<Case> {
    let required = |name: &str, expected: Expected| {
        let document = Document::single_triangle().with_value("/extensionsRequired", json!([name]));
        Case::from_document(format!("requires {name}"), &document, expected)
    };
    let lacking = |name: &str, reason: &str| {
        refusal_containing(&format!(
            "/extensionsRequired/0: the file requires the extension {name}: {reason}; export the \
             file without it, or load the rest with --lenient"
        ))
    };
    vec![
        required("ACME_gizmo", lacking("ACME_gizmo", "it is not supported")),
        required("", lacking("", "it is not supported")),
        required("KHR_texture_basisu", Expected::LoadsClean),
        required("KHR_materials_unlit", Expected::LoadsClean),
    ]
}

fn container_cases() -> Vec<Case> {
    let json = Document::single_triangle().json.to_string();
    let bytes = Document::single_triangle().bytes;
    let with_length = |length: u32| {
        let mut file = encode_glb(json.as_bytes(), &bytes);
        file[8..12].copy_from_slice(&length.to_le_bytes());
        file
    };
    let mut cases = Vec::new();
    for length in [0, 1, 11, 12, 19, 20, 21, u32::MAX / 2, u32::MAX] {
        cases.push(Case::new(
            format!("glb length {length}"),
            with_length(length),
            Expected::Refused,
        ));
    }
    for at in [12, 20 + json.len().next_multiple_of(4)] {
        for length in [0, 1, 3, 5, 1000, u32::MAX - 7, u32::MAX] {
            let mut file = encode_glb(json.as_bytes(), &bytes);
            file[at..at + 4].copy_from_slice(&length.to_le_bytes());
            cases.push(Case::new(
                format!("chunk at {at}, length {length}"),
                file,
                Expected::Refused,
            ));
        }
    }
    let mut longer = encode_glb(json.as_bytes(), &bytes);
    longer.extend([0; 5]);
    let ignored = Expected::Warns(" ignored 5 bytes after the end of the GLB".to_owned());
    cases.push(Case::new("glb with data after it", longer, ignored));
    cases.push(Case::new(
        "glb without binary chunk",
        encode_glb(json.as_bytes(), &[]),
        Expected::Anything,
    ));
    cases
}
