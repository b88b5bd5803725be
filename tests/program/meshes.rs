//! Models in formats other than glTF: recognized, measured, drawn and described.

use crate::drawings::{assert_near, assert_succeeds};
use crate::sandbox::Sandbox;
use crate::vector_files::{layer_bounds, parse_pdf, parse_svg};
use serde_json::Value;

/// Returns a box as ASCII STL, with one corner at the origin and these sides along x, y and z.
pub(crate) fn stl_box([w, d, h]: [f32; 3]) -> String {
    let corner =
        |n: usize| [(n & 1, w), (n >> 1 & 1, d), (n >> 2, h)].map(|(bit, s)| bit as f32 * s);
    let quads =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let vertex = |n: usize| {
        let [x, y, z] = corner(n);
        format!("vertex {x} {y} {z}\n")
    };
    let facet = |corners: [usize; 3]| {
        let vertices: String = corners.into_iter().map(vertex).collect();
        format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    let facets: String =
        quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).map(facet).collect();
    format!("solid box\n{facets}endsolid box\n")
}

/// Returns the width and height of a sheet's front view, in millimeters on paper.
fn front_size(sandbox: &Sandbox, flags: &[&str]) -> [f64; 2] {
    let flags = [&["sheet"], flags, &["-o", "out.svg", "--no-dimensions"]].concat();
    assert_succeeds(sandbox, &flags);
    let svg = std::fs::read_to_string(sandbox.path_of("out.svg")).expect("an SVG");
    let [low, high] = layer_bounds(&parse_svg(&svg).1, |id| id.starts_with("front-"));
    [high[0] - low[0], high[1] - low[1]]
}

#[test]
fn an_stl_file_is_upright_and_in_millimeters_on_paper() {
    let sandbox = Sandbox::new("stl_sheet");
    sandbox.write_file("part.stl", stl_box([40.0, 20.0, 30.0]));
    let one_to_one = ["part.stl", "--paper", "a4", "--scale", "1:1"];
    for (flags, [width, height]) in [
        (&[][..], [40.0, 30.0]),
        (&["--up", "y"], [40.0, 20.0]),
        (&["--up", "x"], [20.0, 40.0]),
        (&["--unit", "cm", "--scale", "1:10"], [40.0, 30.0]),
        (&["--unit", "um", "--scale", "100:1"], [4.0, 3.0]),
    ] {
        let base = if flags.contains(&"--scale") { &one_to_one[..3] } else { &one_to_one[..] };
        let [w, h] = front_size(&sandbox, &[base, flags].concat());
        assert_near(w, width);
        assert_near(h, height);
    }
    assert_succeeds(
        &sandbox,
        &[
            &["sheet"],
            &one_to_one[..],
            &["--axonometric", "none", "--no-dimensions", "-o", "out.pdf"],
        ]
        .concat(),
    );
    let pages = parse_pdf(&std::fs::read(sandbox.path_of("out.pdf")).expect("a PDF"));
    let long = |pair: &&[[f64; 2]]| {
        ((pair[0][0] - pair[1][0]).abs() - 40.0).abs() < 0.0005
            && (pair[0][1] - pair[1][1]).abs() < 1e-3
    };
    // Two edges of the front view and two edges of the top view.
    assert_eq!(pages[0].1.iter().flat_map(|line| line.windows(2)).filter(long).count(), 4);
}

#[test]
fn flags_override_the_axis_unit_and_crease_angle_of_scene_files() {
    let sandbox = Sandbox::new("stl_scene");
    sandbox.write_file("part.stl", stl_box([40.0, 20.0, 30.0]));
    let scene = |fields: &str| {
        let text =
            format!("Scene(models: [(path: \"part.stl\", {fields})], sheet: (scale: (1, 1)))");
        sandbox.write_file("scene.ron", text);
    };
    scene("up: Y, unit: Inch, crease_degrees: 180");
    assert_near(front_size(&sandbox, &["scene.ron", "--scale", "1:10"])[1], 50.8);
    assert_near(front_size(&sandbox, &["scene.ron", "--unit", "mm"])[1], 20.0);
    assert_near(front_size(&sandbox, &["scene.ron", "--unit", "mm", "--up", "z"])[1], 30.0);
    scene("crease_degrees: 181");
    let run = sandbox.run(&["scene", "check", "scene.ron"]);
    assert!(run.stdout.contains("invalid crease angle: 181 degrees"), "{}", run.stdout);
    let run = sandbox.run(&["render", "part.stl", "--crease", "181"]);
    assert_eq!(run.code, 2);
    let two = "Scene(models: [(path: \"part.stl\"), (path: \"part.stl\", unit: Inch)], sheet: ())";
    sandbox.write_file("two.ron", two);
    let run = sandbox.run(&["sheet", "two.ron"]);
    assert!(
        run.code == 1 && run.stderr.contains("some models are in mm and others in in"),
        "{}",
        run.stderr
    );
    assert_succeeds(&sandbox, &["sheet", "two.ron", "--unit", "mm", "--paper", "a0"]);
}

#[test]
fn the_crease_angle_determines_smoothness() {
    let sandbox = Sandbox::new("stl_crease");
    sandbox.write_file("part.stl", stl_box([1.0; 3]));
    let picture = |name: &str, flags: &[&str]| {
        assert_succeeds(
            &sandbox,
            &[&["render", "part.stl", "--size", "64x48", "-o", name], flags].concat(),
        );
        std::fs::read(sandbox.path_of(name)).expect("a picture")
    };
    let sharp = picture("sharp.png", &[]);
    assert_eq!(sharp, picture("flat.png", &["--crease", "0"]));
    assert!(sharp != picture("smooth.png", &["--crease", "90"]));
}

#[test]
fn every_command_reads_an_stl_file() {
    let sandbox = Sandbox::new("stl_commands");
    let text = stl_box([40.0, 20.0, 30.0]);
    sandbox.write_file("part.stl", &text);
    let run = sandbox.run(&["info", "part.stl"]);
    for line in [
        "bounds      (0.000000, 0.000000, -20.000000) to (40.000000, 30.000000, 0.000000)",
        "unit        mm, z up",
    ] {
        assert!(run.stdout.contains(line), "{}", run.stdout);
    }
    let run = sandbox.run(&["info", "part.stl", "--json"]);
    let info: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!((&info["unit"], &info["up"]), (&Value::from("mm"), &Value::from("z")));
    let run = sandbox.run(&["check", "part.stl"]);
    assert_eq!(run.stdout, "part.stl: no errors, no warnings, no notes; it can be drawn\n");
    assert_succeeds(&sandbox, &["render", "part.stl", "-o", "lines.svg"]);
    let run = sandbox.run(&["explain", "part.stl", "--point", "0,1,0"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_succeeds(&sandbox, &["scene", "init", "part.stl", "--crease", "45"]);
    let scene = std::fs::read_to_string(sandbox.path_of("part.ron")).expect("a scene");
    for field in ["up: Z", "unit: Millimeter", "crease_degrees: 45"] {
        assert!(scene.contains(field), "{scene}");
    }
    assert_succeeds(&sandbox, &["scene", "check", "part.ron"]);
    let run = sandbox.run(&["batch", ".", "--out-dir", "out", "--size", "32x24"]);
    assert_eq!(run.stdout, "1 rendered, 0 up to date, 0 failed\n", "{}", run.stderr);
    let (code, picture) =
        sandbox.run_with_input(&["render", "-", "-o", "-", "--size", "32x24"], text.as_bytes());
    assert!(code == 0 && picture.starts_with(b"\x89PNG"));
}

#[test]
fn content_determines_the_format_and_wrong_names_are_reported() {
    let sandbox = Sandbox::new("stl_names");
    sandbox.write_file("part.glb", stl_box([1.0; 3]));
    let run = sandbox.run(&["render", "part.glb"]);
    let note = "note: part: the name suggests glTF, but the content is STL; \
                rename it to end in .stl\n";
    assert_eq!((run.code, run.stderr.as_str()), (0, note));
    let run = sandbox.run(&["check", "part.glb"]);
    assert!(run.code == 0 && run.stdout.contains("note[MISLEADING_NAME]"), "{}", run.stdout);
    sandbox.write_file("part.step", "ISO-10303-21;\nHEADER;\n");
    let run = sandbox.run(&["render", "part.step"]);
    assert!(run.code == 1 && run.stderr.contains("this is a STEP file"), "{}", run.stderr);
    sandbox.write_file("part.stl", "solid part\nfacet normal 0 0 1\nouter loop\nvertex 1 2 x\n");
    let run = sandbox.run(&["render", "part.stl"]);
    assert!(
        run.stderr.contains("line 4, column 12: expected a number, found \"x\""),
        "{}",
        run.stderr
    );
}
