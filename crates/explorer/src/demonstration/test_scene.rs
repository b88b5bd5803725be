//! The test scene for the demonstrations.

use scene::{Origin, ResolveOptions, Scene};
use scene_file::SceneFile;
use std::path::Path;

/// Returns the lessons' house with default settings, at a small size.
///
/// The picture has 320 × 240 pixels and hidden lines removed, so that drawing it is fast in a debug
/// build and independent of materials and light.
pub(super) fn house_scene() -> (Origin, SceneFile, Scene) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/models/house.glb");
    let (origin, mut file) = Origin::from_model_path(&path);
    file.image.size = (320, 240);
    file.style = scene_file::file::StyleFile::lines_hidden_removed();
    let scene = Scene::resolve(&origin, &file, &ResolveOptions::default()).expect("the house");
    (origin, file, scene)
}
