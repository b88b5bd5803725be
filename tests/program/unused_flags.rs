//! Flags without effect on a picture are reported. Warnings about things that the picture does not
//! show are omitted.

use crate::sandbox::Sandbox;

/// Returns the messages for a picture of 8 × 8 pixels.
fn messages(sandbox: &Sandbox, flags: &[&str]) -> String {
    let run = sandbox.run(&[&["render", "crate.glb", "--size", "8x8"], flags].concat());
    assert_eq!(run.code, 0, "{flags:?}: {}", run.stderr);
    run.stderr
}

#[test]
fn flags_without_effect_are_reported() {
    let sandbox = Sandbox::new("unused_flags");
    sandbox.copy_model("crate.glb");
    for (flags, told) in [
        (
            &["--style", "lines", "--exposure", "3", "--tone-mapping", "aces", "--shadows", "on"][..],
            "warning: --exposure, --tone-mapping and --shadows do nothing here: a line drawing has no shading\n",
        ),
        (
            &["--style", "patent", "--samples", "8"],
            "warning: --samples does nothing here: a line drawing has no shading\n",
        ),
        (
            &["--style", "clay", "--ambient-occlusion"],
            "warning: --ambient-occlusion does nothing here: the `clay` style has neither shadows nor ambient occlusion\n",
        ),
        (
            &["--style", "ids", "--environment", "sky"],
            "warning: --environment does nothing here: the `ids` style has no lighting\n",
        ),
        (
            &["--style", "shaded", "-o", "x.svg"],
            "warning: --style shaded does nothing here: SVG output is always a line drawing; to show surfaces, write a .png\n",
        ),
        (
            &["--camera-axes", "opencv"],
            "warning: --camera-axes does nothing here: it applies only to --extrinsics and --pose\n",
        ),
        (
            &["--arc-tolerance", "0.1"],
            "warning: --arc-tolerance does nothing here: only a DXF has arcs\n",
        ),
        // These have an effect.
        (&["--exposure", "3", "--shadows", "on", "--ambient-occlusion"], ""),
        (&["--style", "clay", "--ground", "shadow", "--shadows", "on"], ""),
        (&["--style", "ids", "--environment", "sky", "--background", "environment"], ""),
        (&["--style", "lines", "-o", "x.dxf", "--arc-tolerance", "0.1"], ""),
        (&["--style", "technical", "-o", "x.svg"], ""),
    ] {
        assert_eq!(messages(&sandbox, flags), told, "{flags:?}");
    }
}

#[test]
fn the_json_report_contains_the_warnings() {
    let sandbox = Sandbox::new("unused_report");
    sandbox.copy_model("crate.glb");
    let call = ["render", "crate.glb", "--size", "8x8", "--arc-tolerance", "1", "--json"];
    let run = sandbox.run(&call);
    assert!(run.stdout.contains("only a DXF has arcs"), "{}", run.stdout);
    assert_eq!(run.stderr, "");
}

/// Returns a glTF file that uses the extension `name`, which is drawn only in part.
fn partly_drawn(name: &str) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "extensionsUsed": ["{name}"], "scene": 0,
        "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
        "buffers": [{{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
        "min": [0, 0, 0], "max": [1, 1, 0]}}]}}"#
    )
}

#[test]
fn only_pictures_with_materials_warn_about_materials() {
    let sandbox = Sandbox::new("unshown_materials");
    sandbox.write_file("glass.gltf", partly_drawn("KHR_materials_transmission"));
    sandbox.write_file("edges.gltf", partly_drawn("EXT_mesh_primitive_edge_visibility"));
    for (model, style, warns) in [
        ("glass.gltf", "shaded", true),
        ("glass.gltf", "flat", true),
        ("glass.gltf", "lines", false),
        ("glass.gltf", "ids", false),
        ("glass.gltf", "depth", false),
        ("glass.gltf", "outline", false),
        ("edges.gltf", "shaded", true),
        ("edges.gltf", "lines", false),
    ] {
        let run = sandbox.run(&["render", model, "--size", "8x8", "--style", style]);
        assert_eq!(run.code, 0, "{}", run.stderr);
        assert_eq!(!run.stderr.is_empty(), warns, "{model} {style}: {}", run.stderr);
    }
}

#[test]
fn a_batch_report_contains_the_warnings() {
    let sandbox = Sandbox::new("unused_flags_batch");
    sandbox.copy_model("crate.glb");
    let flags = ["--size", "8x8", "--style", "lines", "--exposure", "3"];
    let run = sandbox.run(&[&["batch", "crate.glb", "--out-dir", "out"], &flags[..]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let records = crate::batch::read_records(&sandbox, "");
    let message = records[0]["message"].as_str().expect("words");
    assert_eq!(message, "--exposure does nothing here: a line drawing has no shading");
}
