//! Pictures as JPEG and WebP, and pictures that are redrawn when their files change.

use crate::sandbox::Sandbox;
use std::time::{Duration, Instant};

#[test]
fn jpeg_and_webp_have_the_requested_size_and_do_not_depend_on_threads() {
    let sandbox = Sandbox::new("picture_formats");
    sandbox.copy_model("crate.glb");
    let bytes = |name: &str| std::fs::read(sandbox.path_of(name)).expect("a picture");
    for (name, flags) in [
        ("a.jpg", &["--threads", "1"][..]),
        ("b.jpeg", &["--threads", "3"]),
        ("low.jpg", &["--quality", "20"]),
        ("a.webp", &["--threads", "1"]),
        ("b.webp", &["--threads", "3"]),
        ("sheet.jpg", &[]),
    ] {
        let command: &[&str] = if name == "sheet.jpg" {
            &["sheet", "crate.glb"]
        } else {
            &["render", "crate.glb", "--size", "90x70"]
        };
        let run = sandbox.run(&[command, flags, &["-o", name]].concat());
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{name}");
    }
    assert!(bytes("a.jpg") == bytes("b.jpeg") && bytes("a.webp") == bytes("b.webp"));
    assert!(bytes("low.jpg").len() < bytes("a.jpg").len());
    assert_eq!(jpeg_size(&bytes("a.jpg")), [90, 70]);
    let webp = bytes("a.webp");
    assert!(webp.starts_with(b"RIFF") && &webp[8..16] == b"WEBPVP8L");
    // 14 bits for the width minus one, then 14 bits for the height minus one.
    let bits = u32::from_le_bytes([webp[21], webp[22], webp[23], webp[24]]);
    assert_eq!([bits & 0x3fff, bits >> 14 & 0x3fff], [89, 69]);
}

/// Returns the width and height of a baseline JPEG from its frame header.
fn jpeg_size(bytes: &[u8]) -> [u16; 2] {
    assert!(bytes.starts_with(&[0xff, 0xd8]) && bytes.ends_with(&[0xff, 0xd9]), "a complete JPEG");
    let mut at = 2;
    loop {
        let number = |at: usize| u16::from_be_bytes([bytes[at], bytes[at + 1]]);
        assert_eq!(bytes[at], 0xff, "a marker");
        if bytes[at + 1] == 0xc0 {
            return [number(at + 7), number(at + 5)];
        }
        at += 2 + usize::from(number(at + 2));
    }
}

#[test]
fn a_watched_picture_is_rendered_again_when_its_model_changes() {
    let sandbox = Sandbox::new("watched");
    sandbox.copy_model("crate.glb");
    sandbox.copy_model("vase.glb");
    sandbox.write_file("scene.ron", "Scene(models: [(path: \"crate.glb\")])");
    let words = ["render", "scene.ron", "--size", "32x24", "--watch", "-o", "out.png"];
    let mut child = sandbox.start(&words);
    let first = wait_for_change(&sandbox, &[]);
    let vase = std::fs::read(sandbox.path_of("vase.glb")).expect("the vase");
    // The new file may have the same time in seconds, but its length differs.
    sandbox.write_file("crate.glb", vase);
    let second = wait_for_change(&sandbox, &first);
    sandbox.write_file("scene.ron", "Scene(models: [(path: \"crate.glb\")], style: Normals)");
    wait_for_change(&sandbox, &second);
    child.kill().expect("the process can be killed");
    child.wait().expect("the process exits");
}

/// Waits until the bytes of the picture differ from the previous ones, and returns them.
fn wait_for_change(sandbox: &Sandbox, before: &[u8]) -> Vec<u8> {
    let begin = Instant::now();
    loop {
        let now = std::fs::read(sandbox.path_of("out.png")).unwrap_or_default();
        if !now.is_empty() && now != before {
            return now;
        }
        assert!(begin.elapsed() < Duration::from_secs(60), "the picture does not change");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_starter_scene_looks_like_the_bare_model() {
    let sandbox = Sandbox::new("starter_look");
    for model in ["crate", "teapot", "finishes", "lamp"] {
        let (file, scene) = (format!("{model}.glb"), format!("{model}.ron"));
        sandbox.copy_model(&file);
        let small = ["--size", "160x120", "--background", "#f4f1ea"];
        let bare = sandbox.run(&[&["render", &file, "-o", "bare.png"][..], &small].concat());
        assert_eq!(bare.code, 0, "{}", bare.stderr);
        assert_eq!(sandbox.run(&["scene", "init", &file]).code, 0, "{model}");
        let words =
            ["render", &scene, "-o", "own.png", "--compare", "bare.png", "--tolerance", "2"];
        let own = sandbox.run(&[&words[..], &small].concat());
        assert_eq!(own.code, 0, "{model}: {}", own.stderr);
    }
}

#[test]
fn a_label_has_lines_greek_letters_and_a_halo() {
    let sandbox = Sandbox::new("label_lines");
    sandbox.copy_model("crate.glb");
    let scene = |text: &str| {
        format!(
            "Scene(models: [(path: \"crate.glb\")], image: (size: (240, 180), background: Color(\"#000000\")), \
             overlays: [Label(at: (0, 0, 0), text: \"{text}\", color: \"#000000\")])"
        )
    };
    let white = |text: &str| {
        sandbox.write_file("scene.ron", scene(text));
        let run = sandbox.run(&["render", "scene.ron", "-o", "out.png"]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{text}");
        let rows = sandbox.read_picture("out.png").2;
        let has_white = |row: &[[u8; 4]]| row.contains(&[255; 4]);
        rows.chunks_exact(240).filter(|row| has_white(row)).count()
    };
    // Black letters on a black background are visible because of their halo.
    let (one, two) = (white("α → β"), white("α → β\\nΔφ ≤ 2π"));
    assert!(one > 8 && two > one + 10, "{one} rows for one line, {two} for two lines");
}

#[test]
fn point_size_can_be_set_and_passes_can_be_written_as_openexr() {
    let sandbox = Sandbox::new("points_and_exr");
    sandbox.write_file("dots.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n");
    let covered = |size: &str| {
        let words = ["render", "dots.obj", "--size", "64x48", "--point-size", size, "-o", "a.png"];
        let run = sandbox.run(&words);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{size}");
        sandbox.read_picture("a.png").2.iter().filter(|pixel| pixel[3] > 0).count()
    };
    let (small, large) = (covered("2"), covered("8"));
    assert!(small >= 12 && large > 8 * small, "{small} and {large} pixels");
    sandbox.copy_model("crate.glb");
    let words = ["render", "crate.glb", "--size", "20x10", "--passes", "depth,id"];
    let run = sandbox.run(&[&words[..], &["--pass-format", "exr", "-o", "b.png"]].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for name in ["b.depth.exr", "b.id.exr"] {
        let bytes = std::fs::read(sandbox.path_of(name)).expect("a pass");
        assert!(bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]), "{name}");
        // Ten rows of twenty values, each row preceded by its number and its length.
        assert!(bytes.len() > 10 * (8 + 80), "{name}: {}", bytes.len());
    }
}
