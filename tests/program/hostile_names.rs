//! Names with terminal control sequences: for any file name and content, the program prints only
//! plain text.

use crate::sandbox::{RunResult, Sandbox};

/// A name with a terminal title, a color, C1, DEL, text directions, and a forged line of output.
const HOSTILE: &str =
    "\u{1b}]0;P\u{7}\u{1b}[31m\u{9b}2J\u{7f}\u{202e}\u{2066}\u{2028}\r\t\u{85}\n  = help: FORGED";

/// Checks that text has no control characters, and that [`HOSTILE`] does not start a new line in
/// it.
fn assert_is_text(text: &str, arguments: &[&str]) {
    let is_control = |c: char| {
        (c.is_control() && c != '\n')
            || matches!(c, '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    assert!(!text.contains(is_control), "{arguments:?}: {text:?}");
    let is_forged = |line: &str| line.starts_with("  = help: FORGED");
    assert!(!text.lines().any(is_forged), "{arguments:?}: {text}");
}

fn run(sandbox: &Sandbox, arguments: &[&str]) -> RunResult {
    let run = sandbox.run(arguments);
    assert_is_text(&run.stdout, arguments);
    assert_is_text(&run.stderr, arguments);
    run
}

/// Returns the glTF of a triangle in which a hostile name replaces `place`, a word in capitals.
fn model_with(place: &str) -> String {
    let buffer =
        "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    let gltf = r#"{"asset": {"version": "2.0", "generator": "GENERATOR"}, "scene": 0,
        "scenes": [{"nodes": [0, 1], "name": "SCENE"}],
        "nodes": [{"mesh": 0, "name": "NODE"}, {"camera": 0, "name": "EYE", "translation": [0, 0, 3]}],
        "cameras": [{"type": "perspective", "name": "CAMERA",
            "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "meshes": [{"name": "MESH",
            "primitives": [{"attributes": {"POSITION": 0, "KEY": 0}, "material": 0}]}],
        "materials": [{"name": "MATERIAL"}],
        "animations": [{"name": "ANIMATION", "channels": [], "samplers": []}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "URI"}],
        "extensionsUsed": ["USED", "KHR_materials_variants"],
        "extensionsRequired": ["REQUIRED"],
        "extensions": {"KHR_materials_variants": {"variants": [{"name": "VARIANT"}]}}}"#;
    let hostile = serde_json::Value::from(HOSTILE).to_string();
    let mut text = gltf.replace(&format!("\"{place}\""), &hostile);
    text = text.replace("\"URI\"", &format!("\"{buffer}\""));
    text =
        text.replace(", \"KEY\": 0", "").replace("[\"REQUIRED\"]", "[\"KHR_materials_variants\"]");
    text.replace("\"USED\", ", "")
}

#[test]
fn names_in_models_do_not_reach_a_terminal() {
    let sandbox = Sandbox::new("hostile_names_models");
    let places = ["GENERATOR", "SCENE", "NODE", "EYE", "CAMERA", "MESH", "MATERIAL", "ANIMATION"];
    let mut all = model_with("NODE");
    for place in places {
        all = all.replace(&format!("\"{place}\""), &serde_json::Value::from(HOSTILE).to_string());
    }
    sandbox.write_file("names.gltf", all);
    for place in ["KEY", "URI", "USED", "REQUIRED", "VARIANT"] {
        sandbox.write_file(&format!("{place}.gltf"), model_with(place));
    }
    for name in ["names", "KEY", "URI", "USED", "REQUIRED", "VARIANT"] {
        let file = &format!("{name}.gltf");
        let shown = run(&sandbox, &["info", file]);
        let is_drawn = !matches!(name, "URI" | "REQUIRED");
        assert_eq!(shown.code, i32::from(!is_drawn), "{name}: {}", shown.stderr);
        run(&sandbox, &["info", file, "--json"]);
        run(&sandbox, &["check", file]);
        run(&sandbox, &["check", file, "--json"]);
        let render = ["render", file, "--size", "16x16", "-o", "a.png"];
        run(&sandbox, &render);
        run(&sandbox, &[&render[..], &["--json"]].concat());
        run(&sandbox, &[&render[..], &["--color", "never", "--animation", "none"]].concat());
        run(&sandbox, &[&render[..], &["--camera", "none"]].concat());
        run(&sandbox, &[&render[..], &["--variant", "none"]].concat());
        run(&sandbox, &["sheet", file, "--parts-list=a.csv", "-o", "a.svg"]);
        run(&sandbox, &["explain", file, "--node", "none", "--point", "0,0,0"]);
        run(&sandbox, &["scene", "init", file, "-o", "-"]);
        run(&sandbox, &["animate", file, "--frames", "2", "--animation", "none", "-o", "a.gif"]);
        let batch = run(&sandbox, &["batch", file, "--out-dir", name, "--size", "16x16"]);
        assert_eq!(batch.code, i32::from(!is_drawn), "{name}: {}", batch.stderr);
    }
    let shown = run(&sandbox, &["info", "names.gltf"]).stdout;
    assert!(shown.contains("\\u{1b}]0;P\\u{7}\\u{1b}[31m\\u{9b}2J"), "{shown}");
    let json = run(&sandbox, &["info", "names.gltf", "--json"]).stdout;
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json["nodes"][0]["name"], HOSTILE, "the same name, in escaped form");
    let refused = run(&sandbox, &["info", "REQUIRED.gltf"]).stderr;
    assert!(refused.contains("\\u{1b}]0;P"), "{refused}");
}

#[test]
fn names_in_other_formats_do_not_reach_a_terminal() {
    let sandbox = Sandbox::new("hostile_names_formats");
    let word = "\u{1b}]0;P\u{7}\u{9b}2J\u{202e}";
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let obj = format!(
        "mtllib {word}.mtl\no {word}\ng {word}\nusemtl {word}\n{triangle}f 1 2 3\n{word} 1\n"
    );
    let ply = format!(
        "ply\nformat ascii 1.0\ncomment {word}\nelement vertex 3\nproperty float x\nproperty float y\n\
         property float z\nproperty float {word}\nelement face 1\nproperty list uchar int {word}\n\
         end_header\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n"
    );
    let stl = format!(
        "solid {word}\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex {word} 1 0\n\
         endloop\nendfacet\nendsolid\n"
    );
    for (name, text) in [("a.obj", obj), ("a.ply", ply), ("a.stl", stl)] {
        sandbox.write_file(name, text);
        run(&sandbox, &["info", name]);
        run(&sandbox, &["check", name]);
        run(&sandbox, &["info", name, "--lenient"]);
        run(&sandbox, &["render", name, "--size", "16x16", "-o", "a.png"]);
    }
}

#[test]
fn strings_in_scenes_do_not_reach_a_terminal() {
    let sandbox = Sandbox::new("hostile_names_scenes");
    sandbox.copy_model("crate.glb");
    let escaped = HOSTILE.escape_debug();
    let model = "models: [Model(path: \"crate.glb\")]";
    for (at, scene) in [
        format!("Scene(models: [Model(path: \"{HOSTILE}.glb\")])"),
        format!("Scene(models: [Model(path: \"{escaped}.glb\")])"),
        format!("Scene({model}, \u{1b}[31mevil\u{9b}: 3)"),
        format!("Scene({model}, camera: Camera(view: Model(\"{escaped}\")))"),
        format!("Scene({model}, camera: Camera(view: Model(\"{HOSTILE}\")))"),
        format!("Scene({model}, title: \"{escaped}\", overlays: [Text(text: \"{escaped}\")])"),
        format!("Scene(include: [\"{escaped}.ron\"])"),
    ]
    .into_iter()
    .enumerate()
    {
        let file = &format!("{at}.ron");
        sandbox.write_file(file, scene);
        for color in ["never", "always"] {
            for command in [
                &["scene", "check", file, "--color", color][..],
                &["scene", "check", file, "--json", "--color", color],
                &["check", file, "--color", color],
                &["render", file, "-o", "a.png", "--color", color],
                &["explain", file, "--point", "0,0,0", "--color", color],
            ] {
                let run = sandbox.run(command);
                let plain = |text: &str| {
                    if color == "always" { without_colors(text) } else { text.to_owned() }
                };
                assert_is_text(&plain(&run.stdout), command);
                assert_is_text(&plain(&run.stderr), command);
            }
        }
    }
}

/// Removes color codes such as `ESC [1;31m` from text.
fn without_colors(text: &str) -> String {
    let mut parts = text.split("\u{1b}[");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |plain, part| {
        let rest = part.trim_start_matches(|c: char| c.is_ascii_digit() || c == ';');
        plain + rest.strip_prefix('m').unwrap_or("\u{1b}")
    })
}

#[test]
fn names_in_batch_lists_do_not_reach_a_terminal() {
    let sandbox = Sandbox::new("hostile_names_lists");
    sandbox.copy_model("crate.glb");
    let hostile = serde_json::Value::from(HOSTILE);
    let lines = [
        serde_json::json!({"input": hostile}),
        serde_json::json!({"input": "crate.glb", "output": format!("{HOSTILE}.png")}),
        serde_json::json!({"input": "crate.glb", "output": hostile}),
        serde_json::json!({"input": "crate.glb", HOSTILE: 1}),
        serde_json::json!({"input": "crate.glb", "view": hostile}),
    ];
    let lines: Vec<String> = lines.iter().map(ToString::to_string).collect();
    sandbox.write_file("a.jsonl", lines.join("\n"));
    let batch = ["batch", "--list", "a.jsonl", "--out-dir", "out", "--size", "16x16"];
    assert_eq!(run(&sandbox, &batch).code, 1);
    run(&sandbox, &[&batch[..], &["--verify"]].concat());
    run(&sandbox, &["batch", "--merge", "--out-dir", "out"]);
    sandbox.write_file("b.jsonl", format!("{}\n{}", lines[1], lines[1]));
    run(&sandbox, &["batch", "--list", "b.jsonl", "--out-dir", "out"]);
}

/// Some systems do not allow file names with control characters.
#[cfg(target_os = "linux")]
#[test]
fn paths_do_not_reach_a_terminal() {
    let sandbox = Sandbox::new("hostile_names_paths");
    let (model, text) = (&format!("{HOSTILE}.gltf"), &format!("{HOSTILE}.ron"));
    sandbox.write_file(model, model_with("NODE"));
    sandbox.write_file(text, "Scene(");
    let missing = &format!("{HOSTILE}.glb");
    for file in [model, text, missing] {
        for command in [
            &["info", file][..],
            &["info", file, "--json"],
            &["check", file],
            &["scene", "check", file],
            &["scene", "fmt", "--check", file],
            &["render", file, "--size", "16x16", "-o", "a.png"],
            &["render", "none.glb", "-o", file],
            &["render", file, file, "-o", "{name}.png", "--size", "16x16"],
            &["scene", "init", file, "-o", "-"],
            &["scene", "init", file],
            &["explain", file, "--point", "0,0,0"],
            &["sheet", file, "-o", "a.svg"],
            &["compare", file],
            &["batch", file, "--out-dir", "out"],
            &["batch", "--list", file, "--out-dir", "out"],
            &["explore", missing],
        ] {
            run(&sandbox, command);
        }
    }
}

#[test]
fn names_in_a_parts_list_are_not_spreadsheet_formulas() {
    let sandbox = Sandbox::new("hostile_names_csv");
    let name = serde_json::Value::from("=cmd|'/c calc'!A1\",\"x").to_string();
    sandbox.write_file("a.gltf", model_with("NONE").replace("\"NODE\"", &name));
    let run = sandbox.run(&["sheet", "a.gltf", "--parts-list=a.csv", "-o", "a.svg"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let list = std::fs::read_to_string(sandbox.path_of("a.csv")).expect("the list");
    assert!(list.contains(",\"'=cmd|'/c calc'!A1\"\",\"\"x\","), "{list}");
}
