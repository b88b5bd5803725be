//! Tests that framing is tight: the image touches the padded frame in one direction, is centered in
//! the other, and is not cropped.

use camera::{
    Basis, FramingConstraint, FramingError, Slopes, frame_oblique, frame_parallel,
    frame_perspective,
};
use homog::{Point, Vector, View, World};
use proptest::prelude::*;

fn triple(range: f64) -> impl Strategy<Value = [f64; 3]> {
    [-range..range, -range..range, -range..range]
}

fn cloud() -> impl Strategy<Value = Vec<Point<World>>> {
    (triple(50.0), prop::collection::vec(triple(4.0), 2..40)).prop_map(|(place, points)| {
        points.into_iter().map(|p| Point::from(p) + Vector::from(place)).collect()
    })
}

fn orientation() -> impl Strategy<Value = Basis> {
    (triple(1.0), triple(1.0)).prop_filter_map("a valid gaze and view-up", |(gaze, up)| {
        Basis::from_gaze(gaze.into(), up.into()).ok()
    })
}

fn slopes() -> impl Strategy<Value = Slopes> {
    ([-1.0..1.0, 0.1..3.0], [-1.0..1.0, 0.1..3.0]).prop_map(|([left, width], [bottom, height])| {
        Slopes { left, right: left + width, bottom, top: bottom + height }
    })
}

/// Returns the minimum and maximum of these numbers relative to the window: −1 is its lower end, +1
/// its upper end.
fn reach(numbers: impl Iterator<Item = f64>, low: f64, high: f64) -> [f64; 2] {
    let mut ends = [f64::INFINITY, -f64::INFINITY];
    for x in numbers.map(|x| (2.0 * x - low - high) / (high - low)) {
        ends = [ends[0].min(x), ends[1].max(x)];
    }
    ends
}

/// Asserts that the image touches the frame at ±(1 − 2 padding) in the direction of `fit`, and that
/// it fits and is centered in the other direction.
fn assert_tight(x: [f64; 2], y: [f64; 2], fit: FramingConstraint, padding: f64) {
    let rim = 1.0 - 2.0 * padding;
    let (tight, other) = if fit == FramingConstraint::Width { (x, y) } else { (y, x) };
    let near = |a: f64, b: f64| (a - b).abs() < 1e-11;
    assert!(near(tight[0], -rim) && near(tight[1], rim), "{fit:?}: {tight:?} is not ±{rim}");
    assert!(other[1] <= rim + 1e-11, "{fit:?}: {other:?} is cropped at {rim}");
    assert!(near(other[0], -other[1]), "{fit:?}: {other:?} is not centered");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn perspective_framing_is_tight(
        points in cloud(), basis in orientation(), slopes in slopes(), padding in 0.0..0.4,
    ) {
        let framing = frame_perspective(points.clone(), basis, slopes, padding).expect("valid");
        let world_to_view = framing.camera.world_to_view();
        let seen: Vec<Point<View>> = points.iter().map(|&p| world_to_view.transform_point(p)).collect();
        let (near, far) = (framing.near, framing.far);
        prop_assert!(seen.iter().all(|p| -p.z() > near - 1e-12 * far && -p.z() < far * (1.0 + 1e-12)));
        prop_assert!(near > 0.0);
        if framing.constraint != FramingConstraint::Loose {
            let x = reach(seen.iter().map(|p| -p.x() / p.z()), slopes.left, slopes.right);
            let y = reach(seen.iter().map(|p| -p.y() / p.z()), slopes.bottom, slopes.top);
            assert_tight(x, y, framing.constraint, padding);
        }
    }

    #[test]
    fn parallel_framing_is_tight_for_any_projectors(
        points in cloud(), basis in orientation(), a in -1.5..1.5, b in -1.5..1.5,
        aspect in 0.2..5.0, padding in 0.0..0.4,
    ) {
        let projectors = Vector::new(a, b, -1.0);
        let framing = frame_oblique(points.clone(), basis, projectors, aspect, padding).expect("valid");
        let world_to_view = framing.camera.world_to_view();
        let seen: Vec<Point<View>> = points.iter().map(|&p| world_to_view.transform_point(p)).collect();
        let x = reach(seen.iter().map(|p| p.x() + p.z() * a), framing.left, framing.right);
        let y = reach(seen.iter().map(|p| p.y() + p.z() * b), framing.bottom, framing.top);
        assert_tight(x, y, framing.constraint, padding);
        let width_to_height = (framing.right - framing.left) / (framing.top - framing.bottom);
        prop_assert!((width_to_height / aspect - 1.0).abs() < 1e-14);
        prop_assert!(seen.iter().all(|p| -p.z() > 0.0 && -p.z() > framing.near - 1e-12));
    }
}

const FRAME: Slopes = Slopes { left: -1.0, right: 1.0, bottom: -0.5, top: 0.5 };

fn perspective(points: &[[f64; 3]]) -> Result<camera::Framing, FramingError> {
    frame_perspective(points.iter().map(|&p| Point::from(p)), Basis::WORLD, FRAME, 0.0)
}

fn parallel(points: &[[f64; 3]]) -> Result<camera::ParallelFraming, FramingError> {
    frame_parallel(points.iter().map(|&p| Point::from(p)), Basis::WORLD, 2.0, 0.0)
}

#[test]
fn a_single_point_is_framed_as_a_unit_cube() {
    for place in [[0.0; 3], [3.0, -4.0, 5.0]] {
        let framing = perspective(&[place]).expect("one point is enough");
        assert_eq!(framing.camera.eye(), Point::from(place) + Vector::new(0.0, 0.0, 1.5));
        assert_eq!(
            (framing.near, framing.far, framing.constraint),
            (1.0, 2.0, FramingConstraint::Loose)
        );
        assert_eq!(perspective(&[place, place]), Ok(framing), "two equal points count as one");
        let flat = parallel(&[place]).expect("one point is enough");
        assert_eq!((flat.top, flat.right, flat.constraint), (0.5, 1.0, FramingConstraint::Loose));
    }
    let far = perspective(&[[1e20, 0.0, 0.0]]).expect("far away, but finite");
    assert!(far.near > 0.0 && far.camera.eye().z() > 0.0);
}

#[test]
fn coplanar_and_collinear_points_are_framed() {
    let wall = perspective(&[[-2.0, -1.0, 0.0], [2.0, 1.0, 0.0]])
        .expect("a wall perpendicular to the gaze");
    assert_eq!((wall.near, wall.far), (2.0, 2.0));
    let line = perspective(&[[0.0, 0.0, 0.0], [0.0, 0.0, 64.0]]).expect("a line along the gaze");
    assert_eq!((line.near, line.far, line.constraint), (1.0, 65.0, FramingConstraint::Loose));
    let line = parallel(&[[0.0, 0.0, 0.0], [0.0, 0.0, 8.0]]).expect("a line along the gaze");
    assert_eq!(
        (line.top, line.near, line.far, line.constraint),
        (4.0, 8.0, 16.0, FramingConstraint::Loose)
    );
    let level = parallel(&[[0.0, 0.0, 0.0], [8.0, 0.0, 0.0]]).expect("a horizontal line");
    assert_eq!((level.right, level.top, level.constraint), (4.0, 2.0, FramingConstraint::Width));
}

#[test]
fn the_eye_keeps_its_distance_from_a_needle_that_points_at_it() {
    let needle = [[0.01, 0.0, 0.0], [-0.01, 0.0, 0.0], [0.0, 0.0, 6.4]];
    let framing = perspective(&needle).expect("thin, but valid");
    assert_eq!(framing.constraint, FramingConstraint::Loose);
    assert!((framing.near - 0.1).abs() < 1e-5, "near is {}", framing.near);
}

#[test]
fn framing_errors_report_the_offending_values() {
    assert_eq!(perspective(&[]), Err(FramingError::NoPoints));
    assert!(matches!(
        perspective(&[[0.0; 3], [0.0, f64::NAN, 0.0]]),
        Err(FramingError::PointNotFinite { index: 1, .. })
    ));
    assert_eq!(
        perspective(&[[f64::MAX, 0.0, 0.0], [0.0; 3]]),
        Err(FramingError::OutOfRange { farthest: f64::MAX })
    );
    let points = [Point::ORIGIN, Point::new(1.0, 2.0, 3.0)];
    let sliver = Slopes { left: 1e30, right: 2e30, ..FRAME };
    let nowhere = frame_perspective(points, Basis::WORLD, sliver, 0.0);
    assert_eq!(nowhere, Err(FramingError::OutOfRange { farthest: 3.0 }));
    for padding in [-0.01, 0.5, f64::NAN] {
        let got = frame_perspective(points, Basis::WORLD, FRAME, padding);
        assert!(matches!(got, Err(FramingError::Padding { .. })), "padding {padding}");
    }
    for frame in [
        Slopes { left: 1.0, ..FRAME },
        Slopes { top: -0.6, ..FRAME },
        Slopes { right: f64::INFINITY, ..FRAME },
        Slopes { bottom: f64::NAN, ..FRAME },
    ] {
        let got = frame_perspective(points, Basis::WORLD, frame, 0.0);
        assert!(matches!(got, Err(FramingError::Window { .. })), "{frame:?}");
    }
    for aspect in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let got = frame_parallel(points, Basis::WORLD, aspect, 0.0);
        assert!(matches!(got, Err(FramingError::Aspect { .. })), "aspect {aspect}");
    }
    for direction in [Vector::X, Vector::Z, Vector::ZERO, Vector::new(0.0, f64::NAN, -1.0)] {
        let got = frame_oblique(points, Basis::WORLD, direction, 1.0, 0.0);
        assert!(matches!(got, Err(FramingError::Projectors { .. })), "{direction:?}");
    }
}
