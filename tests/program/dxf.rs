//! DXF and outlines: units, coordinates and layers in the written files; `tests/dxf` reads whole
//! files.

use crate::drawings::{assert_near, assert_succeeds, write_box};
use crate::sandbox::Sandbox;

/// Returns the tags in a file.
fn read_tags(sandbox: &Sandbox, name: &str) -> Vec<(u16, String)> {
    let text = std::fs::read_to_string(sandbox.path_of(name)).expect("a DXF");
    let lines: Vec<&str> = text.lines().collect();
    let pair = |pair: &[&str]| (pair[0].parse().expect("a group code"), pair[1].to_owned());
    lines.chunks(2).map(pair).collect()
}

/// Returns the values of a code in the entities of a kind.
fn numbers(tags: &[(u16, String)], kind: &str, code: u16) -> Vec<f64> {
    let mut is_inside = false;
    let mut found = Vec::new();
    for (other, value) in tags {
        is_inside = if *other == 0 { value == kind } else { is_inside };
        if is_inside && *other == code {
            found.push(value.parse().expect("a number"));
        }
    }
    found
}

/// Returns whether there is an entity of a kind on a layer whose name has this prefix.
fn has_entity(tags: &[(u16, String)], kind: &str, layer: &str) -> bool {
    let is_such = |entity: &[(u16, String)]| {
        entity[0].1 == kind
            && entity.iter().any(|(code, name)| *code == 8 && name.starts_with(layer))
    };
    tags.chunk_by(|_, (code, _)| *code != 0).any(is_such)
}

/// Returns the text entities on a layer, sorted.
fn texts_on<'a>(tags: &'a [(u16, String)], layer: &str) -> Vec<&'a str> {
    let is_here = |entity: &&[(u16, String)]| {
        entity[0].1 == "TEXT" && entity.iter().any(|(code, name)| *code == 8 && name == layer)
    };
    let entities = tags.chunk_by(|_, (code, _)| *code != 0).filter(is_here);
    let mut texts: Vec<&str> = entities
        .flat_map(|entity| entity.iter().filter(|(code, _)| *code == 1).map(|(_, text)| &**text))
        .collect();
    texts.sort_unstable();
    texts
}

/// Returns the value after a variable in the header.
fn header<'a>(tags: &'a [(u16, String)], name: &str) -> &'a str {
    let at = tags.iter().position(|(_, value)| value == name).expect("a variable");
    &tags[at + 1].1
}

/// Returns the minimum and maximum of these numbers.
fn extent(numbers: &[f64]) -> [f64; 2] {
    let least = numbers.iter().fold(f64::INFINITY, |least, number| least.min(*number));
    [least, numbers.iter().fold(-least, |most, number| most.max(*number))]
}

#[test]
fn a_parallel_view_has_model_coordinates() {
    let sandbox = Sandbox::new("dxf_units");
    write_box(&sandbox, "box", [40.0, 25.0, 10.0]);
    let view = ["--view", "front", "--projection", "orthographic", "--style", "outline"];
    for (unit, code) in [("mm", "4"), ("m", "6"), ("in", "1")] {
        let flags = ["render", "box.gltf", "--unit", unit, "-o", "box.dxf"];
        assert_succeeds(&sandbox, &[&flags[..], &view].concat());
        let tags = read_tags(&sandbox, "box.dxf");
        assert_eq!((header(&tags, "$ACADVER"), header(&tags, "$INSUNITS")), ("AC1015", code));
        // One closed polyline through the corners of the front.
        assert_eq!(numbers(&tags, "LWPOLYLINE", 70), [129.0]);
        let [x, y] = [10, 20].map(|code| extent(&numbers(&tags, "LWPOLYLINE", code)));
        for (actual, expected) in x.into_iter().chain(y).zip([0.0, 40.0, 0.0, 25.0]) {
            assert_near(actual, expected);
        }
    }
}

#[test]
fn perspective_views_and_sheets_are_in_page_millimeters() {
    let sandbox = Sandbox::new("dxf_paper");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    let flags = ["render", "box.gltf", "--projection", "perspective", "--style", "lines"];
    assert_succeeds(&sandbox, &[&flags[..], &["-o", "eye.dxf"]].concat());
    let tags = read_tags(&sandbox, "eye.dxf");
    assert_eq!(header(&tags, "$INSUNITS"), "4");
    let [_, high] = extent(&numbers(&tags, "LWPOLYLINE", 10));
    assert!((100.0..254.0).contains(&high), "{high}");
    assert_succeeds(&sandbox, &["sheet", "box.gltf", "--scale", "1:1", "-o", "sheet.dxf"]);
    let tags = read_tags(&sandbox, "sheet.dxf");
    let texts: Vec<&str> =
        tags.windows(2).filter(|p| p[0].0 == 40 && p[1].0 == 1).map(|p| p[1].1.as_str()).collect();
    assert!(
        ["100", "50", "30", "1:1", "Scale"].iter().all(|text| texts.contains(text)),
        "{texts:?}"
    );
    let layer = |name: &str| tags.iter().any(|(code, value)| *code == 8 && value.starts_with(name));
    assert!(layer("front-visible-") && layer("dimensions") && layer("title-block"));
}

#[test]
fn sheet_annotations_have_text_on_separate_layers() {
    let sandbox = Sandbox::new("dxf_annotations");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    let flags = ["sheet", "box.gltf", "--scale", "1:1", "--section", "z=0.015", "-o", "cut.dxf"];
    assert_succeeds(&sandbox, &flags);
    let tags = read_tags(&sandbox, "cut.dxf");
    let [dimensions, names] = ["dimensions-text", "cut-names"].map(|layer| texts_on(&tags, layer));
    assert!(dimensions.contains(&"100") && dimensions.contains(&"50"), "{dimensions:?}");
    // The section line is in the views above and beside the front view, which is cut.
    assert_eq!(names, ["A", "A", "A", "A", "A-A"]);
    for layer in ["dimensions", "cut-lines", "cut-arrows", "scale-bar"] {
        assert_eq!(texts_on(&tags, layer), [""; 0], "{layer}");
    }
    for layer in ["dimensions-text", "cut-names", "scale-bar-text"] {
        let kinds = ["LINE", "LWPOLYLINE", "HATCH"];
        assert!(!kinds.iter().any(|kind| has_entity(&tags, kind, layer)), "{layer}");
    }
    assert!(has_entity(&tags, "HATCH", "front-visible-hatching"));
    assert!(!has_entity(&tags, "LINE", "front-visible-hatching"));
}

#[test]
fn sheets_have_the_outlines_that_a_scene_requests() {
    let sandbox = Sandbox::new("dxf_outline_sheet");
    write_box(&sandbox, "box", [0.1, 0.05, 0.03]);
    sandbox.write_file(
        "box.ron",
        "Scene(models: [(path: \"box.gltf\")], style: Lines(edges: Outline))",
    );
    assert_succeeds(&sandbox, &["sheet", "box.ron", "--no-dimensions", "-o", "box.dxf"]);
    let tags = read_tags(&sandbox, "box.dxf");
    for view in ["front", "top", "left", "isometric"] {
        assert!(has_entity(&tags, "LWPOLYLINE", &format!("{view}-outline")), "{view}");
        assert!(!has_entity(&tags, "LWPOLYLINE", &format!("{view}-visible")), "{view}");
    }
}

#[test]
fn images_and_invalid_tolerances_are_reported() {
    let sandbox = Sandbox::new("dxf_images");
    write_box(&sandbox, "box", [1.0, 1.0, 1.0]);
    sandbox.write_file(
        "flat.ron",
        "Scene(models: [(path: \"box.gltf\")], style: Lines(face_fill: Flat))",
    );
    let run = sandbox.run(&["render", "flat.ron", "-o", "flat.dxf"]);
    assert!(run.code == 0 && run.stderr.contains("but no images"), "{}", run.stderr);
    for tolerance in ["-1", "11", "nan", "x"] {
        let flag = format!("--arc-tolerance={tolerance}");
        let run = sandbox.run(&["render", "box.gltf", "-o", "box.dxf", &flag]);
        assert!(
            run.code == 2 && run.stderr.contains("expected 0 to 10 millimeters"),
            "{}",
            run.stderr
        );
    }
}

#[test]
fn outlines_are_closed_in_every_format() {
    let sandbox = Sandbox::new("outlines");
    write_box(&sandbox, "box", [2.0, 1.0, 1.0]);
    let flags = ["render", "box.gltf", "--projection", "isometric", "--style", "outline"];
    assert_succeeds(&sandbox, &[&flags[..], &["-o", "box.svg"]].concat());
    let svg = std::fs::read_to_string(sandbox.path_of("box.svg")).expect("an SVG");
    assert!(svg.contains("<g id=\"outline\"") && svg.matches("z\"/>").count() == 1, "{svg}");
    assert_eq!(svg.matches("<path").count(), 1);
    let cut = ["--view", "front", "--section", "z=0.5", "-o", "cut.svg"];
    let flags = ["render", "box.gltf", "--projection", "orthographic", "--style", "outline"];
    assert_succeeds(&sandbox, &[&flags[..], &cut].concat());
    let svg = std::fs::read_to_string(sandbox.path_of("cut.svg")).expect("an SVG");
    assert!(svg.contains("<g id=\"outline.1\">") && svg.contains("z\"/>"), "{svg}");
}
