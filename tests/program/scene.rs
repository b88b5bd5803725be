//! `alberti scene`: starter files, checks, formatting.

use crate::sandbox::Sandbox;
use serde_json::{Value, json};

#[test]
fn a_starter_is_valid_and_formatted_and_its_commented_options_are_valid() {
    let sandbox = Sandbox::new("scene_init");
    for model in ["room.glb", "crate.glb", "lamp.glb"] {
        sandbox.copy_model(model);
        let scene = model.replace(".glb", ".ron");
        let run = sandbox.run(&["scene", "init", model]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{model}");
        assert_eq!(run.stdout.trim_end(), scene);
        let run = sandbox.run(&["render", &scene, "--size", "32x24", "--samples", "1"]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{model}");
        let run = sandbox.run(&["scene", "check", &scene]);
        let clean = run.stdout.contains(&format!("{scene}: no mistakes\n"));
        assert!(run.code == 0 && clean, "{}", run.stdout);
        assert_eq!(sandbox.run(&["scene", "fmt", "--check", &scene]).code, 0, "{scene}");
        let text = std::fs::read_to_string(sandbox.path_of(&scene)).expect("the scene");
        let choices = text.lines().filter(|line| {
            let comment = line.trim_start().strip_prefix("// ");
            comment.is_some_and(|comment| comment.contains(": ") && comment.ends_with(','))
        });
        let mut seen = 0;
        for choice in choices {
            // Replaces the existing field with the field in the comment.
            let field = choice.trim_start().trim_start_matches("// ");
            let name = field.split(':').next().expect("a name");
            let there = |line: &&str| !line.trim_start().starts_with(&format!("{name}: "));
            let lines: Vec<&str> = text.lines().filter(there).collect();
            sandbox.write_file("chosen.ron", lines.join("\n").replace(choice, field));
            let run = sandbox.run(&["scene", "check", "chosen.ron"]);
            assert!(run.stdout.contains("chosen.ron: no mistakes"), "{field}\n{}", run.stdout);
            seen += 1;
        }
        assert!(seen >= 3, "{model}: {seen} choices");
    }
}

#[test]
fn a_starter_replaces_files_only_if_forced_and_refers_to_models_in_other_folders() {
    let sandbox = Sandbox::new("scene_init_places");
    sandbox.copy_model("crate.glb");
    sandbox.write_file("crate.ron", "mine");
    let run = sandbox.run(&["scene", "init", "crate.glb"]);
    assert!(run.code == 1 && run.stderr.contains("crate.ron already exists"), "{}", run.stderr);
    assert_eq!(std::fs::read_to_string(sandbox.path_of("crate.ron")).expect("mine"), "mine");
    assert_eq!(sandbox.run(&["scene", "init", "crate.glb", "--force"]).code, 0);
    std::fs::create_dir(sandbox.path_of("scenes")).expect("a folder");
    let run = sandbox.run(&["scene", "init", "crate.glb", "-o", "scenes/crate.ron"]);
    assert!(run.code == 0 && run.stderr.contains("--allow-outside"), "{}", run.stderr);
    let draw = ["render", "scenes/crate.ron", "--size", "16x16", "-o", "out.png"];
    assert_eq!(sandbox.run(&draw).code, 1);
    assert_eq!(sandbox.run(&[&draw[..], &["--allow-outside", "."]].concat()).code, 0);
    let run = sandbox.run(&["scene", "init", "crate.glb", "-o", "-"]);
    assert!(run.code == 0 && run.stdout.contains("path: \"crate.glb\""), "{}", run.stdout);
    assert_eq!(sandbox.run(&["scene", "init", "missing.glb"]).code, 1);
}

#[test]
fn formatting_is_written_or_only_checked() {
    let sandbox = Sandbox::new("scene_fmt");
    let wild = "Scene( models:[ (path:\"a.glb\") ],// the crate\nstyle:Flat)";
    let tidy = "Scene(\n    models: [(path: \"a.glb\")], // the crate\n    style: Flat,\n)\n";
    sandbox.write_file("wild.ron", wild);
    sandbox.write_file("tidy.ron", tidy);
    let run = sandbox.run(&["scene", "fmt", "--check", "wild.ron", "tidy.ron"]);
    assert_eq!((run.code, run.stdout.as_str()), (1, "wild.ron\n"));
    assert_eq!(std::fs::read_to_string(sandbox.path_of("wild.ron")).expect("the file"), wild);
    let run = sandbox.run(&["scene", "fmt", "wild.ron", "tidy.ron"]);
    assert_eq!((run.code, run.stdout.as_str()), (0, ""));
    assert_eq!(std::fs::read_to_string(sandbox.path_of("wild.ron")).expect("the file"), tidy);
    sandbox.write_file("slip.ron", "Scene(modles: [])");
    let run = sandbox.run(&["scene", "fmt", "slip.ron"]);
    assert!(run.code == 1 && run.stderr.contains("did you mean `models`?"), "{}", run.stderr);
}

#[test]
fn the_committed_scenes_are_formatted_and_free_of_lints() {
    let sandbox = Sandbox::new("scene_committed");
    let folder = alberti_tests::project_root().join("scenes");
    let entries = std::fs::read_dir(&folder).expect("the scenes");
    let paths = entries.map(|entry| entry.expect("an entry").path().display().to_string());
    let mut scenes: Vec<String> = paths.filter(|path| path.ends_with(".ron")).collect();
    scenes.sort();
    let scenes: Vec<&str> = scenes.iter().map(String::as_str).collect();
    let run = sandbox.run(&[&["scene", "fmt", "--check"], &scenes[..]].concat());
    assert_eq!((run.code, run.stdout.as_str()), (0, ""), "run `alberti scene fmt scenes/*.ron`");
    let run = sandbox.run(&[&["scene", "check", "--json"], &scenes[..]].concat());
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!((&report["errors"], &report["warnings"]), (&json!(0), &json!(0)), "{report:#}");
    assert_eq!(report["files"].as_array().map(Vec::len), Some(scenes.len()));
}

/// Returns a scene with a crate, one unit wide and centered at the origin, and the messages about
/// it.
fn check_with_fields(sandbox: &Sandbox, rest: &str) -> (i32, String) {
    sandbox.write_file(
        "scene.ron",
        format!("Scene(\n  models: [(path: \"crate.glb\")],\n  {rest}\n)"),
    );
    let run = sandbox.run(&["scene", "check", "scene.ron"]);
    (run.code, run.stdout)
}

/// Valid but probably unintended fields for a scene with a crate, each with the code of its
/// warning, the location (empty for any), and words from the message.
const SUSPICIOUS: &[(&str, &str, &str, &str)] = &[
    (
        "camera: (view: LookTo(eye: (0, 0.5, 6), gaze: (0, 0, 1)), projection: Perspective(near: 0.1, far: 100))",
        "nothing-visible",
        "3:11",
        "everything is behind the camera",
    ),
    (
        "camera: (view: LookTo(eye: (0, 0.5, 90), gaze: (0, 0, -1)), projection: Perspective(near: 1, far: 9))",
        "nothing-visible",
        "3:11",
        "everything is outside the far plane",
    ),
    (
        "camera: (view: LookAt(eye: (0.1, 0.3, 0.1), target: (0, 0.2, -5)), projection: Perspective(near: 0.01, far: 9))",
        "camera-inside",
        "3:18",
        "is inside crate",
    ),
    (
        "camera: (view: LookAt(eye: (4, 3, 5), target: (0, 0, 0)), projection: Perspective(near: 0.001, far: 50))",
        "wasteful-depth-range",
        "",
        "times closer than the nearest surface",
    ),
    (
        "camera: (view: LookAt(eye: (4, 3, 5), target: (0, 0, 0)), projection: Perspective(near: 1, far: 7))",
        "cut-by-far",
        "",
        "the far plane cuts off",
    ),
    (
        "camera: (projection: Frustum(left: -0.3, right: 0.3, bottom: -0.3, top: 0.3, near: 0.5))",
        "aspect-mismatch",
        "3:24",
        "stretched",
    ),
    ("lights: []", "no-light", "3:11", "black"),
    (
        "style: Lines(), sections: [(point: (0, 0, 9), normal: (0, 0, 1))]",
        "section-misses",
        "3:30",
        "point: (0.000, 0.500, 0.000)",
    ),
    (
        "style: Lines(), sections: [(point: (0, 0, -9), normal: (0, 0, 1))]",
        "section-removes-all",
        "3:30",
        "removes everything",
    ),
    (
        "viewports: [(at: (0, 0, 0.3, 0.3), camera: (view: LookAt(eye: (0, 0, 9), target: (0, 0, 20))))]",
        "nothing-visible",
        "3:46",
        "behind the camera",
    ),
    (
        "camera: (view: LookAt(eye: (0, 0, 200), target: (0, 0, 0)))",
        "tiny-picture",
        "3:11",
        "less than a thousandth",
    ),
    (
        "style: Depth, image: (background: Color(\"white\"))",
        "depth-on-white",
        "3:37",
        "Color(\"black\")",
    ),
    (
        "camera: (projection: Perspective(fov_y_degrees: 0.87))",
        "narrow-field-of-view",
        "3:51",
        "if it is in radians, write fov_y_degrees: 49.8",
    ),
    (
        "lights: [Point(position: (1, 2, 3), intensity: 100, color: (255, 255, 0))]",
        "color-above-one",
        "3:62",
        "255 times as bright as white",
    ),
    ("stereo: Anaglyph(eye_distance: 65)", "wide-stereo", "3:34", "the scene's units"),
    ("ground: Shadow(height: 1)", "ground-above-models", "3:26", "remove `height`"),
    (
        "camera_path: (keys: [(time: 0, eye: (0, 0, 9), target: (0, 0, 0)), (time: 2, eye: (0, 0, -9), target: (0, 0, 0))])",
        "camera-path-turns-over",
        "3:24",
        "at 1.000 s the camera passes through its target",
    ),
    (
        "camera_path: (keys: [(time: 0, eye: (0, 9, 9), target: (0, 0, 0)), (time: 2, eye: (0, 9, -9), target: (0, 0, 0))])",
        "camera-path-turns-over",
        "3:24",
        "along its view-up vector",
    ),
];

#[test]
fn suspicious_values_cause_warnings_with_locations() {
    let sandbox = Sandbox::new("scene_advice");
    sandbox.copy_model("crate.glb");
    for &(rest, code, location, words) in SUSPICIOUS {
        let (exit, output) = check_with_fields(&sandbox, rest);
        let head = format!("warning[{code}]: ");
        let pointed = location.is_empty() || output.contains(&format!("scene.ron:{location}\n"));
        assert!(exit == 0 && output.contains(&head), "{code}:\n{output}");
        assert!(
            pointed && output.contains(words) && output.contains("= help: "),
            "{code}:\n{output}"
        );
        assert_eq!(output.matches("warning[").count(), 1, "{code}:\n{output}");
    }
    for good in ["", "camera: (view: LookAt(eye: (4, 3, 5), target: (0, 0, 0)))", "style: Lines()"]
    {
        assert!(!check_with_fields(&sandbox, good).1.contains("warning["), "{good}");
    }
}

#[test]
fn coincident_and_tiny_models_are_reported() {
    let sandbox = Sandbox::new("scene_advice_instances_coincide");
    sandbox.copy_model("crate.glb");
    let check = |models: &str| {
        sandbox.write_file("scene.ron", format!("Scene(\n  models: [{models}],\n)"));
        sandbox.run(&["scene", "check", "scene.ron"]).stdout
    };
    let grid = |step: &str| {
        format!("(path: \"crate.glb\", instances: Grid(count: (2, 1, 2), step: {step}))")
    };
    let output = check(&grid("(3, 0, 0)"));
    let told = "warning[coincident-instances]: 2 of 4 instances coincide with another instance";
    assert!(output.contains(told) && output.contains("scene.ron:2:72"), "{output}");
    assert!(!check(&grid("(3, 0, 3)")).contains("warning["));
    let output = check(
        "(path: \"crate.glb\"), (path: \"crate.glb\", scale: 0.0001, translation: (1, 0, 0))",
    );
    assert!(
        output.contains("warning[tiny-model]") && output.contains("scene.ron:2:33"),
        "{output}"
    );
}

#[test]
fn missing_names_are_reported_together_and_missing_files_with_their_folders() {
    let sandbox = Sandbox::new("scene_missing_names");
    sandbox.copy_model("crate.glb");
    std::fs::create_dir(sandbox.path_of("models")).expect("a folder");
    std::fs::rename(sandbox.path_of("crate.glb"), sandbox.path_of("models/crate.glb"))
        .expect("moved");
    for path in ["models/crat.glb", "crate.glb"] {
        sandbox.write_file("scene.ron", format!("Scene(models: [(path: \"{path}\")])"));
        let output = sandbox.run(&["scene", "check", "scene.ron"]).stdout;
        assert!(output.contains("did you mean \"models/crate.glb\"?"), "{output}");
    }
    let materials = "materials: [(of: Name(\"one\")), (of: Index(77)), (of: Name(\"two\"))]";
    let text = format!("Scene(models: [(path: \"models/crate.glb\", {materials})])");
    sandbox.write_file("scene.ron", text);
    let output = sandbox.run(&["scene", "check", "scene.ron"]).stdout;
    let told = ["`one`", "`77`", "`two`"];
    assert!(told.iter().all(|name| output.contains(&format!("no material {name}"))), "{output}");
}

#[test]
fn errors_about_viewports_in_pixels_suggest_fractions() {
    let sandbox = Sandbox::new("scene_pixels");
    sandbox.copy_model("crate.glb");
    let scene =
        |place: &str| format!("Scene(models: [(path: \"crate.glb\")], viewports: [({place})])");
    sandbox.write_file("scene.ron", scene("pixels: (400, 0, 400, 400)"));
    let render = ["render", "scene.ron", "--size", "40x30", "-o", "out.png"];
    let run = sandbox.run(&render);
    assert!(run.code == 1 && run.stderr.contains("at: (0.5, 0, 0.5, 0.5)"), "{}", run.stderr);
    sandbox.write_file("scene.ron", scene("at: (0.5, 0, 0.5, 0.5)"));
    assert_eq!(sandbox.run(&render).code, 0);
}

#[test]
fn a_model_outside_the_picture_is_reported() {
    let sandbox = Sandbox::new("scene_advice_model");
    sandbox.copy_model("crate.glb");
    sandbox.write_file(
        "scene.ron",
        "Scene(\n  models: [(path: \"crate.glb\"), (path: \"crate.glb\", translation: (30, 0, -16))],\n  \
         camera: (view: LookAt(eye: (4, 3, 5), target: (0, 0, 0))),\n)",
    );
    let run = sandbox.run(&["scene", "check", "scene.ron"]);
    let output = run.stdout;
    assert!(
        output.contains("warning[model-not-visible]") && output.contains("scene.ron:2:33"),
        "{output}"
    );
    assert!(output.contains("everything is outside the right"), "{output}");
    let run = sandbox.run(&["scene", "check", "scene.ron", "--json"]);
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let advice = &report["files"][0]["advice"][0];
    assert_eq!((&advice["code"], &advice["line"]), (&json!("model-not-visible"), &json!(2)));
}

#[test]
fn instances_outside_the_picture_are_reported_once_and_only_if_all_are() {
    let sandbox = Sandbox::new("scene_advice_instances");
    sandbox.copy_model("crate.glb");
    let check = |grid: &str, after: &str| {
        let text = format!(
            "Scene(\n  models: [(path: \"crate.glb\", instances: Grid({grid})),{after}],\n  \
             camera: (view: LookAt(eye: (4, 3, 5), target: (0, 0, 0))),\n)"
        );
        sandbox.write_file("scene.ron", &text);
        sandbox.run(&["scene", "check", "scene.ron"]).stdout
    };
    // A forest with the camera among its trees.
    let forest = "count: (9, 1, 9), step: (4, 0, 4)";
    let output = check(forest, "");
    assert!(!output.contains("model-not-visible"), "{output}");
    // A model after the forest is located as the second model in the file.
    let output = check(forest, "\n    (path: \"crate.glb\", translation: (90, 0, 90))");
    assert_eq!(output.matches("warning[model-not-visible]").count(), 1, "{output}");
    assert!(output.contains("scene.ron:3:5"), "{output}");
}

#[test]
fn included_files_are_merged_and_mistakes_point_to_the_correct_file() {
    let sandbox = Sandbox::new("scene_include");
    sandbox.copy_model("crate.glb");
    std::fs::create_dir(sandbox.path_of("lib")).expect("a folder");
    std::fs::copy(sandbox.path_of("crate.glb"), sandbox.path_of("lib/other.glb")).expect("a copy");
    let view = "camera: (view: LookAt(eye: (4, 3, 5), target: (0, 0, 0)))";
    let image = "image: (size: (24, 16), background: Color(\"#fff\"))";
    sandbox.write_file(
        "lib/studio.ron",
        format!(
            "Scene(\n  include: \"paper.ron\",\n  models: [(path: \"other.glb\")],\n  {view},\n)"
        ),
    );
    sandbox.write_file("lib/paper.ron", format!("Scene({image}, style: Flat)"));
    let main = |rest: &str| {
        format!(
            "Scene(\n  include: [\"lib/studio.ron\"],\n  models: [(path: \"crate.glb\", translation: (1, 0, 0))],\n  {rest}\n)"
        )
    };
    sandbox.write_file("scene.ron", main("style: Shaded"));
    let run = sandbox.run(&["render", "scene.ron", "-o", "out.png"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let one = "models: [(path: \"lib/other.glb\"), (path: \"crate.glb\", translation: (1, 0, 0))]";
    sandbox.write_file("one.ron", format!("Scene({one}, {view}, {image}, style: Shaded)"));
    assert_eq!(sandbox.run(&["render", "one.ron", "-o", "one.png"]).code, 0);
    assert!(sandbox.read_picture("out.png") == sandbox.read_picture("one.png"));
    // One mistake in each of the three files.
    let cases = [
        (
            "lib/studio.ron",
            format!("Scene(models: [\n  (path: \"no.glb\")],\n {view})"),
            "lib/studio.ron:2:10",
        ),
        ("lib/paper.ron", "Scene(image: (samples: 3))".to_owned(), "lib/paper.ron:1:24"),
        ("scene.ron", main("image: (samples: 3)"), "scene.ron:4:20"),
        ("lib/paper.ron", "Scene(imag: ())".to_owned(), "lib/paper.ron:1:7"),
    ];
    for (name, text, location) in cases {
        sandbox.write_file("lib/studio.ron", format!("Scene(include: \"paper.ron\", {view})"));
        sandbox.write_file("lib/paper.ron", format!("Scene({image})"));
        sandbox.write_file("scene.ron", main(""));
        sandbox.write_file(name, text);
        for command in [&["render", "scene.ron"][..], &["scene", "check", "scene.ron"]] {
            let run = sandbox.run(command);
            let output = run.stdout + &run.stderr;
            assert!(
                run.code == 1 && output.contains(&format!("--> {location}\n")),
                "{location}\n{output}"
            );
        }
    }
}

#[test]
fn circular_includes_and_includes_outside_the_folder_are_refused() {
    let sandbox = Sandbox::new("scene_include_refused");
    sandbox.copy_model("crate.glb");
    std::fs::create_dir(sandbox.path_of("in")).expect("a folder");
    sandbox.write_file("outside.ron", "Scene(style: Flat)");
    sandbox.write_file("in/a.ron", "Scene(\n  include: \"b.ron\",\n)");
    sandbox.write_file("in/b.ron", "Scene(include: [\n  \"./a.ron\",\n])");
    let run = sandbox.run(&["scene", "check", "in/a.ron"]);
    assert_eq!(run.code, 1);
    for words in ["in/b.ron:2:3", "the file includes itself: in/a.ron → in/b.ron → in/./a.ron"]
    {
        assert!(run.stdout.contains(words), "{words}\n{}", run.stdout);
    }
    for (path, words) in [
        ("../outside.ron", "points outside the scene's folder"),
        ("no.ron", "in/no.ron: the file does not exist; check the name"),
        ("/etc/hostname", "points outside the scene's folder"),
    ] {
        sandbox.write_file("in/c.ron", format!("Scene(\n  include: \"{path}\",\n)"));
        let run = sandbox.run(&["render", "in/c.ron"]);
        let pointed = run.stderr.contains("in/c.ron:2:12") && run.stderr.contains(words);
        assert!(run.code == 1 && pointed, "{path}\n{}", run.stderr);
    }
    sandbox.write_file(
        "in/d.ron",
        "Scene(include: \"../outside.ron\", models: [(path: \"../crate.glb\")])",
    );
    let draw = ["render", "in/d.ron", "--size", "16x16", "-o", "out.png", "--allow-outside", "."];
    let run = sandbox.run(&draw);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
}

#[test]
fn a_misspelled_model_gets_the_name_of_a_nearby_file() {
    let sandbox = Sandbox::new("scene_namesake");
    sandbox.copy_model("crate.glb");
    sandbox.write_file("scene.ron", "Scene(models: [(path: \"crato.glb\")])");
    let run = sandbox.run(&["render", "scene.ron"]);
    assert!(run.code == 1 && run.stderr.contains("did you mean \"crate.glb\"?"), "{}", run.stderr);
}

/// Valid but unintended values cause warnings, even if there are also errors.
#[test]
fn sections_of_shaded_scenes_and_flat_stereo_pairs_cause_warnings() {
    let sandbox = Sandbox::new("scene_warnings");
    sandbox.copy_model("crate.glb");
    let check = |fields: &str| {
        let text = format!("Scene(models: [(path: \"crate.glb\")], {fields})");
        sandbox.write_file("scene.ron", &text);
        sandbox.run(&["scene", "check", "scene.ron"])
    };
    let cut = "sections: [(normal: (1, 0, 0))]";
    for style in ["", ", style: Flat", ", camera: (projection: Perspective(near: 5, far: 2))"] {
        let run = check(&format!("{cut}{style}"));
        let count = run.stdout.matches("warning[sections-ignored]").count();
        assert_eq!(count, 1, "{style}: {}", run.stdout);
    }
    for drawn in [", style: Lines", ", sheet: ()"] {
        let run = check(&format!("{cut}{drawn}"));
        assert!(!run.stdout.contains("sections-ignored"), "{drawn}: {}", run.stdout);
    }
    let flat = check("stereo: SideBySide(eye_distance: 0.0001)");
    assert!(flat.stdout.contains("warning[flat-stereo]: "), "{}", flat.stdout);
    assert!(flat.stdout.contains("larger eye_distance"), "{}", flat.stdout);
    let deep = check("stereo: SideBySide()");
    assert!(deep.code == 0 && !deep.stdout.contains("flat-stereo"), "{}", deep.stdout);
}
