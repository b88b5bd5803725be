//! The same bytes: bands and the whole, PNG and the renderer of scene files, one explorer and
//! another.

use super::{explorer_with_models, json, lessons, scenes_folder};
use pipeline::{Origin, Scene};

#[test]
fn bands_are_parts_of_the_whole() {
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

/// The saved picture has the bytes of `alberti render` of the scene file that is shown, which is
/// formatted as `alberti scene fmt` does it and has no lint.
#[test]
fn a_png_is_that_of_the_scene_file() {
    let mut explorer = explorer_with_models();
    for lesson in lessons(&mut explorer).iter().filter(|lesson| lesson["id"] != "model") {
        let id = lesson["id"].as_str().expect("an id");
        let query = format!("size=120x75&lesson={id}");
        let png = explorer.answer(&format!("what=picture&format=png&{query}")).expect(id).bytes;
        let state = json(&mut explorer, &format!("what=state&{query}"));
        let text = state["scene"].as_str().expect("a scene");
        let origin = Origin::from_text("scene.ron", text, scenes_folder());
        let (origin, file) = origin.parse_with_includes(&[]).expect("a scene file");
        let scene = Scene::resolve(&origin, &file, &Default::default()).expect("a scene");
        let picture = pipeline::render(&scene, 1).expect("a picture");
        assert!(picture.to_png() == png, "{id}");
        let command = state["command"].as_str().expect("a command");
        assert!(command.contains(text), "{id}");
        let formatted = pipeline::scene::format_source("scene.ron", text).expect("a scene file");
        assert_eq!(formatted, text, "{id}");
        assert_eq!(pipeline::scene::lint_description(&origin, &file), [], "{id}");
    }
}

/// Answers do not depend on what was asked before.
#[test]
fn kept_scenes_change_no_answer() {
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
