//! Camera flags: intrinsics, extrinsics and poses.

use crate::gltf_builder::GltfBuilder;
use crate::sandbox::Sandbox;
use serde_json::Value;

/// A camera at (0, 0, −3) that looks at the origin, with x to the right, y down and z forward.
const EXTRINSICS: &str = "1,0,0,0, 0,1,0,0, 0,0,1,3";

/// Returns an item of an explanation.
fn item(explanation: &Value, step: &str, id: &str) -> Value {
    let by_id = |list: &Value, id: &str| {
        let list = list.as_array().expect("a list");
        list.iter().find(|entry| entry["id"] == id).cloned().unwrap_or_else(|| panic!("{id}"))
    };
    by_id(&by_id(&explanation["steps"], step)["items"], id)["value"].clone()
}

/// Returns K, and the column and row of the point (0.5, 0.25, 1) with pixel centers at
/// half-integers.
fn seen(sandbox: &Sandbox, flags: &[&str]) -> ([f64; 2], Value) {
    let subject =
        ["explain", "square.gltf", "--point", "0.5,0.25,1", "--json", "--size", "640x480"];
    let run = sandbox.run(&[&subject[..], flags].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{flags:?}");
    let explanation: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let screen = item(&explanation, "viewport", "screen");
    let pixel = [0, 1].map(|at| screen[at].as_f64().expect("a number"));
    (pixel, item(&explanation, "viewport", "intrinsics"))
}

#[test]
fn pixels_follow_the_definition_of_k() {
    let sandbox = Sandbox::new("calibrated");
    GltfBuilder::square().write_file(&sandbox, "square");
    // X/Z = 0.125, Y/Z = 0.0625; with pixel centers at whole numbers, coordinates are half a pixel
    // smaller than in this project.
    let expected = [800.0 * 0.125 + 300.0 + 0.5, 780.0 * 0.0625 + 250.0 + 0.5];
    for flags in [
        ["--intrinsics", "800,780,300,250", "--extrinsics", EXTRINSICS],
        [
            "--intrinsics",
            "[[800, 0, 300], [0, 780, 250], [0, 0, 1]]",
            "--extrinsics",
            "1,0,0,0,0,1,0,0,0,0,1,3,0,0,0,1",
        ],
        // The same camera as a pose: OpenGL's y and z axes point the opposite way.
        ["--intrinsics", "800,780,300,250", "--pose", "1,0,0,0, 0,-1,0,0, 0,0,-1,-3"],
    ] {
        let (pixel, k) = seen(&sandbox, &flags);
        let near = pixel.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(near, "{pixel:?} is not {expected:?} with {flags:?}");
        let rows = [[800.0, 0.0, 300.5], [0.0, 780.0, 250.5], [0.0, 0.0, 1.0]];
        for (row, expected) in rows.iter().enumerate() {
            for (column, expected) in expected.iter().enumerate() {
                let found = k["rows"][row][column].as_f64().expect("a number");
                assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
            }
        }
    }
    let halves = ["--intrinsics", "800,780,300,250", "--pixel-centers", "half"];
    let (pixel, _) = seen(&sandbox, &[&halves[..], &["--extrinsics", EXTRINSICS]].concat());
    assert!((pixel[0] - 400.0).abs() < 1e-9, "{pixel:?}");
}

#[test]
fn invalid_cameras_are_reported() {
    let sandbox = Sandbox::new("uncalibrated");
    GltfBuilder::square().write_file(&sandbox, "square");
    for (flags, code, words) in [
        (&["--intrinsics", "800,780,300"][..], 2, "found 3 numbers"),
        (&["--intrinsics", "0,780,300,250"], 2, "focal lengths must be greater than 0"),
        (&["--extrinsics", "1,2,3"], 2, "expected 12 numbers"),
        (&["--extrinsics", "2,0,0,0,0,2,0,0,0,0,2,0"], 1, "the matrix is not a rotation"),
        (&["--pose", "1,0,0,0,0,1,0,0,0,0,-1,0"], 1, "the matrix is a reflection"),
        (&["--pose", EXTRINSICS, "--view", "front"], 2, "cannot be used with"),
        (&["--intrinsics", "8,8,3,2", "--projection", "isometric"], 2, "cannot be used with"),
    ] {
        let run = sandbox.run(&[&["render", "square.gltf", "-o", "a.png"][..], flags].concat());
        assert_eq!(run.code, code, "{flags:?}: {}", run.stderr);
        assert!(run.stderr.contains(words), "{flags:?}: {}", run.stderr);
        assert!(!sandbox.path_of("a.png").exists(), "{flags:?}");
    }
}

#[test]
fn the_matrix_of_a_calibrated_camera_is_built() {
    let sandbox = Sandbox::new("intrinsics");
    // OpenGL's matrix has 2fx/w and 2fy/h on its diagonal, computed here by hand.
    let numbers = "--intrinsics=800,780,300,250,640,480,1,3";
    let run = sandbox.run(&["matrix", numbers, "--json"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let answer: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let text = answer.to_string();
    for entry in ["2.5", "3.25"] {
        assert!(text.contains(entry), "{entry}: {text}");
    }
    let broken = sandbox.run(&["matrix", "--intrinsics=800,780,300,250,640.5,480,1,3"]);
    assert_eq!(broken.code, 1);
    assert!(broken.stderr.contains("the width must be a whole number, not 640.5"));
}
