//! Tests: mistakes that people make in scene files, and the messages they get.

mod hints;
mod vocabulary;

use super::{SceneErrors, parse_scene};

/// Returns the message, line and column, and help of each mistake.
fn mistakes(source: &str) -> Vec<(String, (usize, usize), String)> {
    let errors: SceneErrors = parse_scene("scene.ron", source).expect_err(source);
    let mistakes = errors.iter().map(|error| {
        let (line, column) = error.line_and_column();
        let text = error.to_string();
        // An empty file has no line to show.
        let location = format!("scene.ron:{line}:{column}");
        assert!(source.is_empty() || text.contains(&location), "{text}");
        (error.message.clone(), (line, column), error.help.clone().unwrap_or_default())
    });
    mistakes.collect()
}

/// Expects exactly one mistake.
#[track_caller]
fn check(source: &str, message: &str, location: (usize, usize), help: &str) {
    let expected = (message.to_owned(), location, help.to_owned());
    assert_eq!(mistakes(source), [expected], "{source}");
}

/// Returns a scene with one more field after the models.
fn scene_with(field: &str) -> String {
    format!("Scene(\n  models: [(path: \"a.glb\")],\n  {field}\n)")
}

#[test]
fn near_misses_get_a_hint_with_the_intended_name() {
    check(
        "Scene(models: [Model(path: \"a.glb\", rotate: (0, 30, 0))])",
        "unexpected field `rotate` in `Model`",
        (1, 37),
        "did you mean `rotation_degrees`?",
    );
    check(
        &scene_with("camera: (view: LookAt(eye: (4, 3, 5.5), traget: (0, 0, 0))),"),
        "unexpected field `traget` in `LookAt`",
        (3, 43),
        "did you mean `target`?",
    );
    check(
        &scene_with("camera: (projection: Perspectiv(fov_y_degrees: 18)),"),
        "`Perspectiv` is not a valid `Projection`",
        (3, 24),
        "did you mean `Perspective`?",
    );
    check(
        &scene_with("style: Blueprint"),
        "`Blueprint` is not a valid `Style`",
        (3, 10),
        "write style: Lines(edges: Tangents, hidden: Dashed, width: Iso(0.5), color: \"#ffffff\", paper: \"#1d4279\")",
    );
}

#[test]
fn numbers_out_of_range_are_reported_with_their_path() {
    let location = |field: &str| (3, field.find('?').expect("a mark") + 3);
    for (field, value, message) in [
        (
            "lights: [Ambient(intensity: ?)]",
            "-1",
            "`lights[0].Ambient.intensity`: expected 0 or a positive number, found -1",
        ),
        (
            "lights: [Ambient(intensity: ?)]",
            "inf",
            "`lights[0].Ambient.intensity`: expected 0 or a positive number, found inf",
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
        check(&scene_with(&field.replace('?', value)), message, location(field), "");
    }
}

#[test]
fn syntax_errors_are_located() {
    let begin = "a scene looks like this: Scene(models: [(path: \"model.glb\")])";
    check("", "the file is empty", (1, 1), begin);
    check("[]", "this is not a scene", (1, 1), begin);
    check("Scene(", "unexpected end of file", (1, 6), "close the `(` on line 1");
    check(
        "Scene(models: [(path: \"a.glb\")]) more",
        "unexpected text after the scene's closing bracket",
        (1, 34),
        "a file holds one scene; move the text inside the brackets, or remove it",
    );
    check(
        "Scene(models: [(scale: 3)])",
        "missing field `path` in `Model`",
        (1, 16),
        "add `path: …`",
    );
    check(
        "Scene(models: [(path: a)])",
        "`models[0].path`: expected a string, found `a`",
        (1, 23),
        "write strings in double quotation marks: \"a\"",
    );
    check(
        &scene_with("image: (size: (800.5, 600))"),
        "`image.size[0]`: expected a whole number, found `800.5`",
        (3, 18),
        "write a whole number such as 4, without a decimal point",
    );
}

/// After a syntax error, the parser continues, but it does not report consequences of that error.
#[test]
fn syntax_errors_neither_hide_nor_cause_others() {
    let comma = "expected a comma or a closing bracket here";
    for (source, expected) in [
        (
            "(models: [(path: \"a.glb\")] style: Falt)",
            vec![(1, 28, comma), (1, 35, "`Falt` is not")],
        ),
        (
            "(models: [(path: \"a.glb\")), style: Falt)",
            vec![(1, 26, comma), (1, 36, "`Falt` is not")],
        ),
        (
            "(models: [(path: \"a.glb\"), style: Falt, image: ())",
            vec![(1, 10, "this `[` is not closed"), (1, 35, "`Falt` is not")],
        ),
        (
            "(models: [(path: \"a.glb\"], style: Falt)",
            vec![(1, 25, comma), (1, 35, "`Falt` is not")],
        ),
        (
            "(style = Falt, models: [(path \"a.glb\")])",
            vec![
                (1, 8, "expected a colon here"),
                (1, 10, "`Falt` is not"),
                (1, 31, "expected a colon here"),
            ],
        ),
        (
            "(models: [], style: , image: (sise: (1, 1)))",
            vec![(1, 21, "expected a value here"), (1, 31, "unexpected field")],
        ),
        ("(models: [(path: \"a.glb)], style: Falt)", vec![(1, 18, "this string is not closed")]),
        (
            "(models: [(path: \"a.glb\"], camera: (view: Frame()",
            vec![(1, 25, comma), (1, 49, "unexpected end of file")],
        ),
    ] {
        let found = mistakes(source);
        let found: Vec<_> = found.iter().map(|(text, at, _)| (at.0, at.1, text.as_str())).collect();
        assert_eq!(found.len(), expected.len(), "{source}: {found:?}");
        for (found, expected) in found.iter().zip(expected) {
            let is_expected = (found.0, found.1) == (expected.0, expected.1);
            assert!(is_expected && found.2.starts_with(expected.2), "{source}: {found:?}");
        }
    }
}

#[test]
fn deep_nesting_and_binary_garbage_are_ordinary_errors() {
    let _ = mistakes(&"(".repeat(100_000));
    let _ = mistakes(&format!("Scene(models: {}", "[".repeat(100_000)));
    let _ = mistakes("\u{0}\u{1}\u{7f}");
    let _ = mistakes("Scene(models: [(path: \"ä\\u{110000}\")])");
}

/// Truncated texts do not break the parser, and every mistake points into the text.
#[test]
fn every_prefix_of_a_scene_is_parsed() {
    let source = "#![enable(implicit_some)]\n// A (comment.\nScene(models: [Model(path: r#\"ä\"#), (path: \"c\\\"(.glb\", translation: [1, -2.5, 3e-2])], /* a /* b */ */ camera: (view: LookAt(eye: (4, 3, 6), target: (0, 1, 0))), style: Lines(width: Iso(0.5)))";
    assert!(parse_scene("s.ron", source).is_ok(), "{:?}", parse_scene("s.ron", source));
    for (cut, _) in source.char_indices() {
        let text = &source[..cut];
        let errors = parse_scene("s.ron", text).expect_err(text);
        for error in errors.iter() {
            assert!(text.get(error.span.clone()).is_some(), "{text}: {error:?}");
        }
    }
}

#[test]
fn numbers_are_written_in_ron_notation() {
    let far = |text: &str| {
        let scene = parse_scene(
            "s.ron",
            &scene_with(&format!("camera: (projection: Orthographic(far: {text}))")),
        );
        let projection = scene.map(|scene| scene.camera.projection);
        match projection {
            Ok(Some(super::file::ProjectionFile::Orthographic { far: Some(far), .. })) => {
                Some(far.value())
            }
            _ => None,
        }
    };
    for (text, expected) in [
        ("1", 1.0),
        ("+1.5", 1.5),
        ("-.5", -0.5),
        ("2.", 2.0),
        ("1_000", 1000.0),
        ("1e3", 1000.0),
        ("1.5E-2", 0.015),
        ("Some(4)", 4.0),
    ] {
        assert_eq!(far(text), Some(expected), "{text}");
    }
    for text in
        ["1..2", "1x", "--1", "0xff", "0b101", "0x", "0xgg", "1e", "infinity", "nan", "_1", "1-2"]
    {
        assert_eq!(far(text), None, "{text}");
    }
}

#[test]
fn omitted_fields_have_defaults_and_byte_order_marks_are_ignored() {
    let short = parse_scene(
        "s.ron",
        "\u{feff}(models: [(path: \"a.glb\", scale: (1, 2, 3), translation: [1, 2, 3])])\r\n",
    );
    let scene = short.expect("a short scene");
    let long = "Scene(models: [Model(path: \"a.glb\", translation: (1, 2, 3), scale: (1, 2, 3), rotation_degrees: (0, 0, 0))], camera: Camera(), image: Image(), stereo: None)";
    assert_eq!(scene, parse_scene("s.ron", long).expect("a long scene"));
}

/// Twelve different mistakes give twelve messages, in text order.
#[test]
fn all_mistakes_are_reported_at_once() {
    let source = include_str!("mistakes/twelve.ron");
    let found = mistakes(source);
    let lines: Vec<usize> = found.iter().map(|(_, (line, _), _)| *line).collect();
    let marked = source.lines().enumerate().filter(|(_, line)| line.contains("// mistake"));
    let expected: Vec<usize> = marked.map(|(index, _)| index + 1).collect();
    assert_eq!(lines, expected, "{found:#?}");
    assert_eq!(lines.len(), 12);
}
