//! Cuts through models, and tones under lines, in the program's output.

use crate::drawings::{assert_near, assert_succeeds, read_drawing, write_box};
use crate::sandbox::Sandbox;
use crate::vector_files::{Layers, PagePoint, layer_bounds, parse_svg};

/// The layers of a cut box of 100 × 50 × 30 mm.
#[test]
fn sections_cut_through_models_in_drawings() {
    let sandbox = Sandbox::new("sections");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    let layers = |flags: &[&str]| {
        assert_succeeds(
            &sandbox,
            &[&["render", "box.gltf", "-o", "out.svg", "--style", "lines"], flags].concat(),
        );
        read_drawing(&sandbox, "out.svg").1
    };
    assert!(layers(&[]).keys().all(|id| !id.contains("section") && !id.contains("hatching")));
    for flags in [
        &["--section", "x=0.05"][..],
        &["--section", "-z=0.01", "--view", "back"],
        &["--section", "0.05,0,0,1,0.2,0.1", "--projection", "cavalier", "--view", "isometric"],
        &["--section=x=0.05", "--section=z=0.01", "--projection", "isometric"],
    ] {
        let layers = layers(flags);
        let [low, high] = layer_bounds(&layers, |id| id == "visible-section");
        let [inner_low, inner_high] = layer_bounds(&layers, |id| id == "visible-hatching");
        for axis in 0..2 {
            assert!(low[axis] - 0.001 <= inner_low[axis], "{flags:?}");
            assert!(inner_high[axis] <= high[axis] + 0.001, "{flags:?}");
        }
        assert!(layers["visible-hatching"].len() > 3, "{flags:?}");
    }
    // A plane outside the box removes nothing, or everything, and the message names the plane.
    for (plane, warning) in [("x=1", "cuts nothing"), ("-x=1", "would remove everything")] {
        let flags = ["render", "box.gltf", "-o", "out.svg", "--style", "lines", "--section", plane];
        let run = sandbox.run(&flags);
        assert!(run.code == 0 && run.stderr.contains(warning), "{plane}: {}", run.stderr);
        let (_, layers) = read_drawing(&sandbox, "out.svg");
        assert!(layers.keys().all(|id| !id.contains("section")));
        assert_eq!(layers.is_empty(), plane == "-x=1");
    }
}

#[test]
fn invalid_sections_are_reported() {
    let sandbox = Sandbox::new("bad_sections");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    for wrong in ["x", "w=0", "x=nan", "1,2,3", "0,0,0,0,0,0"] {
        let run = sandbox.run(&["render", "box.gltf", "-o", "out.svg", "--section", wrong]);
        assert!(
            run.code == 2 && run.stderr.contains("expected a plane"),
            "{wrong}: {}",
            run.stderr
        );
    }
    let run = sandbox.run(&["render", "box.gltf", "-o", "out.png", "--section", "x=0.05"]);
    assert!(run.code == 0 && run.stderr.contains("warning: sections are ignored"));
    for (more, message) in [
        ("sections: [Section(normal: (0, 0, 0))]", "wrong.ron:2:28"),
        ("sections: [Section(point: (1, 0, 0))]", "normal"),
        ("style: Lines(hatch_spacing_mm: 0.01)", "a distance from 0.1 to 1000 millimeters"),
        ("style: Lines(face_fill: Grey)", "Grey"),
    ] {
        sandbox.write_file("wrong.ron", format!("Scene(models: [(path: \"box.gltf\")],\n{more})"));
        let run = sandbox.run(&["render", "wrong.ron", "-o", "out.svg"]);
        assert!(run.code == 1 && run.stderr.contains(message), "{more}: {}", run.stderr);
    }
}

#[test]
fn open_surfaces_are_cut_without_a_cap_and_reported() {
    let sandbox = Sandbox::new("open_section");
    sandbox.copy_model("teapot.glb");
    let run = sandbox.run(&["render", "teapot.glb", "-o", "out.svg", "--section", "z=0"]);
    assert_eq!(run.code, 0);
    assert!(run.stderr.contains("warning: the cut through `body` is not closed"), "{}", run.stderr);
    assert!(read_drawing(&sandbox, "out.svg").1.contains_key("visible-section"));
}

/// The remaining part fills the picture, and the technical style draws no dashed lines behind the
/// cut.
#[test]
fn cut_pictures_frame_the_rest_and_dash_nothing_behind_the_cut() {
    let sandbox = Sandbox::new("cut_frame");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    let layers = |flags: &[&str]| {
        let render = ["render", "box.gltf", "-o", "out.svg", "--projection", "isometric"];
        assert_succeeds(&sandbox, &[&render[..], flags].concat());
        read_drawing(&sandbox, "out.svg").1
    };
    let height = |layers: &Layers| {
        let [low, high] = layer_bounds(layers, |_| true);
        high[1] - low[1]
    };
    let whole = layers(&["--style", "technical"]);
    assert!(whole.keys().any(|id| id.starts_with("hidden-")));
    let cut = layers(&["--style", "technical", "--section", "x=0.02"]);
    assert!(cut.keys().all(|id| !id.starts_with("hidden-")), "{:?}", cut.keys());
    // Both drawings are as high as the picture allows; framed like the whole model, the rest would
    // be smaller.
    assert!(height(&cut) > 0.95 * height(&whole), "{} {}", height(&cut), height(&whole));
    // Requested dashes are drawn.
    let dashed = layers(&["--style", "dashed", "--section", "x=0.02"]);
    assert!(dashed.keys().any(|id| id.starts_with("hidden-")));
}

/// The front view of a sheet is cut and labeled; the others show the whole model and the position
/// of the cut.
#[test]
fn sheets_show_cuts_in_the_view_that_faces_them() {
    let sandbox = Sandbox::new("cut_sheet");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    let flags = ["--section", "z=0.01", "--scale", "1:1"];
    assert_succeeds(&sandbox, &[&["sheet", "box.gltf", "-o", "out.svg"][..], &flags].concat());
    let (_, layers) = read_drawing(&sandbox, "out.svg");
    assert!(layers.contains_key("front-visible-hatching"));
    assert!(layers.contains_key("isometric-visible-hatching"));
    assert!(!layers.contains_key("top-visible-hatching"));
    // The top view shows the whole depth of 30 mm. The cut is 10 mm in front of the rear edge, and
    // its line extends beyond both sides.
    let [low, high] = layer_bounds(&layers, |id| id.starts_with("top-"));
    assert_near(high[1] - low[1], 30.0);
    let along = layers["cut-lines"].iter().find(|line| line[0][1] == line[1][1]).expect("a line");
    assert_near(along[0][1] - low[1], 10.0);
    assert_near((along[1][0] - along[0][0]).abs(), 108.0);
    // The hatch spacing follows the style at any scale: 2 mm, perpendicular to the lines.
    let mut at: Vec<f64> =
        layers["front-visible-hatching"].iter().map(|line| line[0][0] + line[0][1]).collect();
    at.sort_by(f64::total_cmp);
    let step = (at[at.len() - 1] - at[0]) / (at.len() - 1) as f64;
    assert!((step - 2.0 * std::f64::consts::SQRT_2).abs() < 0.01, "{step}");
}

#[test]
fn tones_are_under_the_lines_in_all_formats() {
    let sandbox = Sandbox::new("tones");
    sandbox.copy_model("house.glb");
    let scene = |tone: &str| {
        let style = format!("style: Lines(face_fill: {tone}), image: (size: (320, 240))");
        sandbox.write_file("scene.ron", format!("Scene(models: [(path: \"house.glb\")], {style})"));
    };
    let drawn = |name: &str| {
        assert_succeeds(&sandbox, &["render", "scene.ron", "-o", name, "--threads", "1"]);
        let first = std::fs::read(sandbox.path_of(name)).expect("a drawing");
        assert_succeeds(&sandbox, &["render", "scene.ron", "-o", name, "--threads", "3"]);
        assert!(first == std::fs::read(sandbox.path_of(name)).expect("a drawing"), "{name}");
        first
    };
    scene("Flat");
    let svg = String::from_utf8(drawn("out.svg")).expect("text");
    assert!(svg.contains("<image id=\"tone\"") && svg.contains("href=\"data:image/png;base64,"));
    assert!(svg.find("<image") < svg.find("<g "), "the picture is under the lines");
    let pdf = String::from_utf8_lossy(&drawn("out.pdf")).into_owned();
    assert!(pdf.contains("/XObject") && pdf.contains("/SMask"));
    let flat = drawn("out.png");
    scene("Hatching");
    let (_, layers) = read_svg_bytes(&drawn("out.svg"));
    assert!(layers["visible-hatching"].len() > 20);
    assert!(drawn("out.png") != flat);
}

fn read_svg_bytes(bytes: &[u8]) -> (PagePoint, Layers) {
    parse_svg(std::str::from_utf8(bytes).expect("text"))
}
