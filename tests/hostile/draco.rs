//! Draco primitives with truncated or changed streams, and with wrong numbers.

use crate::hostile::case::{Case, Expected};
use alberti_tests::gltf::Document;
use serde_json::json;

/// A box of 24 vertices and 12 triangles, written by the Draco encoder for the sample BoxDraco.
const DRACO_BOX: [u8; 118] = [
    0x44, 0x52, 0x41, 0x43, 0x4F, 0x02, 0x02, 0x01, 0x01, 0x00, 0x00, 0x00, 0x08, 0x0C, 0x01, 0x0B,
    0x00, 0x00, 0x03, 0x5F, 0x5B, 0x0A, 0x01, 0x01, 0x10, 0x55, 0x04, 0x5C, 0xE3, 0x8D, 0x46, 0x02,
    0xFF, 0x00, 0x00, 0x00, 0x01, 0x00, 0x01, 0x00, 0x09, 0x03, 0x00, 0x01, 0x02, 0x01, 0x01, 0x09,
    0x03, 0x00, 0x00, 0x03, 0x01, 0x01, 0x01, 0x00, 0x03, 0x03, 0x01, 0x30, 0x01, 0x10, 0x03, 0x00,
    0x24, 0x96, 0x13, 0x0A, 0x24, 0x04, 0x00, 0x00, 0x00, 0x00, 0xFF, 0x3F, 0x00, 0x00, 0x00, 0x00,
    0x00, 0xBF, 0x00, 0x00, 0x00, 0xBF, 0x00, 0x00, 0x00, 0xBF, 0x00, 0x00, 0x80, 0x3F, 0x0E, 0x06,
    0x03, 0x01, 0x01, 0x01, 0x01, 0x01, 0x40, 0x01, 0x00, 0xFF, 0x03, 0x00, 0x00, 0xFF, 0x01, 0x00,
    0x00, 0xFF, 0x02, 0xA1, 0x41, 0x0A,
];

fn compressed_document(stream: &[u8]) -> Document {
    let mut document = Document::single_triangle();
    document.bytes.clear();
    document.json["bufferViews"] = json!([]);
    let view = document.add_buffer_view(stream);
    let accessor = |component: u32, shape: &str, count: usize| json!({"componentType": component, "type": shape, "count": count});
    document.json["accessors"] = json!([
        accessor(5126, "VEC3", 24),
        accessor(5123, "SCALAR", 36),
        accessor(5126, "VEC3", 24)
    ]);
    document.with_value(
        "/meshes/0/primitives/0",
        json!({"attributes": {"POSITION": 0, "NORMAL": 2}, "indices": 1, "extensions": {
            "KHR_draco_mesh_compression": {"bufferView": view, "attributes": {"NORMAL": 0, "POSITION": 1}}}}),
    )
}

/// Returns all Draco cases.
pub fn draco_cases() -> Vec<Case> {
    let whole = compressed_document(&DRACO_BOX);
    let mut cases = vec![Case::from_document("draco: whole", &whole, Expected::LoadsClean)];
    for end in 0..DRACO_BOX.len() {
        let document = compressed_document(&DRACO_BOX[..end]);
        cases.push(Case::from_document(
            format!("draco: truncated at {end}"),
            &document,
            Expected::Refused,
        ));
    }
    for at in 0..DRACO_BOX.len() {
        for change in [0x01, 0x02, 0x10, 0x40, 0x80, 0xFF] {
            let mut stream = DRACO_BOX;
            stream[at] ^= change;
            let name = format!("draco: byte {at} xor {change:#x}");
            cases.push(Case::from_document(
                name,
                &compressed_document(&stream),
                Expected::Anything,
            ));
        }
    }
    cases.extend(wrong_member_cases(&whole));
    cases.push(Case::from_document(
        "draco: more triangles than indices",
        &whole.with_value("/accessors/1/count", json!(33)),
        Expected::Says(
            "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: invalid Draco stream: \
             stream decodes 12 faces, over the caller's ceiling of 11; export the file again"
                .to_owned(),
        ),
    ));
    cases
}

/// Returns cases in which members of the extension and of its accessors have wrong values.
fn wrong_member_cases(whole: &Document) -> Vec<Case> {
    let mut cases = Vec::new();
    let wrong = [
        json!(null),
        json!("x"),
        json!(-1),
        json!(0),
        json!(1),
        json!(2),
        json!(25),
        json!(1u64 << 32),
        json!(u64::MAX),
        json!([]),
        json!({}),
    ];
    for member in [
        "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression",
        "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/bufferView",
        "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/attributes",
        "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/attributes/POSITION",
        "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/attributes/NORMAL",
        "/meshes/0/primitives/0/mode",
        "/accessors/0/count",
        "/accessors/1/count",
        "/accessors/2/count",
    ] {
        for wrong in &wrong {
            let document = whole.clone().with_value(member, wrong.clone());
            cases.push(Case::from_document(
                format!("draco: {member} is {wrong}"),
                &document,
                Expected::Anything,
            ));
        }
    }
    cases
}
