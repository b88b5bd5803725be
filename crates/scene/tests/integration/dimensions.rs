//! Tests dimensions in scene files: the points that they measure, and the locations of errors.

#![allow(clippy::panic, clippy::unwrap_used, reason = "tests may panic")]

use homog::{Point, World};
use import::MemoryFolder;
use scene::{Origin, ResolveOptions, Scene, SheetContent, resolve_sheet};
use scene_file::{SceneError, parse_scene};
use sheet::{Dimension, Measure, Sheet};

/// A box of 4 × 2 × 1 and a roof over it, with an angle of 90° at the ridge.
const HOUSE: &str = "\
o walls\nv 0 0 0\nv 4 0 0\nv 4 2 0\nv 0 2 0\nv 0 0 1\nv 4 0 1\nv 4 2 1\nv 0 2 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 1 5 8 4
o roof\nv 0 2 0\nv 4 2 0\nv 2 4 0\nv 0 2 1\nv 4 2 1\nv 2 4 1
f 11 10 9\nf 12 13 14\nf 9 10 13 12\nf 10 11 14 13\nf 11 9 12 14
";

/// Returns the sheet of the house with these dimensions.
fn sheet_with(dimensions: &str) -> Result<Sheet, SceneError> {
    sheet_of(HOUSE, dimensions)
}

/// Returns a disk of radius 4 around (10, 0, 20), 2 high, of which only some of 36 sectors remain.
fn disk(sectors: usize) -> String {
    use std::fmt::Write as _;
    let (mut vertices, mut faces) = (String::new(), String::new());
    let last = if sectors == 36 { 35 } else { sectors };
    for height in [0.0, 2.0] {
        let _ = writeln!(vertices, "v 10 {height} 20");
        for at in 0..=last {
            let (sine, cosine) = libm::sincos(std::f64::consts::TAU * at as f64 / 36.0);
            let _ = writeln!(vertices, "v {} {height} {}", 10.0 + 4.0 * cosine, 20.0 - 4.0 * sine);
        }
    }
    let count = last + 2;
    for at in 0..sectors {
        let (a, b) = (at + 2, (at + 1) % (last + 1) + 2);
        let _ = writeln!(faces, "f 1 {b} {a}\nf {} {} {}", count + 1, count + a, count + b);
        let _ = writeln!(faces, "f {a} {b} {} {}", count + b, count + a);
    }
    vertices + &faces
}

/// Returns the sheet of a model with these dimensions.
fn sheet_of(obj: &str, dimensions: &str) -> Result<Sheet, SceneError> {
    let text = format!(
        "Scene(models: [(path: \"house.obj\")], sheet: (unit: Millimeter, dimensions: {dimensions}))"
    );
    let mut folder = MemoryFolder::default();
    folder.insert("house.obj", obj.as_bytes().to_vec());
    let file = parse_scene("scene.ron", &text).expect("a scene");
    let origin = Origin::from_text_in_memory("scene.ron", &text, folder);
    let scene = Scene::resolve(&origin, &file, &ResolveOptions::default()).expect("models");
    let content = SheetContent::from_scene(&scene);
    resolve_sheet(&origin, &file.sheet.expect("a sheet"), content)
}

/// Returns the points that a dimension measures.
fn points(dimension: &str) -> Vec<[f64; 3]> {
    let sheet = sheet_with(&format!("[{dimension}]")).unwrap_or_else(|error| panic!("{error}"));
    let [Dimension { measure, .. }] = sheet.measures.as_slice() else { panic!("{dimension}") };
    let points: Vec<Point<World>> = match measure {
        Measure::Chain(points, _) | Measure::Baseline(points, _) => points.clone(),
        Measure::Angle(points) => points.to_vec(),
        other => panic!("{other:?}"),
    };
    points.iter().map(|point| point.raw().to_array().map(|c| (c * 1e6).round() / 1e6)).collect()
}

#[test]
fn true_gives_the_overall_dimensions_and_false_gives_none() {
    for (text, overall) in [("true", true), ("false", false), ("[Overall]", true), ("[]", false)] {
        let sheet = sheet_with(text).unwrap();
        assert_eq!((sheet.dimensions, sheet.measures.len()), (overall, 0), "{text}");
    }
}

#[test]
fn parts_are_picked_by_position_and_by_name() {
    for (from, to, expected) in [
        ("Point((1, 2, 3))", "Fraction((1, 0.5, 0))", [[1.0, 2.0, 3.0], [4.0, 2.0, 0.0]]),
        (
            "Node(name: \"walls\")",
            "Node(name: \"roof\", fraction: (0.5, 1, 0.5))",
            [[2.0, 1.0, 0.5], [2.0, 4.0, 0.5]],
        ),
        (
            "Vertex(near: (-1, 5, 2), node: \"walls\")",
            "Vertex(fraction: (1, 0, 1))",
            [[0.0, 2.0, 1.0], [4.0, 0.0, 1.0]],
        ),
        // Perpendicular to the floor, from the ridge.
        ("Vertex(near: (2, 5, 0))", "Face(near: (1, -1, 0.5))", [[2.0, 4.0, 0.0], [2.0, 0.0, 0.0]]),
        ("Face(near: (-1, 1, 0.5))", "Face(near: (5, 1, 0.5))", [[0.0, 1.0, 0.5], [4.0, 1.0, 0.5]]),
        (
            "Edge(near: (1, -1, 1.5))",
            "Edge(near: (3, -1, -0.5))",
            [[1.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        ),
        ("Edge(near: (1, -1, 1.5))", "Vertex(near: (4, 2, 1))", [[4.0, 0.0, 1.0], [4.0, 2.0, 1.0]]),
    ] {
        assert_eq!(points(&format!("Length(from: {from}, to: {to})")), expected, "{from} {to}");
    }
}

#[test]
fn angles_are_between_edges_faces_and_points() {
    for sides in [
        "from: Edge(near: (1, 3.1, 1)), to: Edge(near: (3, 3.1, 1))",
        "from: Face(near: (1, 3.1, 0.5)), to: Face(near: (3, 3.1, 0.5))",
        "vertex: Point((0, 0, 0)), from: Point((0, 3, 0)), to: Point((2, 0, 0))",
    ] {
        let [vertex, a, b] = points(&format!("Angle({sides})"))[..] else { panic!("{sides}") };
        let [u, v] = [a, b].map(|end| glam::DVec3::from(end) - glam::DVec3::from(vertex));
        assert!(
            (u.angle_between(v).to_degrees() - 90.0).abs() < 1e-3,
            "{sides}: {vertex:?} {a:?} {b:?}"
        );
    }
}

#[test]
fn errors_point_at_the_mistakes() {
    for (dimension, at, message, help) in [
        (
            "Length(from: Node(name: \"rof\"), to: Point((0, 0, 0)))",
            "\"rof\"",
            "no node `rof`",
            "did you mean `roof`?",
        ),
        (
            "Chain(points: [Point((0, 0, 0)), Vertex(node: \"Wall\")])",
            "\"Wall\"",
            "no node `Wall`",
            "`walls`",
        ),
        (
            "Length(from: Point((0, 0, 0)), to: Node(name: \"roof\", number: 1))",
            "1",
            "with number 1",
            "highest is 0",
        ),
        ("Diameter(circle: (near: (0, 0, 0)))", "(near: (0, 0, 0))", "there is no circle", "eight"),
        ("Chain(points: [Point((0, 0, 0))])", "[Point((0, 0, 0))]", "at least two points", ""),
        (
            "Length(from: Edge(near: (1, 0, 1)), to: Edge(near: (0, 1, 1)))",
            "Edge(near: (0, 1, 1))",
            "not parallel",
            "Vertex",
        ),
        (
            "Length(from: Vertex(near: (0, 0, 0), fraction: (0, 0, 0)), to: Point((0, 0, 0)))",
            "Vertex(near: (0, 0, 0), fraction: (0, 0, 0))",
            "both set the point",
            "near",
        ),
        (
            "Angle(from: Edge(near: (2, 0, 1)), to: Edge(near: (2, 0, 0)))",
            "Angle(from",
            "parallel",
            "distance",
        ),
        ("Radius(circle: (near: (0, 0, 0)), decimals: 7)", "7", "decimal places: 7", "0 to 6"),
        (
            "Length(from: Point((0, 0, 0)), to: Point((1, 0, 0)), direction: Vertical, side: Above)",
            "Above",
            "cannot be placed above",
            "Left or Right",
        ),
        ("LargestDiameters(count: 0)", "0", "count: 0", "1 to 50"),
    ] {
        let error = sheet_with(&format!("[Overall, {dimension}]")).expect_err(dimension);
        let shown = &error.source[error.span.clone()];
        assert!(shown.starts_with(at), "{dimension}: {shown}");
        assert!(error.message.contains(message), "{dimension}: {}", error.message);
        let text = error.help.unwrap_or_default();
        assert!(text.contains(help), "{dimension}: {text}");
    }
}

#[test]
fn circles_far_from_a_position_are_reported() {
    let disk = disk(36);
    for (near, help) in [
        ("(500, 0, 20)", "nearest circle has center (10, 0, 20), radius 4, at a distance of 486"),
        // The position with z up.
        ("(10, -20, 0)", "y points up here: (10, 0, 20) is near a circle with center (10, 0, 20)"),
        ("(10, -20, 2)", "y points up here: (10, 2, 20) is near a circle with center (10, 2, 20)"),
    ] {
        let error =
            sheet_of(&disk, &format!("[Diameter(circle: (near: {near}))]")).expect_err(near);
        assert_eq!(error.message, format!("there is no circle near {near}"));
        let text = error.help.unwrap_or_default();
        assert!(text.contains(help), "{near}: {text}");
    }
    for near in
        ["near: (10, 0, 20)", "near: (14.1, 0, 20)", "near: (10, 3, 20)", "fraction: (1, 1, 1)"]
    {
        sheet_of(&disk, &format!("[Diameter(circle: ({near}))]")).expect(near);
    }
}

#[test]
fn arcs_have_radii_but_no_diameters() {
    for (sectors, has_diameter) in [(36, true), (18, true), (9, false)] {
        let disk = disk(sectors);
        let near = "(circle: (near: (14, 0, 20)))";
        let error = sheet_of(&disk, &format!("[Diameter{near}]")).err();
        assert_eq!(error.is_none(), has_diameter, "{sectors}: {error:?}");
        if let Some(error) = error {
            assert!(error.message.contains("an arc of 90°"), "{}", error.message);
            assert!(error.help.is_some_and(|help| help.contains("Radius")));
        }
        let sheet = sheet_of(&disk, &format!("[Radius{near}]")).expect("a radius");
        let Measure::Radius(circle) = &sheet.measures[0].measure else { panic!("{sectors}") };
        assert!((circle.radius - 4.0).abs() < 1e-5);
    }
}
