//! Scenes that read other files: included scenes, background images and environments.
//!
//! The files are in a folder of this process, next to a model.

use crate::scene::resolve_and_draw;
use pipeline::Origin;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// A small model with several materials.
const MODEL: &[u8] = include_bytes!("../../../scenes/models/crate.glb");

/// The separator between the files in a case.
const SEPARATOR: &str = "\n====\n";

/// The files in a case: the first is the scene, and the others can be included.
const FILES: [&str; 4] = ["scene.ron", "a.ron", "b.ron", "sub/c.ron"];

static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = std::env::temp_dir().join(format!("alberti-fuzz-{}", std::process::id()));
    for model in ["crate.glb", "sub/crate.glb"] {
        write_file(&folder.join(model), MODEL);
    }
    folder
});

/// Writes a file and creates its folder.
///
/// # Panics
/// Panics if the system's temporary folder is not writable, because nothing can be tested then.
fn write_file(path: &Path, bytes: &[u8]) {
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    let written = folder.and_then(|()| fs::write(path, bytes));
    assert!(written.is_ok(), "{}: {written:?}", path.display());
}

/// Tests a scene with the files that it includes. The bytes contain all files in the order of
/// [`FILES`].
pub fn included(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let mut parts = text.splitn(FILES.len(), SEPARATOR);
    for name in FILES {
        // Files left over from the previous case would change this case.
        write_file(&FOLDER.join(name), parts.next().unwrap_or_default().as_bytes());
    }
    match Origin::read_scene(&FOLDER.join(FILES[0])) {
        Ok((origin, mut file)) => {
            // Other targets cover models.
            file.models.truncate(2);
            resolve_and_draw(&origin, &file);
        }
        Err(error) => assert!(!error.to_string().is_empty(), "empty error message"),
    }
}

/// Tests a background image; the first byte selects how it fills the picture.
pub fn background(bytes: &[u8]) {
    let Some((&kind, image)) = bytes.split_first() else { return };
    let fit = ["Cover", "Contain", "Stretch"][usize::from(kind % 3)];
    let background = format!("image: Image(background: Picture(path: \"image\", fit: {fit}))");
    with_file("image", image, &background);
}

/// Tests a Radiance environment image; the first byte rotates it.
pub fn environment(bytes: &[u8]) {
    let Some((&turn, image)) = bytes.split_first() else { return };
    let environment = format!(
        "environment: File(path: \"sky.hdr\", rotation_degrees: {turn}), \
         image: Image(background: Environment(blur: 0.{turn}))"
    );
    with_file("sky.hdr", image, &environment);
}

/// Tests a scene with these additional fields, one of which reads a file.
fn with_file(name: &str, bytes: &[u8], fields: &str) {
    write_file(&FOLDER.join(name), bytes);
    let text = format!("Scene(models: [Model(path: \"crate.glb\")], {fields})");
    let origin = Origin::from_text("scene.ron", text, FOLDER.clone());
    match origin.parse_with_includes(&[]) {
        Ok((origin, file)) => resolve_and_draw(&origin, &file),
        Err(error) => panic!("the scene of this target is invalid: {error}"),
    }
}
