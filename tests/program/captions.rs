//! Labels at world points, captions below views, and several views at one scale: all are where the
//! formulas place them, in pictures and in drawings.

use crate::sandbox::Sandbox;
use crate::vector_files::{Layers, PagePoint, parse_svg, point_bounds};

/// Pixels per millimeter of a drawing, at 96 pixels per inch.
const PIXELS_PER_MILLIMETRE: f64 = 96.0 / 25.4;
/// The maximum error, in pixels, of an extent whose endpoints are rounded to micrometers.
const MICROMETRE: f64 = 0.001 * PIXELS_PER_MILLIMETRE;
/// The crate's extents along x, y and z, and also its scales, because it is a unit cube.
const BOX: [f64; 3] = [2.0, 1.0, 3.0];

/// Renders a scene with the crate to an SVG, and checks that there are no messages.
fn draw(sandbox: &Sandbox, fields: &str) -> Layers {
    let (stderr, layers) = draw_with_messages(sandbox, fields);
    assert_eq!(stderr, "", "{fields}");
    layers
}

fn draw_with_messages(sandbox: &Sandbox, fields: &str) -> (String, Layers) {
    write_scene(sandbox, fields);
    let run = sandbox.run(&["render", "scene.ron", "-o", "out.svg"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    (run.stderr, read_layers(sandbox, "out.svg"))
}

fn write_scene(sandbox: &Sandbox, fields: &str) {
    sandbox.copy_model("crate.glb");
    let [x, y, z] = BOX;
    let model = format!("(path: \"crate.glb\", scale: ({x}, {y}, {z}))");
    sandbox.write_file("scene.ron", format!("Scene(models: [{model}], {fields})"));
}

fn read_layers(sandbox: &Sandbox, file: &str) -> Layers {
    parse_svg(&std::fs::read_to_string(sandbox.path_of(file)).expect("an SVG")).1
}

/// Returns the minimum and maximum coordinates of the layers whose names have a prefix, in pixels.
fn bounds_in_pixels(layers: &Layers, prefix: &str) -> [PagePoint; 2] {
    let lines = layers.iter().filter(|(id, _)| id.starts_with(prefix)).flat_map(|(_, all)| all);
    point_bounds(lines.flatten()).map(|point| point.map(|c| c * PIXELS_PER_MILLIMETRE))
}

#[track_caller]
fn assert_near(actual: PagePoint, expected: PagePoint, tolerance: f64) {
    let near = actual.iter().zip(expected).all(|(a, b)| (a - b).abs() <= tolerance);
    assert!(near, "{actual:?} instead of {expected:?}");
}

/// In a picture of 800 × 600 pixels, a unit in the plane z = 0 covers 100 pixels. In perspective,
/// (1, 1, 2) is drawn 10/8 times as far out, because the eye is at z = 10.
#[test]
fn labels_are_next_to_their_projected_points() {
    let sandbox = Sandbox::new("labels");
    let parallel = ("Orthographic(height: 6)", "(1, 1, 2)", [500.0, 200.0]);
    let fov = 2.0 * libm::atan(0.3).to_degrees();
    let perspective = format!("Perspective(fov_y_degrees: {fov:?})");
    let perspective = (perspective.as_str(), "(1, 1, 2)", [525.0, 175.0]);
    for (projection, at, [x, y]) in [parallel, perspective] {
        let camera = format!(
            "camera: (view: LookAt(eye: (0, 0, 10), target: (0, 0, 0)), projection: {projection})"
        );
        let image = "image: (size: (800, 600))";
        // The corner or side of the text that is at the offset. Capitals are 20 pixels high.
        for (offset, corner) in [
            ([30.0, -10.0], [Some(0), Some(1)]),
            ([-30.0, 10.0], [Some(1), Some(0)]),
            ([0.0, 15.0], [None, Some(0)]),
            ([15.0, 0.0], [Some(0), None]),
        ] {
            let label = format!(
                "Label(at: {at}, text: \"HIH\", size: 20, leader: true, offset: ({}, {}))",
                offset[0], offset[1]
            );
            let layers = draw(&sandbox, &format!("{camera}, {image}, overlays: [{label}]"));
            let text = bounds_in_pixels(&layers, "overlay-1-label");
            let letters = layers.iter().filter(|(id, _)| *id == "overlay-1-label");
            let [low, high] = point_bounds(letters.flat_map(|(_, lines)| lines).flatten())
                .map(|point| point.map(|c| c * PIXELS_PER_MILLIMETRE));
            assert!((high[1] - low[1] - 20.0).abs() < 2.0 * MICROMETRE, "{low:?} {high:?}");
            let place = [0, 1].map(|axis| match corner[axis] {
                Some(0) => low[axis],
                Some(_) => high[axis],
                None => (low[axis] + high[axis]) * 0.5,
            });
            assert_near(place, [x + offset[0], y + offset[1]], 2.0 * MICROMETRE);
            assert!(text[0][0] <= x && text[1][0] >= x, "the leader line ends at the point");
            let dot = layers["overlay-1-label-leader"].last().expect("a dot");
            let [low, high] =
                point_bounds(dot.iter()).map(|p| p.map(|c| c * PIXELS_PER_MILLIMETRE));
            assert_near([(low[0] + high[0]) * 0.5, (low[1] + high[1]) * 0.5], [x, y], 0.01);
        }
    }
}

#[test]
fn labels_outside_the_picture_are_reported() {
    let sandbox = Sandbox::new("labels_outside");
    let labels = "Label(at: (0, 0, 20), text: \"B\"), Label(at: (50, 0, 0), text: \"far 漢\")";
    let fields = format!(
        "camera: (view: LookAt(eye: (0, 0, 10), target: (0, 0, 0))), image: (size: (80, 60)), \
         overlays: [{labels}, Label(at: (0, 0, 0), text: \"here\")]"
    );
    let wanted = [
        "the label \"B\" is not drawn: its point is behind the eye",
        "the label \"far 漢\" is not drawn: its point is outside the picture",
        "the drawing font lacks 漢 in \"far 漢\"",
    ];
    let (stderr, layers) = draw_with_messages(&sandbox, &fields);
    let png = sandbox.run(&["render", "scene.ron", "-o", "out.png"]);
    let check = sandbox.run(&["scene", "check", "scene.ron"]);
    assert_eq!((png.code, check.code), (0, 0));
    for message in wanted {
        for text in [&stderr, &png.stderr, &format!("{}{}", check.stdout, check.stderr)] {
            assert!(text.contains(message), "{message}: {text}");
        }
    }
    let labels = layers.keys().filter(|id| id.ends_with("label"));
    assert_eq!(labels.collect::<Vec<_>>(), ["overlay-3-label"]);
}

/// The caption strip is 28 pixels high, and the picture above it has the remaining height.
#[test]
fn a_caption_is_below_the_picture() {
    let sandbox = Sandbox::new("caption");
    let look = "style: Clay, camera: (projection: Multiview(Front))";
    let picture = |name: &str, size: (u32, u32), caption: &str| {
        let image = format!("image: (size: {size:?}, background: Color(\"#1234aa\"))");
        write_scene(&sandbox, &format!("{look}, {image}, {caption}"));
        let run = sandbox.run(&["render", "scene.ron", "-o", name]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        sandbox.read_picture(name).2
    };
    let with = picture("with.png", (128, 156), "caption: \"Front\"");
    let without = picture("without.png", (128, 128), "");
    assert_eq!(with[..128 * 128], without[..]);
    let strip = &with[128 * 128..];
    let written: Vec<usize> =
        (0..strip.len()).filter(|at| strip[*at] != [0x12, 0x34, 0xaa, 255]).collect();
    assert!(!written.is_empty());
    // The letters are 12 pixels high, centered in the strip, and light on the dark background.
    assert!(written.iter().all(|at| (7..=21).contains(&(at / 128))));
    let columns = written.iter().map(|at| at % 128);
    let (least, most) = (columns.clone().min(), columns.max());
    let middle = (least.expect("a column") + most.expect("a column") + 1) as f64 / 2.0;
    assert!((middle - 64.0).abs() <= 1.0, "{middle}");
    assert!(written.iter().any(|at| strip[*at][0] > 200));
    // A crop includes the part of the caption inside it.
    picture("with.png", (128, 156), "caption: \"Front\"");
    let run = sandbox.run(&["render", "scene.ron", "-o", "part.png", "--crop", "20,120,90,30"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let part = sandbox.read_picture("part.png").2;
    for (y, row) in part.chunks_exact(90).enumerate() {
        let from = (120 + y) * 128 + 20;
        assert_eq!(row, &with[from..from + 90], "{y}");
    }
    // In a drawing, the caption is a layer, and its strip contains nothing else.
    let floor =
        "overlays: [Axes(length: 90)], camera: (view: LookAt(eye: (5, 4, 7), target: (0, 0, 0)))";
    let image = "image: (size: (400, 300)), style: Lines(), caption: \"HIM\"";
    let layers = draw(&sandbox, &format!("{floor}, {image}"));
    let [low, high] = bounds_in_pixels(&layers, "caption");
    assert_near([low[1], high[1]], [280.0, 292.0], 2.0 * MICROMETRE);
    assert!((low[0] + high[0] - 400.0).abs() < 2.0 * MICROMETRE);
    for (id, lines) in layers.iter().filter(|(id, _)| *id != "caption") {
        let [_, low] = point_bounds(lines.iter().flatten());
        assert!(low[1] * PIXELS_PER_MILLIMETRE <= 272.0 + MICROMETRE, "{id}");
    }
}

/// MV-1, AX-1: extents on the page of an SVG are the box's extents times the scale.
#[test]
fn c75_several_views_of_a_drawing_have_one_scale() {
    let sandbox = Sandbox::new("one_scale");
    let views =
        ["Front", "Left", "Top", "Isometric"].iter().zip(["0, 0", "0.5, 0", "0, 0.5", "0.5, 0.5"]);
    let views = views.map(|(from, at)| {
        format!(
            "(at: ({at}, 0.5, 0.5), caption: \"{from}\", camera: (view: Frame(from: {from}), \
             projection: Orthographic()))"
        )
    });
    let views = views.collect::<Vec<_>>().join(", ");
    let fields = format!(
        "image: (size: (800, 600)), style: Lines(), viewports_scale: Shared, viewports: [{views}]"
    );
    let layers = draw(&sandbox, &fields);
    let [x, y, z] = BOX;
    let isometric = [(x + z) * libm::sqrt(0.5), (x + z + 2.0 * y) * libm::sqrt(1.0 / 6.0)];
    let expected = [[x, y], [z, y], [x, z], isometric];
    let sizes = [1, 2, 3, 4].map(|number| {
        let [low, high] = bounds_in_pixels(&layers, &format!("view-{number}-visible"));
        [high[0] - low[0], high[1] - low[1]]
    });
    let scale = sizes[0][0] / x;
    for (size, expected) in sizes.into_iter().zip(expected) {
        assert_near(size, expected.map(|extent| extent * scale), 3.0 * MICROMETRE);
    }
    // The lower right view is in its quarter, with the caption below it.
    let [low, high] = bounds_in_pixels(&layers, "view-4-visible");
    let [caption, _] = bounds_in_pixels(&layers, "view-4-caption");
    assert!(low[0] > 400.0 && low[1] > 300.0 && high[0] < 800.0 && high[1] < caption[1]);
}

#[test]
fn command_line_views_share_a_scale() {
    let sandbox = Sandbox::new("same_scale");
    write_scene(&sandbox, "image: (size: (300, 200)), style: Lines()");
    let views = ["--views", "front,right,top", "-o", "{view}.svg", "--same-scale"];
    let run = sandbox
        .run(&[&["render", "scene.ron", "--projection", "orthographic"], &views[..]].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let [x, y, z] = BOX;
    let expected = [("front", [x, y]), ("right", [z, y]), ("top", [x, z])];
    let sizes = expected.map(|(view, _)| {
        let [low, high] =
            bounds_in_pixels(&read_layers(&sandbox, &format!("{view}.svg")), "visible");
        [high[0] - low[0], high[1] - low[1]]
    });
    // The top view, 3 units high, determines the scale: with 5 % padding, it is 180 pixels high.
    for (size, (_, extents)) in sizes.into_iter().zip(expected) {
        assert_near(size, extents.map(|extent| extent * 60.0), 2.0 * MICROMETRE);
    }
    let run = sandbox.run(&[&["render", "scene.ron"], &views[..]].concat());
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("--same-scale needs a parallel projection"), "{}", run.stderr);
}

#[test]
fn mistakes_in_labels_and_captions_are_explained_and_fmt_preserves_both() {
    let sandbox = Sandbox::new("caption_mistakes");
    let cases = [
        ("caption: 5", "expected a string"),
        ("caption: \"\"", "the caption has no text"),
        ("overlays: [Label(at: (0, 0), text: \"a\")]", "three"),
        ("overlays: [Label(at: (0, 0, 0))]", "text"),
        (
            "overlays: [Label(at: (0, 0, 0), text: \"a\", size: 0)]",
            "a height from 1 to 1000 pixels",
        ),
        ("overlays: [Text(at: (0, 0, 0), text: \"a\")]", "`Label`"),
        ("viewports_scale: Same", "Shared"),
        ("viewports_scale: Shared", "two parallel views"),
        ("viewports: [(at: (0, 0, 1, 1), title: \"Front\")]", "`caption`"),
        ("title: \"Front\"", "`caption`"),
    ];
    for (fields, message) in cases {
        write_scene(&sandbox, fields);
        let run = sandbox.run(&["scene", "check", "scene.ron"]);
        assert_eq!(run.code, 1, "{fields}: {}", run.stdout);
        let all = format!("{}{}", run.stdout, run.stderr);
        assert!(all.contains(message), "{fields}: {all}");
    }
    let scene = "Scene(\n    models: [Model(path: \"crate.glb\")],\n    viewports: [Viewport(at: (0, 0, 1, 0.5), \
         caption: \"A\"), Viewport(at: (0, 0.5, 1, 0.5))],\n    viewports_scale: Individual,\n    \
         overlays: [Label(at: (0, 1, 0), text: \"top\", offset: (4, -4), color: \"#c00\", size: 9, leader: true)],\n    \
         caption: \"Two\",\n)\n";
    sandbox.write_file("kept.ron", scene);
    let run = sandbox.run(&["scene", "fmt", "kept.ron"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let kept = std::fs::read_to_string(sandbox.path_of("kept.ron")).expect("a scene");
    let words =
        |text: &str| text.chars().filter(|c| !c.is_whitespace() && *c != ',').collect::<String>();
    assert_eq!(words(&kept), words(scene));
    let run = sandbox.run(&["scene", "doc"]);
    for word in ["viewports_scale", "caption", "Label", "leader"] {
        assert!(run.stdout.contains(word), "{word}");
    }
}
