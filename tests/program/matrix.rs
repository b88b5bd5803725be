//! Tests `alberti matrix`.

use crate::sandbox::Sandbox;
use serde_json::{Value, json};

/// Ortho(−1, 3, −2, 1, 2, 6), as the slides print it: the depth offset has the wrong sign.
const SLIDE: &str = "1/2 0 0 -0.5  0 2/3 0 1/3  0 0 -0.5 2  0 0 0 1";
/// glFrustum(−1, 3, −2, 1, 2, 6).
const FRUSTUM: &str = "[[1,0,.5,0],[0,4/3,-1/3,0],[0,0,-2,-6],[0,0,-1,0]]";

#[test]
fn a_frustum_and_a_misprint_are_recognized() {
    let sandbox = Sandbox::new("matrix");
    let run = sandbox.run(&["matrix", FRUSTUM]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let read = "OpenGL (near −1, far +1)";
    assert!(run.stdout.contains(read), "{}", run.stdout);
    let window = "perspective projection: left -1, right 3, bottom -2, top 1, near 2, far 6";
    assert!(run.stdout.contains(window), "{}", run.stdout);
    assert!(!run.stdout.contains("misprint"), "{}", run.stdout);
    let slide: Vec<&str> = SLIDE.split_whitespace().collect();
    let run = sandbox.run(&[&["matrix"], &slide[..]].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert!(run.stdout.contains("known misprint (M15)"), "{}", run.stdout);
}

#[test]
fn json_steps_and_items_have_ids() {
    let sandbox = Sandbox::new("matrix_json");
    let columns = "1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1";
    let run = sandbox.run(&["matrix", "--json", "--column-major", columns]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let found: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(found["schema"], json!({"name": "alberti-explain", "version": 1}));
    let item = |step: &str, item: &str| {
        let named = |list: &Value, id: &str| {
            let entries = list.as_array().expect("a list");
            entries.iter().find(|entry| entry["id"] == id).cloned().expect("an entry with that id")
        };
        named(&named(&found["steps"], step)["items"], item)["value"].clone()
    };
    assert_eq!(item("affine", "translation"), json!([5.0, 6.0, 7.0]));
    assert_eq!(item("kind", "matrix")["rows"][0], json!([1.0, 0.0, 0.0, 5.0]));
}

#[test]
fn invalid_matrices_are_refused_with_the_reason() {
    let sandbox = Sandbox::new("matrix_refused");
    for (numbers, reason) in [
        ("1 2 3", "expected 16 numbers, or 9 for a 3 × 3 matrix, found 3"),
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

/// Returns the entries of a matrix as arguments.
fn words(numbers: &str) -> Vec<&str> {
    [vec!["matrix"], numbers.split_whitespace().collect()].concat()
}

/// Returns the value after a label in the report.
fn labeled<'a>(report: &'a str, label: &str) -> &'a str {
    let line = report.lines().find_map(|line| line.trim().strip_prefix(label));
    line.expect("the label").trim()
}

#[test]
fn matrices_from_the_sources_are_not_misprints() {
    let sandbox = Sandbox::new("matrix_sources");
    for (numbers, verdict) in [
        ("-2 0 0 0 0 -2 0 0 0 0 -8 -12 0 0 1 0", "It is the textbook's P: n = -2, f = -6."),
        (
            "-1 0 -.5 0 0 -4/3 1/3 0 0 0 -2 -6 0 0 1 0",
            ", for the textbook (near +1, far −1), times -1",
        ),
        (
            "1 0 0 0 0 1 0 0 0 0 0 0 0 0 -0.2 1",
            "It is a one-point perspective, onto the plane z = 0: (p, q, r) = (0, 0, -0.2).",
        ),
        ("1 0 0 0 0 1 0 0 0 0 1 0 .1 .2 .3 1", "depth preserved: (p, q, r) = (0.1, 0.2, 0.3)"),
        (
            "320 0 0 319.5 0 -240 0 239.5 0 0 1 0 0 0 0 1",
            "It is the viewport of 640 × 480 pixels, with y down and centers at integers.",
        ),
    ] {
        let run = sandbox.run(&words(numbers));
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{numbers}");
        assert!(run.stdout.contains(verdict), "{numbers}: {}", run.stdout);
        assert!(!run.stdout.contains("misprint"), "{numbers}: {}", run.stdout);
    }
}

#[test]
fn row_vectors_and_the_lessons_misprint_are_identified() {
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
fn angles_and_the_inverse_are_printed_with_significant_digits() {
    let sandbox = Sandbox::new("matrix_angles");
    let run = sandbox.run(&words("0.9743 0 0 0 0 1.7321 0 0 0 0 -1.0020 -0.2002 0 0 -1 0"));
    assert_eq!(labeled(&run.stdout, "vertical field of view, degrees"), "60");
    for line in ["Inverse", "near 0.1, far 100"] {
        assert!(run.stdout.contains(line), "{line}: {}", run.stdout);
    }
}

#[test]
fn flags_may_follow_negative_numbers() {
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
fn nine_numbers_are_a_planar_matrix() {
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
fn matrices_built_from_parameters_list_their_factors() {
    let sandbox = Sandbox::new("matrix_built");
    let run = sandbox.run(&["matrix", "--json", "--frustum", "-1,3,-2,1,2,6"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let built: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let rows = &built["steps"][0]["items"][0]["value"]["rows"];
    assert_eq!(rows[0], json!([1.0, 0.0, 0.5, 0.0]));
    assert_eq!(rows[3], json!([0.0, 0.0, -1.0, 0.0]));
    assert_eq!(built["steps"][1]["items"].as_array().map(Vec::len), Some(3), "three factors");
    // A built matrix is recognized in every convention.
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
fn invalid_parameters_are_reported() {
    let sandbox = Sandbox::new("matrix_parameters");
    for (flags, reason) in [
        (["--frustum", "1,2,3"], "--frustum expects 6 numbers, found 3"),
        (
            ["--perspective", "60,1,2,1"],
            "`far` (1) must be beyond `near` (2) along the line of sight",
        ),
        (["--n-point", "0,0,0"], "p, q and r are all 0: this is a parallel projection"),
    ] {
        let run = sandbox.run(&[&["matrix"], &flags[..]].concat());
        assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{flags:?}");
        assert!(run.stderr.contains(reason), "{}", run.stderr);
    }
}

/// The output of `--code` can be used as input.
#[test]
fn pasted_code_is_read_back() {
    let sandbox = Sandbox::new("matrix_pasted");
    for (language, order) in [
        ("c", "column by column"),
        ("glsl", "column by column"),
        ("python", "row by row"),
        ("rust", "column by column"),
        ("latex", "row by row"),
    ] {
        let code = sandbox.run(&["matrix", "--look-at", "4,3,6,0,0,0", "--code", language]).stdout;
        let run = sandbox.run(&["matrix", &code]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{language}");
        assert!(run.stdout.contains("camera transform: eye (4, 3, 6)"), "{}", run.stdout);
        let header = run.stdout.lines().next().expect("a header");
        assert!(header.contains(&format!("read {order}")), "{language}: {header}");
    }
    let bare = "mat4(1,0,0,0, 0,1,0,0, 0,0,1,0, 2.0f,3.0f,4.0f,1)";
    let run = sandbox.run(&["matrix", bare]);
    assert!(run.stdout.contains("It is a translation by (2, 3, 4)."), "{}", run.stdout);
    assert!(run.stdout.contains("column by column, as in mat constructors"), "{}", run.stdout);
}

/// Near and far are distances; the textbook's coordinates are refused with the sentence from the
/// help.
#[test]
fn signed_planes_are_refused_where_distances_are_expected() {
    let sandbox = Sandbox::new("matrix_signed");
    let sentence = "For the textbook's coordinates 0 > n > f, use near = -n and far = -f";
    for flags in [
        ["--ortho=-2,2,-1,3,-1,-5", "--conventions=chapter"],
        ["--ortho=-2,2,-1,3,-1,-5", "--conventions=opengl"],
        ["--ortho=-2,2,-1,3,-1,5", "--conventions=chapter"],
        ["--frustum=-2,2,-1,3,-1,-5", "--conventions=chapter"],
        ["--moved-apex=-2,2,-1,3,-1,-5", "--conventions=opengl"],
        ["--perspective=60,1,-1,-5", "--conventions=opengl"],
        ["--oblique=1/2,45,-2,2,-1,3,-1,-5", "--conventions=chapter"],
    ] {
        let run = sandbox.run(&["matrix", flags[0], flags[1]]);
        assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{flags:?}");
        assert!(run.stderr.contains(sentence), "{flags:?}: {}", run.stderr);
    }
    let help = sandbox.run(&["matrix", "-h"]).stdout.replace("\n", " ");
    assert!(help.contains(sentence), "{help}");
    // glOrtho's box around the eye.
    assert_eq!(sandbox.run(&["matrix", "--ortho", "-1,1,-1,1,-1,1"]).code, 0);
}

#[test]
fn flags_without_effect_are_refused_by_name() {
    let sandbox = Sandbox::new("matrix_conflicts");
    for (flags, reason) in [
        (&["--p", "-1,-3", "--reversed"][..], "--reversed has no effect on --p"),
        (&["--translate", "1,2,3", "--onto-plane"], "--onto-plane has no effect on --translate"),
        (&["--scale", "1,2,3", "--conventions", "vulkan"], "--conventions has no effect on"),
        (&["--oblique", "1,45", "--reversed"], "--reversed has no effect on --oblique"),
        (&["--oblique", "1,45,-1,1,-1,1,1,5", "--onto-plane"], "--onto-plane drops z"),
        (&["--reversed", "1 0 0 0 1 0 0 0 1"], "--reversed applies only to matrices from"),
        (&["--conventions", "vulkan", "1 0 0 0 1 0 0 0 1"], "--conventions applies only to"),
        (&["--point", "1,2,3", "1 0 0 0 1 0 0 0 1"], "--point needs a 4 × 4 matrix"),
    ] {
        let run = sandbox.run(&[&["matrix"], flags].concat());
        assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{flags:?}");
        assert!(run.stderr.contains(reason), "{flags:?}: {}", run.stderr);
    }
}

/// Exercises 2, 7 and 10: M_vp M_orth P M_cam, as written, with the rightmost applied first.
#[test]
fn several_matrices_are_multiplied_as_written() {
    let sandbox = Sandbox::new("matrix_product");
    let chain = "--viewport 4,3 --ortho -2,2,-1,3,1,5 --p -1,-5 --translate 0,0,-1";
    let flags: Vec<&str> = chain.split(' ').chain(["--conventions", "chapter"]).collect();
    let run = sandbox.run(&[&["matrix", "--json", "--point", "1,1,-2"], &flags[..]].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let found: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let factors = found["steps"][1]["items"].as_array().expect("factors");
    let names: Vec<&str> = factors.iter().filter_map(|item| item["name"].as_str()).collect();
    let expected = ["--translate 0,0,-1", "--p -1,-5", "--ortho -2,2,-1,3,1,5", "--viewport 4,3"];
    assert_eq!(names, expected);
    // (1, 1, −2) moves to (1, 1, −3); P divides x and y by 3 and maps z to −6 + 5/3.
    let steps = found["steps"].as_array().expect("steps");
    let image = steps.iter().find(|step| step["id"] == "image").expect("an image");
    let divided: Vec<f64> = image["items"][2]["value"]
        .as_array()
        .expect("x, y, z")
        .iter()
        .filter_map(Value::as_f64)
        .collect();
    // xs = 2 x/2 + 3/2, ys = 3/2 (y − 1)/2 + 1, z = (2 z + 6)/4
    let third = 1.0 / 3.0;
    let expected =
        [third + 1.5, 0.75 * (third - 1.0) + 1.0, (2.0 * (5.0 * third - 6.0) + 6.0) / 4.0];
    assert!(divided.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{divided:?}");
    let subject = found["subject"].as_str().expect("a subject");
    assert!(subject.contains("--viewport · --ortho · --p · --translate"), "{subject}");
    let [look_at, look_to] =
        [["--look-at", "0,1,0,0,0,0,1,1,0"], ["--look-to", "0,1,0,0,-1,0,1,1,0"]]
            .map(|flags| sandbox.run(&["matrix", "--code", "c", flags[0], flags[1]]).stdout);
    assert_eq!(look_at, look_to);
}

#[test]
fn formula_ids_match_the_printed_matrix() {
    let sandbox = Sandbox::new("matrix_formulas");
    for (flags, title) in [
        ("--viewport 4,3 --conventions chapter", "The matrix (VP-1)"),
        ("--viewport 4,3 --conventions chapter-y-down", "The matrix (VP-2)"),
        ("--viewport 4,3 --conventions vulkan", "The matrix (VP-3)"),
        ("--ortho -1,1,-1,1,1,3 --conventions chapter", "The matrix (OR-1)"),
        ("--ortho -1,1,-1,1,1,3", "The matrix (GL-3)"),
        ("--frustum -1,1,-1,1,1,3", "The matrix (GL-1)"),
        ("--perspective 60,1,1,3", "The matrix (GL-2)"),
        ("--perspective 60,1,1,inf --conventions webgpu --reversed", "The matrix (IF-3)"),
        ("--perspective 60,1,1,3 --conventions direct3d", "The matrix (D3D-1)"),
        ("--frustum -1,1,-1,1,1,3 --conventions chapter", "-M_per: w is the distance ahead"),
        ("--n-point 0,0.2,0.1", "The matrix (TWO-1)"),
    ] {
        let run = sandbox.run(&[&["matrix"], &flags.split(' ').collect::<Vec<_>>()[..]].concat());
        assert!(run.code == 0 && run.stdout.contains(title), "{flags}: {}", run.stdout);
    }
    let header = |flags: &[&str]| sandbox.run(flags).stdout.lines().next().map(str::to_owned);
    let opengl = header(&["matrix", "--frustum", "-1,1,-1,1,1,3"]).expect("a header");
    assert!(opengl.ends_with("(conventions: opengl)"), "{opengl}");
}

/// For matrices stored by columns, the transposed reading comes first; classical projections are
/// named.
#[test]
fn the_likeliest_reading_comes_first() {
    let sandbox = Sandbox::new("matrix_first");
    for (numbers, verdict) in [
        ("1 0 0 0 0 1 0 0 0 0 1 0 3 4 5 1", "\nTransposed, it is a translation by (3, 4, 5)"),
        (
            "0.9743 0 0 0 0 1.7321 0 0 0 0 -1.0020 -1 0 0 -0.2002 0",
            "\nTransposed, it is a perspective projection: left -0.1026, right 0.1026, bottom -0.05773, top \
             0.05773, near 0.1, far 100",
        ),
        ("320 0 0 0 0 240 0 0 0 0 1 0 319.5 239.5 0 1", "\nTransposed, it is the viewport"),
        ("525 0 0 0 525 0 319.5 239.5 1", "\nTransposed, it is camera intrinsics"),
        (
            "1 0 .25 0 0 1 .433 0 0 0 0 0 0 0 0 1",
            "(cabinet) onto the plane z = 0: length 0.5, angle 60°",
        ),
        (
            "1 0 .5 0 0 1 .866 0 0 0 0 0 0 0 0 1",
            "(cavalier) onto the plane z = 0: length 1, angle 60°",
        ),
        (
            ".866 0 .5 0 .5 1 -.866 0 0 0 0 0 0 0 0 1",
            "It is a military projection: the plan of x and z rotated by 30°",
        ),
        (
            "0.707107 0 -0.707107 0 -0.408248 0.816497 -0.408248 0 0.57735 0.57735 0.57735 \
             -8.660254037844387 0 0 0 1",
            "It is a camera transform: eye (5, 5, 5)",
        ),
        ("-200 0 199.5 0 0 -150 149.5 0 0 0 -2 -6 0 0 1 0", "and a viewport in one"),
    ] {
        let run = sandbox.run(&words(numbers));
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{numbers}");
        assert!(run.stdout.contains(verdict), "{numbers}: {}", run.stdout);
    }
    // Zeros are not printed as rounding noise such as 5.6e-17.
    let inverse = sandbox.run(&["matrix", "--rotate", "1,2,3,40", "--translate", "1,1,1"]).stdout;
    assert!(!inverse.contains("e-1"), "{inverse}");
}
