//! Compares the bytes of bands and whole pictures, of PNGs and the scene renderer, and of used and
//! fresh explorers.

use super::{explorer_with_models, json, lessons, scenes_folder};
use explorer::Explorer;
use import::ImportOptions;
use pipeline::{Origin, Scene};
use scene::ResolveOptions;

/// Returns a lesson model, as the program does.
fn lesson_model(name: &str) -> Option<Vec<u8>> {
    std::fs::read(scenes_folder().join(format!("models/{name}.glb"))).ok()
}

#[test]
fn bands_match_the_whole_picture() {
    let mut explorer = explorer_with_models();
    for (what, state) in [
        ("picture", "lesson=frustum"),
        ("picture", "lesson=multiview"),
        ("picture", "lesson=stereo&mode=anaglyph"),
        ("picture", "lesson=frustum&style=Toon"),
        ("world", "lesson=frustum"),
        ("volume", "lesson=tear"),
    ] {
        let query = format!("what={what}&size=90x50&{state}");
        let whole = explorer_with_models().answer(&query).expect("a picture").bytes;
        let rows = ["0-13", "13-14", "14-50"];
        let bands = rows.map(|rows| explorer.answer(&format!("{query}&rows={rows}")));
        let bands = bands.map(|band| band.expect("a band").bytes).concat();
        assert!(bands == whole, "{what} {state}");
    }
}

/// A saved picture has the same bytes as the output of `alberti render` for the displayed scene
/// file. That file is formatted as by `alberti scene fmt` and has no lints.
#[test]
fn a_png_matches_the_rendered_scene_file() {
    let mut explorer = explorer_with_models();
    for lesson in lessons(&mut explorer).iter().filter(|lesson| lesson["models"][0].is_string()) {
        let id = lesson["id"].as_str().expect("an id");
        let query = format!("size=120x75&lesson={id}");
        let png = explorer.answer(&format!("what=picture&format=png&{query}")).expect(id).bytes;
        let state = json(&mut explorer, &format!("what=state&{query}"));
        let text = state["scene"].as_str().expect("a scene");
        let origin = Origin::from_text("scene.ron", text, scenes_folder());
        let (origin, file) = origin.parse_with_includes(&[]).expect("a scene file");
        let import = ImportOptions { lesson_model: Some(lesson_model), ..ImportOptions::default() };
        let options = ResolveOptions::with_import(import);
        let scene = Scene::resolve(&origin, &file, &options).expect("a scene");
        let picture = pipeline::render(&scene, 1).expect("a picture");
        assert!(picture.to_png() == png, "{id}");
        let command = state["command"].as_str().expect("a command");
        assert!(command.contains(text), "{id}");
        let formatted = scene_file::format_source("scene.ron", text).expect("a scene file");
        assert_eq!(formatted, text, "{id}");
        assert_eq!(scene::lint_description(&origin, &file), [], "{id}");
    }
}

/// The user's own scene file is drawn as the program would draw it with the displayed flags.
#[test]
fn scene_files_are_drawn_unchanged() {
    let mut explorer = Explorer::new();
    for name in ["house.glb", "teapot.glb", "table.glb", "crate.glb"] {
        let path = format!("models/{name}");
        let bytes = std::fs::read(scenes_folder().join(&path)).expect("a model of the scenes");
        explorer.add_file(&path, bytes).expect("a name");
    }
    for name in ["two_point.ron", "teapot.ron", "three_point.ron", "viewports.ron"] {
        let text = std::fs::read_to_string(scenes_folder().join(name)).expect("a scene");
        explorer.add_file(name, text.clone().into_bytes()).expect("a name");
        let query = format!("lesson=scene&model={name}&size=120x75");
        let png = explorer.answer(&format!("what=picture&format=png&{query}")).expect(name).bytes;
        let state = json(&mut explorer, &format!("what=state&{query}"));
        assert_eq!(state["scene"].as_str(), Some(text.as_str()));
        let origin = Origin::from_text(name, text, scenes_folder());
        let (origin, mut file) = origin.parse_with_includes(&[]).expect("a scene file");
        (file.image.size, file.image.samples) = ((120, 75), 4);
        let scene = Scene::resolve(&origin, &file, &Default::default()).expect("a scene");
        assert!(pipeline::render(&scene, 1).expect("a picture").to_png() == png, "{name}");
        let toon = explorer.answer(&format!("what=picture&format=png&{query}&style=Toon"));
        assert!(toon.expect("a picture").bytes != png, "{name}");
    }
}

/// Answers do not depend on earlier requests.
#[test]
fn cached_scenes_do_not_change_answers() {
    let mut used = explorer_with_models();
    let queries = [
        "what=world&size=64x40&lesson=frustum&near=2",
        "what=world&size=64x40&lesson=frustum&near=3",
        "what=picture&size=64x40&lesson=perspective",
        "what=volume&size=64x40&lesson=tear",
        "what=world&size=64x40&lesson=frustum&near=2",
        "what=world&size=64x40&lesson=frustum&near=2&orbit=10,20",
        "what=volume&size=64x40&lesson=normalization&step=1",
        "what=picture&size=64x40&lesson=frustum&near=2&samples=1",
        "what=picture&size=64x40&lesson=frustum&near=2",
    ];
    for query in queries {
        let fresh = explorer_with_models().answer(query).expect(query);
        assert!(used.answer(query).expect(query) == fresh, "{query}");
    }
}
