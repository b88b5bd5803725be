//! Distance and depth: the conversions are monotone and inverse to each other, and the resolution
//! matches the formulas (ZP-1, LW-3).

use super::samples::{self, convention, frustum, orthographic, planes};
use homog::Point;
use projection::{Convention, DepthCurve, DepthFormat, Frustum, ProjectionError, third_row};
use proptest::prelude::*;

proptest! {
    #![proptest_config(samples::cases(128))]

    #[test]
    fn the_curve_matches_the_matrix(
        f in frustum(),
        o in orthographic(),
        c in convention(),
        t in 0.0..1.0,
    ) {
        let far = f.far().min(1e3 * f.near());
        let distance = f.near() + t * (far - f.near());
        let seen = f
            .view_to_clip(c)
            .transform_point(Point::new(0.0, 0.0, c.ahead() * distance))
            .divide()
            .expect("in front");
        let depth = f.depth_curve(c).depth(distance).expect("in front");
        prop_assert!((seen.z() - depth).abs() < 1e-10);
        let distance = o.near() + t * (o.far() - o.near());
        let seen = o
            .view_to_clip(c)
            .transform_point(Point::new(0.0, 0.0, c.ahead() * distance))
            .divide()
            .expect("affine");
        prop_assert!((seen.z() - o.depth_curve(c).depth(distance).expect("finite")).abs() < 1e-10);
    }

    #[test]
    fn linearizing_inverts_the_curve((near, far) in planes(), c in convention(), t in 0.0..1.0) {
        let curve = DepthCurve::perspective(near, far, c).expect("valid");
        let distance = near + t * (far.min(1e4 * near) - near);
        let back = curve.distance(curve.depth(distance).expect("in front")).expect("finite");
        // A rounding error in the depth changes the distance by this much.
        let blur = 4.0 * f64::EPSILON / curve.slope(distance).expect("in front").abs();
        prop_assert!(
            (back - distance).abs() <= 1e-12 * distance + blur,
            "{back} is not {distance}"
        );
    }

    /// C41, exercise 4: the order along the line of sight is preserved.
    #[test]
    fn depth_preserves_the_order_of_distances(
        (near, far) in planes(),
        c in convention(),
        a in 0.0..1.0,
        b in 0.0..1.0,
    ) {
        let curve = DepthCurve::perspective(near, far, c).expect("valid");
        let at = |t: f64| near * libm::pow(far.min(1e4 * near) / near, t);
        let towards = c.far_depth() - c.near_depth();
        let (da, db) =
            (curve.depth(at(a)).expect("in front"), curve.depth(at(b)).expect("in front"));
        prop_assert!((db - da) * towards * (b - a) >= -1e-12);
    }

    /// C68: depth reaches the middle of its range at 2FN/(F + N).
    #[test]
    fn half_of_the_range_is_used_at_the_half_range_distance(
        (near, far) in planes(),
        c in convention(),
    ) {
        let curve = DepthCurve::perspective(near, far, c).expect("valid");
        let half = curve.half_range_distance();
        let middle = 0.5 * (c.near_depth() + c.far_depth());
        prop_assert!((curve.depth(half).expect("in front") - middle).abs() < 1e-9);
        prop_assert!(half <= 2.0 * near);
    }

    #[test]
    fn slope_is_the_derivative((near, far) in planes(), c in convention(), t in 0.1..3.0) {
        let curve = DepthCurve::perspective(near, far, c).expect("valid");
        let (distance, step) = (near * (1.0 + t), near * 1e-5);
        let rise = curve.depth(distance + step).expect("in front")
            - curve.depth(distance - step).expect("in front");
        let slope = curve.slope(distance).expect("in front");
        prop_assert!((rise / (2.0 * step) / slope - 1.0).abs() < 1e-4);
    }

    #[test]
    fn reversed_float_depth_has_the_resolution_of_the_formula(near in 0.001..1.0, t in 0.0..1.0) {
        // Without a far plane, ΔD ≤ 2⁻²³ D everywhere. The resolution of forward depth degrades
        // with D².
        let reversed = DepthCurve::perspective(near, f64::INFINITY, Convention::WEBGPU.reversed())
            .expect("valid");
        let distance = near * libm::exp10(5.0 * t);
        let step = reversed.resolution(distance, DepthFormat::Float32).expect("in front");
        prop_assert!(step > 0.0 && step <= 1.0001 * distance * libm::ldexp(1.0, -23));
        let forward = DepthCurve::perspective(near, 1e6 * near, Convention::WEBGPU).expect("valid");
        let coarse = forward.resolution(distance, DepthFormat::Float32).expect("in front");
        prop_assert!(
            distance < 4.0 * near
                || coarse >= 0.4 * distance * distance / near * libm::ldexp(1.0, -24)
        );
    }

    #[test]
    fn fixed_point_gains_nothing_from_reversal((near, far) in planes(), t in 0.0..1.0) {
        let distance = near * (1.0 + 20.0 * t);
        let step = |c: Convention| {
            let curve = DepthCurve::perspective(near, far, c).expect("valid");
            curve.resolution(distance, DepthFormat::FixedPoint(24)).expect("in front")
        };
        let (forward, reversed) = (step(Convention::WEBGPU), step(Convention::WEBGPU.reversed()));
        prop_assert!((forward / reversed - 1.0).abs() < 1e-9);
        prop_assert!((step(Convention::OPENGL) / forward - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_third_row_can_be_solved_for_any_range(
        z1 in 0.1_f64..5.0,
        z2 in 5.5_f64..90.0,
        v1 in -1.0..1.0,
        v2 in -1.0..1.0,
    ) {
        let (a, b) = third_row((-z1, v1), (-z2, v2)).expect("two planes");
        prop_assert!((a - b / z1 - v1).abs() < 1e-12 && (a - b / z2 - v2).abs() < 1e-12);
    }
}

/// C56: in (a z + b)/(−z), a = −(F+N)/(F−N) and b = −2FN/(F−N), so A = −a and B = −b.
#[test]
fn the_opengl_row_is_solved_from_its_two_conditions() {
    let (a, b) = third_row((-2.0, -1.0), (-40.0, 1.0)).expect("two planes");
    assert!((a - 42.0 / 38.0).abs() < 1e-15 && (b - 160.0 / 38.0).abs() < 1e-14);
    let row = Frustum::new(-1.0, 1.0, -1.0, 1.0, 2.0, 40.0)
        .expect("valid")
        .view_to_clip(Convention::OPENGL);
    assert!((row.raw().z_axis.z + a).abs() < 1e-15 && (row.raw().w_axis.z + b).abs() < 1e-14);
}

/// LW-3, C67, C68: tests three rows of the table from 2 to 40, and the constants c1 and c2.
#[test]
fn the_curve_reproduces_the_lessons_table() {
    let curve = DepthCurve::perspective(2.0, 40.0, Convention::OPENGL).expect("valid");
    let table: Vec<_> =
        curve.table([2.0, 3.8, 40.0]).map(|(_, depth)| depth.expect("in front")).collect();
    assert_eq!((table[0], table[2]), (-1.0, 1.0));
    assert!((table[1] + 1.0 / 361.0).abs() < 1e-15);
    let (c2, c1) = curve.coefficients();
    assert!((c1 + 80.0 / 19.0).abs() < 1e-15 && (c2 - 21.0 / 19.0).abs() < 1e-15);
}

#[test]
fn missing_depth_is_none() {
    let curve = DepthCurve::perspective(1.0, f64::INFINITY, Convention::WEBGPU).expect("valid");
    assert_eq!(curve.depth(0.0), None);
    assert_eq!(curve.depth(f64::NAN), None);
    assert_eq!(curve.distance(1.0), None, "infinitely far away");
    assert_eq!(curve.distance(f64::NAN), None);
    assert_eq!(curve.slope(0.0), None);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            curve.resolution(bad, DepthFormat::Float32),
            Err(ProjectionError::NotFinite { .. } | ProjectionError::OutOfRange { .. })
        ));
    }
    assert!(matches!(
        curve.resolution(2.0, DepthFormat::FixedPoint(0)),
        Err(ProjectionError::OutOfRange { .. })
    ));
    assert!(matches!(
        curve.resolution(2.0, DepthFormat::FixedPoint(65)),
        Err(ProjectionError::OutOfRange { .. })
    ));
    assert!(matches!(third_row((0.0, 1.0), (1.0, 2.0)), Err(ProjectionError::OutOfRange { .. })));
    assert!(matches!(third_row((1.0, 1.0), (1.0, 2.0)), Err(ProjectionError::EmptyDepth { .. })));
    assert!(matches!(
        DepthCurve::parallel(1.0, 1.0, Convention::OPENGL),
        Err(ProjectionError::EmptyDepth { .. })
    ));
}
