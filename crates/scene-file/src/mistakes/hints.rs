//! Tests that follow the hints. Each row has a field as a newcomer writes it, words from the help,
//! and the field rewritten as the help suggests. The rewritten field must give a valid scene.

use super::{mistakes, scene_with};
use crate::parse_scene;

/// The field of a scene, the help, and the field written according to the help.
const FIELDS: &[(&str, &str, &str)] = &[
    (
        "sheet: Sheet(layout: 4)",
        "side_view: Left or Right, and axonometric_view: Isometric",
        "sheet: (side_view: Left, axonometric_view: Isometric)",
    ),
    (
        "camera_path: Turntable",
        "keys: [(time: 0, eye: (0, 2, 6), target: (0, 0, 0)), (time: 2, eye: (6, 2, 0), target: (0, 0, 0))]",
        "camera_path: (keys: [(time: 0, eye: (0, 2, 6), target: (0, 0, 0)), (time: 2, eye: (6, 2, 0), target: (0, 0, 0))])",
    ),
    ("camera_path: Orbit(seconds: 4)", "alberti animate SCENE --turntable", ""),
    (
        "sections: [Plane]",
        "sections: [(point: (0, 0, 0), normal: (0, 0, 1))]",
        "sections: [(point: (0, 0, 0), normal: (0, 0, 1))]",
    ),
    (
        "sections: (normal: (0, 0, 1))",
        "sections: [(normal: (0, 0, 1))]",
        "sections: [(normal: (0, 0, 1))]",
    ),
    (
        "camera: (projection: TwoPoint(fov: 40))",
        "projection: Perspective(fov_y_degrees: 35)",
        "camera: (projection: Perspective(fov_y_degrees: 35))",
    ),
    (
        "camera: (projection: TwoPoint(at: (1, 0)))",
        "x: (-3.2, 0.4), z: (2.4, 0.4)",
        "camera: (projection: TwoPoint(x: (-3.2, 0.4), z: (2.4, 0.4)))",
    ),
    (
        "camera: (projection: OnePoint(fov: 40))",
        "distance: 3",
        "camera: (projection: OnePoint(distance: 3))",
    ),
    (
        "camera: (projection: ThreePoint(fov: 40))",
        "x: (-3.2, 1.2), y: (0.1, -5), z: (2.4, 1.2)",
        "camera: (projection: ThreePoint(x: (-3.2, 1.2), y: (0.1, -5), z: (2.4, 1.2)))",
    ),
    (
        "camera: (view: Frame(distance: 4))",
        "padding_percent: 20",
        "camera: (view: Frame(padding_percent: 20))",
    ),
    (
        "camera: (view: Frame(distance: 5))",
        "view: LookAt(eye: (0, 2, 6), target: (0, 0, 0))",
        "camera: (view: LookAt(eye: (0, 2, 6), target: (0, 0, 0)))",
    ),
    (
        "camera: (view: Frame(angle: 30))",
        "from: Direction((1, 1, 1))",
        "camera: (view: Frame(from: Direction((1, 1, 1))))",
    ),
    ("overlays: [Dimensions]", "sheet: (dimensions: true)", "sheet: (dimensions: true)"),
    (
        "ground: Shadow(color: \"red\")",
        "image: (background: Color(\"#f4f1ea\"))",
        "image: (background: Color(\"#f4f1ea\"))",
    ),
    ("ground: Plane", "ground: Shadow()", "ground: Shadow()"),
    ("style: Lines(hatch: Parallel)", "face_fill: Hatching", "style: Lines(face_fill: Hatching)"),
    ("style: Hatched", "style: Lines(face_fill: Hatching)", "style: Lines(face_fill: Hatching)"),
    ("image: (size: \"320x240\")", "write (320, 240)", "image: (size: (320, 240))"),
    ("image: (size: 512)", "write (512, 512)", "image: (size: (512, 512))"),
    ("sheet: (scale: 1:20)", "write (1, 20)", "sheet: (scale: (1, 20))"),
    ("sheet: (scale: \"1:20\")", "write (1, 20)", "sheet: (scale: (1, 20))"),
    ("sheet: (scale: 20)", "write (1, 20)", "sheet: (scale: (1, 20))"),
    ("style: Lines(hidden: false)", "`Removed`", "style: Lines(hidden: Removed)"),
    ("style: Lines(hidden: true)", "`Dashed`", "style: Lines(hidden: Dashed)"),
    (
        "camera: (view: Frame(from: (1, 1, 1)))",
        "`Direction((1, 1, 1))`",
        "camera: (view: Frame(from: Direction((1, 1, 1))))",
    ),
    ("camera: Front", "camera: (view: Frame(from: Front))", "camera: (view: Frame(from: Front))"),
    ("camera: Isometric", "camera: (projection: Isometric)", "camera: (projection: Isometric)"),
    ("camera: Wireframe", "style: Wireframe", "style: Wireframe"),
    ("sheet: (paper: \"A4\")", "`A4`", "sheet: (paper: A4)"),
    ("sheet: (unit: mm)", "`Millimeter`", "sheet: (unit: Millimeter)"),
    ("shadows: true", "`On()`", "shadows: On()"),
    ("camera: (view: Left)", "Frame(from: Left)", "camera: (view: Frame(from: Left))"),
    ("sections: [(normal: Z)]", "write (0, 0, 1)", "sections: [(normal: (0, 0, 1))]"),
    ("passes: [Depth]", "write (write: [Depth])", "passes: (write: [Depth])"),
    ("viewports: [(at: TopLeft)]", "(0, 0, 0.5, 0.5)", "viewports: [(at: (0, 0, 0.5, 0.5))]"),
    (
        "viewports: [(rect: (0, 0, 1, 1))]",
        "at: (0.5, 0, 0.5, 0.5)",
        "viewports: [(at: (0.5, 0, 0.5, 0.5))]",
    ),
    ("viewports: [(x: 0)]", "at: (0.5, 0, 0.5, 0.5)", "viewports: [(at: (0.5, 0, 0.5, 0.5))]"),
    ("style: Lines(hatch_angle: 30)", "hatch_spacing_mm: 2", "style: Lines(hatch_spacing_mm: 2)"),
    ("image: (format: Png)", "-o picture.png", ""),
    (
        "camera_path: (keys: [], duration: 4)",
        "keys: [(time: 0, eye: (0, 2, 6), target: (0, 0, 0)), (time: 2, eye: (6, 2, 0), target: (0, 0, 0))]",
        "",
    ),
    ("style: Lines(stroke: 2)", "width: Px(2)", "style: Lines(width: Px(2))"),
    ("style: Lines(hidden: Dotted)", "`Dashed`", "style: Lines(hidden: Dashed)"),
    (
        "ground: Shadow(opacity: 0.5)",
        "shadows: On(softness_degrees: 4)",
        "ground: Shadow(), shadows: On(softness_degrees: 4)",
    ),
    (
        "lights: [Softbox]",
        "lights: [Directional(direction: (-1, -2, -1), intensity: 3)]",
        "lights: [Directional(direction: (-1, -2, -1), intensity: 3)]",
    ),
    ("stereo: True", "stereo: SideBySide()", "stereo: SideBySide()"),
    (
        "stereo: (eye_distance: 0.1)",
        "write SideBySide(eye_distance: 0.1)",
        "stereo: SideBySide(eye_distance: 0.1)",
    ),
    (
        "viewports: [Top]",
        "write (at: (0.5, 0, 0.5, 0.5), camera: (view: Frame(from: Top)))",
        "viewports: [(at: (0.5, 0, 0.5, 0.5), camera: (view: Frame(from: Top)))]",
    ),
    ("viewports: [(at: (0, 0, 0.5, 50%))]", "write 0.5", "viewports: [(at: (0, 0, 0.5, 0.5))]"),
    (
        "camera: (view: Frame(padding_percent: 20%))",
        "write 20",
        "camera: (view: Frame(padding_percent: 20))",
    ),
    (
        "style: DepthCued",
        "write style: Lines(edges: Facets, hidden: Drawn, depth_cue_percent: 80)",
        "style: Lines(edges: Facets, hidden: Drawn, depth_cue_percent: 80)",
    ),
];

/// Materials written as colors or as a map get a hint with a list of them.
#[test]
fn materials_in_other_forms_get_a_hint_with_a_list() {
    for (field, followed) in [
        ("material: \"red\"", "materials: [(base_color: \"red\")]"),
        ("material: Color(\"red\")", "materials: [(base_color: \"red\")]"),
        ("materials: \"#aabbcc\"", "materials: [(base_color: \"#aabbcc\")]"),
        (
            "materials: {\"wood\": (base_color: \"red\"), \"iron\": \"gray\"}",
            "materials: [(of: Name(\"wood\"), base_color: \"red\"), (of: Name(\"iron\"), base_color: \"gray\")]",
        ),
    ] {
        let found = mistakes(&format!("(models: [(path: \"a.glb\", {field})])"));
        assert!(matches!(found.as_slice(), [(.., help)] if help.ends_with(followed)), "{found:?}");
        let scene = format!("(models: [(path: \"a.glb\", {followed})])");
        assert!(parse_scene("s.ron", &scene).is_ok(), "{scene}");
    }
}

/// A field outside the scene's brackets is reported as a single mistake.
#[test]
fn fields_outside_a_scene_are_one_mistake() {
    let found = mistakes("models: [\"a.glb\"]");
    assert!(matches!(found.as_slice(), [(told, ..)] if told == "this is not a scene"), "{found:?}");
}

#[test]
fn following_a_hint_gives_a_valid_scene() {
    let mut wrong = Vec::new();
    for &(field, help, followed) in FIELDS {
        let found = mistakes(&scene_with(field));
        let is_known = matches!(found.as_slice(), [(.., told)] if told.contains(help));
        let is_scene = parse_scene("s.ron", &scene_with(followed)).is_ok();
        if !is_known || !is_scene {
            wrong.push((field, found));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// A model without its list and brackets gets one hint that shows both.
#[test]
fn models_without_lists_get_a_hint_with_the_whole_field() {
    for scene in ["(model: \"a.glb\")", "(models: \"a.glb\")", "(model: (path: \"a.glb\"))"] {
        let found = mistakes(scene);
        let full = "models: [(path: \"a.glb\")]";
        assert!(matches!(found.as_slice(), [(.., help)] if help.ends_with(full)), "{found:?}");
    }
    let found = mistakes("(models: [\"a.glb\", \"b.glb\"])");
    let helps: Vec<&str> = found.iter().map(|(.., help)| help.as_str()).collect();
    assert_eq!(helps, ["write (path: \"a.glb\")", "write (path: \"b.glb\")"]);
}

/// The items of a list that lacks its brackets are checked in the same run.
#[test]
fn a_missing_list_does_not_hide_the_mistakes_in_its_element() {
    let found = mistakes("(models: (path: \"a.glb\", position: (1, 2, 3)))");
    let told: Vec<&str> = found.iter().map(|(message, ..)| message.as_str()).collect();
    assert_eq!(
        told,
        [
            "`models`: expected a list, found values in parentheses (…)",
            "unexpected field `position` in `Model`"
        ]
    );
}

/// The contents of a misspelled field are checked in the same run.
#[test]
fn a_misspelled_field_does_not_hide_the_mistakes_in_its_value() {
    let path = "camera_path: (points: [(t: 0, eye: (0, 2, 5), target: (0, 1, 0)), (time: 4, eye: (5, 2, 0), target: (0, 1, 0))])";
    let helps: Vec<String> = mistakes(&scene_with(path)).into_iter().map(|one| one.2).collect();
    assert_eq!(helps, ["did you mean `keys`?", "did you mean `time`?"]);
    let grid = "(models: [(path: \"a.glb\", instances: Grid(rows: 4, spacing: 2))])";
    let helps: Vec<String> = mistakes(grid).into_iter().map(|one| one.2).collect();
    assert!(helps[0].contains("count: (5, 1, 4)") && helps[1].contains("step: (2, 0, 2)"));
    let model = "(models: [(path: \"a.glb\", material: (colour: \"red\", metal: 1))])";
    let helps: Vec<String> = mistakes(model).into_iter().map(|one| one.2).collect();
    let list = "did you mean `materials`? write materials: [(colour: \"red\", metal: 1)]";
    assert_eq!(helps, [list, "did you mean `base_color`?", "did you mean `metallic`?"]);
}

#[test]
fn grids_with_two_numbers_get_a_hint_with_three() {
    let grid = "(models: [(path: \"a.glb\", instances: Grid(count: (20, 10), step: (2, 3)))])";
    let found = mistakes(grid);
    let is_known = |(told, part): (&(String, (usize, usize), String), &str)| told.2.contains(part);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found.iter().zip(["(20, 1, 10)", "(2, 0, 3)"]).all(is_known), "{found:?}");
}
