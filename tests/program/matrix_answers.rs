//! The answers that `alberti matrix` and `alberti explain` give to a teacher's questions: Direct3D
//! conventions, rigid matrices, signs, and command lines that are almost correct.

use crate::sandbox::Sandbox;

fn report(sandbox: &Sandbox, command: &str, numbers: &str) -> String {
    let words: Vec<&str> = command.split(' ').chain(numbers.split_whitespace()).collect();
    let run = sandbox.run(&words);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{numbers}");
    run.stdout
}

#[test]
fn the_likeliest_reading_matches_the_source_program() {
    let sandbox = Sandbox::new("matrix_answers");
    for (numbers, words) in [
        (
            "1.299038 0 0 0 0 1.732051 0 0 0 0 1.020408 4.081633 0 0 1 5",
            "in a left-handed world: eye (0, 0, -5), gaze (0, 0, 1), up (0, 1, 0)",
        ),
        ("0.0025 0 0 -1 0 -0.0033333333 0 1 0 0 -1 0 0 0 0 1", "bottom 600, top 0, near -1, far 1"),
        (
            "0.866 -0.5 0 5 0.5 0.866 0 2 0 0 1 0 0 0 0 1",
            "It is a model transform: rotation by 30° about (0, 0, 1), translation (5, 2, 0).",
        ),
        ("1 0 0 0 0 1 0 0 0 0 0 0 0 0 1 0", "from the origin onto the plane z = 1, z dropped."),
        (
            "0.9743 0 0 0 0 1.7321 0 0 0 0 -1.0020 -0.2002 0 0 1 0",
            "It looks like a misprint. With its last row negated, it is a perspective projection: left -0.1026",
        ),
        (
            "0.8575 0 -0.5145 0 0.291 0.8246 -0.4851 0 0.4243 0.5657 0.7071 -7.0711 0 0 0 1",
            "With the sign of row 2, column 1 flipped, it is a camera transform: eye (3, 4, 5)",
        ),
    ] {
        let found = report(&sandbox, "matrix", numbers);
        assert!(found.contains(words), "{numbers}: {found}");
    }
    // A rigid matrix is also reported as a camera, and vice versa.
    let moved = report(&sandbox, "matrix", "0.866 -0.5 0 5 0.5 0.866 0 2 0 0 1 0 0 0 0 1");
    assert!(moved.contains("a camera transform: eye (-5.33, 0.77, 0)"), "{moved}");
    let camera = "0.8575 0 -0.5145 0 -0.291 0.8246 -0.4851 0 0.4243 0.5657 0.7071 -7.0711 0 0 0 1";
    let camera = report(&sandbox, "matrix", camera);
    assert!(camera.contains("It is a camera transform: eye (3, 4, 5)"), "{camera}");
    assert!(camera.contains("a model transform: rotation by"), "{camera}");
    assert!(camera.contains("a camera pose (view to world): eye (0, 0, -7.0711)"), "{camera}");
}

/// The slips of students: one sign of a projection or a rotation, and mirrored windows.
#[test]
fn one_wrong_sign_is_named_with_other_repairs() {
    let sandbox = Sandbox::new("matrix_one_sign");
    for (numbers, words) in [
        (
            "0.974279 0 0 0 0 1.732051 0 0 0 0 -1.002002 0.2002 0 0 -1 0",
            "With the sign of row 3, column 4 flipped, it is a perspective projection: left -0.10264",
        ),
        (
            "1 0 .5 0 0 4/3 1/3 0 0 0 -2 6 0 0 -1 0",
            "column 4 flipped, it is a perspective projection: left -1, right 3, bottom -1, top 2, \
             near 2, far 6, for OpenGL",
        ),
        (
            "-2 0 0 0 0 -2 0 0 0 0 -8 12 0 0 1 0",
            "row 3, column 4 flipped, it is the textbook's P: n = -2, f = -6.\n",
        ),
        (
            "1.609476 0 0 0 0 -2.414214 0 0 0 0 1.001001 -0.1001 0 0 -1 0",
            "for Vulkan (near 0, far 1, y down). Another repair is possible: negate the last row.",
        ),
        (
            "0.8776 0 0.4794 0 0 1 0 0 0.4794 0 0.8776 0 0 0 0 1",
            "Another repair is possible: flip the sign of row 1, column 3.",
        ),
        (
            "-0.974279 0 0 0 0 1.732051 0 0 0 0 -1.002002 -0.2002 0 0 -1 0",
            "As given, it is a perspective projection, mirrored left to right: left 0.10264, right",
        ),
        (
            "1 0 0 .5 0 4/3 0 1/3 0 0 -6 -2 0 0 0 -1",
            "With columns 3 and 4 exchanged, it is a perspective projection: left -1, right 3",
        ),
        (
            "1.299038 0 0 0 0 1.732051 0 0 0 0 1.020408 -0.102041 0 0 1 1",
            "a misprint in which the last entry is 1 instead of 0, so w is the distance plus 1.",
        ),
        (
            "1 0 0 0 0 1.7778 0 0 0 0 0 1 0 0 10 0",
            "near 10, far infinite, for Direct3D with reversed depth",
        ),
    ] {
        let found = report(&sandbox, "matrix", numbers);
        assert!(found.contains(words), "{numbers}: {found}");
    }
}

/// Views from (1, 2, −5) to the origin, as Direct3D prints them and as OpenCV's extrinsics.
#[test]
fn a_view_is_read_with_the_gaze_of_its_interface() {
    let sandbox = Sandbox::new("matrix_views");
    let gaze = "eye (1, 2, -5), gaze (-0.1826, -0.3652, 0.9129), up (-0.0716, 0.9309, 0.3581)";
    for (numbers, axes) in [
        (
            "0.9806 -0.0716 -0.1826 0 0 0.9309 -0.3651 0 0.1961 0.3581 0.9129 0 0 0 5.4772 1",
            "looks along +z, as in Direct3D",
        ),
        (
            "-0.9806 0 -0.1961 0 0.0716 -0.9309 -0.3581 0 -0.1826 -0.3651 0.9129 5.4772 0 0 0 1",
            "looks along +z with y down, as in OpenCV",
        ),
    ] {
        let found = report(&sandbox, "matrix", numbers);
        let verdict = found.lines().last().expect("a verdict");
        assert!(verdict.contains(&format!("{gaze}, for a view space that {axes}.")), "{verdict}");
    }
}

/// XMMatrixLookAtLH: zaxis = at − eye, xaxis = up × zaxis, yaxis = zaxis × xaxis, each of length 1.
#[test]
fn the_direct3d_camera_is_look_at_lh() {
    let sandbox = Sandbox::new("matrix_look_at_lh");
    let flags = "matrix --look-at 0,2,-5,0,0,0 --conventions direct3d";
    let found = report(&sandbox, flags, "");
    let rows: Vec<Vec<&str>> = found
        .lines()
        .filter_map(|line| Some(line.split_once('[')?.1.split_whitespace().collect()))
        .collect();
    assert_eq!(rows[0], ["1", "0", "0", "0", "]"]);
    assert_eq!(rows[1], ["0", "0.928477", "0.371391", "0", "]"]);
    assert_eq!(rows[2], ["0", "-0.371391", "0.928477", "5.385165", "]"]);
    assert!(found.contains("XMMatrixLookAtLH"), "{found}");
    // The product with the projection is recognized without a flip.
    let flags = "--perspective 60,1.5,0.1,100 --look-at 1,2,-5,0,0,0 --conventions direct3d";
    let code = report(&sandbox, &format!("matrix {flags} --code python"), "");
    let numbers: Vec<&str> = code.lines().skip(1).filter(|line| *line != "]").collect();
    let read = sandbox.run(&["matrix", &numbers.join(" ")]).stdout;
    assert!(read.contains("left-handed world: eye (1, 2, -5)"), "{read}");
    assert!(read.contains("Direct3D (near 0, far 1, looks along +z)"), "{read}");
}

#[test]
fn errors_suggest_a_fix() {
    let sandbox = Sandbox::new("matrix_way_out");
    for (command, words) in [
        (
            "matrix --look-to 0,1,0 0,-1,0 1,0,0",
            "for one list of 9 numbers, write `--look-to 0,1,0,0,-1,0,1,0,0`",
        ),
        (
            "matrix --look-to 0,1,0",
            "--look-to expects 6 or 9 numbers, found 3; join them with commas",
        ),
        ("matrix --ortho -1,1,-1,1,0,1 1", "takes one list of numbers joined by commas"),
        ("explain --segment 0,0,0,1,1,1", "--planes N,F (the textbook's P) or --matrix NUMBERS"),
        ("explain --point 1,2,3 --matrix 1 0 0 0", "join numbers with commas, or quote them"),
    ] {
        let run = sandbox.run(&command.split(' ').collect::<Vec<_>>());
        assert!(run.code != 0 && run.stdout.is_empty(), "{command}");
        assert!(run.stderr.contains(words), "{command}: {}", run.stderr);
        assert!(run.stderr.lines().count() < 8, "{command}: {}", run.stderr);
    }
}

#[test]
fn a_segment_through_the_eye_plane_has_one_verdict() {
    let sandbox = Sandbox::new("matrix_segment");
    let found = report(&sandbox, "explain --planes -1,-3 --segment 0,0,-1,0,0,1", "");
    assert!(found.contains("w changes sign between them"), "{found}");
    assert!(!found.contains("f(t) gives"), "{found}");
    let found = report(&sandbox, "explain --planes -1,-3 --segment 0,0,-1,0,0,-2", "");
    assert!(found.contains("Both ends are mapped; f(t) gives"), "{found}");
}

#[test]
fn both_scalings_of_the_inverse_of_p_refer_to_each_other() {
    let sandbox = Sandbox::new("matrix_p_inverse");
    let built = report(&sandbox, "matrix --p -1,-3", "");
    assert!(built.contains("`alberti explain --planes N,F`"), "{built}");
    let explained = report(&sandbox, "explain --planes -1,-3", "");
    assert!(explained.contains("alberti matrix --p -1,-3"), "{explained}");
}

#[test]
fn reports_are_free_of_rounding_noise() {
    let sandbox = Sandbox::new("matrix_noise");
    let planar = report(&sandbox, "matrix", "1 0 0 0 1 0 5 2 1");
    assert!(planar.contains("Nine numbers") && !planar.contains("Sixteen"), "{planar}");
    let turned = report(&sandbox, "matrix", "1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1");
    assert!(!turned.contains("e-1"), "{turned}");
    assert_eq!(turned.matches("translation by (5, 6, 7)").count(), 2, "{turned}");
    // Small numbers are kept unless they are rounding errors.
    let scale = report(&sandbox, "matrix --scale 1e16,1,1", "");
    assert!(scale.contains("1e-16"), "{scale}");
    let help = sandbox.run(&["help", "matrix"]).stdout;
    assert_eq!(help.matches("\n  alberti matrix ").count(), 3, "{help}");
}
