//! What cannot be answered is told, and the next request works.

use super::{explorer_with_models, json, scenes_folder};
use explorer::Explorer;

fn code(explorer: &mut Explorer, query: &str) -> &'static str {
    let error = explorer.answer(query).expect_err(query);
    assert!(!error.message.is_empty() && !error.help.is_empty(), "{error:?}");
    error.code
}

#[test]
fn a_broken_model_is_an_error_and_the_next_request_works() {
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
fn missing_models_are_told() {
    let mut explorer = explorer_with_models();
    assert_eq!(code(&mut explorer, "what=picture&lesson=model"), "missing_model");
    assert_eq!(code(&mut explorer, "what=picture&lesson=model&model=no.glb"), "missing_model");
    assert_eq!(code(&mut Explorer::new(), "what=picture"), "missing_model");
    let chinese = explorer.answer("what=picture&lesson=model&lang=zh").expect_err("no model");
    assert_eq!(chinese.message, "还没有选择模型");
}

#[test]
fn names_of_files_stay_in_the_folder() {
    let mut explorer = Explorer::new();
    for name in ["", "/etc/passwd", "../a.glb", "a/../../b.glb"] {
        assert_eq!(explorer.add_file(name, Vec::new()).expect_err(name).code, "malformed_value");
    }
}

/// A glTF file finds its buffer in the same folder of memory, and nothing outside of it.
#[test]
fn companions_of_a_model_are_found() {
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
fn files_that_are_replaced_are_loaded_anew() {
    let mut explorer = explorer_with_models();
    let read = |name: &str| std::fs::read(scenes_folder().join("models").join(name)).expect(name);
    let query = "what=state&lesson=model&model=own.glb";
    explorer.add_file("own.glb", read("crate.glb")).expect("a name");
    assert_eq!(json(&mut explorer, query)["facts"]["triangles"], 12);
    explorer.add_file("own.glb", read("house.glb")).expect("a name");
    assert_eq!(json(&mut explorer, query)["facts"]["triangles"], 262);
}

#[test]
fn a_pixel_must_be_given_and_be_in_the_picture() {
    let mut explorer = explorer_with_models();
    let query = "what=pick&lesson=frustum";
    assert_eq!(code(&mut explorer, query), "malformed_query");
    let query = "what=pick&lesson=frustum&pixel=640,0";
    assert_eq!(code(&mut explorer, query), "nothing_there");
}
