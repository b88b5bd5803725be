//! Tests the explorer through requests, with the lesson models.

mod equal_bytes;
mod errors;
mod every_lesson;
mod exercises;
mod statements;

use explorer::Explorer;
use serde_json::Value as Json;
use std::path::{Path, PathBuf};

/// Returns the scene folder, which contains `models`.
fn scenes_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

/// Creates an explorer with all lesson models.
fn explorer_with_models() -> Explorer {
    let mut explorer = Explorer::new();
    for name in ["house", "crate", "mexican_hat", "mexican_hat_lines", "floor"] {
        let path = scenes_folder().join("models").join(format!("{name}.glb"));
        let bytes = std::fs::read(path).expect("a model of the scenes");
        explorer.add_file(&format!("models/{name}.glb"), bytes).expect("a name");
    }
    explorer
}

/// Returns the answer to a request as JSON.
fn json(explorer: &mut Explorer, query: &str) -> Json {
    let answer = explorer.answer(query).expect(query);
    assert_eq!(answer.content_type, "application/json");
    serde_json::from_slice(&answer.bytes).expect("JSON")
}

/// Returns the facts of a state.
fn facts(explorer: &mut Explorer, state: &str) -> Json {
    json(explorer, &format!("what=state&{state}"))["facts"].take()
}

/// Returns the English sentences of a state.
fn consequences(explorer: &mut Explorer, state: &str) -> Vec<String> {
    let state = json(explorer, &format!("what=state&{state}"));
    let sentences = state["consequences"].as_array().expect("a list").iter();
    sentences.map(|sentence| sentence["en"].as_str().expect("English").to_owned()).collect()
}

/// Returns the lessons of the catalog.
fn lessons(explorer: &mut Explorer) -> Vec<Json> {
    json(explorer, "what=lessons")["lessons"].as_array().expect("a list").clone()
}
