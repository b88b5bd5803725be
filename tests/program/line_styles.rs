//! Paper and presets of line drawings.

use crate::drawings::{assert_succeeds, read_drawing};
use crate::sandbox::Sandbox;

/// Returns the upper left pixel of a drawing of the house.
fn corner_pixel(sandbox: &Sandbox, arguments: &[&str]) -> [u8; 4] {
    let run = ["render", "house.glb", "--size", "64x48", "-o", "corner.png"];
    assert_succeeds(sandbox, &[&run[..], arguments].concat());
    sandbox.read_picture("corner.png").2[0]
}

#[test]
fn line_pictures_have_white_paper_unless_a_background_is_set() {
    let sandbox = Sandbox::new("paper");
    sandbox.copy_model("house.glb");
    let corner = |arguments: &[&str]| corner_pixel(&sandbox, arguments);
    for style in ["lines", "dashed", "technical", "outline", "wireframe", "patent", "sketch"] {
        assert_eq!(corner(&["--style", style]), [255; 4], "{style}");
    }
    assert_eq!(corner(&["--style", "blueprint"]), [29, 66, 121, 255]);
    assert_eq!(corner(&["--style", "lines", "--background", "transparent"]), [0; 4]);
    assert_eq!(corner(&["--style", "blueprint", "--background", "#102030"]), [16, 32, 48, 255]);
    assert_eq!(
        corner(&["--style", "shaded"])[3],
        0,
        "shaded pictures have a transparent background"
    );
}

#[test]
fn vector_files_omit_blank_paper() {
    let sandbox = Sandbox::new("vector_paper");
    sandbox.copy_model("house.glb");
    for (style, has_paper) in [("lines", false), ("blueprint", true)] {
        assert_succeeds(&sandbox, &["render", "house.glb", "--style", style, "-o", "x.svg"]);
        let svg = std::fs::read_to_string(sandbox.path_of("x.svg")).expect("an SVG");
        assert_eq!(svg.contains("<rect"), has_paper, "{style}");
    }
    sandbox.write_file(
        "blue.ron",
        r##"Scene(models: [Model(path: "house.glb")],
            style: Lines(color: "#ffffff", paper: "#1d4279"),
            sheet: Sheet(paper: A4))"##,
    );
    let run = sandbox.run(&["sheet", "blue.ron", "-o", "blue.png"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert_eq!(sandbox.read_picture("blue.png").2[0], [29, 66, 121, 255]);
}

#[test]
fn a_sketch_has_the_layers_of_the_exact_drawing_and_each_line_twice() {
    let sandbox = Sandbox::new("sketch");
    sandbox.copy_model("house.glb");
    let draw = |style: &str| {
        let name = format!("{style}.svg");
        assert_succeeds(&sandbox, &["render", "house.glb", "--style", style, "-o", &name]);
        read_drawing(&sandbox, &name).1
    };
    let (exact, sketch) = (draw("lines"), draw("sketch"));
    assert!(exact.keys().eq(sketch.keys()), "{:?}", sketch.keys());
    for (id, lines) in &exact {
        assert_eq!(sketch[id].len(), 2 * lines.len(), "{id}");
    }
    let again = std::fs::read(sandbox.path_of("sketch.svg")).expect("an SVG");
    draw("sketch");
    assert_eq!(again, std::fs::read(sandbox.path_of("sketch.svg")).expect("an SVG"));
}
