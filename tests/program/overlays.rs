//! Overlays and classical projections: vanishing points, the horizon and the axes are where the
//! formulas place them.

use crate::sandbox::Sandbox;
use crate::vector_files::{Layers, PagePoint, parse_svg, point_bounds};

/// Returns half the width and height of the page of a drawing of the house, and its layers.
fn draw_overlays(sandbox: &Sandbox, camera: &str, overlays: &str) -> (PagePoint, Layers) {
    sandbox.copy_model("house.glb");
    sandbox.write_file(
        "scene.ron",
        format!(
            "Scene(models: [(path: \"house.glb\")], style: Lines(), camera: ({camera}),
             overlays: [{overlays}], image: (size: (800, 600)))"
        ),
    );
    let run = sandbox.run(&["render", "scene.ron", "-o", "out.svg"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{camera}");
    let text = std::fs::read_to_string(sandbox.path_of("out.svg")).expect("an SVG");
    let (page, layers) = parse_svg(&text);
    ([page[0] / 2.0, page[1] / 2.0], layers)
}

/// Returns the lines of the overlay layers whose names end with this suffix.
fn layers_ending_in<'a>(layers: &'a Layers, end: &str) -> Vec<&'a Vec<PagePoint>> {
    let chosen = layers.iter().filter(|(id, _)| id.starts_with("overlay-") && id.ends_with(end));
    chosen.flat_map(|(_, lines)| lines).collect()
}

/// Converts a point on the page to an offset from the picture's center, in half heights, with y up.
fn to_half_heights(point: PagePoint, half: PagePoint) -> PagePoint {
    [(point[0] - half[0]) / half[1], (half[1] - point[1]) / half[1]]
}

#[track_caller]
fn assert_near(actual: PagePoint, expected: PagePoint) {
    let near = actual.iter().zip(expected).all(|(a, b)| (a - b).abs() < 2e-4);
    assert!(near, "{actual:?} instead of {expected:?}");
}

/// Returns the center of the ring around a vanishing point.
fn ring_center(layers: &Layers, axis: &str, half: PagePoint) -> Option<PagePoint> {
    let lines = layers_ending_in(layers, &format!("-vanishing-{axis}"));
    let [low, high] = point_bounds(lines.first()?.iter());
    let middle = [(low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0];
    Some(to_half_heights(middle, half))
}

#[test]
fn c82_axes_vanish_at_the_constructed_points() {
    let sandbox = Sandbox::new("vanishing");
    let cases = [
        ("OnePoint(at: (0.35, 0.45), distance: 3)", [None, None, Some([0.35, 0.45])]),
        (
            "TwoPoint(x: (-1.2, 0.5), z: (1.1, 0.5), fraction: 0.4)",
            [Some([-1.2, 0.5]), None, Some([1.1, 0.5])],
        ),
        (
            "ThreePoint(x: (-1.2, 0.8), y: (0.1, -0.9), z: (1.25, 0.7))",
            [Some([-1.2, 0.8]), Some([0.1, -0.9]), Some([1.25, 0.7])],
        ),
    ];
    for (projection, expected) in cases {
        let camera = format!("projection: {projection}");
        let (half, layers) = draw_overlays(&sandbox, &camera, "VanishingPoints, Horizon");
        for (axis, expected) in ["x", "y", "z"].into_iter().zip(expected) {
            let found = ring_center(&layers, axis, half);
            assert_eq!(found.is_some(), expected.is_some(), "{axis} of {projection}");
            found
                .into_iter()
                .zip(expected)
                .for_each(|(found, expected)| assert_near(found, expected));
        }
        // Horizontal directions vanish on one line, wherever the eye is.
        let horizon = layers_ending_in(&layers, "-horizon");
        let ends = [horizon[0][0], horizon[0][1]].map(|end| to_half_heights(end, half));
        for [x, y] in [expected[0], expected[2]].into_iter().flatten() {
            let slope = (ends[1][1] - ends[0][1]) / (ends[1][0] - ends[0][0]);
            assert_near([x, ends[0][1] + slope * (x - ends[0][0])], [x, y]);
        }
    }
}

#[test]
fn c80_model_edges_lead_to_the_vanishing_points() {
    let sandbox = Sandbox::new("run_to");
    let camera = "projection: TwoPoint(x: (-1.2, 0.5), z: (1.1, 0.5), fraction: 0.5)";
    let (half, layers) = draw_overlays(&sandbox, camera, "VanishingPoints");
    for (axis, at) in [("x", [-1.2, 0.5]), ("z", [1.1, 0.5])] {
        let lines = layers_ending_in(&layers, &format!("-to-{axis}"));
        assert_eq!(lines.len(), 8, "one from each corner of the box");
        for line in lines {
            let ends = [line[0], line[1]].map(|end| to_half_heights(end, half));
            assert!(
                ends.iter().any(|end| (0..2).all(|k| (end[k] - at[k]).abs() < 2e-4)),
                "{ends:?}"
            );
        }
    }
}

#[test]
fn c76_c77_axes_have_textbook_lengths_and_angles() {
    let sandbox = Sandbox::new("axes");
    let isometric = libm::sqrt(2.0 / 3.0);
    let half_angle = std::f64::consts::FRAC_1_SQRT_2;
    // The images of the unit vectors along x, y and z, up to a common factor; z points toward the
    // viewer.
    let cases = [
        ("Multiview(Front)", [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]),
        (
            "Isometric",
            [
                [isometric * libm::sqrt(0.75), -isometric / 2.0],
                [0.0, isometric],
                [-isometric * libm::sqrt(0.75), -isometric / 2.0],
            ],
        ),
        ("Cavalier()", [[1.0, 0.0], [0.0, 1.0], [-half_angle, -half_angle]]),
        ("Cabinet()", [[1.0, 0.0], [0.0, 1.0], [-half_angle / 2.0, -half_angle / 2.0]]),
        ("Oblique(length: 0.75, angle_degrees: 0)", [[1.0, 0.0], [0.0, 1.0], [-0.75, 0.0]]),
        ("Military(rotation_degrees: 90)", [[0.0, 1.0], [0.0, 1.0], [1.0, 0.0]]),
    ];
    for (projection, expected) in cases {
        let camera = format!("projection: {projection}, view: Frame(padding_percent: 30)");
        let found = axis_vectors(&draw_overlays(&sandbox, &camera, "Axes(length: 3)").1);
        let up = vector_length(expected[1]) / vector_length(found[1]);
        for (found, expected) in found.into_iter().zip(expected) {
            assert!(
                (found[0] * up - expected[0]).abs() < 1e-3,
                "{projection}: {found:?} {expected:?}"
            );
            assert!(
                (found[1] * up - expected[1]).abs() < 1e-3,
                "{projection}: {found:?} {expected:?}"
            );
        }
    }
    let dimetric_axes =
        axis_vectors(&draw_overlays(&sandbox, "projection: Dimetric", "Axes(length: 3)").1);
    let lengths = dimetric_axes.map(vector_length);
    assert!((lengths[0] / lengths[1] - 1.0).abs() < 1e-3, "{lengths:?}");
    assert!((lengths[2] / lengths[1] - 0.5).abs() < 1e-3, "{lengths:?}");
}

fn vector_length([x, y]: PagePoint) -> f64 {
    libm::sqrt(x * x + y * y)
}

/// Returns the images of the three axes, from the origin to the tip, with y up.
fn axis_vectors(layers: &Layers) -> [PagePoint; 3] {
    let points = ["x", "y", "z"].map(|axis| {
        let parts =
            ["", "-hidden"].map(|part| layers_ending_in(layers, &format!("-axis-{axis}{part}")));
        parts.into_iter().flatten().flatten().copied().collect::<Vec<PagePoint>>()
    });
    // The origin is the point that two axes share; the tip is the farthest point from it.
    let near = |a: PagePoint, b: PagePoint| vector_length([a[0] - b[0], a[1] - b[1]]) < 2e-3;
    let shared = |point: &&PagePoint| points[1].iter().any(|other| near(**point, *other));
    let origin = *points[0].iter().find(shared).expect("x and y begin at the origin");
    points.map(|points| {
        let images = points.iter().map(|point| [point[0] - origin[0], origin[1] - point[1]]);
        images.fold(
            [0.0, 0.0],
            |tip, image| if vector_length(image) > vector_length(tip) { image } else { tip },
        )
    })
}

/// A vanishing point outside the picture is labeled at the border; a vanishing point inside has
/// only its ring.
#[test]
fn vanishing_points_outside_the_picture_are_labeled_at_its_border() {
    let sandbox = Sandbox::new("vanishing_outside");
    let camera = "projection: TwoPoint(x: (-3.2, 0.5), z: (1.1, 0.5))";
    let (half, layers) = draw_overlays(&sandbox, camera, "VanishingPoints");
    let named = layers_ending_in(&layers, "-outside-x");
    let [low, high] = point_bounds(named.iter().flat_map(|line| line.iter()));
    assert!(low[0] > 0.0 && high[0] < half[0], "on the left: {low:?} {high:?}");
    assert!(low[1] > 0.0 && high[1] < 2.0 * half[1]);
    assert!(layers_ending_in(&layers, "-vanishing-x").is_empty());
    assert!(layers_ending_in(&layers, "-outside-z").is_empty());
    assert!(!layers_ending_in(&layers, "-vanishing-z").is_empty());
}
