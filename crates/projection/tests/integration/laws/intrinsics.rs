//! Tests the conversion of K to a matrix and back, and compares pixels from K with pixels from
//! matrix, divide and viewport.

use super::samples::{self, convention, distance, frustum};
use homog::{PixelCenters, Point, View};
use projection::{Convention, Frustum, Intrinsics, ProjectionError};
use proptest::prelude::*;

/// Generates any lens with near and far planes.
fn lens() -> impl Strategy<Value = (Intrinsics, [f64; 2])> {
    let numbers = (30.0..4000.0, 0.2..5.0, -0.3..1.3, -0.3..1.3, -40.0..40.0);
    let size = ([1u32..4000, 1u32..4000], any::<bool>());
    (numbers, size, (0.01..10.0, 1.01..1e4)).prop_map(
        |((fx, ratio, cx, cy, skew), ([width, height], is_half), (near, depth))| {
            let center = [cx * f64::from(width), cy * f64::from(height)];
            let lens = Intrinsics::new([fx, fx * ratio], center, [width, height]);
            let lens = lens.and_then(|lens| lens.with_skew(skew)).expect("a lens");
            let centers = if is_half { PixelCenters::Half } else { PixelCenters::Integer };
            (lens.with_pixel_centers(centers), [near, near * depth])
        },
    )
}

/// Generates points in front of the eye.
fn point_ahead() -> impl Strategy<Value = Point<View>> {
    (-2.0..2.0, -2.0..2.0, 0.01..1e4)
        .prop_map(|(x, y, depth): (f64, f64, f64)| Point::new(x * depth, y * depth, -depth))
}

/// Converts the point to a view space with the convention's handedness.
fn in_view_of(point: Point<View>, c: Convention) -> Point<View> {
    Point::new(point.x(), point.y(), point.z() * -c.ahead())
}

proptest! {
    #![proptest_config(samples::cases(256))]

    #[test]
    fn pixels_from_k_match_matrix_divide_and_viewport(
        (lens, planes) in lens(),
        point in point_ahead(),
        c in convention(),
    ) {
        let matrix = lens.view_to_clip(planes, c).expect("a matrix");
        let ndc = matrix.transform_point(in_view_of(point, c)).divide().expect("ahead");
        let [width, height] = lens.size().map(|side| 0.5 * f64::from(side));
        // The viewport maps corners to corners, so pixel centers are at half-integers.
        let by_viewport = [(1.0 + ndc.x()) * width, (1.0 - c.top() * ndc.y()) * height];
        let by_k = lens.in_pixel_centers(PixelCenters::Half).project(point).expect("ahead");
        for (one, other) in by_viewport.into_iter().zip(by_k) {
            prop_assert!((one - other).abs() <= 1e-12 * (4e4 + one.abs()), "{one} {other}");
        }
        // The other convention moves all points by half a pixel.
        let by_integer = lens.in_pixel_centers(PixelCenters::Integer).project(point).expect("ahead");
        for (half, integer) in by_k.into_iter().zip(by_integer) {
            prop_assert!((half - integer - 0.5).abs() <= 1e-10);
        }
    }

    #[test]
    fn k_is_recovered_from_the_matrix((lens, planes) in lens(), c in convention()) {
        let matrix = lens.view_to_clip(planes, c).expect("a matrix");
        let back = Intrinsics::from_view_to_clip(matrix, c, lens.size()).expect("a lens");
        let back = back.in_pixel_centers(lens.pixel_centers());
        let rows = |lens: Intrinsics| lens.to_rows();
        for (one, other) in rows(lens).as_flattened().iter().zip(rows(back).as_flattened()) {
            prop_assert!((one - other).abs() <= 1e-12 * (4e3 + one.abs()), "{one} {other}");
        }
    }

    #[test]
    fn the_inverse_undoes_the_matrix((lens, planes) in lens(), point in point_ahead(), c in convention()) {
        let view = in_view_of(point, c);
        let clip = lens.view_to_clip(planes, c).expect("a matrix").transform_point(view);
        let back = lens.clip_to_view(planes, c).expect("an inverse").transform_hpoint(clip);
        let back = back.divide().expect("a point");
        // The depth of distant points is inherently coarse, but the pixel position is not.
        let slope = |p: Point<View>| [p.x() / p.z(), p.y() / p.z()];
        for (one, other) in slope(view).into_iter().zip(slope(back)) {
            prop_assert!((one - other).abs() <= 1e-12 * (10.0 + one.abs()), "{one} {other}");
        }
    }

    #[test]
    fn unprojecting_inverts_projecting((lens, _) in lens(), point in point_ahead()) {
        let pixel = lens.project(point).expect("ahead");
        let back = lens.unproject(pixel, -point.z());
        let apart = (back - point).length();
        prop_assert!(apart <= 1e-9 * (point - Point::ORIGIN).length(), "{apart}");
    }

    #[test]
    fn frusta_and_lenses_without_skew_are_equivalent(f in frustum(), c in convention()) {
        // Mirrored windows do not have positive focal lengths.
        let (window, planes) = (f.window(), [f.near(), f.far()]);
        prop_assume!(window.left() < window.right() && window.bottom() < window.top());
        let lens = Intrinsics::from_frustum(f, [640, 480]).expect("a lens");
        let matrix = lens.view_to_clip(planes, c).expect("a matrix");
        prop_assert!(distance(matrix.raw(), f.view_to_clip(c).raw()) < 1e-12);
        let back: Frustum = lens.to_frustum(f.near(), f.far()).expect("a frustum");
        prop_assert!(distance(back.view_to_clip(c).raw(), f.view_to_clip(c).raw()) < 1e-12);
    }
}

#[test]
fn opencvs_example_of_a_calibrated_camera() {
    // The principal point is in the middle. With pixel centers at integers, that is (w − 1) / 2.
    let lens = Intrinsics::new([800.0, 800.0], [319.5, 239.5], [640, 480]).expect("a lens");
    let frustum = lens.to_frustum(1.0, 10.0).expect("a frustum");
    let [x, y] = [frustum.window().right(), frustum.window().top()];
    assert_eq!([x, y], [0.4, 0.3]);
    assert_eq!([frustum.window().left(), frustum.window().bottom()], [-0.4, -0.3]);
}

#[test]
fn invalid_intrinsics_are_rejected() {
    let size = [640, 480];
    let fault =
        |result: Result<Intrinsics, ProjectionError>| result.expect_err("invalid").to_string();
    assert_eq!(
        fault(Intrinsics::new([0.0, 1.0], [0.0; 2], size)),
        "`fx` is 0; it must be greater than 0"
    );
    assert!(fault(Intrinsics::new([1.0, 1.0], [f64::NAN, 0.0], size)).contains("`cx`"));
    assert!(fault(Intrinsics::new([1.0, 1.0], [0.0; 2], [0, 480])).contains("`width`"));
    assert!(fault(Intrinsics::new([1e-300, 1.0], [0.0; 2], size)).contains("intrinsics"));
    let rows = [[500.0, 0.0, 320.0], [1.0, 500.0, 240.0], [0.0, 0.0, 1.0]];
    assert!(fault(Intrinsics::from_rows(rows, size)).contains("`K[1][0]` is 1"));
    let skewed = Intrinsics::new([1.0, 1.0], [0.0; 2], size).and_then(|k| k.with_skew(2.0));
    let frustum = skewed.expect("a lens").to_frustum(1.0, 2.0);
    assert!(frustum.expect_err("skewed").to_string().contains("`skew` is 2"));
    assert!(skewed.expect("a lens").view_to_clip([2.0, 1.0], Convention::OPENGL).is_err());
}

#[test]
fn a_scaled_k_is_the_same_camera() {
    let rows = [[500.0, 1.0, 320.0], [0.0, 400.0, 240.0], [0.0, 0.0, 1.0]];
    let scaled = rows.map(|row| row.map(|entry| entry * 4.0));
    let size = [640, 480];
    assert_eq!(Intrinsics::from_rows(rows, size), Intrinsics::from_rows(scaled, size));
    assert_eq!(Intrinsics::from_rows(rows, size).expect("a lens").to_rows(), rows);
}
