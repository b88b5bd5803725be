//! Requests that cannot be answered return errors, and the next request works.

use super::{explorer_with_models, json, scenes_folder};
use explorer::Explorer;

fn code(explorer: &mut Explorer, query: &str) -> &'static str {
    let error = explorer.answer(query).expect_err(query);
    assert!(!error.message.is_empty() && !error.help.is_empty(), "{error:?}");
    error.code
}

#[test]
fn broken_models_are_reported_and_the_next_request_works() {
    let mut explorer = explorer_with_models();
    explorer.add_file("broken.glb", b"glTF, but not really".to_vec()).expect("a name");
    explorer.add_file("empty.glb", Vec::new()).expect("a name");
    for name in ["broken.glb", "empty.glb"] {
        for what in ["picture", "world", "volume", "state", "depth", "drawing"] {
            let query = format!("what={what}&lesson=model&model={name}");
            assert_eq!(code(&mut explorer, &query), "broken_model");
            assert!(explorer.answer("what=picture&size=8x8").is_ok());
        }
    }
}

#[test]
fn missing_models_are_reported() {
    let mut explorer = explorer_with_models();
    assert_eq!(code(&mut explorer, "what=picture&lesson=model"), "missing_model");
    assert_eq!(code(&mut explorer, "what=picture&lesson=model&model=no.glb"), "missing_model");
    assert_eq!(code(&mut Explorer::new(), "what=picture"), "missing_model");
    let chinese = explorer.answer("what=picture&lesson=model&lang=zh").expect_err("no model");
    assert_eq!(chinese.message, "还没有选择模型");
}

#[test]
fn file_names_outside_the_folder_are_rejected() {
    let mut explorer = Explorer::new();
    for name in ["", "/etc/passwd", "../a.glb", "a/../../b.glb"] {
        assert_eq!(explorer.add_file(name, Vec::new()).expect_err(name).code, "malformed_value");
    }
}

/// A glTF file finds its buffer in the same in-memory folder but nothing outside it.
#[test]
fn files_that_a_model_refers_to_are_found() {
    let mut explorer = Explorer::new();
    let document = |uri: &str| {
        format!(
            r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
            "nodes": [{{"mesh": 0}}], "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
            "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [0, 0, 0], "max": [1, 1, 0]}}], "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
            "buffers": [{{"byteLength": 36, "uri": "{uri}"}}]}}"#
        )
    };
    let corners: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let bytes: Vec<u8> = corners.iter().flat_map(|c| c.to_le_bytes()).collect();
    explorer.add_file("a/model.gltf", document("data/b.bin").into_bytes()).expect("a name");
    let state = "lesson=model&model=a/model.gltf";
    assert_eq!(code(&mut explorer, &format!("what=state&{state}")), "broken_model");
    explorer.add_file("a/data/b.bin", bytes).expect("a name");
    let said = json(&mut explorer, &format!("what=state&{state}"));
    assert_eq!(said["facts"]["triangles"], 1);
    for uri in ["../../b.bin", "/etc/hostname", "https://example.org/b.bin"] {
        explorer.add_file("a/model.gltf", document(uri).into_bytes()).expect("a name");
        assert_eq!(code(&mut explorer, &format!("what=state&{state}")), "broken_model", "{uri}");
    }
}

#[test]
fn replaced_files_are_reloaded() {
    let mut explorer = explorer_with_models();
    let read = |name: &str| std::fs::read(scenes_folder().join("models").join(name)).expect(name);
    let query = "what=state&lesson=model&model=own.glb";
    explorer.add_file("own.glb", read("crate.glb")).expect("a name");
    assert_eq!(json(&mut explorer, query)["facts"]["triangles"], 12);
    explorer.add_file("own.glb", read("house.glb")).expect("a name");
    assert_eq!(json(&mut explorer, query)["facts"]["triangles"], 262);
}

#[test]
fn missing_pixels_and_pixels_outside_the_picture_are_rejected() {
    let mut explorer = explorer_with_models();
    let query = "what=pick&lesson=frustum";
    assert_eq!(code(&mut explorer, query), "malformed_query");
    let query = "what=pick&lesson=frustum&pixel=640,0";
    assert_eq!(code(&mut explorer, query), "nothing_there");
}

/// Queries with changed bytes are answered or rejected but never cause a panic.
#[test]
fn corrupted_queries_are_answered_or_rejected() {
    let mut explorer = explorer_with_models();
    let queries = [
        "what=state&v=1&lesson=frustum&near=2&pin=0,1,2&orbit=10,20",
        "what=world&size=9x7&samples=1&lesson=stereo&eyes=0.5&orbit=1e5,-3",
        "what=volume&size=9x7&rows=1-3&lesson=normalization&step=1&volume_orbit=0,90",
        "what=pick&size=9x7&pixel=3,4&lesson=exercises&exercise=11&style=Lines",
        "what=picture&size=9x7&format=png&lesson=perspective&aspect=1.6&fov=70&lang=zh",
    ];
    // A linear congruential generator, so that failures are reproducible.
    let mut seed = 1_u64;
    let mut random = |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % below
    };
    let mut answered = 0;
    for round in 0..9000 {
        let mut query = queries[round % queries.len()].as_bytes().to_vec();
        for _ in 0..=random(2) {
            let at = random(query.len());
            query[at] = b"0123456789.,-=&%ex"[random(18)];
        }
        // Large pictures are slow and add nothing to the test.
        let query = String::from_utf8(query).expect("ASCII");
        if !query.contains("size=9x7") && !query.starts_with("what=state") {
            continue;
        }
        answered += usize::from(explorer.answer(&query).is_ok());
    }
    assert!(answered > 100, "{answered}");
}
