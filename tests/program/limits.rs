//! Scenes of a few bytes that demand a lot of work: each fails quickly, with a location and a
//! remedy.

use crate::sandbox::Sandbox;

/// Renders a scene, which must be refused.
fn refusal(name: &str, scene: &str) -> String {
    let sandbox = Sandbox::new(name);
    sandbox.copy_model("crate.glb");
    sandbox.write_file("scene.ron", scene);
    let run = sandbox.run(&["render", "scene.ron", "-o", "picture.png"]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert!(!sandbox.path_of("picture.png").exists(), "no picture");
    run.stderr
}

#[test]
fn a_scene_cannot_request_hours_of_rendering() {
    let scene = "Scene(models: [(path: \"crate.glb\")], image: (size: (1048576, 1048576)))";
    let message = refusal("many_pixels", scene);
    assert!(message.contains("the picture has 1048576 x 1048576 pixels"), "{message}");
    assert!(message.contains("--> scene.ron:1:"), "{message}");
    assert!(message.contains("= help: `--size 1048576x1048576` on the command line"), "{message}");
}

#[test]
fn a_size_flag_replaces_the_scenes_size_before_limits_apply() {
    let sandbox = Sandbox::new("small_instead");
    sandbox.copy_model("crate.glb");
    let scene = "Scene(models: [(path: \"crate.glb\")], image: (size: (1048576, 1048576)))";
    sandbox.write_file("scene.ron", scene);
    let run = sandbox.run(&["render", "scene.ron", "--size", "16x16", "-o", "picture.png"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
}

#[test]
fn shadow_maps_have_a_total_limit() {
    let light =
        "Spot(position: (0, 3, 0), direction: (0, -1, 0), intensity: 1, shadows: On(size: 8192))";
    let scene = format!("Scene(models: [(path: \"crate.glb\")], lights: [{light}, {light}])");
    let message = refusal("many_texels", &scene);
    assert!(message.contains("the shadow maps of 2 lights have 134217728 texels"), "{message}");
    assert!(message.contains("= help: use `size: 5792` for each"), "{message}");
}

#[test]
fn many_lights_have_smaller_shadow_maps_by_default() {
    let sandbox = Sandbox::new("many_lights");
    sandbox.copy_model("crate.glb");
    let light = "Directional(direction: (0.1, -1, 0), intensity: 0.01)";
    let lights = vec![light; 100].join(", ");
    let scene = format!(
        "Scene(models: [(path: \"crate.glb\")], lights: [{lights}], shadows: On(), image: (size: (32, 32)))"
    );
    sandbox.write_file("scene.ron", &scene);
    let run = sandbox.run(&["render", "scene.ron", "-o", "picture.png"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
}

#[test]
fn included_files_have_a_total_limit() {
    let sandbox = Sandbox::new("many_includes");
    sandbox.copy_model("crate.glb");
    let comment = "// not read, but counted\n".repeat(36_000);
    sandbox.write_file("large.ron", format!("{comment}Scene(models: [(path: \"crate.glb\")])"));
    let includes = vec!["\"large.ron\""; 60].join(", ");
    sandbox.write_file("scene.ron", format!("Scene(include: [{includes}])"));
    let run = sandbox.run(&["render", "scene.ron", "-o", "picture.png"]);
    assert_eq!(run.code, 1);
    let message = "the included files total more than 4194304 bytes";
    assert!(run.stderr.contains(message), "{}", &run.stderr[..run.stderr.len().min(500)]);
    // The error is reported once, not for each of the skipped files.
    assert_eq!(run.stderr.matches(message).count(), 1);
}

/// Returns random triangles in a cube, as binary STL.
fn soup(count: u32) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend(count.to_le_bytes());
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 40) as f32 / (1_u32 << 24) as f32
    };
    for _ in 0..count {
        bytes.extend([0; 12]);
        bytes.extend((0..9).flat_map(|_| random().to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

#[test]
fn drawings_of_many_crossing_triangles_take_bounded_time() {
    let sandbox = Sandbox::new("soup");
    std::fs::write(sandbox.path_of("soup.stl"), soup(1000)).unwrap();
    for style in ["lines", "dashed"] {
        let output = format!("{style}.svg");
        let run = sandbox.run(&["render", "soup.stl", "--style", style, "-o", &output]);
        assert_eq!(run.code, 0, "{style}: {}", run.stderr);
        let drawing = std::fs::read_to_string(sandbox.path_of(&output)).unwrap();
        assert!(drawing.contains("<path"), "{style}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_command_that_exceeds_its_memory_limit_ends_with_an_error() {
    let sandbox = Sandbox::new("max_memory");
    sandbox.copy_model("crate.glb");
    sandbox.write_file("a.png", "old");
    let words = ["render", "crate.glb", "--size", "9000x9000", "--samples", "16", "-o", "a.png"];
    let run = sandbox.run(&[&words[..], &["--max-memory", "64MiB"]].concat());
    let expected = "error: the command ran out of memory: --max-memory allows 64 MiB\n  = help: ";
    assert!(run.code == 1 && run.stderr.starts_with(expected), "{}: {}", run.code, run.stderr);
    assert_eq!(sandbox.file_names(), ["a.png", "crate.glb"]);
    assert_eq!(std::fs::read(sandbox.path_of("a.png")).expect("the old file"), b"old");
    let small = ["render", "crate.glb", "--size", "64x48", "--max-memory", "256MiB"];
    let run = sandbox.run(&small);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
}
