//! Passes, regions, bit depths and styles of pictures.

#![allow(clippy::panic, reason = "a missing part of a result fails the test")]

mod passes;
mod plane;
mod regions;
mod styles;

use pipeline::scene::ResolveOptions;
use pipeline::scene::file::SceneFile;
use pipeline::{Origin, Scene};
use std::path::Path;

/// Loads a scene from the repository, with changes to its file.
fn load_scene(name: &str, change: impl FnOnce(&mut SceneFile)) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let (origin, mut file) =
        Origin::read_scene(&folder.join(format!("{name}.ron"))).expect("a committed scene");
    change(&mut file);
    let options = ResolveOptions { allow_large_picture: true, ..ResolveOptions::default() };
    Scene::resolve(&origin, &file, &options).expect("a valid scene")
}
