//! Tests: mistakes people make in scene files, and what they are told.

use super::parse_scene;

/// What is wrong, where (line and column), and the help.
fn told(source: &str) -> (String, (usize, usize), String) {
    let error = parse_scene("scene.ron", source).expect_err(source);
    let text = error.to_string();
    let (line, column) = error.line_and_column();
    // An empty file has no line to show.
    let place = format!("scene.ron:{line}:{column}");
    assert!(source.is_empty() || text.contains(&place), "{text}");
    (error.message.clone(), (line, column), error.help.unwrap_or_default())
}

#[track_caller]
fn check(source: &str, message: &str, place: (usize, usize), help: &str) {
    let expected = (message.to_owned(), place, help.to_owned());
    assert_eq!(told(source), expected, "{source}");
}

/// A scene with one more field behind the models.
fn with(field: &str) -> String {
    format!("Scene(\n  models: [(path: \"a.glb\")],\n  {field}\n)")
}

#[test]
fn near_misses_are_answered_with_the_name_that_was_meant() {
    check(
        "Scene(models: [Model(path: \"a.glb\", rotate: (0, 30, 0))])",
        "unexpected field `rotate` in `Model`",
        (1, 37),
        "did you mean `rotate_degrees`?",
    );
    check(
        &with("camera: (view: LookAt(eye: (4, 3, 5.5), traget: (0, 0, 0))),"),
        "unexpected field `traget` in `LookAt`",
        (3, 43),
        "did you mean `target`?",
    );
    check(
        &with("camera: (projection: Perspectiv(fov_y_degrees: 18)),"),
        "unexpected `Perspectiv` for `Projection`",
        (3, 24),
        "did you mean `Perspective`?",
    );
    check(
        &with("style: Hatched"),
        "unexpected `Hatched` for `Style`",
        (3, 10),
        "possible here: `Shaded`, `Flat`, `Gouraud`, `Clay`, `Matcap`, `Normals`, `Depth`, `UvChecker`, `Ids`, `Toon`, `XRay`, `Wireframe`, `Lines`",
    );
}

#[test]
fn numbers_out_of_range_are_named_with_their_path() {
    let place = |field: &str| (3, field.find('?').expect("a mark") + 3);
    for (field, value, message) in [
        (
            "lights: [Ambient(lux: ?)]",
            "-1",
            "`lights[0].Ambient.lux`: expected 0 or a greater number, found -1",
        ),
        (
            "lights: [Ambient(lux: ?)]",
            "inf",
            "`lights[0].Ambient.lux`: expected 0 or a greater number, found inf",
        ),
        (
            "camera: (view: LookTo(eye: (0, ?, 0), gaze: (0, 0, 1)))",
            "NaN",
            "`camera.view.LookTo.eye[1]`: expected a finite number, found NaN",
        ),
        (
            "camera: (view: LookTo(eye: (0, ?, 0), gaze: (0, 0, 1)))",
            "1e400",
            "`camera.view.LookTo.eye[1]`: expected a finite number, found inf",
        ),
        (
            "camera: (view: LookTo(eye: ?, gaze: (0, 0, 1)))",
            "(1, 2)",
            "`camera.view.LookTo.eye`: expected three numbers, found 2",
        ),
        (
            "camera: (view: LookTo(eye: ?, gaze: (0, 0, 1)))",
            "[1, 2, 3, 4]",
            "`camera.view.LookTo.eye`: expected three numbers, found 4",
        ),
        (
            "camera: (projection: Perspective(fov_y_degrees: ?))",
            "180",
            "`camera.projection.Perspective.fov_y_degrees`: expected an angle between 0 and 180 degrees, found 180",
        ),
        (
            "camera: (projection: Perspective(near: ?))",
            "0",
            "`camera.projection.Perspective.near`: expected a number greater than 0, found 0",
        ),
    ] {
        check(&with(&field.replace('?', value)), message, place(field), "");
    }
}

#[test]
fn faults_of_grammar_are_pointed_at() {
    let begin = "a scene looks like this: Scene(models: [(path: \"model.glb\")])";
    check("", "the file is empty", (1, 1), begin);
    check("[]", "this is no scene", (1, 1), begin);
    check("Scene(", "the file ends too early", (1, 6), "close the `(` of line 1");
    check(
        "Scene(models: [(path: \"a.glb\")]) more",
        "there is something behind the scene's last bracket",
        (1, 34),
        "a file has one scene: put it inside of the brackets, or remove it",
    );
    check(
        "Scene(models: [(scale: 3)])",
        "the field `path` of `Model` is missing",
        (1, 16),
        "add `path: …`",
    );
    check(
        "Scene(models: [(path: a)])",
        "`models[0].path`: expected a text",
        (1, 23),
        "texts stand in quotation marks: \"like this\"",
    );
    let commas = "whole numbers have no decimal point; fields and elements are parted by commas";
    check(
        &with("image: (size: (800.5, 600))"),
        "expected a comma or a closing bracket here",
        (3, 21),
        commas,
    );
}

#[test]
fn deep_nesting_and_binary_rubbish_are_errors_like_others() {
    let _ = told(&"(".repeat(100_000));
    let _ = told(&format!("Scene(models: {}", "[".repeat(100_000)));
    let _ = told("\u{0}\u{1}\u{7f}");
    let _ = told("Scene(models: [(path: \"ä\\u{110000}\")])");
}

#[test]
fn what_is_left_out_has_a_default_and_marks_of_other_editors_do_not_hurt() {
    let short = parse_scene(
        "s.ron",
        "\u{feff}(models: [(path: \"a.glb\", scale: (1, 2, 3), translate: [1, 2, 3])])\r\n",
    );
    let scene = short.expect("a short scene");
    assert_eq!(scene, parse_scene("s.ron", "Scene(models: [Model(path: \"a.glb\", translate: (1, 2, 3), scale: (1, 2, 3), rotate_degrees: (0, 0, 0))], camera: Camera(), image: Image())").expect("a long scene"));
}
