//! Animations with wrong keys and values.

use crate::hostile::case::{Case, Expected};
use alberti_tests::gltf::{Document, float_bytes};
use serde_json::{Value, json};

/// Returns a document that animates translation, rotation, scale and morph weights, with every
/// interpolation mode.
fn animated_document() -> Document {
    let mut document = Document::with_all_members();
    let scalars = |count: usize| json!({"componentType": 5126, "type": "SCALAR", "count": count});
    let times = document.add_accessor(&float_bytes(&[0.5, 1.0]), scalars(2));
    let weights = document.add_accessor(&float_bytes(&[0.0, 0.0, 1.0, 0.0, 1.0, 0.0]), scalars(6));
    let vec3 = json!({"componentType": 5126, "type": "VEC3", "count": 2});
    let scales = document.add_accessor(&float_bytes(&[1.0, 1.0, 1.0, 2.0, 2.0, 2.0]), vec3);
    let vec4 = json!({"componentType": 5122, "type": "VEC4", "count": 2, "normalized": true});
    let turns = [[0, 0, 0, 32_767i16], [0, 23_170, 0, 23_170]];
    let turns: Vec<u8> = turns.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    let rotations = document.add_accessor(&turns, vec4);
    document.json["animations"] = json!([{
    "samplers": [
        {"input": times, "output": scales},
        {"input": times, "output": rotations, "interpolation": "LINEAR"},
        {"input": times, "output": weights, "interpolation": "CUBICSPLINE"},
        {"input": times, "output": scales, "interpolation": "STEP"},
    ],
    "channels": [
        {"sampler": 0, "target": {"node": 1, "path": "translation"}},
        {"sampler": 1, "target": {"node": 1, "path": "rotation"}},
        {"sampler": 2, "target": {"node": 0, "path": "weights"}},
        {"sampler": 3, "target": {"node": 1, "path": "scale"}},
    ]}]);
    document
}

pub fn animation_cases() -> Vec<Case> {
    let whole = animated_document();
    let mut cases = vec![Case::from_document("animation: whole", &whole, Expected::LoadsClean)];
    let accessors = whole.json["accessors"].as_array().map_or(0, Vec::len);
    // Every word of the times and values is replaced by numbers that are invalid or extreme.
    for accessor in accessors - 4..accessors {
        let view = whole.json["accessors"][accessor]["bufferView"].as_u64().unwrap_or(0);
        let view = &whole.json["bufferViews"][view as usize];
        let number = |key: &str| view[key].as_u64().unwrap_or(0) as usize;
        let (start, length) = (number("byteOffset"), number("byteLength"));
        for at in (start..start + length).step_by(4) {
            for wrong in [f32::NAN, f32::INFINITY, f32::MAX, f32::MIN, -1.0, 0.0, 1e-45] {
                let mut document = whole.clone();
                document.bytes[at..at + 4].copy_from_slice(&wrong.to_le_bytes());
                let name = format!("animation: accessor {accessor}, byte {at} is {wrong}");
                cases.push(Case::from_document(name, &document, Expected::Loads));
            }
        }
    }
    cases.extend(member_cases(&whole));
    let warns = |text: &str| Expected::Warns(text.to_owned());
    let matrix = "/animations/0/channels/0/target/node node 2 has a matrix, which cannot be animated; \
                  the channel is skipped";
    let node = whole.clone().with_value("/animations/0/channels/0/target/node", json!(2));
    cases.push(Case::from_document("animation: target node has a matrix", &node, warns(matrix)));
    let few = "/animations/0/samplers/0/output wrong number of values: 6 values for 2 keys; \
               the channel is skipped";
    let cubic = whole.with_value("/animations/0/samplers/0/interpolation", json!("CUBICSPLINE"));
    cases.push(Case::from_document("animation: too few values", &cubic, warns(few)));
    cases
}

/// Returns cases in which each member is replaced by a wrong value.
fn member_cases(whole: &Document) -> Vec<Case> {
    let wrong: [Value; 10] = [
        json!(0),
        json!(1),
        json!(2),
        json!(99),
        json!("STEP"),
        json!("CUBICSPLINE"),
        json!("weights"),
        json!("scale"),
        json!("rotation"),
        json!([]),
    ];
    let mut cases = Vec::new();
    for sampler in 0..4 {
        for member in ["input", "output", "interpolation"] {
            for wrong in &wrong {
                let place = format!("/animations/0/samplers/{sampler}/{member}");
                let document = whole.clone().with_value(&place, wrong.clone());
                cases.push(Case::from_document(
                    format!("{place} is {wrong}"),
                    &document,
                    Expected::Anything,
                ));
            }
        }
        for member in ["sampler", "target/node", "target/path"] {
            for wrong in &wrong {
                let place = format!("/animations/0/channels/{sampler}/{member}");
                let document = whole.clone().with_value(&place, wrong.clone());
                cases.push(Case::from_document(
                    format!("{place} is {wrong}"),
                    &document,
                    Expected::Anything,
                ));
            }
        }
    }
    cases
}
