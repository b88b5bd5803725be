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
        ("1 2 3", "expected 16 numbers, or 9 of a 3 × 3 matrix, found 3"),
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

/// The numbers of a matrix as arguments.
fn words(numbers: &str) -> Vec<&str> {
    [vec!["matrix"], numbers.split_whitespace().collect()].concat()
}

/// The value behind a label of the report.
fn labeled<'a>(report: &'a str, label: &str) -> &'a str {
    let line = report.lines().find_map(|line| line.trim().strip_prefix(label));
    line.expect("the label").trim()
}

#[test]
fn the_sources_own_matrices_are_no_misprints() {
    let sandbox = Sandbox::new("matrix_sources");
    for (numbers, verdict) in [
        ("-2 0 0 0 0 -2 0 0 0 0 -8 -12 0 0 1 0", "It is the textbook's P: n = -2, f = -6."),
        (
            "-1 0 -.5 0 0 -4/3 1/3 0 0 0 -2 -6 0 0 1 0",
            "in the convention of the textbook (near +1, far −1), times -1",
        ),
        (
            "1 0 0 0 0 1 0 0 0 0 0 0 0 0 -0.2 1",
            "It is a one-point perspective, onto the plane z = 0: (p, q, r) = (0, 0, -0.2).",
        ),
        ("1 0 0 0 0 1 0 0 0 0 1 0 .1 .2 .3 1", "depth kept: (p, q, r) = (0.1, 0.2, 0.3)"),
        (
            "320 0 0 319.5 0 -240 0 239.5 0 0 1 0 0 0 0 1",
            "It is the viewport of 640 × 480 pixels, y down, pixel centers at whole numbers.",
        ),
    ] {
        let run = sandbox.run(&words(numbers));
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{numbers}");
        assert!(run.stdout.contains(verdict), "{numbers}: {}", run.stdout);
        assert!(!run.stdout.contains("misprint"), "{numbers}: {}", run.stdout);
    }
}

#[test]
fn row_vectors_and_the_lessons_slip_are_named_by_their_cause() {
    let sandbox = Sandbox::new("matrix_slips");
    let printed = "0.9743 0 0 0 0 1.7321 0 0 0 0 -1.0020 -1 0 0 -0.2002 0";
    let run = sandbox.run(&words(printed));
    assert!(run.stdout.contains("this matrix is for row vectors"), "{}", run.stdout);
    let eq5 = "2 0 0 0 0 2 0 0 0 0 1 0 0 0 -1 1";
    let run = sandbox.run(&words(eq5));
    assert!(run.stdout.contains("known misprint (M14)"), "{}", run.stdout);
    let run = sandbox.run(&words("1 0 0 2 0 1 0 3 0 0 1 3 0 0 0 1"));
    assert!(run.stdout.contains("It is a translation by (2, 3, 3)."), "{}", run.stdout);
    assert!(run.stdout.contains("A known misprint (M6) has the same numbers"), "{}", run.stdout);
}

#[test]
fn angles_and_the_inverse_are_printed_with_the_digits_that_matter() {
    let sandbox = Sandbox::new("matrix_angles");
    let run = sandbox.run(&words("0.9743 0 0 0 0 1.7321 0 0 0 0 -1.0020 -0.2002 0 0 -1 0"));
    assert_eq!(labeled(&run.stdout, "vertical field of view, degrees"), "60");
    for line in ["Its inverse", "near 0.1, far 100"] {
        assert!(run.stdout.contains(line), "{line}: {}", run.stdout);
    }
}

#[test]
fn flags_may_stand_behind_numbers_that_begin_with_a_minus_sign() {
    let sandbox = Sandbox::new("matrix_flags_behind");
    let numbers = "-2 0 0 0 0 -2 0 0 0 0 -8 -12 0 0 1 0";
    let before = sandbox.run(&[&["matrix", "--json"], &words(numbers)[1..]].concat());
    let behind = sandbox.run(&[&words(numbers)[..], &["--json"]].concat());
    assert_eq!((before.code, &before.stdout), (0, &behind.stdout));
    let code = sandbox.run(&[&words(numbers)[..], &["--code", "c"]].concat());
    assert!(code.stdout.starts_with("const double matrix[16] = {"), "{}", code.stdout);
    let wrong = sandbox.run(&[&words(numbers)[..], &["--jsn"]].concat());
    assert_eq!((wrong.code, wrong.stdout.as_str()), (1, ""));
    assert_eq!(wrong.stderr, "error: `--jsn` is not a number\n");
}

#[test]
fn nine_numbers_are_a_matrix_of_the_plane() {
    let sandbox = Sandbox::new("matrix_plane");
    let run = sandbox.run(&words("2 0 -1 0 3 0 0 2/3 1/3"));
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for corner in ["(0, 0)  (-3, 0)", "(1, 0)  (3, 0)", "(1, 1)  (1, 3)", "(0, 1)  (-1, 3)"] {
        assert!(run.stdout.contains(corner), "{corner}: {}", run.stdout);
    }
    let run = sandbox.run(&words("525 0 319.5 0 525 239.5 0 0 1"));
    assert!(run.stdout.contains("camera intrinsics K: fx 525, fy 525"), "{}", run.stdout);
}

#[test]
fn matrices_are_built_from_parameters_with_factors() {
    let sandbox = Sandbox::new("matrix_built");
    let run = sandbox.run(&["matrix", "--json", "--frustum", "-1,3,-2,1,2,6"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let built: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let rows = &built["steps"][0]["items"][0]["value"]["rows"];
    assert_eq!(rows[0], json!([1.0, 0.0, 0.5, 0.0]));
    assert_eq!(rows[3], json!([0.0, 0.0, -1.0, 0.0]));
    assert_eq!(built["steps"][1]["items"].as_array().map(Vec::len), Some(3), "three factors");
    // What is built is read back, in every convention.
    for conventions in ["chapter", "opengl", "vulkan", "direct3d", "webgpu"] {
        let flags = ["--perspective", "50,3/2,0.1,100", "--conventions", conventions];
        let run = sandbox.run(&[&["matrix", "--code", "python"], &flags[..]].concat());
        let numbers: Vec<&str> = run.stdout.lines().skip(1).filter(|line| *line != "]").collect();
        let read = sandbox.run(&["matrix", &numbers.join(" ")]);
        assert!(read.stdout.contains("near 0.1, far 100"), "{conventions}: {}", read.stdout);
        assert_eq!(labeled(&read.stdout, "vertical field of view, degrees"), "50");
    }
}

#[test]
fn code_is_written_in_the_order_of_its_language() {
    let sandbox = Sandbox::new("matrix_code");
    let code = |language: &str, flags: &[&str]| {
        let run = sandbox.run(&[&["matrix", "--code", language], flags].concat());
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        run.stdout
    };
    let moved = ["--translate", "2,-3,.5"];
    let glsl = "const mat4 matrix = mat4( // column by column\n    1.0, 0.0, 0.0, 0.0,\n    \
                0.0, 1.0, 0.0, 0.0,\n    0.0, 0.0, 1.0, 0.0,\n    2.0, -3.0, 0.5, 1.0\n);\n";
    assert_eq!(code("glsl", &moved), glsl);
    assert!(code("c", &moved).contains("    2.0, -3.0, 0.5, 1.0,\n};\n"));
    assert!(code("rust", &moved).contains("    [2.0, -3.0, 0.5, 1.0],\n"));
    assert!(code("python", &moved).contains("    [1.0, 0.0, 0.0, 2.0],\n"));
    assert!(code("latex", &["--viewport", "640,480"]).contains("  320 & 0 & 0 & 320 \\\\\n"));
    let chapter = ["--viewport", "640,480", "--conventions", "chapter"];
    assert!(code("python", &chapter).contains("    [320.0, 0.0, 0.0, 319.5],\n"));
    // Exercise 10.
    let camera = ["--look-at", "0,1,0,0,0,0,1,1,0"];
    let rows = "    [0.0, 0.0, 1.0, 0.0],\n    [1.0, 0.0, 0.0, 0.0],\n    [0.0, 1.0, 0.0, -1.0],\n";
    assert!(code("python", &camera).contains(rows), "{}", code("python", &camera));
}

#[test]
fn refused_parameters_are_named() {
    let sandbox = Sandbox::new("matrix_parameters");
    for (flags, reason) in [
        (["--frustum", "1,2,3"], "--frustum takes 6 numbers, found 3"),
        (
            ["--perspective", "60,1,2,1"],
            "`far` (1) must lie beyond `near` (2) along the line of sight",
        ),
        (["--n-point", "0,0,0"], "p, q and r are all 0: that is a parallel projection"),
    ] {
        let run = sandbox.run(&[&["matrix"], &flags[..]].concat());
        assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{flags:?}");
        assert!(run.stderr.contains(reason), "{}", run.stderr);
    }
    assert_eq!(sandbox.run(&["matrix", "--ortho", "-1,1,-1,1,0,1", "1"]).code, 2);
}
