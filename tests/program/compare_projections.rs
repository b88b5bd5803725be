//! `alberti compare-projections`: all projections on one page.

use crate::drawings::{PROJECTIONS, assert_succeeds, read_drawing, write_box};
use crate::sandbox::Sandbox;
use crate::vector_files::{Layers, layer_bounds, parse_pdf};

const COMMAND: &str = "compare-projections";

/// Returns the width and height of the lines in a projection's panel.
fn layer_size(layers: &Layers, name: &str) -> [f64; 2] {
    let [low, high] = layer_bounds(layers, |id| id.starts_with(&format!("{name}-visible-")));
    [high[0] - low[0], high[1] - low[1]]
}

#[test]
fn a_subject_is_drawn_in_every_projection() {
    let sandbox = Sandbox::new("compare_all");
    sandbox.copy_model("house.glb");
    assert_succeeds(&sandbox, &[COMMAND, "house.glb"]);
    let (page, layers) = read_drawing(&sandbox, "projections.svg");
    for name in PROJECTIONS {
        let [low, high] = layer_bounds(&layers, |id| id.starts_with(&format!("{name}-visible-")));
        assert!(low[0] > 0.0 && low[1] > 0.0 && high[0] < page[0] && high[1] < page[1], "{name}");
        // The drawing is framed: it fills most of its 84.7 × 63.5 mm panel without exceeding it.
        let [w, h] = layer_size(&layers, name);
        assert!(w < 84.7 && h < 63.5 && (w > 70.0 || h > 52.0), "{name}: {w} x {h}");
    }
    let text = std::fs::read_to_string(sandbox.path_of("projections.svg")).expect("an SVG");
    assert!(text.contains("<g id=\"names.two-point\">\n<title>two point</title>"));
}

/// A box of 4 × 3 × 2, whose pictures have the sizes from the textbooks.
#[test]
fn oblique_boxes_have_textbook_sizes() {
    let sandbox = Sandbox::new("compare_box");
    write_box(&sandbox, "box", [4.0, 3.0, 2.0]);
    let flags = ["--projections", "multiview,cavalier,cabinet,isometric", "--columns", "2"];
    assert_succeeds(&sandbox, &[&[COMMAND, "box.gltf", "-o", "out.svg"][..], &flags].concat());
    let (_, layers) = read_drawing(&sandbox, "out.svg");
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let slant = 3_f64.sqrt() / 2.0 * (2_f64 / 3.0).sqrt();
    for (name, width, height) in [
        ("multiview", 4.0, 3.0),
        ("cavalier", 4.0 + 2.0 * half, 3.0 + 2.0 * half),
        ("cabinet", 4.0 + half, 3.0 + half),
        // Both horizontal axes are at 30°, the third axis is vertical, and all three are
        // foreshortened by √(2/3).
        ("isometric", 6.0 * slant, (3.0 + 0.5 * 6.0) * (2_f64 / 3.0).sqrt()),
    ] {
        let [w, h] = layer_size(&layers, name);
        assert!((w / h - width / height).abs() < 1e-3, "{name}: {w} x {h}");
    }
    assert!(!layers.keys().any(|id| id.starts_with("military")));
}

#[test]
fn every_format_shows_the_same_content() {
    let sandbox = Sandbox::new("compare_formats");
    write_box(&sandbox, "box", [4.0, 3.0, 2.0]);
    let flags = ["--projections", "cavalier,two-point,cavalier", "--size", "200x150"];
    for name in ["out.svg", "out.pdf", "out.png", "out.html"] {
        assert_succeeds(&sandbox, &[&[COMMAND, "box.gltf", "-o", name][..], &flags].concat());
    }
    let (page, layers) = read_drawing(&sandbox, "out.svg");
    let pages = parse_pdf(&std::fs::read(sandbox.path_of("out.pdf")).expect("a PDF"));
    let [(size, lines)] = &pages[..] else { panic!("one page") };
    assert!((size[0] - page[0]).abs() < 0.001 && (size[1] - page[1]).abs() < 0.001);
    assert_eq!(lines.len(), layers.values().map(Vec::len).sum::<usize>());
    let (width, height, _) = sandbox.read_picture("out.png");
    let dots = [page[0], page[1]].map(|side| side / 25.4 * 150.0);
    assert!(
        (f64::from(width) - dots[0]).abs() <= 1.0 && (f64::from(height) - dots[1]).abs() <= 1.0
    );
    let html = std::fs::read_to_string(sandbox.path_of("out.html")).expect("a page");
    assert_eq!(html.matches("<figure").count(), 2, "each projection appears once");
    assert!(html.contains("formulas OB-1, VV-1") && html.contains("z 1 at 225°"), "{html}");
    assert!(html.contains("formulas VN-1, PE-1, PE-3, VV-2") && html.contains("x to (-3.2, 0.4)"));
    assert!(html.contains("OB-1: x' = x + z L1 cos phi, y' = y + z L1 sin phi"), "{html}");
    assert!(
        html.contains("VN-1: v = M (d, 0)") && html.contains("vanishing points in half heights")
    );
    assert!(!html.contains("href") && !html.contains("src="), "the page needs no other file");
}

#[test]
fn output_does_not_depend_on_threads_or_repetition() {
    let sandbox = Sandbox::new("compare_threads");
    sandbox.copy_model("teapot.glb");
    for flags in [
        &["-o", "out.svg"][..],
        &["-o", "out.svg", "--style", "shaded", "--projections", "cabinet"],
    ] {
        let bytes = |threads: &str| {
            assert_succeeds(
                &sandbox,
                &[&[COMMAND, "teapot.glb", "--threads", threads], flags].concat(),
            );
            std::fs::read(sandbox.path_of("out.svg")).expect("a drawing")
        };
        let first = bytes("1");
        assert!(first == bytes("1") && first == bytes("3"), "{flags:?}");
    }
}

#[test]
fn errors_are_reported_and_leave_no_file() {
    let sandbox = Sandbox::new("compare_mistakes");
    write_box(&sandbox, "box", [1.0, 1.0, 1.0]);
    let run = sandbox.run(&[COMMAND, "box.gltf", "--projections", "isometrik"]);
    assert!(run.code == 2 && run.stderr.contains("isometric"), "{}", run.stderr);
    let run = sandbox.run(&[COMMAND, "box.gltf", "-o", "out.txt"]);
    let expected =
        "out.txt: unsupported output format; use .svg, .pdf, .dxf, .png, .jpg, .webp or .html";
    assert!(run.code == 1 && run.stderr.contains(expected), "{}", run.stderr);
    let run = sandbox.run(&[COMMAND, "none.gltf"]);
    assert!(run.code == 1 && run.stderr.contains("none.gltf"), "{}", run.stderr);
    for wrong in [["--columns", "0"], ["--size", "10"], ["--style", "oil"], ["--threads", "0"]] {
        let run = sandbox.run(&[&[COMMAND, "box.gltf"][..], &wrong].concat());
        assert!(run.code == 2 && run.stderr.contains(wrong[0]), "{wrong:?}: {}", run.stderr);
    }
    assert_eq!(sandbox.file_names(), ["box.bin", "box.gltf"]);
}
