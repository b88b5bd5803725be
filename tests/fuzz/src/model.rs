//! Loads models from bytes, checks their promises, poses them, and draws and encodes them from a
//! few sides.

use crate::{glb, promises};
use homog::Affine;

use gltf_check::check_bytes;
use import::{ImageLoading, ImportError, ImportOptions, Limits, NameOrIndex, load_bytes};
use model::{Model, ModelInstance};
use pipeline::{Origin, Scene, render};
use scene_file::file::{CameraChoice, DEFAULT_PADDING, FromFile, SceneFile, StyleFile, ViewFile};
use std::path::PathBuf;
use std::sync::Arc;

/// Limits that are small enough to make each case fast and large enough to reach every branch.
fn limits() -> Limits {
    Limits {
        json_values: 100_000,
        array_bytes: 48 << 20,
        image_side: 4096,
        image_texels: 4 << 20,
        nodes: 2_000,
        scene_items: 20_000,
        ..Limits::default()
    }
}

/// Checks a file, and loads it as it is, leniently, and with corrected lengths.
pub fn file(bytes: &[u8]) {
    let loaded = load(bytes, ImportOptions::default());
    let has_variants = loaded.as_ref().is_ok_and(|model| !model.variants.is_empty());
    let is_loaded = loaded.is_ok();
    show(loaded);
    let report = check_bytes(
        "model.glb",
        bytes,
        &ImportOptions { limits: limits(), ..ImportOptions::default() },
    );
    assert!(is_loaded || report.errors > 0, "a file does not load but has no errors");
    if !is_loaded {
        show(load(bytes, ImportOptions { lenient: true, ..ImportOptions::default() }));
    }
    if has_variants {
        let (variant, images) = (Some(NameOrIndex::Index(0)), ImageLoading::Headers);
        show(load(bytes, ImportOptions { variant, images, ..ImportOptions::default() }));
    }
    if bytes.starts_with(b"glTF") {
        let (json, binary) = glb::parts(bytes);
        let repaired = glb::glb(json, binary);
        if repaired != bytes {
            show(load(&repaired, ImportOptions::default()));
        }
    }
}

fn load(bytes: &[u8], options: ImportOptions) -> Result<Model, ImportError> {
    load_bytes("model.glb", bytes, &ImportOptions { limits: limits(), ..options })
}

/// Loads a file in a format other than glTF, selected by `name`, as it is and leniently.
pub fn mesh(name: &str, bytes: &[u8]) {
    let load = |lenient| {
        let options = ImportOptions { limits: limits(), lenient, ..ImportOptions::default() };
        load_bytes(name, bytes, &options)
    };
    let loaded = load(false);
    let report =
        check_bytes(name, bytes, &ImportOptions { limits: limits(), ..ImportOptions::default() });
    assert!(loaded.is_ok() || report.errors > 0, "a file does not load but has no errors");
    if loaded.is_err() {
        show(load(true));
    }
    show(loaded);
}

/// Loads a material library whose first materials are used by a few triangles.
pub fn material_library(bytes: &[u8]) {
    let escaped: String = bytes.iter().map(|byte| format!("%{byte:02X}")).collect();
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";
    let mut file = format!("mtllib data:,{escaped}\n{corners}").into_bytes();
    for line in
        bytes.split(|byte| *byte == b'\n').filter(|line| line.starts_with(b"newmtl ")).take(4)
    {
        file.extend_from_slice(b"use");
        file.extend_from_slice(&line[3..]);
        file.extend_from_slice(b"\nf 1/1 2/2 3/3\n");
    }
    mesh("model.obj", &file);
}

/// Loads a file and checks it against its promises. It is not drawn, because only the decoder is
/// under test.
pub fn loaded(bytes: &[u8]) {
    checked(load(bytes, ImportOptions::default()));
}

/// Returns the model, if any, after checking its promises; an error must have a message.
fn checked(loaded: Result<Model, ImportError>) -> Option<Model> {
    let problem = match &loaded {
        Ok(model) => promises::check_model(model).err(),
        Err(error) => error.to_string().is_empty().then(|| "empty error message".to_owned()),
    };
    assert!(problem.is_none(), "a promise is broken: {problem:?}");
    loaded.ok()
}

/// Does what a user would do with the outcome: reads the error, or looks at the model.
fn show(loaded: Result<Model, ImportError>) {
    let Some(mut model) = checked(loaded) else { return };
    draw(&model, StyleFile::Shaded, ViewFile::DEFAULT);
    if !model.cameras.is_empty() {
        draw(&model, StyleFile::Flat, ViewFile::FromModel(CameraChoice::Index(0)));
    }
    if !model.animations.is_empty() {
        model.apply_animation(model.animations.len() - 1, 0.7);
        let view = ViewFile::Frame { from: Some(FromFile::Back), padding_percent: DEFAULT_PADDING };
        draw(&model, StyleFile::Wireframe, view);
    }
}

/// Draws a model at 32 × 24 pixels.
fn draw(model: &Model, style: StyleFile, view: ViewFile) {
    let mut file = SceneFile::from_model_path("model.glb".to_owned());
    file.image.size = (32, 24);
    file.style = style;
    file.camera.view = view;
    let origin = Origin::from_text("model.glb", "", PathBuf::new());
    let placed = ModelInstance { model: Arc::new(model.clone()), model_to_world: Affine::IDENTITY };
    // A model with nothing visible gives an error instead of a picture.
    match Scene::from_models(&origin, &file, &[placed]) {
        Ok(scene) => {
            if let Ok(picture) = render(&scene, 1) {
                assert!(!picture.to_png().is_empty(), "the PNG is empty");
            }
        }
        Err(error) => assert!(!error.to_string().is_empty(), "empty error message"),
    }
}
