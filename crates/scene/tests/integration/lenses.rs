//! Compares lenses and windows in scene files with the formulas of the sources (FOV-1, OR-1, LW-1),
//! and checks that hand-written values survive formatting.

use glam::DMat4;
use import::{ImportOptions, load};
use model::{Model, ModelInstance};
use scene::{Origin, Scene};
use scene_file::{format_source, parse_scene};
use std::path::Path;
use std::sync::Arc;

fn crate_model() -> Arc<Model> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/models/crate.glb");
    Arc::new(load(&path, &ImportOptions::default()).expect("a model"))
}

fn text(camera: &str) -> String {
    format!("Scene(models: [(path: \"crate.glb\")], camera: ({camera}), image: (size: (400, 200)))")
}

/// Returns a scene with this camera, in a picture twice as wide as it is high.
fn scene(camera: &str) -> Scene {
    let text = text(camera);
    let file = parse_scene("lens.ron", &text).expect("a scene");
    let origin = Origin::from_text("lens.ron", text, Path::new("").to_owned());
    let model_to_world = homog::Affine::scale(1.0, 1.0, 1.0);
    let instance = ModelInstance { model: crate_model(), model_to_world };
    Scene::from_models(&origin, &file, &[instance]).expect("a scene")
}

/// Returns the view-to-clip matrix of a projection, seen from (0, 0, 9).
fn matrix(projection: &str) -> DMat4 {
    let camera =
        format!("view: LookTo(eye: (0, 0, 9), gaze: (0, 0, -1)), projection: {projection}");
    scene(&camera).view_projection.view_to_clip.raw()
}

fn check_close(actual: f64, expected: f64) {
    assert!((actual - expected).abs() < 1e-12, "{actual} is not {expected}");
}

/// FOV-1: the angle is between the midpoints of opposite borders, or between opposite corners.
#[test]
fn horizontal_and_diagonal_fields_of_view_match_fov_1() {
    for degrees in [20.0_f64, 60.0, 110.0] {
        let slope = libm::tan(0.5 * degrees.to_radians());
        let across = matrix(&format!("Perspective(fov_x_degrees: {degrees})"));
        check_close(across.x_axis.x, 1.0 / slope);
        check_close(across.y_axis.y, 2.0 / slope);
        let diagonal = matrix(&format!("Perspective(fov_diagonal_degrees: {degrees})"));
        let [x, y] = [1.0 / diagonal.x_axis.x, 1.0 / diagonal.y_axis.y];
        check_close(x, 2.0 * y);
        check_close(libm::hypot(x, y), slope);
        // The same field of view can also be specified vertically.
        let vertical = 2.0 * libm::atan(slope / 2.0).to_degrees();
        let by_height = matrix(&format!("Perspective(fov_y_degrees: {vertical:?})"));
        check_close(by_height.x_axis.x, across.x_axis.x);
    }
}

/// GL-1: a shifted lens is a frustum whose window is moved by fractions of the longer side.
#[test]
fn a_shift_moves_the_window_by_fractions_of_the_longer_side() {
    for (size, longer) in [("(400, 200)", [2.0, 4.0]), ("(200, 400)", [4.0, 2.0])] {
        let camera = "view: LookTo(eye: (0, 0, 9), gaze: (0, 0, -1)), projection: Perspective(fov_y_degrees: 40, shift: (0.1, -0.25))";
        let text = text(camera).replace("(400, 200)", size);
        let file = parse_scene("lens.ron", &text).expect("a scene");
        let origin = Origin::from_text("lens.ron", text, Path::new("").to_owned());
        let model_to_world = homog::Affine::scale(1.0, 1.0, 1.0);
        let instance = ModelInstance { model: crate_model(), model_to_world };
        let scene = Scene::from_models(&origin, &file, &[instance]).expect("a scene");
        let shifted = scene.view_projection.view_to_clip.raw();
        // The picture's sides have length 2 in NDC, and the point straight ahead is (0, 0, −1).
        let [x, y] = longer;
        check_close(-shifted.z_axis.x, -0.1 * x);
        check_close(-shifted.z_axis.y, 0.25 * y);
        check_close(shifted.y_axis.y, 1.0 / libm::tan(20.0_f64.to_radians()));
    }
}

/// A zero shift equals no shift, to the last bit.
#[test]
fn a_zero_shift_changes_no_bits() {
    assert_eq!(matrix("Perspective(fov_y_degrees: 40)"), {
        matrix("Perspective(fov_y_degrees: 40, shift: (0, 0))")
    });
}

/// OR-1: the window and the planes become the borders of the canonical volume.
#[test]
fn orthographic_windows_match_or_1() {
    let m = matrix("Orthographic(left: -1, right: 5, bottom: 2, top: 4, near: 3, far: 11)");
    let (l, r, b, t) = (-1.0, 5.0, 2.0, 4.0);
    check_close(m.x_axis.x, 2.0 / (r - l));
    check_close(m.w_axis.x, -(r + l) / (r - l));
    check_close(m.y_axis.y, 2.0 / (t - b));
    check_close(m.w_axis.y, -(t + b) / (t - b));
    // The chapter's n = −3 and f = −11, with the near plane at +1.
    check_close(m.z_axis.z, 2.0 / 8.0);
    check_close(m.w_axis.z, 14.0 / 8.0);
}

/// LW-1: Eq9 of the lesson, with the depth of the chapter's canonical volume.
#[test]
fn the_lesson_frustum_moves_its_apex() {
    let m = matrix("ApexMovedFrustum(left: -1, right: 3, bottom: -2, top: 1, near: 2, far: 40)");
    let (l, r, b, t, n, f) = (-1.0, 3.0, -2.0, 1.0, 2.0, 40.0);
    let rows = m.transpose();
    assert_eq!([rows.x_axis.y, rows.x_axis.z, rows.y_axis.x, rows.y_axis.z], [0.0; 4]);
    check_close(rows.x_axis.x, 2.0 * n / (r - l));
    check_close(rows.x_axis.w, -n * (r + l) / (r - l));
    check_close(rows.y_axis.y, 2.0 * n / (t - b));
    check_close(rows.y_axis.w, -n * (t + b) / (t - b));
    check_close(rows.z_axis.z, (f + n) / (f - n));
    check_close(rows.z_axis.w, 2.0 * f * n / (f - n));
    assert_eq!(rows.w_axis.to_array(), [0.0, 0.0, -1.0, 0.0]);
}

/// Framing respects the window: the models are inside the picture and touch its margin.
#[test]
fn framed_views_fill_the_window_of_every_lens() {
    for projection in [
        "Perspective(fov_x_degrees: 50)",
        "Perspective(fov_diagonal_degrees: 90, shift: (0.2, -0.1))",
        "Perspective(shift: (0, 0.4))",
        "ApexMovedFrustum(left: -0.4, right: 1.2, bottom: -0.1, top: 0.7, near: 1)",
    ] {
        let scene = scene(&format!("view: Frame(padding_percent: 5), projection: {projection}"));
        let world_to_clip = scene.view_projection.world_to_clip();
        let mut reach = 0.0_f64;
        for point in scene.world_points() {
            let ndc = world_to_clip.transform_point(point).divide().expect("a place");
            reach = reach.max(ndc.x().abs()).max(ndc.y().abs());
        }
        assert!((0.8..=0.9 + 1e-9).contains(&reach), "{projection}: {reach}");
    }
}

#[test]
fn values_from_the_sources_survive_formatting() {
    for projection in [
        "Perspective(fov_x_degrees: 50, shift: (0.1, -0.2))",
        "Perspective(fov_diagonal_degrees: 50, near: 1, far: 9)",
        "Orthographic(left: -1, right: 1, bottom: -0.5, top: 0.5, near: 0, far: 9)",
        "ApexMovedFrustum(left: -1, right: 3, bottom: -2, top: 1, near: 2, far: 40)",
    ] {
        let text = text(&format!("projection: {projection}"));
        let formatted = format_source("lens.ron", &text).expect("a scene");
        assert!(formatted.contains(projection), "{formatted}");
        assert_eq!(parse_scene("a", &formatted), parse_scene("a", &text), "{projection}");
        assert_eq!(format_source("a", &formatted).as_ref(), Ok(&formatted));
    }
}

/// K from calibration: points map to the pixels that K defines, wherever the pixel centers are.
#[test]
fn intrinsics_and_extrinsics_match_calibration() {
    // OpenCV's axes, looking along −z of the world from z = 9: x right, y down, z ahead.
    let view = "Extrinsics(rotation: Rows(((1, 0, 0), (0, -1, 0), (0, 0, -1))), translation: (0.25, 0, 9))";
    for (numbers, [fx, fy, cx, cy, skew], half) in [
        ("fx: 300", [300.0, 300.0, 199.5, 99.5, 0.0], 0.5),
        (
            "fx: 300, fy: 280, cx: 180, cy: 120, skew: 3, size: (400, 200)",
            [300.0, 280.0, 180.0, 120.0, 3.0],
            0.5,
        ),
        (
            "fx: 150, cx: 90, size: (200, 100), pixel_centers: Half",
            [300.0, 300.0, 180.0, 100.0, 0.0],
            0.0,
        ),
    ] {
        let scene = scene(&format!("view: {view}, projection: Intrinsics({numbers})"));
        for [x, y, z] in [[0.5, 0.25, 0.5], [-1.0, 0.75, -0.5]] {
            let world = homog::Point::new(x, y, z);
            let view = scene.view_projection.camera.world_to_view().transform_point(world);
            let clip = scene.view_projection.view_to_clip.transform_point(view);
            let ndc = clip.divide().expect("ahead");
            let [column, row] = [200.0 * (1.0 + ndc.x()), 100.0 * (1.0 - ndc.y())];
            let [x, y, z] = [x + 0.25, -y, 9.0 - z];
            check_near(column, fx * x / z + skew * y / z + cx + half);
            check_near(row, fy * y / z + cy + half);
        }
    }
}

/// Checks that pixel coordinates agree to within 10⁻⁹.
fn check_near(actual: f64, expected: f64) {
    assert!((actual - expected).abs() < 1e-9, "{actual} is not {expected}");
}

/// R and t, columns of R, a quaternion and a pose give the same camera.
#[test]
fn cameras_can_be_placed_as_in_data_sets() {
    let of = |view: &str| scene(&format!("view: {view}, projection: Intrinsics(fx: 300)"));
    let first = of(
        "Extrinsics(rotation: Rows(((1, 0, 0), (0, -1, 0), (0, 0, -1))), translation: (0, 1, 9))",
    );
    assert_eq!(<[f64; 3]>::from(first.view_projection.camera.eye()), [0.0, 1.0, 9.0]);
    for view in [
        "Extrinsics(rotation: Columns(((1, 0, 0), (0, -1, 0), (0, 0, -1))), translation: (0, 1, 9))",
        "Extrinsics(rotation: Quaternion((0, 2, 0, 0)), translation: (0, 1, 9))",
        "Pose(rotation: Rows(((1, 0, 0), (0, 1, 0), (0, 0, 1))), eye: (0, 1, 9))",
        "Extrinsics(rotation: Columns(((-1, 0, 0), (0, 1, 0), (0, 0, -1))), translation: (0, -1, 9), axes: Pytorch3d)",
        "LookTo(eye: (0, 1, 9), gaze: (0, 0, -1))",
    ] {
        assert_eq!(of(view).view_projection.camera, first.view_projection.camera, "{view}");
    }
}
