//! `alberti check`, and the flags for loading: `--lenient`, `--allow-outside`, and a flag for each
//! limit.

use crate::gltf_builder::GltfBuilder;
use crate::sandbox::Sandbox;
use serde_json::{Value, json};

/// Returns a square with wrong bounds and a reference to a missing material.
fn faulty_model() -> GltfBuilder {
    let mut document = GltfBuilder::square();
    document.json["accessors"][0]["min"] = json!([-9, -1, 0]);
    document.json["accessors"][0]["max"] = json!([1, 1, 0]);
    document.json["meshes"][0]["primitives"][0]["material"] = json!(7);
    document.json["nodes"][0]["colour"] = json!("red");
    document.json["extensionsUsed"] = json!(["KHR_materials_unlit"]);
    document
}

#[test]
fn diagnostics_show_severity_code_pointer_and_help_worst_first() {
    let sandbox = Sandbox::new("check");
    faulty_model().write_file(&sandbox, "faulty");
    let run = sandbox.run(&["check", "faulty.gltf"]);
    assert_eq!((run.code, run.stderr.as_str()), (1, ""), "{}", run.stdout);
    for line in [
        "error[UNRESOLVED_REFERENCE] /meshes/0/primitives/0/material: /materials/7 does not exist: ",
        "error[ACCESSOR_MIN_MISMATCH] /accessors/0/min/0: the declared min is -9, but the actual min is -1; ",
        "warning[UNEXPECTED_PROPERTY] /nodes/0/colour: ",
        "faulty.gltf: 2 errors, 1 warning, ",
    ] {
        assert!(run.stdout.lines().any(|found| found.starts_with(line)), "{line}\n{}", run.stdout);
    }
    let offsets: Vec<usize> =
        ["error[", "warning["].iter().filter_map(|word| run.stdout.rfind(word)).collect();
    assert!(offsets.is_sorted(), "{}", run.stdout);
    assert!(run.stdout.ends_with("it can be drawn\n"), "{}", run.stdout);
}

#[test]
fn a_valid_model_has_no_errors_and_exit_code_0() {
    let sandbox = Sandbox::new("check_good");
    sandbox.copy_model("crate.glb");
    let run = sandbox.run(&["check", "crate.glb"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{}", run.stdout);
    assert!(run.stdout.contains("crate.glb: no errors"), "{}", run.stdout);
    let run = sandbox.run(&["check", "missing.glb"]);
    assert_eq!(run.code, 1);
    assert!(run.stdout.starts_with("error[IO_ERROR] the file does not exist"), "{}", run.stdout);
    assert!(run.stdout.ends_with("it cannot be drawn\n"), "{}", run.stdout);
    assert_eq!(sandbox.run(&["check"]).code, 2);
}

#[test]
fn the_json_report_has_a_version_and_the_same_problems() {
    let sandbox = Sandbox::new("check_json");
    faulty_model().write_file(&sandbox, "faulty");
    let run = sandbox.run(&["check", "faulty.gltf", "--json"]);
    assert_eq!((run.code, run.stderr.as_str()), (1, ""));
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(report["schema"], json!({"name": "alberti-check", "version": 1}));
    assert_eq!(report["scene"], Value::Null);
    let model = &report["models"][0];
    assert_eq!((&model["file"], &model["errors"]), (&json!("faulty.gltf"), &json!(2)));
    assert_eq!((&model["refusal"], &model["problems_left_out"]), (&Value::Null, &json!(0)));
    let problems = model["problems"].as_array().expect("an array");
    let codes: Vec<&str> = problems.iter().filter_map(|problem| problem["code"].as_str()).collect();
    assert!(codes.contains(&"ACCESSOR_MIN_MISMATCH"), "{codes:?}");
    for problem in problems {
        for key in ["severity", "code", "pointer", "message", "remedy"] {
            assert!(problem[key].is_string(), "{key} of {problem}");
        }
    }
    sandbox.write_file("text.glb", "hello");
    let run = sandbox.run(&["check", "text.glb", "--json"]);
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(report["models"][0]["problems"][0]["code"], "NOT_GLTF");
    assert!(report["models"][0]["refusal"]["message"].is_string(), "{report}");
}

#[test]
fn all_mistakes_in_a_scene_are_located_and_its_models_are_checked() {
    let sandbox = Sandbox::new("check_scene");
    sandbox.copy_model("crate.glb");
    faulty_model().write_file(&sandbox, "faulty");
    sandbox.write_file(
        "scene.ron",
        "Scene(\n  models: [(path: \"crate.glb\"), (path: \"faulty.gltf\"), (path: \"../other.glb\")],\n  \
         lights: [Directional(direction: (0, 0, 0), intensity: 1)],\n  image: (samples: 3),\n)\n",
    );
    let run = sandbox.run(&["check", "scene.ron"]);
    assert_eq!((run.code, run.stderr.as_str()), (1, ""), "{}", run.stdout);
    for location in ["scene.ron:2:", "scene.ron:3:", "scene.ron:4:"] {
        assert!(run.stdout.contains(location), "{location}\n{}", run.stdout);
    }
    assert!(run.stdout.contains("^^^") && run.stdout.contains("scene.ron: 3 mistakes"));
    assert!(
        run.stdout.contains("crate.glb: no errors") && run.stdout.contains("faulty.gltf: 2 errors")
    );
    let run = sandbox.run(&["check", "scene.ron", "--json"]);
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(report["scene"].as_array().map(Vec::len), Some(3), "{report}");
    assert_eq!(report["scene"][0]["line"], 2);
    sandbox.write_file("slip.ron", "Scene(modles: [])");
    let run = sandbox.run(&["check", "slip.ron"]);
    assert!(run.code == 1 && run.stdout.contains("did you mean `models`?"), "{}", run.stdout);
    sandbox.write_file("good.ron", "Scene(models: [(path: \"crate.glb\")])");
    assert_eq!(sandbox.run(&["check", "good.ron"]).code, 0);
}

#[test]
fn lenient_loading_draws_the_rest_and_reports_omissions() {
    let sandbox = Sandbox::new("lenient");
    let mut document = GltfBuilder::square();
    document.json["extensionsUsed"] = json!(["ACME_gizmo"]);
    document.json["extensionsRequired"] = json!(["ACME_gizmo"]);
    let primitives = document.json["meshes"][0]["primitives"].as_array_mut().expect("an array");
    primitives.push(json!({"attributes": {"POSITION": 99}}));
    document.json["nodes"] = json!([{"mesh": 0, "children": [1, 8]}, {"mesh": 5}]);
    document.json["skins"] = json!([{"joints": "none"}]);
    document.write_file(&sandbox, "broken");
    let render = ["render", "broken.gltf", "-o", "out.png", "--size", "32x32", "--view", "front"];
    let run = sandbox.run(&render);
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("/skins/0/joints"), "{}", run.stderr);
    let run = sandbox.run(&[&render[..], &["--lenient"]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    for location in [
        "/extensionsRequired/0: the file requires the extension ACME_gizmo",
        "/meshes/0/primitives/1/attributes/POSITION: ",
        "/nodes/0/children/1: ",
        "/nodes/1/mesh: ",
        "/skins/0: ",
    ] {
        let line = format!("warning: broken: {location}");
        assert!(run.stderr.contains(&line), "{line}\n{}", run.stderr);
    }
    let (_, _, pixels) = sandbox.read_picture("out.png");
    let red = pixels.iter().filter(|pixel| **pixel == [255, 0, 0, 255]).count();
    assert!(red > 32 * 32 / 2, "only {red} pixels of the square are drawn");
    assert!(sandbox.run(&["info", "broken.gltf", "--lenient"]).stdout.contains("/nodes/1/mesh"));
    let run = sandbox.run(&["check", "broken.gltf", "--lenient"]);
    assert!(run.code == 1 && run.stdout.contains("it can be drawn"), "{}", run.stdout);
}

#[test]
fn every_limit_has_a_flag_and_its_message_names_it() {
    let sandbox = Sandbox::new("limits");
    sandbox.copy_model("teapot.glb");
    GltfBuilder::square().write_file(&sandbox, "square");
    let run = sandbox.run(&["info", "square.gltf", "--max-total-bytes", "100"]);
    assert!(run.code == 1 && run.stderr.contains("(--max-total-bytes)"), "{}", run.stderr);
    for (flag, value) in [
        ("--max-file-bytes", "1k"),
        ("--max-json-depth", "2"),
        ("--max-json-values", "10"),
        ("--max-array-bytes", "1_000"),
        ("--max-nodes", "0"),
        ("--max-node-depth", "0"),
        ("--max-scene-items", "5"),
    ] {
        for command in ["render", "info", "check"] {
            let run = sandbox.run(&[command, "teapot.glb", flag, value]);
            let said = if command == "check" { &run.stdout } else { &run.stderr };
            assert_eq!(run.code, 1, "{command} {flag} {value}");
            assert!(said.contains(&format!("({flag})")), "{command} {flag}: {said}");
        }
    }
    let generous =
        ["--max-file-bytes", "1GiB", "--max-image-side", "64", "--max-image-texels", "1M"];
    let run = sandbox
        .run(&[&["info", "teapot.glb", "--max-array-growth", "100"][..], &generous].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for wrong in ["lots", "-1", "1.5GiB", ""] {
        let run = sandbox.run(&["info", "teapot.glb", "--max-nodes", wrong]);
        assert_eq!(run.code, 2, "{wrong}");
    }
    let help = sandbox.run(&["check", "--help"]).stdout;
    assert!(help.contains("Limits") && help.contains("--max-image-texels"), "{help}");
}

#[test]
fn files_outside_the_allowed_folders_are_refused() {
    let sandbox = Sandbox::new("allow_outside");
    for folder in ["models/tin", "bins", "scenes", "secret"] {
        std::fs::create_dir_all(sandbox.path_of(folder)).expect("a folder");
    }
    let mut document = GltfBuilder::square();
    document.write_file(&sandbox, "bins/square");
    document.json["buffers"][0]["uri"] = json!("../../bins/square.bin");
    sandbox.write_file("models/tin/square.gltf", document.json.to_string());
    let render = |input: &str, allowed: &[&str]| {
        let flags = allowed.iter().flat_map(|folder| ["--allow-outside", folder]);
        let flags: Vec<&str> = flags.collect();
        sandbox.run(&[&["render", input, "-o", "out.png", "--size", "16x16"][..], &flags].concat())
    };
    let run = render("models/tin/square.gltf", &[]);
    assert!(run.code == 1 && run.stderr.contains("--allow-outside DIR"), "{}", run.stderr);
    assert_eq!(render("models/tin/square.gltf", &["secret"]).code, 1);
    let run = render("models/tin/square.gltf", &["bins"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));

    sandbox
        .write_file("scenes/scene.ron", "Scene(models: [(path: \"../models/tin/square.gltf\")])");
    assert_eq!(render("scenes/scene.ron", &["bins"]).code, 1);
    let run = render("scenes/scene.ron", &["models", "bins"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert_eq!(render("scenes/scene.ron", &["."]).code, 0);
    let run = render("scenes/scene.ron", &["nowhere", "."]);
    assert!(run.code == 1 && run.stderr.contains("nowhere"), "{}", run.stderr);
    assert_eq!(sandbox.run(&["render", "scenes/scene.ron", "--allow-outside"]).code, 2);
}

#[cfg(unix)]
#[test]
fn symbolic_links_do_not_lead_a_scene_out_of_its_folder() {
    let sandbox = Sandbox::new("scene_links");
    sandbox.copy_model("crate.glb");
    std::fs::create_dir(sandbox.path_of("scenes")).expect("a folder");
    std::os::unix::fs::symlink(sandbox.path_of("crate.glb"), sandbox.path_of("scenes/link.glb"))
        .expect("a link");
    sandbox.write_file("scenes/scene.ron", "Scene(models: [(path: \"link.glb\")])");
    let render = ["render", "scenes/scene.ron", "-o", "out.png", "--size", "16x16"];
    let run = sandbox.run(&render);
    assert!(
        run.code == 1 && run.stderr.contains("points outside the scene's folder"),
        "{}",
        run.stderr
    );
    assert_eq!(sandbox.run(&[&render[..], &["--allow-outside", "."]].concat()).code, 0);
}
