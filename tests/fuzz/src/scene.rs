//! Parses scene files, resolves them with an existing model, and draws them with one and two
//! threads.

use pipeline::{Origin, Scene, SceneFile, render};
use scene_file::parse_scene;
use std::path::Path;

/// A small model with several materials.
const MODEL: &str = "crate.glb";
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/models");

/// Loads and draws a scene from its text.
pub fn text(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let mut file = match parse_scene("scene.ron", text) {
        Ok(file) => file,
        Err(error) => return assert!(!error.to_string().is_empty(), "empty error message"),
    };
    let nowhere = Path::new("nowhere-at-all");
    let origin = Origin::from_text("scene.ron", text, nowhere.to_owned());
    if let Err(error) = Scene::resolve(&origin, &file, &Default::default()) {
        assert!(!error.to_string().is_empty(), "empty error message");
    }
    file.models.truncate(2);
    for model in &mut file.models {
        model.path = MODEL.to_owned();
    }
    resolve_and_draw(&Origin::from_text("scene.ron", text, FOLDER.into()), &file);
}

/// Resolves a scene, which may fail with a message, and draws it at a small size with one thread
/// and with two.
pub fn resolve_and_draw(origin: &Origin, file: &SceneFile) {
    let mut scene = match Scene::resolve(origin, file, &Default::default()) {
        Ok(scene) => scene,
        Err(error) => return assert!(!error.to_string().is_empty(), "empty error message"),
    };
    scene.image.width = scene.image.width.min(32);
    scene.image.height = scene.image.height.min(24);
    if let (Ok(alone), Ok(together)) = (render(&scene, 1), render(&scene, 2)) {
        assert!(alone == together, "two threads draw a different picture than one");
    }
}
