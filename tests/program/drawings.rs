//! Line drawings and sheets, measured in the SVG and PDF files that the program writes.

use crate::gltf_builder::GltfBuilder;
use crate::sandbox::Sandbox;
use crate::vector_files::{Layers, PagePoint, layer_bounds, parse_pdf, parse_svg};

/// The projections by name, in textbook order.
pub(crate) const PROJECTIONS: [&str; 12] = [
    "perspective",
    "orthographic",
    "multiview",
    "isometric",
    "dimetric",
    "trimetric",
    "cavalier",
    "cabinet",
    "military",
    "one-point",
    "two-point",
    "three-point",
];

/// Writes a solid box with these sides in meters, with one corner at the origin and a groove that
/// makes front and back differ.
pub(crate) fn write_box(sandbox: &Sandbox, name: &str, [w, h, d]: [f32; 3]) {
    let mut document = GltfBuilder::square();
    let corner = |n: usize| {
        [(n & 1, w), (n >> 1 & 1, h), (n >> 2 & 1, d)]
            .map(|(bit, side)| if bit == 1 { side } else { 0.0 })
    };
    let points: Vec<f32> = (0..8).flat_map(corner).collect();
    let position = document.add_floats("VEC3", &points);
    let indices: [u16; 36] = [
        0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5, 0, 1, 4, 1, 5, 4,
        2, 6, 3, 3, 6, 7,
    ];
    let bytes: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
    let shape = serde_json::json!({"componentType": 5123, "type": "SCALAR", "count": 36});
    let indices = document.add_accessor(&bytes, &shape);
    document.json["meshes"][0]["primitives"][0] = serde_json::json!({
        "attributes": {"POSITION": position}, "indices": indices, "mode": 4
    });
    document.write_file(sandbox, name);
}

pub(crate) fn read_drawing(sandbox: &Sandbox, name: &str) -> (PagePoint, Layers) {
    parse_svg(&std::fs::read_to_string(sandbox.path_of(name)).expect("an SVG"))
}

pub(crate) fn assert_succeeds(sandbox: &Sandbox, arguments: &[&str]) {
    let run = sandbox.run(arguments);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{arguments:?}");
}

/// Returns the size of a view's contents.
fn view_size(layers: &Layers, view: &str) -> PagePoint {
    let [low, high] = layer_bounds(layers, |id| id.starts_with(view));
    [high[0] - low[0], high[1] - low[1]]
}

#[track_caller]
pub(crate) fn assert_near(actual: f64, expected: f64) {
    assert!((actual - expected).abs() < 0.0005, "{actual} mm instead of {expected} mm");
}

#[test]
fn lengths_are_exact_at_scale_one_to_one() {
    let sandbox = Sandbox::new("hundred");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    let flags = ["--scale", "1:1", "--no-dimensions", "--axonometric", "none"];
    for name in ["box.svg", "box.pdf"] {
        assert_succeeds(&sandbox, &[&["sheet", "box.gltf", "-o", name][..], &flags].concat());
    }
    let (page, layers) = read_drawing(&sandbox, "box.svg");
    assert_eq!(page, [420.0, 297.0]);
    for (view, width, height) in
        [("front-", 100.0, 50.0), ("top-", 100.0, 30.0), ("left-", 30.0, 50.0)]
    {
        let [w, h] = view_size(&layers, view);
        assert_near(w, width);
        assert_near(h, height);
    }
    // The PDF has the same lines at the same positions, to the precision of its matrix.
    let pages = parse_pdf(&std::fs::read(sandbox.path_of("box.pdf")).expect("a PDF"));
    let [(page, lines)] = &pages[..] else { panic!("one page") };
    assert_near(page[0], 420.0);
    assert_near(page[1], 297.0);
    let all: Vec<_> = layers.values().flatten().collect();
    assert_eq!(lines.len(), all.len());
    let side = |lines: &mut dyn Iterator<Item = &Vec<PagePoint>>, wanted: f64| {
        let level = |pair: &[PagePoint]| (pair[0][1] - pair[1][1]).abs() < 1e-3;
        let length = |pair: &[PagePoint]| (pair[0][0] - pair[1][0]).abs();
        let sides = lines.flat_map(|line| line.windows(2));
        sides.filter(|pair| level(pair) && (length(pair) - wanted).abs() < 0.0005).count()
    };
    // Two edges of the front view and two edges of the top view are 100 mm long.
    assert_eq!(side(&mut all.into_iter(), 100.0), 4);
    assert_eq!(side(&mut lines.iter(), 100.0), 4);
}

#[test]
fn scale_and_unit_determine_the_drawn_size() {
    let sandbox = Sandbox::new("scales");
    write_box(&sandbox, "box", [1.0, 0.5, 0.25]);
    for (flags, width) in [
        (["--scale", "1:10", "--unit", "m"], 100.0),
        (["--scale", "2:1", "--unit", "mm"], 2.0),
        (["--scale", "1:1", "--unit", "in"], 25.4),
        (["--scale", "1:3", "--unit", "ft"], 101.6),
        (["--scale", "1:1", "--unit", "cm"], 10.0),
    ] {
        assert_succeeds(&sandbox, &[&["sheet", "box.gltf", "-o", "out.svg"][..], &flags].concat());
        assert_near(view_size(&read_drawing(&sandbox, "out.svg").1, "front-")[0], width);
    }
}

#[test]
fn views_are_aligned_and_arranged_by_projection_angle() {
    let sandbox = Sandbox::new("aligned");
    sandbox.copy_model("house.glb");
    for (angle, side, top_is_below) in [("first", "left-", true), ("third", "right-", false)] {
        for paper in ["a0", "a1", "a2", "a3", "a4", "a5", "letter", "tabloid"] {
            let flags = ["-o", "out.svg", "--projection-angle", angle, "--paper", paper];
            assert_succeeds(&sandbox, &[&["sheet", "house.glb"][..], &flags].concat());
            let (page, layers) = read_drawing(&sandbox, "out.svg");
            let of = |view: &str| layer_bounds(&layers, |id| id.starts_with(view));
            let (front, top, side) = (of("front-"), of("top-"), of(side));
            for end in 0..2 {
                assert_near(front[end][0], top[end][0]);
                assert_near(front[end][1], side[end][1]);
            }
            assert_eq!(top[0][1] > front[1][1], top_is_below, "{angle} {paper}");
            assert!(side[0][0] > front[1][0], "{angle} {paper}");
            // The depth is as large horizontally in the side view as it is vertically in the top
            // view.
            assert_near(side[1][0] - side[0][0], top[1][1] - top[0][1]);
            let all = layer_bounds(&layers, |_| true);
            assert!(all[0].iter().all(|c| *c > 0.0) && all[1][0] < page[0] && all[1][1] < page[1]);
            let block = layer_bounds(&layers, |id| id == "title-block");
            for view in
                ["front-", "top-", "left-", "right-", "isometric-", "scale-bar", "dimensions"]
            {
                let [low, high] = of(view);
                let apart = high[0] < block[0][0] || high[1] < block[0][1];
                assert!(apart || low[0] > high[0], "{view} is in the title block: {angle} {paper}");
            }
        }
    }
}

#[test]
fn dimensions_show_the_true_size() {
    let sandbox = Sandbox::new("dimensions");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    assert_succeeds(&sandbox, &["sheet", "box.gltf", "-o", "with.svg", "--scale", "1:1"]);
    let (_, layers) = read_drawing(&sandbox, "with.svg");
    let front = layer_bounds(&layers, |id| id.starts_with("front-"));
    let lines = &layers["dimensions"];
    let level = |line: &&Vec<PagePoint>| line.len() == 2 && line[0][1] == line[1][1];
    // The dimension line for the width is above the front view and has the same length.
    let widths = lines.iter().filter(level).filter(|line| {
        (line[0][0] - front[0][0]).abs() < 5e-4 && (line[1][0] - front[1][0]).abs() < 5e-4
    });
    assert!(
        widths.clone().count() == 1 && widths.clone().all(|line| line[0][1] < front[0][1] - 5.0)
    );
    assert_succeeds(
        &sandbox,
        &["sheet", "box.gltf", "-o", "without.svg", "--scale", "1:1", "--no-dimensions"],
    );
    assert!(!read_drawing(&sandbox, "without.svg").1.contains_key("dimensions"));
}

#[test]
fn drawings_do_not_depend_on_threads_or_repetition() {
    let sandbox = Sandbox::new("same_drawing");
    sandbox.copy_model("teapot.glb");
    for (command, name) in
        [("render", "out.svg"), ("render", "out.pdf"), ("sheet", "out.pdf"), ("sheet", "out.svg")]
    {
        let bytes = |threads: &str| {
            assert_succeeds(&sandbox, &[command, "teapot.glb", "-o", name, "--threads", threads]);
            std::fs::read(sandbox.path_of(name)).expect("a drawing")
        };
        let first = bytes("1");
        assert!(
            first == bytes("1") && first == bytes("2") && first == bytes("5"),
            "{command} {name}"
        );
    }
}

#[test]
fn each_style_draws_its_kinds_of_lines_in_every_projection() {
    let sandbox = Sandbox::new("styles");
    sandbox.copy_model("house.glb");
    let count = |style: &str, projection: &str| {
        let flags = ["-o", "out.svg", "--style", style, "--projection", projection];
        let run = sandbox.run(&[&["render", "house.glb"][..], &flags].concat());
        // An SVG shows only the lines of surfaces, as a message explains.
        let is_surface = matches!(style, "shaded" | "flat");
        assert_eq!(run.code, 0, "{flags:?}: {}", run.stderr);
        assert_eq!(
            run.stderr.contains("SVG output is always a line drawing"),
            is_surface,
            "{flags:?}"
        );
        assert!(is_surface || run.stderr.is_empty(), "{flags:?}: {}", run.stderr);
        let (page, layers) = read_drawing(&sandbox, "out.svg");
        let [low, high] = layer_bounds(&layers, |_| true);
        assert!(
            low.iter().all(|c| *c > 0.0) && high[0] < page[0] && high[1] < page[1],
            "{flags:?}"
        );
        layers
    };
    for projection in PROJECTIONS {
        let of = |style: &str| {
            let layers = count(style, projection);
            let hidden = layers.keys().filter(|id| id.starts_with("hidden-")).count();
            (layers.values().map(Vec::len).sum::<usize>(), hidden)
        };
        let (lines, dashed, silhouette) = (of("lines"), of("dashed"), of("silhouette"));
        assert!(lines.1 == 0 && silhouette.1 == 0 && dashed.1 > 0, "{projection}");
        assert!(silhouette.0 > 0 && silhouette.0 < lines.0 && lines.0 < dashed.0, "{projection}");
        assert!(of("wireframe").0 > lines.0 && of("depth-cued").0 > lines.0, "{projection}");
        assert!(
            of("technical").1 > 0 && of("shaded") == lines && of("flat") == lines,
            "{projection}"
        );
    }
}

#[test]
fn drawing_errors_are_reported_and_leave_no_file() {
    let sandbox = Sandbox::new("no_drawing");
    write_box(&sandbox, "box", [1.0, 1.0, 1.0]);
    let failing = [
        (
            &["render", "box.gltf", "-o", "out.xyz"][..],
            "unsupported output format; use .png, .jpg, .webp, .svg, .pdf or .dxf",
        ),
        (
            &["sheet", "box.gltf", "-o", "out"],
            "unsupported output format; use .png, .jpg, .webp, .svg, .pdf or .dxf",
        ),
        (&["sheet", "box.gltf", "--scale", "1:1", "--paper", "a4", "-o", "out.pdf"], "; 1:20 fits"),
    ];
    for (arguments, message) in failing {
        let run = sandbox.run(arguments);
        assert!(run.code == 1 && run.stderr.contains(message), "{arguments:?}: {}", run.stderr);
    }
    for scale in ["0:1", "1:0", "1", "1:2:3", "a:b", "-1:2"] {
        let run = sandbox.run(&["sheet", "box.gltf", "-o", "out.pdf", &format!("--scale={scale}")]);
        assert_eq!(run.code, 2, "{scale}: {}", run.stderr);
    }
    let scene = |name: &str, more: &str| {
        sandbox.write_file(name, format!("Scene(models: [(path: \"box.gltf\")],\n{more})"));
        sandbox.run(&["check", name])
    };
    for (more, message) in [
        ("style: Lines(width: Iso(0.4))", "ISO 128 has no line group of width 0.4"),
        ("style: Lines(color: \"bleu\")", "`bleu` is not a color"),
        ("sheet: (scale: (1, 0))", "scale of the object"),
        ("camera: (projection: NPoint())", "p, q and r are all 0"),
        ("camera: (projection: NPoint(r: -3))", "behind the eye"),
        ("camera: (projection: Axonometric(x: 1, y: 1, z: 9))", "no axonometric projection"),
        (
            "camera: (view: LookAt(eye: (9, 9, 9), target: (0, 0, 0)), projection: OnePoint())",
            "determines its own eye",
        ),
    ] {
        let run = scene("wrong.ron", more);
        assert!(run.code == 1 && run.stdout.contains(message), "{more}: {}", run.stdout);
    }
    assert_eq!(sandbox.file_names(), ["box.bin", "box.gltf", "wrong.ron"]);
}

#[test]
fn flags_override_the_sheet_of_the_scene() {
    let sandbox = Sandbox::new("described");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    sandbox.write_file(
        "scene.ron",
        "Scene(models: [(path: \"box.gltf\")], sheet: (paper: A4, orientation: Landscape, projection_angle: Third,
         scale: (1, 2), title: \"A <box> & more\", author: \"Zoë\"))",
    );
    assert_succeeds(&sandbox, &["sheet", "scene.ron", "-o", "out.svg"]);
    let (page, layers) = read_drawing(&sandbox, "out.svg");
    assert_eq!(page, [297.0, 210.0]);
    assert_near(view_size(&layers, "front-")[0], 50.0);
    assert!(layers.keys().any(|id| id.starts_with("right-")));
    let text = std::fs::read_to_string(sandbox.path_of("out.svg")).expect("an SVG");
    assert!(text.contains("<title>A &lt;box&gt; &amp; more</title>"));
    assert_succeeds(
        &sandbox,
        &["sheet", "scene.ron", "-o", "out.svg", "--paper", "a3", "--scale", "1:1"],
    );
    let (page, layers) = read_drawing(&sandbox, "out.svg");
    assert_eq!(page, [420.0, 297.0]);
    assert_near(view_size(&layers, "front-")[0], 100.0);
    // Without an output name, the sheet becomes a PDF in the current folder.
    assert_succeeds(&sandbox, &["sheet", "scene.ron"]);
    assert_eq!(sandbox.file_names(), ["box.bin", "box.gltf", "out.svg", "scene.pdf", "scene.ron"]);
}

#[test]
fn sheets_use_the_line_style_of_the_scene() {
    let sandbox = Sandbox::new("sheet_style");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    let sheet = |fields: &str, flags: &[&str]| {
        let scene = format!("Scene(models: [(path: \"box.gltf\")], {fields})");
        sandbox.write_file("scene.ron", scene);
        let run = sandbox.run(&[&["sheet", "scene.ron", "-o", "out.svg"][..], flags].concat());
        assert_eq!(run.code, 0, "{}", run.stderr);
        (run.stderr, std::fs::read_to_string(sandbox.path_of("out.svg")).expect("an SVG"))
    };
    let (messages, plain) = sheet("", &[]);
    assert!(messages.is_empty() && !plain.contains("<image"), "{messages}");
    let style =
        "style: Lines(face_fill: Flat, hidden: Dashed, color: \"#e01020\", width: Mm(1.25))";
    let (messages, styled) = sheet(style, &[]);
    assert!(messages.is_empty(), "{messages}");
    for part in ["<image id=\"front-tone\"", "#e01020", "stroke-width=\"1.25\""] {
        assert!(styled.contains(part) && !plain.contains(part), "{part}");
    }
    // Edges of 90° are creases only for crease angles below 90°.
    let (_, creases) = sheet("style: Lines()", &["--crease", "89"]);
    let (_, smooth) = sheet("style: Lines()", &["--crease", "91"]);
    assert!(creases.contains("isometric-visible-crease"));
    assert!(!smooth.contains("isometric-visible-crease"));
    let (messages, _) = sheet("style: Toon", &[]);
    assert!(messages.contains("ignore the style of the scene"), "{messages}");
    let (messages, _) = sheet("sheet: (title: \"轴承\")", &[]);
    assert!(messages.contains("轴承"), "{messages}");
}

#[test]
fn creases_follow_the_crease_flag() {
    let sandbox = Sandbox::new("crease_flag");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    let has_creases = |angle: &str, style: &[&str]| {
        let render = ["render", "box.gltf", "-o", "out.svg", "--view", "isometric"];
        assert_succeeds(&sandbox, &[&render[..], &["--crease", angle], style].concat());
        read_drawing(&sandbox, "out.svg").1.contains_key("visible-crease")
    };
    // This also applies without a style, because a vector file shows lines.
    for style in [&["--style", "lines"][..], &["--style", "technical"], &[]] {
        assert!(has_creases("89", style) && !has_creases("91", style), "{style:?}");
    }
}

#[test]
fn verification_finds_no_errors_in_the_drawing_of_a_box() {
    let sandbox = Sandbox::new("verified");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    let run = sandbox.run(&["render", "box.gltf", "-o", "box.svg", "--verify"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    // Nine edges of a box are visible, and no pixel is ambiguous.
    let prefix = "verified: 0.0000% of ";
    assert!(run.stderr.starts_with(prefix), "{}", run.stderr);
    let length = run.stderr[prefix.len()..].split(' ').next().and_then(|px| px.parse::<f64>().ok());
    assert!(length.is_some_and(|px| px > 1000.0), "{}", run.stderr);
}
