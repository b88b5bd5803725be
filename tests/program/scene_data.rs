//! Scenes as data: read and written by `ron` and other serde formats, using only the public
//! interface.

#[allow(dead_code, reason = "long runs use more of it")]
#[path = "../soak/bits.rs"]
mod bits;
#[path = "../soak/scene_text.rs"]
mod scene_text;

use alberti_tests::harness::sample_cases;
use pipeline::SceneFile;
use scene_file::file::ModelFile;
use scene_file::scene_ron_options;
use scene_text::{SceneFiles, random_scene_text};
use std::fs;
use std::path::PathBuf;

/// The number of random scenes per run.
const CASES: u64 = 10_000;

/// Finds all scene files in a folder and its subfolders.
fn scene_files(folder: PathBuf, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the folder can be read") {
        let path = entry.expect("the folder can be read").path();
        if path.is_dir() {
            scene_files(path, found);
        } else if path.extension().is_some_and(|extension| extension == "ron") {
            found.push(path);
        }
    }
}

#[test]
fn plain_ron_reads_every_scene_in_the_repository() {
    let mut paths = Vec::new();
    for folder in ["scenes", "book/scenes", "docs/exercises"] {
        scene_files(alberti_tests::project_root().join(folder), &mut paths);
    }
    assert!(paths.len() > 110, "{}", paths.len());
    for path in paths {
        let text = fs::read_to_string(&path).expect("the scene can be read");
        let scene: SceneFile = scene_ron_options()
            .from_str(&text)
            .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert_reads_back(&scene, &path.display().to_string());
    }
}

#[test]
fn random_scenes_survive_a_round_trip() {
    let files = SceneFiles {
        models: vec!["crate.glb".to_owned(), "part \"2\".gltf".to_owned()],
        environment: "sky.hdr",
        image: "image.png",
        include: "part.ron",
    };
    let mut read = 0;
    let numbers = sample_cases("random scenes", (0..CASES).collect());
    let count = numbers.len();
    for number in numbers {
        let text = random_scene_text(number, &files);
        // Most of these scenes are valid; errors in the others are tested elsewhere.
        let Ok(scene) = SceneFile::from_ron(&text) else { continue };
        read += 1;
        assert_reads_back(&scene, &format!("scene {number}"));
    }
    assert!(read > count / 2, "only {read} scenes can be read");
}

/// Checks that a scene survives round trips through RON, formatted and compact, and through JSON.
#[track_caller]
fn assert_reads_back(scene: &SceneFile, name: &str) {
    let text = scene.to_ron().expect(name);
    assert_eq!(&SceneFile::from_ron(&text).expect(name), scene, "{name}:\n{text}");
    let compact = scene_ron_options().to_string(scene).expect(name);
    assert_eq!(&scene_ron_options().from_str::<SceneFile>(&compact).expect(name), scene, "{name}");
    let json = serde_json::to_string(scene).expect(name);
    assert_eq!(&serde_json::from_str::<SceneFile>(&json).expect(name), scene, "{name}:\n{json}");
}

#[test]
fn default_values_are_not_written() {
    let scene = SceneFile::from_model_path("a.glb".to_owned());
    assert_eq!(
        scene.to_ron().expect("the scene can be written"),
        "Scene(models: [(path: \"a.glb\")])\n"
    );
    let json = serde_json::to_string(&scene).expect("the scene can be written");
    assert_eq!(json, r#"{"models":[{"path":"a.glb"}]}"#);
}

#[test]
fn values_that_cannot_be_read_are_not_written() {
    let crate_at = |place: [f64; 3]| SceneFile::new([ModelFile::new("crate.glb").at(place)]);
    assert!(crate_at([1.0, 2.0, 3.0]).to_ron().is_ok());
    for wrong in [crate_at([f64::NAN, 0.0, 0.0]), crate_at([0.0, f64::INFINITY, 0.0])] {
        let error = wrong.to_ron().expect_err("it cannot be read").to_string();
        assert!(error.contains("finite"), "{error}");
    }
}

#[test]
fn other_formats_refuse_the_same_values_as_ron() {
    for (json, reason) in [
        (r#"{"modles": []}"#, "unknown field `modles`"),
        (r#"{"models": [{}]}"#, "missing field `path`"),
        (r#"{"camera": {"zoom": 0}}"#, "expected a number greater than 0, found 0"),
        (r#"{"style": "Falt"}"#, "unknown variant `Falt`"),
        (r#"{"camera": {"view": {"LookAt": {"eye": [1, 2], "target": [0, 0, 0]}}}}"#, "three"),
    ] {
        let error = serde_json::from_str::<SceneFile>(json).expect_err(json).to_string();
        assert!(error.contains(reason), "{json}: {error}");
    }
}

#[test]
fn every_type_of_a_public_field_can_be_named() {
    let read = |crate_name: &str| {
        let listing = format!("docs/api/{crate_name}.txt");
        fs::read_to_string(alberti_tests::project_root().join(listing)).expect("a listing")
    };
    let listing = read("scene-file");
    let others = [
        "camera",
        "drawing",
        "hidden-line",
        "homog",
        "model",
        "page",
        "projection",
        "shade",
        "sheet",
    ]
    .map(read);
    let mut known: Vec<&str> = vec!["Option", "Vec", "String", "Box", "Self"];
    // Items are at the beginning of a line: `shade::ImageFit`.
    let items = others.iter().flat_map(|other| other.lines()).chain(listing.lines());
    let items = items.filter(|line| !line.starts_with(' '));
    known.extend(items.filter_map(|line| line.split_whitespace().next()?.rsplit("::").next()));
    let mut count = 0;
    let items = listing.split("\nscene_file::");
    for item in items.filter(|item| item.starts_with("file::")) {
        // Fields, and values of variants: `name: Type,` and `Variant(Type),`.
        let body = item.split("\n    impl").next().unwrap_or_default();
        let fields = body.lines().filter_map(|line| {
            let line = line.trim().trim_end_matches(',');
            line.split_once(": ").or_else(|| line.split_once('(')).map(|(_, value)| value)
        });
        for value in fields.filter(|value| !value.starts_with("/*")) {
            let names = value.split(|c: char| !c.is_alphanumeric() && c != '_');
            for name in names.filter(|name| name.starts_with(char::is_uppercase)) {
                assert!(known.contains(&name), "`{name}` cannot be named: {value}");
                count += 1;
            }
        }
    }
    assert!(count > 200, "{count} types");
}
