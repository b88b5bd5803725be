//! Tests of how often model files are read, and of the memory budget that they share.

use import::MemoryFolder;
use model::Timings;
use scene::{Origin, ResolveOptions, Scene, validate_scene};
use scene_file::parse_scene;

const TRIANGLE: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// Counts the mistakes in a scene and the model files parsed to find them.
fn mistakes_and_loads(text: &str, is_check: bool) -> (usize, usize) {
    let mut folder = MemoryFolder::default();
    folder.insert("a.obj", TRIANGLE.to_vec());
    folder.insert("b.obj", TRIANGLE.to_vec());
    let file = parse_scene("scene.ron", text).expect("a scene");
    let origin = Origin::from_text_in_memory("scene.ron", text, folder);
    let timings = Timings::enabled();
    let mut options = ResolveOptions::default();
    options.import.timings = timings.clone();
    let count = if is_check {
        validate_scene(&origin, &file, &options).1.len()
    } else {
        let error = Scene::resolve(&origin, &file, &options).expect_err("mistakes");
        match error {
            scene::ResolveError::Scene(errors) => errors.iter().count(),
            _ => 0,
        }
    };
    (count, timings.count("parse"))
}

#[test]
fn each_model_is_loaded_once_even_if_the_scene_has_mistakes() {
    let models = "(path: \"a.obj\"), (path: \"missing.obj\"), (path: \"b.obj\"), (path: \"a.obj\")";
    let text = format!("Scene(models: [{models}], image: (samples: 3), caption: \"\")");
    assert_eq!(mistakes_and_loads(&text, true), (3, 2));
    assert_eq!(mistakes_and_loads(&text, false), (3, 2));
    let text = "Scene(models: [(path: \"a.obj\")], camera: (view: LookTo(eye: (0, 0, 0), gaze: (0, 0, 0))))";
    assert_eq!(mistakes_and_loads(text, false), (1, 1));
}

#[test]
fn models_of_a_scene_share_one_budget() {
    let mut folder = MemoryFolder::default();
    for name in ["a.obj", "b.obj", "c.obj"] {
        folder.insert(name, TRIANGLE.to_vec());
    }
    let load = |models: &str, scene_bytes: u64| {
        let text = format!("Scene(models: [{models}])");
        let file = parse_scene("scene.ron", &text).expect("a scene");
        let origin = Origin::from_text_in_memory("scene.ron", &text, folder.clone());
        let mut options = ResolveOptions::default();
        options.import.limits.scene_bytes = scene_bytes;
        Scene::resolve(&origin, &file, &options)
    };
    let three = "(path: \"a.obj\"), (path: \"b.obj\"), (path: \"c.obj\")";
    let scene = load("(path: \"a.obj\")", 1 << 20).expect("one model");
    let bytes = scene.models[0].model.array_bytes();
    assert!(bytes >= 3 * 12 + 3 * 4, "positions and indices: {bytes}");
    assert!(load(three, 3 * bytes).is_ok());
    assert!(load("(path: \"a.obj\"), (path: \"a.obj\"), (path: \"a.obj\")", bytes).is_ok());
    let message = load(three, 3 * bytes - 1).expect_err("one too many").to_string();
    assert!(message.contains("models[2]") || message.contains(":1:"), "{message}");
    assert!(message.contains("--max-scene-bytes"), "{message}");
}
