//! `alberti matrix`.

use crate::sandbox::Sandbox;
use serde_json::{Value, json};

/// Ortho(−1, 3, −2, 1, 2, 6), as the slides print it: the depth offset has the wrong sign.
const SLIDE: &str = "1/2 0 0 -0.5  0 2/3 0 1/3  0 0 -0.5 2  0 0 0 1";
/// glFrustum(−1, 3, −2, 1, 2, 6).
const FRUSTUM: &str = "[[1,0,.5,0],[0,4/3,-1/3,0],[0,0,-2,-6],[0,0,-1,0]]";

#[test]
fn a_frustum_is_read_back_and_a_misprint_is_found() {
    let sandbox = Sandbox::new("matrix");
    let run = sandbox.run(&["matrix", FRUSTUM]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let read = "OpenGL (near −1, far +1)";
    assert!(run.stdout.contains(read), "{}", run.stdout);
    let window = "perspective: left -1, right 3, bottom -2, top 1, near 2, far 6";
    assert!(run.stdout.contains(window), "{}", run.stdout);
    assert!(!run.stdout.contains("misprint"), "{}", run.stdout);
    let slide: Vec<&str> = SLIDE.split_whitespace().collect();
    let run = sandbox.run(&[&["matrix"], &slide[..]].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert!(run.stdout.contains("known misprint (M15)"), "{}", run.stdout);
}

#[test]
fn json_names_steps_and_items() {
    let sandbox = Sandbox::new("matrix_json");
    let columns = "1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1";
    let run = sandbox.run(&["matrix", "--json", "--column-major", columns]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let found: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(found["schema"], json!({"name": "alberti-explain", "version": 1}));
    let item = |step: &str, item: &str| {
        let named = |list: &Value, id: &str| {
            let entries = list.as_array().expect("a list");
            entries.iter().find(|entry| entry["id"] == id).cloned().expect("an entry of that name")
        };
        named(&named(&found["steps"], step)["items"], item)["value"].clone()
    };
    assert_eq!(item("affine", "translation"), json!([5.0, 6.0, 7.0]));
    assert_eq!(item("kind", "matrix")["rows"][0], json!([1.0, 0.0, 0.0, 5.0]));
}

#[test]
fn what_is_no_matrix_is_refused_with_the_reason() {
    let sandbox = Sandbox::new("matrix_refused");
    for (numbers, reason) in [
        ("1 2 3", "expected 16 numbers, found 3"),
        ("one", "`one` is not a number"),
        (
            "1/0 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1",
            "the entry in row 1, column 1 is not a finite number",
        ),
    ] {
        let run = sandbox.run(&["matrix", numbers]);
        assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{numbers}");
        assert_eq!(run.stderr, format!("error: {reason}\n"));
    }
}
