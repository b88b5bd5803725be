//! Compares orbits, orientations, stereo rigs and screens in the world with their formulas.

use camera::{
    Basis, Camera, CameraError, CameraView, NamedView, Orbit, Orientation, ScreenCorners,
    StereoRig, ViewWindow, apex_moved_view,
};
use core::f64::consts::{FRAC_PI_2, PI};
use homog::{Affine, Model, Point, Vector, World};
use proptest::prelude::*;

const WINDOW: ViewWindow =
    ViewWindow { left: -1.0, right: 3.0, bottom: -2.0, top: 1.0, distance: 2.0 };

fn triple() -> impl Strategy<Value = [f64; 3]> {
    [-10.0..10.0, -10.0..10.0, -10.0..10.0]
}

fn camera() -> impl Strategy<Value = Camera> {
    (triple(), triple(), triple()).prop_filter_map("a valid gaze and view-up", |(eye, gaze, up)| {
        Camera::look_to(eye.into(), gaze.into(), up.into()).ok()
    })
}

fn window() -> impl Strategy<Value = ViewWindow> {
    (-2.0..2.0, 0.1..3.0, -2.0..2.0, 0.1..3.0, 0.1..5.0).prop_map(
        |(left, width, bottom, height, distance)| ViewWindow {
            left,
            right: left + width,
            bottom,
            top: bottom + height,
            distance,
        },
    )
}

/// Returns the position at which a view sees a point, as fractions of its window from the lower
/// left corner.
fn seen(view: CameraView, point: Point<World>) -> [f64; 2] {
    let p = view.camera.world_to_view().transform_point(point);
    let w = view.window;
    let (x, y) = (p.x() * w.distance / -p.z(), p.y() * w.distance / -p.z());
    [(x - w.left) / (w.right - w.left), (y - w.bottom) / (w.top - w.bottom)]
}

/// Returns the point at `distance` along the gaze whose image is at `at`, in fractions of the
/// window from the lower left corner.
fn point_ahead(camera: Camera, window: ViewWindow, at: [f64; 2], distance: f64) -> Point<World> {
    let x = window.left + (window.right - window.left) * at[0];
    let y = window.bottom + (window.top - window.bottom) * at[1];
    let on_window = camera.u() * x + camera.v() * y + camera.gaze() * window.distance;
    camera.eye() + on_window * (distance / window.distance)
}

fn close(a: Basis, b: Basis) -> bool {
    (a.u() - b.u()).length() + (a.v() - b.v()).length() + (a.w() - b.w()).length() < 1e-12
}

proptest! {
    #[test]
    fn orientations_round_trip(yaw in -3.1..3.1, pitch in -1.5..1.5, roll in -3.1..3.1) {
        let attitude = Orientation { yaw, pitch, roll };
        let back = Orientation::from_basis(attitude.basis().expect("finite"));
        for (got, want) in [(back.yaw, yaw), (back.pitch, pitch), (back.roll, roll)] {
            prop_assert!((got - want).abs() < 1e-12, "{back:?} is not {attitude:?}");
        }
    }

    #[test]
    fn an_orientation_is_the_product_of_three_rotations(
        yaw in -9.0..9.0, pitch in -9.0..9.0, roll in -9.0..9.0,
    ) {
        let basis = Orientation { yaw, pitch, roll }.basis().expect("finite");
        let turn = Affine::<Model, World>::rotation_z(roll)
            .then(Affine::<World, World>::rotation_x(pitch))
            .then(Affine::<World, World>::rotation_y(yaw));
        for (axis, image) in [(basis.u(), Vector::X), (basis.v(), Vector::Y), (basis.w(), Vector::Z)] {
            prop_assert!((axis - turn.transform_vector(image)).length() < 1e-14);
        }
    }

    #[test]
    fn every_basis_has_an_orientation(camera in camera()) {
        let again = Orientation::from_basis(camera.basis()).basis().expect("finite");
        prop_assert!(close(again, camera.basis()));
    }

    #[test]
    fn orbits_look_at_their_target_and_round_trip(
        target in triple(), azimuth in -3.1..3.1, elevation in -1.57..1.57, distance in 0.1..50.0,
    ) {
        let orbit = Orbit { target: target.into(), azimuth, elevation, distance };
        let camera = orbit.camera().expect("valid");
        let middle = camera.world_to_view().transform_point(orbit.target);
        prop_assert!((middle - Point::new(0.0, 0.0, -distance)).length() < 1e-12);
        let back = Orbit::from_camera(camera, orbit.target).expect("a level camera");
        prop_assert!((back.azimuth - azimuth).abs() < 1e-9);
        prop_assert!((back.elevation - elevation).abs() < 1e-9);
        prop_assert!((back.distance - distance).abs() < 1e-12);
        let tilted = Camera::new(camera.eye(), camera.basis().rolled(0.1).expect("finite"));
        prop_assert_eq!(Orbit::from_camera(tilted.expect("valid"), orbit.target), None);
    }

    #[test]
    fn stereo_pairs_coincide_only_at_zero_parallax(
        middle in camera(), window in window(), at in [0.0..1.0, 0.0..1.0],
        interocular in 0.01..1.0, zero_parallax in 0.5..20.0, distance in 0.5..40.0,
    ) {
        let rig = StereoRig { interocular, zero_parallax };
        let pair = rig.off_axis_pair(middle, window).expect("valid");
        let ahead = |distance: f64| point_ahead(middle, window, at, distance);

        // In the plane of zero parallax, both eyes and the middle camera see the same point.
        let [left, right] = [pair.left, pair.right].map(|eye| seen(eye, ahead(zero_parallax)));
        for i in 0..2 {
            prop_assert!((left[i] - right[i]).abs() < 1e-10 && (left[i] - at[i]).abs() < 1e-10);
        }
        // Elsewhere they differ by the parallax, but never vertically.
        let [left, right] = [pair.left, pair.right].map(|eye| seen(eye, ahead(distance)));
        let width = (window.right - window.left) * zero_parallax / window.distance;
        let parallax = rig.parallax(distance).expect("positive");
        prop_assert!(((right[0] - left[0]) * width - parallax).abs() < 1e-9);
        prop_assert!((right[1] - left[1]).abs() < 1e-10);
    }

    #[test]
    fn c65_the_apex_moved_variant_agrees_only_on_the_plane_of_the_window(
        camera in camera(), window in window(), at in [0.0..1.0, 0.0..1.0],
    ) {
        let whole = CameraView { camera, window };
        let moved = apex_moved_view(camera, window).expect("valid");
        prop_assert!((moved.window.left + moved.window.right).abs() < 1e-15);
        let [on_window, behind] =
            [1.0, 2.0].map(|times| point_ahead(camera, window, at, times * window.distance));
        let apart = |p: Point<World>| {
            let (a, b) = (seen(whole, p), seen(moved, p));
            (a[0] - b[0]).abs() + (a[1] - b[1]).abs()
        };
        prop_assert!(apart(on_window) < 1e-9);
        let off_axis = (window.left + window.right).abs() / (window.right - window.left);
        prop_assert!(apart(behind) >= 0.2 * off_axis, "{} behind the window", apart(behind));
    }

    #[test]
    fn a_screen_looks_like_a_hole_in_the_wall(camera in camera(), size in [0.1..5.0, 0.1..5.0], eye in triple()) {
        let (u, v) = (camera.u() * size[0], camera.v() * size[1]);
        let corner = camera.eye();
        let screen =
            ScreenCorners { lower_left: corner, lower_right: corner + u, upper_left: corner + v };
        let eye = corner + camera.w() * (0.1 + eye[2].abs()) + u * eye[0] + v * eye[1];
        let view = screen.view_from(eye).expect("the eye is in front");
        for (point, want) in [
            (screen.lower_left, [0.0, 0.0]),
            (screen.lower_right, [1.0, 0.0]),
            (screen.upper_left, [0.0, 1.0]),
            (eye.lerp(corner + u * 0.25 + v * 0.5, 3.0), [0.25, 0.5]), // far behind it
        ] {
            let got = seen(view, point);
            prop_assert!((got[0] - want[0]).abs() + (got[1] - want[1]).abs() < 1e-9, "{got:?}, {want:?}");
        }
    }
}

#[test]
fn orbits_pass_through_the_named_views_including_the_poles() {
    let quarter = FRAC_PI_2;
    for (azimuth, elevation, view) in [
        (0.0, 0.0, NamedView::Front),
        (quarter, 0.0, NamedView::Right),
        (PI, 0.0, NamedView::Back),
        (-quarter, 0.0, NamedView::Left),
        (0.0, quarter, NamedView::Top),
        (0.0, -quarter, NamedView::Bottom),
        (PI / 4.0, libm::asin(1.0 / libm::sqrt(3.0)), NamedView::Isometric),
    ] {
        let basis = Basis::from_azimuth_elevation(azimuth, elevation).expect("finite");
        assert!(close(basis, view.basis()), "{view}: {basis:?}");
    }
}

#[test]
fn an_orbit_too_far_to_measure_is_rejected() {
    let orbit = |size: f64| {
        let target = Point::new(-size, 0.0, -size);
        Orbit::from_camera(
            Camera::look_at(Point::ORIGIN, target, Vector::Y).expect("a gaze"),
            target,
        )
    };
    assert!(orbit(1e308).is_some());
    assert_eq!(orbit(1.5e308), None, "√2 times that is out of range");
}

#[test]
fn a_turntable_closes_without_repeating_its_first_frame() {
    let start = Orbit { target: Point::ORIGIN, azimuth: 0.3, elevation: 0.2, distance: 2.0 };
    let places: Vec<Orbit> = start.turntable(8).collect();
    assert_eq!((places.len(), places[0]), (8, start));
    assert!((places[7].azimuth + PI / 4.0 - (0.3 + 2.0 * PI)).abs() < 1e-15);
    assert_eq!(start.turntable(0).len(), 0);
}

#[test]
fn orientations_turn_in_the_documented_directions() {
    let gaze = |yaw: f64, pitch: f64| {
        Orientation { yaw, pitch, roll: 0.0 }.basis().expect("finite").gaze()
    };
    assert!(gaze(0.1, 0.0).x() < 0.0, "positive yaw looks left");
    assert!(gaze(0.0, 0.1).y() > 0.0, "positive pitch looks up");
    let tipped = Basis::WORLD.rolled(0.1).expect("finite");
    assert!(tipped.v().x() < 0.0, "positive roll tips the camera to the left");
    let up = Orientation { yaw: 0.5, pitch: FRAC_PI_2, roll: 0.25 }.basis().expect("finite");
    let read = Orientation::from_basis(up);
    assert_eq!(read.roll, 0.0);
    assert!(
        close(read.basis().expect("finite"), up),
        "yaw contains the whole rotation when looking straight up"
    );
}

#[test]
fn apex_moved_pairs_do_not_coincide_at_the_requested_distance() {
    let middle = Camera::new(Point::ORIGIN, Basis::WORLD).expect("valid");
    let rig = StereoRig { interocular: 0.5, zero_parallax: 8.0 };
    let meeting = Point::new(0.0, 0.0, -8.0);
    let across =
        |pair: camera::StereoPair| seen(pair.right, meeting)[0] - seen(pair.left, meeting)[0];
    assert!(across(rig.off_axis_pair(middle, WINDOW).expect("valid")).abs() < 1e-15);
    let wrong = rig.pair_apex_moved(middle, WINDOW).expect("valid");
    assert!(across(wrong).abs() > 0.01);
    let apart = wrong.right.camera.eye().x() - wrong.left.camera.eye().x();
    assert_eq!(apart, 0.5 * (1.0 - 2.0 / 8.0), "the eyes are closer than requested");
}

#[test]
fn a_camera_node_may_be_scaled_and_mirrored() {
    let node = Affine::<Model, Model>::scale(-2.0, 3.0, 0.5)
        .then(Affine::<Model, Model>::rotation_y(0.5))
        .then(Affine::<Model, World>::translation(Vector::new(1.0, 2.0, 3.0)));
    let camera = Camera::from_frame(node).expect("not flat");
    assert_eq!(camera.eye(), Point::new(1.0, 2.0, 3.0));
    let turned = Basis::from_azimuth_elevation(0.5, 0.0).expect("finite");
    assert!(close(camera.basis(), turned), "neither scaling nor mirroring turns a camera");
    let flat = Camera::from_frame(Affine::<Model, World>::scale(1.0, 1.0, 0.0));
    assert_eq!(flat, Err(CameraError::ZeroGaze));
}

#[test]
fn rigs_reject_invalid_parameters() {
    let camera = Camera::new(Point::ORIGIN, Basis::WORLD).expect("valid");
    let rig = StereoRig { interocular: 0.06, zero_parallax: 2.0 };
    let is_not_positive =
        |got: Result<_, CameraError>| matches!(got, Err(CameraError::NotPositive { .. }));
    assert!(is_not_positive(
        StereoRig { interocular: 0.0, ..rig }.off_axis_pair(camera, WINDOW).map(drop)
    ));
    assert!(is_not_positive(
        StereoRig { zero_parallax: -1.0, ..rig }.off_axis_pair(camera, WINDOW).map(drop)
    ));
    assert!(is_not_positive(
        rig.off_axis_pair(camera, ViewWindow { distance: 0.0, ..WINDOW }).map(drop)
    ));
    assert!(is_not_positive(rig.parallax(0.0).map(drop)));
    assert!(is_not_positive(WINDOW.at_distance(-1.0).map(drop)));
    let nan = StereoRig { interocular: f64::NAN, ..rig }.off_axis_pair(camera, WINDOW);
    assert!(matches!(nan, Err(CameraError::NumberNotFinite { .. })));
    let empty = ViewWindow { left: 3.0, ..WINDOW };
    assert!(matches!(apex_moved_view(camera, empty), Err(CameraError::EmptyWindow { .. })));
    let huge = ViewWindow { right: 1e300, ..WINDOW };
    assert!(matches!(apex_moved_view(camera, huge), Err(CameraError::TooLarge { .. })));

    let orbit = Orbit { target: Point::ORIGIN, azimuth: 0.0, elevation: 0.0, distance: 1.0 };
    assert!(is_not_positive(Orbit { distance: 0.0, ..orbit }.camera().map(drop)));
    let lost = Orbit { azimuth: f64::INFINITY, ..orbit }.camera();
    assert!(matches!(lost, Err(CameraError::NumberNotFinite { name: "azimuth", .. })));
    let nowhere = Orbit { target: Point::new(f64::NAN, 0.0, 0.0), ..orbit }.camera();
    assert!(matches!(nowhere, Err(CameraError::NotFinite { name: "target", .. })));
}

#[test]
fn screens_must_be_rectangles_in_front_of_the_eye() {
    let o = Point::<World>::ORIGIN;
    let wall =
        ScreenCorners { lower_left: o, lower_right: o + Vector::X, upper_left: o + Vector::Y };
    let front = Point::new(0.5, 0.5, 2.0);
    assert!(wall.view_from(front).is_ok());
    let behind = wall.view_from(Point::new(0.5, 0.5, -2.0));
    assert_eq!(behind, Err(CameraError::EyeBehindScreen { distance: -2.0 }));
    assert_eq!(wall.view_from(o + Vector::X), Err(CameraError::EyeBehindScreen { distance: 0.0 }));
    let flat = ScreenCorners { upper_left: o, ..wall };
    assert_eq!(flat.view_from(front), Err(CameraError::FlatScreen { corner: o }));
    let skewed = ScreenCorners { upper_left: o + Vector::X + Vector::Y, ..wall };
    assert!(matches!(skewed.view_from(front), Err(CameraError::SkewedScreen { .. })));
    let nan = ScreenCorners { lower_right: Point::new(f64::NAN, 0.0, 0.0), ..wall };
    assert!(matches!(
        nan.view_from(front),
        Err(CameraError::NotFinite { name: "lower right corner", .. })
    ));
}
