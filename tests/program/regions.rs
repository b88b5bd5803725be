//! Parts of pictures, 16-bit channels, passes, comparison, report and preview.

use crate::sandbox::Sandbox;
use serde_json::Value;

const SIZE: [&str; 2] = ["--size", "120x90"];

fn render_region(sandbox: &Sandbox, output: &str, flags: &[&str]) {
    let run = sandbox.run(&[&["render", "crate.glb", "-o", output], &SIZE[..], flags].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{flags:?}");
}

fn sandbox_with_model(name: &str) -> Sandbox {
    let sandbox = Sandbox::new(name);
    sandbox.copy_model("crate.glb");
    sandbox
}

#[test]
fn crops_and_bands_match_the_whole_picture() {
    let sandbox = sandbox_with_model("parts");
    render_region(&sandbox, "whole.png", &["--overlay", "axes"]);
    let (width, _, whole) = sandbox.read_picture("whole.png");
    render_region(&sandbox, "crop.png", &["--overlay", "axes", "--crop", "31,20,50,40"]);
    let (across, down, crop) = sandbox.read_picture("crop.png");
    assert_eq!((across, down), (50, 40));
    for (at, pixel) in crop.iter().enumerate() {
        let (x, y) = (31 + at % 50, 20 + at / 50);
        assert_eq!(*pixel, whole[y * width as usize + x], "({x}, {y})");
    }
    let mut united = Vec::new();
    for band in ["1/4", "2/4", "3/4", "4/4"] {
        render_region(&sandbox, "band.png", &["--overlay", "axes", "--band", band]);
        united.extend(sandbox.read_picture("band.png").2);
    }
    assert_eq!(united, whole);
}

/// A scene with everything that depends on more than one pixel: shadows of two kinds of light, a
/// ground that catches them, occlusion, an environment and textures.
const EVERYTHING: &str = r#"Scene(
    models: [
        (path: "crate.glb"),
        (path: "panes.glb", translation: (1.5, 0.3, 0), scale: 0.5),
    ],
    camera: (view: Frame(from: ThreeQuarter)),
    lights: [
        Directional(direction: (-1, -1.4, -0.4), intensity: 2, shadows: On(size: 256, softness_degrees: 4)),
        Spot(position: (3, 4, 3), direction: (-3, -4, -3), intensity: 50, shadows: On(size: 256)),
    ],
    ground: Shadow(),
    environment: Studio(),
    ambient_occlusion: (radius: 0.5),
)"#;

#[test]
fn parts_with_shadows_and_occlusion_match_byte_for_byte() {
    let sandbox = sandbox_with_model("everything");
    sandbox.copy_model("panes.glb");
    sandbox.write_file("scene.ron", EVERYTHING);
    // The tall picture is drawn in two bands.
    for (size, columns, rows) in [("96x80", 96, 80), ("60x2100", 60, 2100)] {
        let draw = |output: &str, flags: &[&str]| {
            let default = ["render", "scene.ron", "-o", output, "--size", size];
            let run = sandbox.run(&[&default[..], flags].concat());
            assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{size} {flags:?}");
            sandbox.read_picture(output).2
        };
        let whole = draw("whole.png", &[]);
        let shades = whole.iter().filter(|p| p[..3] == [0; 3] && (1..255).contains(&p[3]));
        assert!(shades.count() > 100, "the ground catches shadows");
        let mut bands = Vec::new();
        for band in ["1/3", "2/3", "3/3"] {
            bands.extend(draw("band.png", &["--band", band]));
        }
        assert!(bands == whole, "{size} in bands");
        // The parts left and right of a line, joined row by row.
        let left = draw("left.png", &["--crop", &format!("0,0,37,{rows}")]);
        let right = draw("right.png", &["--crop", &format!("37,0,{},{rows}", columns - 37)]);
        let pairs = left.chunks(37).zip(right.chunks(columns - 37));
        let united: Vec<_> = pairs.flat_map(|(left, right)| [left, right].concat()).collect();
        assert!(united == whole, "{size} in crops");
    }
}

#[test]
fn invalid_regions_are_refused() {
    let sandbox = sandbox_with_model("no-parts");
    for (flags, message) in [
        (
            &["--crop", "100,0,30,10"][..],
            "--crop 100,0,30,10 is not inside the picture of 120 x 90 pixels",
        ),
        (&["--band", "91/200"], "--band 91/200 is empty; set N to at most 90, the number of rows"),
        (&["--band", "5/4"], "expected I/N with I from 1 to N, such as 2/8"),
        (&["--crop", "1,2,0,4"], "expected column, row, width and height in pixels"),
        (&["--bits", "12"], "for '--bits <N>': expected 8 or 16"),
        (&["--passes", "depht"], "depth"),
        (&["--pass-format", "npy"], "--passes <PASS,…>"),
        (&["--tolerance", "3"], "--compare <PNG>"),
        (&["--compare", "nowhere.png"], "cannot compare with nowhere.png"),
        (&["-o", "a.svg", "--crop", "0,0,1,1"], "need a raster image: name a .png"),
    ] {
        let run = sandbox.run(&[&["render", "crate.glb"], &SIZE[..], flags].concat());
        assert!(run.code == 1 || run.code == 2, "{flags:?}");
        assert!(run.stderr.contains(message), "{flags:?}: {}", run.stderr);
        assert!(!sandbox.path_of("crate.png").exists(), "{flags:?}");
    }
    let run = sandbox.run(&["render", "crate.glb", "--size", "1048577x1"]);
    assert!(run.stderr.contains("each from 1 to 1048576"), "{}", run.stderr);
}

#[test]
fn sixteen_bits_round_to_eight() {
    let sandbox = sandbox_with_model("bits");
    render_region(&sandbox, "flat.png", &[]);
    render_region(&sandbox, "deep.png", &["--bits", "16"]);
    let file = std::fs::read(sandbox.path_of("deep.png")).expect("a file");
    assert_eq!(file[24], 16, "the depth in the header");
    let (flat, deep) = (sandbox.read_picture("flat.png").2, sandbox.read_picture("deep.png").2);
    // The test's reader uses the high byte, which equals the 8-bit code or differs from it by one.
    for (flat, deep) in flat.iter().zip(&deep) {
        assert!((0..4).all(|k| flat[k].abs_diff(deep[k]) <= 1), "{flat:?} {deep:?}");
    }
}

#[test]
fn passes_are_written_next_to_the_picture() {
    let sandbox = sandbox_with_model("passes");
    render_region(
        &sandbox,
        "a.png",
        &["--passes", "depth,normal,id", "--pass-format", "npy", "--samples", "1"],
    );
    let seen = sandbox.read_picture("a.png").2;
    let read = |name: &str| std::fs::read(sandbox.path_of(name)).expect(name);
    let depth = read("a.depth.npy");
    assert_eq!(depth[..8], *b"\x93NUMPY\x01\0");
    let data = &depth[depth.len() - 120 * 90 * 4..];
    for (at, (bytes, pixel)) in data.as_chunks::<4>().0.iter().zip(&seen).enumerate() {
        let depth = f32::from_le_bytes(*bytes);
        assert_eq!(depth.is_finite(), pixel[3] == 255, "pixel {at}: {depth} {pixel:?}");
    }
    assert_eq!(read("a.normal.npy").len() % 64, (120 * 90 * 12) % 64);
    render_region(&sandbox, "b.png", &["--passes", "overdraw,coverage,view-normal"]);
    for name in ["b.overdraw.png", "b.coverage.png", "b.view-normal.png"] {
        assert_eq!(read(name)[24], 16, "{name}");
    }
    sandbox
        .write_file("scene.ron", "Scene(models: [(path: \"crate.glb\")], passes: (write: [Uv]))");
    assert_eq!(sandbox.run(&["render", "scene.ron", "--size", "20x10"]).code, 0);
    assert!(sandbox.path_of("scene.uv.png").exists());
}

#[test]
fn nothing_is_written_if_a_pass_fails() {
    let sandbox = sandbox_with_model("all-or-nothing");
    // A name that is just short enough for a picture but too long for its pass.
    let stem = "a".repeat(232);
    let output = format!("{stem}.png");
    sandbox.write_file(&output, "old");
    let run = sandbox.run(&["render", "crate.glb", "-o", &output, "--passes", "depth,view-normal"]);
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("view-normal.png"), "{}", run.stderr);
    assert_eq!(std::fs::read_to_string(sandbox.path_of(&output)).expect("a file"), "old");
    assert!(!sandbox.path_of(&format!("{stem}.depth.png")).exists());
    let left = std::fs::read_dir(sandbox.path_of("")).expect("a folder").filter_map(Result::ok);
    let parts = left.filter(|entry| entry.file_name().to_string_lossy().ends_with(".part"));
    assert_eq!(parts.count(), 0, "nothing is left behind");
}

#[test]
fn comparisons_print_statistics_and_set_the_exit_code() {
    let sandbox = sandbox_with_model("compare");
    render_region(&sandbox, "expected.png", &[]);
    let same = ["render", "crate.glb", "-o", "same.png", "--compare", "expected.png"];
    let run = sandbox.run(&[&same[..], &SIZE].concat());
    assert_eq!(run.code, 0);
    assert_eq!(
        run.stderr,
        "compared: agrees; the maximum difference is 0 of 255, and 0.0000% of the pixels (0) exceed the tolerance of 0\n"
    );
    let (width, height, _) = sandbox.read_picture("same.compare.png");
    assert_eq!((width, height), (360, 90));
    let other =
        ["render", "crate.glb", "-o", "other.png", "--style", "flat", "--background", "#123"];
    let flags = ["--compare", "expected.png", "--tolerance", "40"];
    let run = sandbox.run(&[&other[..], &flags, &SIZE].concat());
    assert_eq!(run.code, 1);
    assert!(run.stderr.starts_with("compared: differs; the maximum difference is 255 of 255, "));
    assert!(sandbox.path_of("other.png").exists(), "the picture is written for inspection");
    let run = sandbox.run(&["render", "crate.glb", "--size", "10x10", "--compare", "expected.png"]);
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("its size is 120 x 90, but the picture is 10 x 10"));
}

#[test]
fn the_report_identifies_files_by_content() {
    let sandbox = sandbox_with_model("report");
    let flags = ["--json", "--passes", "id", "--crop", "10,10,60,50", "--compare", "expected.png"];
    render_region(&sandbox, "expected.png", &["--crop", "10,10,60,50"]);
    let run = sandbox.run(&[&["render", "crate.glb", "-o", "a.png"], &SIZE[..], &flags].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(report["schema"]["name"], "alberti-render");
    assert_eq!(report["image"]["size"], serde_json::json!([120, 90]));
    assert_eq!(report["image"]["region"], serde_json::json!([10, 10, 60, 50]));
    assert_eq!(report["comparison"]["agrees"], true);
    assert_eq!(report["models"][0]["name"], "crate");
    assert!(report["models"][0]["triangles"].as_u64().is_some_and(|count| count >= 12));
    let files: Vec<&str> = report["files"]
        .as_array()
        .expect("files")
        .iter()
        .filter_map(|f| f["path"].as_str())
        .collect();
    assert_eq!(files, ["a.png", "a.id.png", "a.compare.png"]);
    for file in report["files"].as_array().expect("files") {
        let bytes =
            std::fs::read(sandbox.path_of(file["path"].as_str().expect("a path"))).expect("a file");
        assert_eq!(file["bytes"], bytes.len());
        assert_eq!(file["sha256"].as_str().map(str::len), Some(64));
    }
}

#[test]
fn pictures_are_shown_in_half_blocks() {
    let sandbox = sandbox_with_model("show");
    let run = sandbox.run(&[&["render", "crate.glb", "--show"], &SIZE[..]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let lines: Vec<&str> = run.stdout.lines().collect();
    // The 60 rows of 80 pixels are shown in 30 lines of half blocks or, without colors, of other
    // characters.
    assert_eq!(lines.len(), 30);
    let cells = lines[15].matches('▀').count();
    assert!(cells == 80 || lines[15].chars().count() == 80, "{}", lines[15]);
}
