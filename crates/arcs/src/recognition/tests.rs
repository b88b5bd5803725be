//! Compares arcs with known circles, and checks that polygons stay polygons.

use super::*;
use core::f64::consts::TAU;

/// The tolerance of five micrometers, in grid steps.
const TOLERANCE: f64 = 5.0;

/// Returns points on a circle in millimeters, from one angle to another. Angles are in turns.
fn on_circle(center: [f64; 2], radius: f64, [from, to]: [f64; 2], steps: u32) -> Vec<DVec2> {
    let point = |k: u32| {
        let (sin, cos) = libm::sincos(TAU * (from + (to - from) * f64::from(k) / f64::from(steps)));
        DVec2::from(center) + DVec2::new(cos, sin) * radius
    };
    (0..=steps).map(point).collect()
}

/// Rounds points to a micrometer grid.
fn grid(points: &[DVec2]) -> Vec<[i32; 2]> {
    let to_grid = |point: &DVec2| (*point * 1000.0).to_array().map(|c| libm::round(c) as i32);
    points.iter().map(to_grid).collect()
}

fn polygon(center: [f64; 2], radius: f64, sides: u32) -> Vec<[i32; 2]> {
    let mut points = on_circle(center, radius, [0.01, 1.01], sides);
    points.pop();
    grid(&points)
}

fn vertices(curve: LineShape) -> Vec<ArcVertex> {
    match curve {
        LineShape::Path(vertices, _) => vertices,
        other => panic!("{other:?}"),
    }
}

#[test]
fn polygons_with_thirteen_or_more_sides_are_circles() {
    for (sides, radius) in [(13, 3.0), (16, 0.4), (24, 40.0), (32, 1.5), (90, 0.9), (720, 95.0)] {
        let LineShape::Circle(circle) =
            recognize_arcs(&polygon([20.5, -7.0], radius, sides), true, TOLERANCE)
        else {
            panic!("{sides} sides")
        };
        assert!(circle.center.distance(DVec2::new(20_500.0, -7000.0)) < 0.8, "{sides}: {circle:?}");
        assert!((circle.radius - 1000.0 * radius).abs() < 0.8, "{sides}: {circle:?}");
    }
}

#[test]
fn polygons_with_few_corners_stay_polygons() {
    for sides in 3..=12 {
        let polygon = polygon([0.0, 0.0], 30.0, sides);
        let vertices = vertices(recognize_arcs(&polygon, true, TOLERANCE));
        assert_eq!(vertices.len(), sides as usize);
        assert!(vertices.iter().all(|vertex| vertex.bulge == 0.0), "{sides}");
    }
    // Unequally spaced points on a circle do not form an arc either.
    let points: Vec<DVec2> = [0.0, 0.05, 0.11, 0.14, 0.22, 0.26, 0.33, 0.37, 0.45, 0.5]
        .iter()
        .flat_map(|&at| on_circle([0.0, 0.0], 50.0, [at, at], 1).into_iter().take(1))
        .collect();
    let vertices = vertices(recognize_arcs(&grid(&points), false, TOLERANCE));
    assert!(vertices.len() == 10 && vertices.iter().all(|vertex| vertex.bulge == 0.0));
    // With a tolerance of 0 there are no arcs.
    let circle = polygon([0.0, 0.0], 30.0, 90);
    assert!(
        matches!(recognize_arcs(&circle, true, 0.0), LineShape::Path(points, true) if points.len() == 90)
    );
}

#[test]
fn arcs_have_the_angles_of_their_endpoints() {
    for [from, to] in [[0.1, 0.4], [0.7, 1.2], [0.4, 0.1], [0.05, 0.9]] {
        let points = on_circle([5.0, 6.0], 12.0, [from, to], 40);
        let LineShape::Arc(circle, [start, end]) = recognize_arcs(&grid(&points), false, TOLERANCE)
        else {
            panic!("{from} to {to}")
        };
        assert!(circle.center.distance(DVec2::new(5000.0, 6000.0)) < 3.0, "{circle:?}");
        let (low, high): (f64, f64) = (from.min(to), from.max(to));
        assert!((end - start - TAU * (high - low)).abs() < 2e-3, "{from} to {to}: {start} {end}");
        let turns = (start / TAU - low) - libm::round(start / TAU - low);
        assert!(turns.abs() < 1e-3, "{from} to {to}: {start}");
    }
}

#[test]
fn a_slot_is_two_lines_and_two_semicircles() {
    let mut points = on_circle([10.0, 0.0], 4.0, [-0.25, 0.25], 16);
    points.extend(on_circle([-10.0, 0.0], 4.0, [0.25, 0.75], 16));
    for shift in [0, 3, 16, 20] {
        points.rotate_left(shift);
        let vertices = vertices(recognize_arcs(&grid(&points), true, TOLERANCE));
        assert_eq!(vertices.len(), 4, "{shift}: {vertices:?}");
        let bulges: Vec<f64> =
            vertices.iter().map(|vertex| vertex.bulge).filter(|bulge| *bulge != 0.0).collect();
        assert!(bulges.len() == 2 && bulges.iter().all(|bulge| (bulge - 1.0).abs() < 1e-3));
    }
}

#[test]
fn shortened_end_steps_and_omitted_points_do_not_prevent_arcs() {
    let mut points = on_circle([0.0, 0.0], 20.0, [0.0, 0.5], 24);
    // The first step is cut short, as happens where a line becomes hidden.
    points[0] = points[0].lerp(points[1], 0.9);
    assert!(
        matches!(recognize_arcs(&grid(&points), false, TOLERANCE), LineShape::Path(v, _) if v.len() == 2 || v.len() == 3)
    );
    // Many short steps, with every third point omitted.
    let mut fine = on_circle([0.0, 0.0], 20.0, [0.0, 1.0], 600);
    fine.pop();
    let mut count = 0;
    fine.retain(|_| {
        count += 1;
        count % 3 != 0
    });
    assert!(matches!(recognize_arcs(&grid(&fine), true, TOLERANCE), LineShape::Circle(_)));
}
