//! Tests `alberti explain`.

use crate::gltf_builder::GltfBuilder;
use crate::sandbox::Sandbox;
use serde_json::{Value, json};

/// A red square in front of a camera that looks along −z from (0, 0, 5).
const SCENE: &str = "Scene(models: [(path: \"model.gltf\")], camera: (view: LookAt(eye: (0, 0, 5), target: (0, 0, 0)), \
    projection: Perspective(fov_y_degrees: 90, near: 1, far: 9)), image: (size: (200, 100)))";

fn sandbox_with_scene(name: &str, change: impl FnOnce(&mut GltfBuilder)) -> Sandbox {
    let sandbox = Sandbox::new(name);
    let mut document = GltfBuilder::square();
    change(&mut document);
    document.write_file(&sandbox, "model");
    sandbox.write_file("scene.ron", SCENE);
    sandbox
}

fn explanation_json(sandbox: &Sandbox, arguments: &[&str]) -> Value {
    let run = sandbox.run(&[&["explain", "scene.ron", "--json"], arguments].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{arguments:?}");
    serde_json::from_str(&run.stdout).expect("JSON")
}

/// Returns the value of an item, in any step.
fn find_item(explanation: &Value, id: &str) -> Value {
    let steps = explanation["steps"].as_array().expect("steps").iter();
    let mut items = steps.flat_map(|step| step["items"].as_array().expect("items"));
    items.find(|item| item["id"] == id).unwrap_or_else(|| panic!("no {id} in {explanation:#}"))["value"]
        .clone()
}

fn assert_near(ours: &Value, theirs: &[f64]) {
    let ours: Vec<f64> =
        ours.as_array().expect("numbers").iter().filter_map(Value::as_f64).collect();
    let close =
        ours.len() == theirs.len() && ours.iter().zip(theirs).all(|(a, b)| (a - b).abs() < 1e-9);
    assert!(close, "{ours:?} is not {theirs:?}");
}

#[test]
fn a_point_is_traced_to_its_pixel() {
    let sandbox = sandbox_with_scene("explain_point", |_| {});
    // Halfway up from the center at distance 5, where the picture is 10 units high: row 25 of 100.
    let found = explanation_json(&sandbox, &["--point", "0,2.5,0"]);
    assert_eq!(found["schema"], json!({"name": "alberti-explain", "version": 1}));
    assert_near(&find_item(&found, "view"), &[0.0, 2.5, -5.0]);
    assert_near(&find_item(&found, "ndc"), &[0.0, 0.5, -0.8]);
    assert_near(&find_item(&found, "screen"), &[100.0, 25.0, 0.1]);
    let lowest = explanation_json(&sandbox, &["--point", "0,-2.5,0", "--conventions", "chapter"]);
    assert_near(&find_item(&lowest, "screen"), &[99.5, 24.5, -0.8]);
    let gl = explanation_json(&sandbox, &["--point", "0,2.5,0", "--conventions", "opengl"]);
    assert_near(&find_item(&gl, "screen"), &[100.0, 75.0, 0.9]);
    let d3d = explanation_json(&sandbox, &["--point", "0,2.5,0", "--conventions", "direct3d"]);
    assert_near(&find_item(&d3d, "view"), &[0.0, 2.5, 5.0]);
    assert_near(&find_item(&d3d, "screen"), &[100.0, 25.0, 0.9]);
    let vulkan = explanation_json(&sandbox, &["--point", "0,2.5,0", "--conventions", "vulkan"]);
    assert_near(&find_item(&vulkan, "ndc"), &[0.0, -0.5, 0.9]);
    assert_near(&find_item(&vulkan, "screen"), &[100.0, 25.0, 0.9]);
}

#[test]
fn a_segment_behind_the_eye_is_clipped_by_the_near_plane() {
    let sandbox = sandbox_with_scene("explain_segment", |_| {});
    let found = explanation_json(&sandbox, &["--segment", "0,0,0,0,0,10"]);
    assert_near(&find_item(&found, "t"), &[0.0, 0.4]);
    assert_eq!(find_item(&found, "leaves"), "the near plane");
    let beside = explanation_json(&sandbox, &["--segment", "50,0,0,60,0,0"]);
    assert_eq!(beside["verdict"], "None of it is in the picture: it is outside the right plane.");
}

#[test]
fn vertices_and_triangles_come_from_the_mesh() {
    let sandbox = sandbox_with_scene("explain_mesh", |document| {
        document.json["nodes"][0]["translation"] = json!([1, 0, 0]);
        document.json["nodes"][0]["name"] = json!("sign");
    });
    let corner = explanation_json(&sandbox, &["--node", "sign", "--vertex", "2"]);
    assert_near(&find_item(&corner, "mesh"), &[1.0, 1.0, 0.0]);
    assert_near(&find_item(&corner, "world"), &[2.0, 1.0, 0.0]);
    let half = explanation_json(&sandbox, &["--node", "0", "--triangle", "1"]);
    // Half of a square of 2 × 2 units; ten units are a hundred pixels.
    assert!((find_item(&half, "area").as_f64().expect("an area").abs() - 200.0).abs() < 1e-9);
    let run = sandbox.run(&["explain", "scene.ron", "--node", "sing", "--vertex", "2"]);
    assert_eq!(run.code, 1);
    assert!(
        run.stderr.contains("there is no node `sing`") && run.stderr.contains("sign"),
        "{}",
        run.stderr
    );
    let run = sandbox.run(&["explain", "scene.ron", "--node", "0", "--vertex", "9"]);
    assert!(run.stderr.contains("there is no vertex 9: primitive 0 has 4"), "{}", run.stderr);
}

#[test]
fn invisible_nodes_are_explained() {
    let verdict = |name: &str, change: &dyn Fn(&mut GltfBuilder)| {
        let sandbox = sandbox_with_scene(name, change);
        explanation_json(&sandbox, &["--node", "0"])["verdict"].as_str().expect("words").to_owned()
    };
    let seen = verdict("explain_seen", &|_| {});
    assert!(seen.contains("in the view volume: 2 of 2 (100%)"), "{seen}");
    let away = verdict("explain_away", &|document| {
        document.json["nodes"][0]["translation"] = json!([100, 0, 0]);
    });
    assert_eq!(away, "It is not in the picture: the whole mesh is outside the right plane.");
    let behind = verdict("explain_behind", &|document| {
        document.json["nodes"][0]["rotation"] = json!([0, 1, 0, 0]);
    });
    assert!(behind.contains("face away from the camera"), "{behind}");
    let mirrored = verdict("explain_mirrored", &|document| {
        document.json["nodes"][0]["scale"] = json!([-1, 1, 1]);
    });
    assert!(mirrored.contains("in the view volume: 2 of 2"), "{mirrored}");
    let other = verdict("explain_other", &|document| {
        document.push_item("/nodes", json!({"name": "empty"}));
        document.json["scenes"][0]["nodes"] = json!([1]);
    });
    assert_eq!(other, "It is not part of the scene that is drawn.");
}

#[test]
fn without_a_subject_the_transforms_are_explained() {
    let sandbox = sandbox_with_scene("explain_chain", |_| {});
    let run = sandbox.run(&["explain", "scene.ron"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for word in ["CA-1, CA-2", "VV-2", "M_vp", "perspective: left -2, right 2"] {
        assert!(run.stdout.contains(word), "{word}: {}", run.stdout);
    }
}

#[test]
fn a_pixel_is_traced_to_its_triangle() {
    let sandbox = sandbox_with_scene("explain_pixel", |_| {});
    // The square is 20 × 20 pixels around the center; its lower right half is its first triangle.
    let found = explanation_json(&sandbox, &["--pixel", "104,52", "--samples", "1"]);
    assert_eq!(find_item(&found, "hex"), "#ff0000, alpha 255");
    assert_near(&find_item(&found, "srgb"), &[255.0, 0.0, 0.0, 255.0]);
    let title = found["steps"][0]["title"].as_str().expect("words");
    assert!(title.contains("triangle 0 of primitive 0 at node 0"), "{title}");
    let world = find_item(&found, "world");
    let position: Vec<f64> =
        world.as_array().expect("a position").iter().filter_map(Value::as_f64).collect();
    let expected = [0.45, -0.25, 0.0];
    assert!(position.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-4), "{position:?}");
    let empty = explanation_json(&sandbox, &["--pixel", "0,0"]);
    assert!(empty["verdict"].as_str().expect("words").contains("only the background is visible"));
    let run = sandbox.run(&["explain", "scene.ron", "--pixel", "200,0"]);
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("200 x 100"), "{}", run.stderr);
}

#[test]
fn a_page_has_the_same_numbers_as_the_text_and_loads_nothing() {
    let sandbox = sandbox_with_scene("explain_page", |_| {});
    let run = sandbox.run(&[
        "explain",
        "scene.ron",
        "--segment",
        "0,0,0,0,2.5,8",
        "--html",
        "-o",
        "page.html",
    ]);
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (0, "", ""));
    let page = std::fs::read_to_string(sandbox.path_of("page.html")).expect("a page");
    assert!(page.starts_with("<!doctype html>") && page.ends_with("</html>\n"));
    // Two views of the view volume, two of the canonical volume, and the picture.
    assert_eq!(page.matches("<figure>").count(), 5);
    assert_eq!(page.matches("<svg").count(), page.matches("</svg>").count());
    assert_eq!(page.matches("data:image/png;base64,").count(), 1);
    for other in ["http:", "https:", "<script", "<link", "src="] {
        assert!(!page.contains(other), "{other}");
    }
    let text = sandbox.run(&["explain", "scene.ron", "--segment", "0,0,0,0,2.5,8"]).stdout;
    let verdict = text.lines().last().expect("a verdict");
    assert!(page.contains(verdict), "{verdict}");
    assert!(page.contains("<td>") && page.contains("<code>CL-2</code>"));
}

#[test]
fn a_page_marks_the_pixel_even_if_rows_run_upward() {
    let sandbox = sandbox_with_scene("explain_page_rows", |_| {});
    for conventions in ["alberti", "chapter", "opengl", "vulkan", "direct3d", "webgpu"] {
        let run = sandbox.run(&[
            "explain",
            "scene.ron",
            "--point",
            "0,2.5,0",
            "--html",
            "--conventions",
            conventions,
        ]);
        // 25 rows from the top, in any row convention.
        assert!(run.stdout.contains("cx=\"100.0\" cy=\"25.0\""), "{conventions}");
    }
}

#[test]
fn the_page_states_its_units() {
    let sandbox = sandbox_with_scene("explain_introduction", |_| {});
    for (flags, words) in [
        (&["explain", "scene.ron"][..], "in scene units"),
        (&["explain", "--planes", "1,2"], "divided by its w"),
    ] {
        let run = sandbox.run(flags);
        assert!(run.stdout.replace('\n', " ").contains(words), "{flags:?}: {}", run.stdout);
        assert!(run.stdout.lines().take(6).all(|line| line.chars().count() <= 100));
        let json = sandbox.run(&[flags, &["--json"]].concat()).stdout;
        let json: Value = serde_json::from_str(&json).expect("JSON");
        assert!(json["introduction"].as_str().is_some_and(|text| text.contains(words)));
    }
    let html = sandbox.run(&["explain", "scene.ron", "--html"]).stdout;
    assert!(html.contains("in scene units"), "{html}");
}

#[test]
fn maps_without_a_scene_report_what_they_need() {
    let sandbox = Sandbox::new("explain_map_mistakes");
    for (flags, code, words) in [
        (&["explain"][..], 1, "no scene or model to explain"),
        (&["explain", "--matrix", "1 2 3"], 2, "expected 16 numbers separated by commas, found 3"),
        (&["explain", "--planes", "0,1"], 1, "--planes 0,1"),
        (&["explain", "--planes", "-1,1"], 1, "same side of the eye"),
        (&["explain", "--planes", "1,2", "--point", "0,0,0,0"], 2, "0,0,0,0 is not a point"),
        (&["explain", "--planes", "1,2", "--point", "1,2"], 2, "expected 3 or 4 numbers"),
        (&["explain", "--planes", "1,2", "--node", "0"], 2, "cannot be used with"),
    ] {
        let run = sandbox.run(flags);
        assert!(run.code == code && run.stderr.contains(words), "{flags:?}: {}", run.stderr);
    }
    let run = sandbox.run(&["explain", "--planes", "1,2", "--point", "1,1,0"]);
    assert!(run.stdout.contains("It maps to infinity: its w is 0."), "{}", run.stdout);
}

/// A point with w = 0 is a direction, and its image is a vanishing point (VN-1); a segment that
/// passes the eye has no f(t).
#[test]
fn directions_have_vanishing_points_and_segments_past_the_eye_have_no_f() {
    let sandbox = sandbox_with_scene("explain_direction", |_| {});
    // The window is 4 x 2 on the plane at distance 1: (1, 0, -1) vanishes halfway to the right.
    let found = explanation_json(&sandbox, &["--point", "1,0,-1,0"]);
    let screen = find_item(&found, "screen");
    let position = screen.as_array().expect("a position");
    assert_near(&json!(position[..2]), &[150.0, 50.0]);
    let parallel = explanation_json(&sandbox, &["--point", "1,0,0,0"]);
    assert!(parallel["verdict"].as_str().expect("words").contains("stay parallel"));
    let torn = explanation_json(&sandbox, &["--segment", "0,0,0,0,0,10"]);
    assert!(find_item(&torn, "f").as_str().expect("words").contains("clip first"));
}
