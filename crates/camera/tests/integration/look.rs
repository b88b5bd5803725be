//! Look-at and look-to: the chapter's exercise, misprints in the sources, algebraic properties, and
//! every error.

use camera::{Basis, Camera, CameraError};
use homog::{Affine, Point, Vector, World};
use proptest::prelude::*;

fn v(x: f64, y: f64, z: f64) -> Vector<World> {
    Vector::new(x, y, z)
}

fn triple() -> impl Strategy<Value = [f64; 3]> {
    [-100.0..100.0, -100.0..100.0, -100.0..100.0]
}

fn camera() -> impl Strategy<Value = Camera> {
    (triple(), triple(), triple()).prop_filter_map("a valid gaze and view-up", |(eye, gaze, up)| {
        Camera::look_to(eye.into(), gaze.into(), up.into()).ok()
    })
}

proptest! {
    #[test]
    fn c11_axes_are_orthonormal_and_right_handed(camera in camera()) {
        let (u, v, w) = (camera.u(), camera.v(), camera.w());
        for (name, value, want) in [
            ("u·u", u.dot(u), 1.0), ("v·v", v.dot(v), 1.0), ("w·w", w.dot(w), 1.0),
            ("u·v", u.dot(v), 0.0), ("v·w", v.dot(w), 0.0), ("w·u", w.dot(u), 0.0),
            ("det", u.dot(v.cross(w)), 1.0),
        ] {
            prop_assert!((value - want).abs() < 1e-15, "{name} = {value}");
        }
    }

    #[test]
    fn c12_m_cam_has_an_inverse_and_maps_the_eye_to_the_origin(
        camera in camera(), p in triple(),
    ) {
        let p = Point::<World>::from(p);
        let back = camera.view_to_world().transform_point(camera.world_to_view().transform_point(p));
        prop_assert!((back - p).length() < 1e-12, "{p} becomes {back}");
        prop_assert!((camera.world_to_view().transform_point(camera.eye()) - Point::ORIGIN).length() < 1e-13);
        let ahead = camera.world_to_view().transform_point(camera.eye() + camera.gaze() * 2.0);
        prop_assert!((ahead - Point::new(0.0, 0.0, -2.0)).length() < 1e-12);
    }

    #[test]
    fn lengths_of_gaze_and_up_do_not_matter(camera in camera(), a in -900..900, b in -900..900) {
        let scale = |exponent: i32| libm::scalbn(1.0, exponent);
        let again = Camera::look_to(camera.eye(), camera.gaze() * scale(a), camera.v() * scale(b));
        let again = again.expect("only the lengths changed");
        prop_assert!((again.u() - camera.u()).length() < 1e-15);
    }
}

#[test]
fn exercise_10_c46_camera_above_looking_down() {
    let camera = Camera::look_to(Point::new(0.0, 1.0, 0.0), v(0.0, -1.0, 0.0), v(1.0, 1.0, 0.0))
        .expect("the exercise's camera");
    assert_eq!(camera.u(), v(0.0, 0.0, 1.0));
    assert_eq!(camera.v(), v(1.0, 0.0, 0.0));
    assert_eq!(camera.w(), v(0.0, 1.0, 0.0));
    let rows = camera.world_to_view().raw().transpose().to_cols_array_2d();
    let want =
        [[0.0, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, -1.0], [0.0, 0.0, 0.0, 1.0]];
    assert_eq!(rows, want);
}

/// Chapter §10 no. 18: one set of notes prints the third row of the translation as (0, 0, 0, −ze).
#[test]
fn misprint_m11_a_translation_without_the_diagonal_one_is_singular() {
    let eye = Point::<World>::new(1.0, 2.0, 3.0);
    let camera = Camera::new(eye, Basis::WORLD).expect("a finite eye");
    let mut printed = camera.translation().raw();
    printed.z_axis.z = 0.0;
    let printed = Affine::<World, World>::from_raw(printed).expect("still affine");
    assert_eq!(printed.determinant(), 0.0, "the printed matrix has no inverse");
    let depth = |map: Affine<World, World>, z: f64| {
        map.then(camera.rotation()).transform_point(Point::new(0.0, 0.0, z)).z()
    };
    assert_eq!(
        (depth(printed, 0.0), depth(printed, -7.0)),
        (-3.0, -3.0),
        "all have the same depth"
    );
    assert_eq!(
        (depth(camera.translation(), 0.0), depth(camera.translation(), -7.0)),
        (-3.0, -10.0)
    );
    assert_eq!(camera.translation().then(camera.rotation()), camera.world_to_view());
}

/// Some notes say that the camera looks "from the −z axis". In fact it is at the origin of camera
/// space and looks along −z, so its target is on the −z axis.
#[test]
fn misprint_m11b_the_camera_looks_along_minus_z_and_is_at_the_origin() {
    let (eye, target) = (Point::new(4.0, -1.0, 2.0), Point::new(1.0, 3.0, 2.0));
    let camera = Camera::look_at(eye, target, Vector::Z).expect("a gaze");
    let view = camera.world_to_view();
    assert!((view.transform_point(target) - Point::new(0.0, 0.0, -5.0)).length() < 1e-14);
    assert!((view.transform_point(eye) - Point::ORIGIN).length() < 1e-15);
}

#[test]
fn up_a_millionth_of_a_radian_from_the_gaze_loses_no_digits() {
    let t = 1e-6;
    let camera =
        Camera::look_to(Point::ORIGIN, v(1.0, 2.0, 3.0), v(1.0 + t, 2.0, 3.0)).expect("valid");
    // t × w is along (0, −3, 2) for any t.
    let want = v(0.0, 3.0, -2.0) / libm::sqrt(13.0);
    assert!((camera.u() + want).length() < 1e-15 || (camera.u() - want).length() < 1e-15);
}

#[test]
fn camera_errors_report_the_offending_values() {
    let at = |x: f64, y: f64, z: f64| Point::<World>::new(x, y, z);
    let (o, y, z) = (Point::ORIGIN, Vector::Y, Vector::Z);
    let nan = f64::NAN;
    assert_eq!(Camera::look_to(o, Vector::ZERO, y), Err(CameraError::ZeroGaze));
    assert_eq!(Camera::look_to(o, z, Vector::ZERO), Err(CameraError::ZeroUp));
    let here = at(1.0, 2.0, 3.0);
    assert_eq!(Camera::look_at(here, here, y), Err(CameraError::TargetIsEye { eye: here }));
    for length in [1e-300, 1.0, -1e300] {
        assert_eq!(
            Camera::look_to(o, v(0.0, -3.0, 0.0), y * length),
            Err(CameraError::UpParallelToGaze {
                up: y * length,
                gaze: v(0.0, -3.0, 0.0),
                suggestion: -z
            })
        );
    }
    let oblique = v(0.1, 0.2, 0.3);
    let thrice = Camera::look_to(o, oblique, v(0.3, 0.6, 0.9));
    assert!(matches!(thrice, Err(CameraError::UpParallelToGaze { .. })), "parallel up to rounding");
    for (got, name) in [
        (Camera::look_to(at(nan, 0.0, 0.0), z, y), "eye"),
        (Camera::look_at(at(f64::INFINITY, 0.0, 0.0), o, y), "eye"),
        (Camera::look_at(o, at(0.0, nan, 0.0), y), "target"),
        (Camera::look_to(o, v(nan, 0.0, 0.0), y), "gaze"),
        (Camera::look_to(o, z, v(0.0, f64::NEG_INFINITY, 0.0)), "view-up"),
    ] {
        assert!(
            matches!(got, Err(CameraError::NotFinite { name: said, .. }) if said == name),
            "{got:?} should mention the {name}"
        );
    }
    let far = Camera::look_to(at(f64::MAX, 0.0, 0.0), z, y);
    assert!(matches!(far, Err(CameraError::EyeTooFar { .. })));
}

#[test]
fn messages_contain_values_and_a_remedy() {
    let top =
        Camera::look_to(Point::ORIGIN, v(0.0, -1.0, 0.0), Vector::Y).expect_err("up is parallel");
    assert_eq!(
        top.to_string(),
        "the view-up (0, 1, 0) is parallel to the gaze (0, -1, 0): choose another view-up, such \
         as (0, 0, -1)"
    );
}

#[test]
fn the_fallback_allows_top_views_but_not_a_zero_gaze() {
    let o = Point::ORIGIN;
    for (gaze, up) in [
        (v(0.0, -2.0, 0.0), -Vector::Z),
        (v(0.0, 5.0, 0.0), Vector::Z),
        (v(0.0, 0.0, -1.0), Vector::Y),
        (v(4.0, 0.0, 0.0), Vector::Y),
    ] {
        let camera = Camera::look_to_or_fallback(o, gaze, gaze).expect("the fallback applies");
        assert_eq!(camera.v(), up, "looking along {gaze}");
        assert_eq!(Camera::look_to_or_fallback(o, gaze, Vector::ZERO), Ok(camera));
        assert_eq!(Camera::look_at_or_fallback(o, o + gaze, gaze), Ok(camera));
    }
    assert_eq!(Camera::look_to_or_fallback(o, Vector::ZERO, Vector::Y), Err(CameraError::ZeroGaze));
    let usual = Camera::look_to(o, v(1.0, 2.0, 3.0), Vector::Y);
    assert_eq!(Camera::look_to_or_fallback(o, v(1.0, 2.0, 3.0), Vector::Y), usual);
}

#[test]
fn eye_and_target_at_opposite_ends_of_the_range_give_a_direction() {
    let far = f64::MAX / 4.0;
    let camera =
        Camera::look_at(Point::new(0.0, 0.0, far), Point::new(0.0, 0.0, -f64::MAX), Vector::Y);
    assert_eq!(camera.expect("both finite").w(), Vector::Z);
}
