//! `alberti sweep`: one parameter, step by step.

use crate::drawings::{assert_succeeds, read_drawing, write_box};
use crate::sandbox::Sandbox;
use crate::vector_files::layer_bounds;

const RANGES: [(&str, &str, &str); 9] = [
    ("fov", "20", "60"),
    ("aspect", "0.5", "2"),
    ("near", "6", "9"),
    ("far", "9", "14"),
    ("lens", "4", "9"),
    ("shift", "-0.5", "0.5"),
    ("distance", "8", "30"),
    ("dolly", "8", "30"),
    ("angle", "0", "270"),
];

const PARALLEL_RANGES: [(&str, &str, &str); 6] = [
    ("height", "5", "20"),
    ("aspect", "0.5", "2"),
    ("near", "-20", "-1"),
    ("far", "13", "20"),
    ("shift", "-0.5", "0.5"),
    ("angle", "0", "90"),
];

/// C62, C64, C94: a page for every parameter, in perspective and in parallel projection.
#[test]
fn every_parameter_can_be_varied() {
    let sandbox = Sandbox::new("sweep_all");
    sandbox.copy_model("house.glb");
    let in_perspective = RANGES.map(|range| ("perspective", range));
    let in_parallel = PARALLEL_RANGES.map(|range| ("orthographic", range));
    for (projection, (vary, from, to)) in in_perspective.into_iter().chain(in_parallel) {
        let flags = ["--vary", vary, "--from", from, "--to", to, "--steps", "3", "-o", "out.svg"];
        let begin = ["sweep", "house.glb", "--projection", projection];
        assert_succeeds(&sandbox, &[&begin[..], &flags].concat());
        let text = std::fs::read_to_string(sandbox.path_of("out.svg")).expect("an SVG");
        for (step, value) in [(1, from), (3, to)] {
            let name = format!("<g id=\"names.step-{step}\">\n<title>{vary} {value}</title>");
            assert!(text.contains(&name), "{vary}");
        }
        let (_, layers) = read_drawing(&sandbox, "out.svg");
        let shown = (1..=3)
            .filter(|step| layers.keys().any(|id| id.starts_with(&format!("step-{step}-visible"))));
        assert_eq!(shown.count(), 3, "{vary}");
    }
}

/// The front of a very flat box is at the depth of its center, so it keeps its size in a dolly
/// zoom; otherwise it scales with 1/distance.
#[test]
fn a_dolly_zoom_keeps_the_size_and_a_plain_move_does_not() {
    let sandbox = Sandbox::new("sweep_dolly");
    write_box(&sandbox, "box", [4.0, 3.0, 1e-6]);
    let widths = |vary: &str| {
        let flags = ["--vary", vary, "--from", "10", "--to", "40", "--steps", "4", "-o", "out.svg"];
        let front = ["sweep", "box.gltf", "--view", "front"];
        assert_succeeds(&sandbox, &[&front[..], &flags].concat());
        let (_, layers) = read_drawing(&sandbox, "out.svg");
        [1, 2, 3, 4].map(|step| {
            let [low, high] =
                layer_bounds(&layers, |id| id.starts_with(&format!("step-{step}-visible")));
            high[0] - low[0]
        })
    };
    let dolly = widths("dolly");
    assert!(dolly.iter().all(|width| (width - dolly[0]).abs() < 0.005), "{dolly:?}");
    let walk = widths("distance");
    for (width, distance) in walk.iter().zip([10.0, 20.0, 30.0, 40.0]) {
        assert!((width * distance - walk[0] * 10.0).abs() < 0.05, "{walk:?}");
    }
}

/// C64: the frustum and its apex.
#[test]
fn view_volumes_are_below_the_pictures() {
    let sandbox = Sandbox::new("sweep_volumes");
    write_box(&sandbox, "box", [4.0, 3.0, 2.0]);
    let sweep =
        ["sweep", "box.gltf", "--vary", "fov", "--from", "20", "--to", "50", "--steps", "2"];
    let bytes = |threads: &str| {
        let flags = ["--view-volumes", "-o", "out.svg", "--threads", threads];
        assert_succeeds(&sandbox, &[&sweep[..], &flags].concat());
        std::fs::read(sandbox.path_of("out.svg")).expect("a drawing")
    };
    assert!(bytes("1") == bytes("4"), "the number of threads does not matter");
    let (_, layers) = read_drawing(&sandbox, "out.svg");
    for step in [1, 2] {
        let of =
            |part: &str| layer_bounds(&layers, |id| id.starts_with(&format!("step-{step}-{part}")));
        assert!(of("view-visible")[1][1] < of("volume-overlay")[0][1], "{step}");
    }
    assert_succeeds(&sandbox, &[&sweep[..], &["-o", "out.html"]].concat());
    let html = std::fs::read_to_string(sandbox.path_of("out.html")).expect("a page");
    assert!(html.contains("<b>fov 20</b><span>20° high"), "{html}");
}

#[test]
fn parameters_that_do_not_apply_are_reported() {
    let sandbox = Sandbox::new("sweep_mistakes");
    write_box(&sandbox, "box", [4.0, 3.0, 2.0]);
    let run = |vary: &str, from: &str, to: &str, more: &[&str]| {
        let flags = ["sweep", "box.gltf", "--vary", vary, "--from", from, "--to", to];
        sandbox.run(&[&flags[..], more].concat())
    };
    for (vary, from, to, more, told) in [
        (
            "fov",
            "20",
            "180",
            &[][..],
            "error: `fov` cannot be 180: it must be between 0 and 180 degrees",
        ),
        ("aspect", "0", "2", &[], "`aspect` cannot be 0: it must be greater than 0"),
        ("distance", "-3", "9", &[], "`distance` cannot be -3: it must be greater than 0"),
        ("near", "1e9", "2e9", &[], "`near` cannot be 1e9: "),
        ("fov", "20", "40", &["--projection", "isometric"], "use a perspective or an orthographic"),
        (
            "dolly",
            "5",
            "9",
            &["--projection", "orthographic"],
            "the scene's projection is parallel",
        ),
    ] {
        let run = run(vary, from, to, more);
        assert!(run.code == 1 && run.stderr.contains(told), "{vary}: {}", run.stderr);
    }
    for (vary, from, more) in [
        ("roll", "1", &[][..]),
        ("fov", "wide", &[]),
        ("fov", "nan", &[]),
        ("fov", "30", &["--steps", "0"]),
        ("fov", "30", &["--steps", "65"]),
    ] {
        let run = run(vary, from, "40", more);
        assert_eq!(run.code, 2, "{vary} {from} {more:?}: {}", run.stderr);
    }
    // Orbiting the models also works in parallel projection.
    assert_eq!(run("angle", "0", "90", &["--projection", "orthographic"]).code, 0);
    assert_eq!(sandbox.file_names(), ["box.bin", "box.gltf", "sweep.svg"]);
}
