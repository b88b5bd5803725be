//! Tests that each parameter has the effect stated in the lessons and no other.

use super::*;
use crate::demonstration::test_scene::house_scene;
use homog::{Bounds, Point, World};

fn sweep_house(
    parameter: SweepParameter,
    from: f64,
    to: f64,
    steps: u32,
) -> Vec<(ViewProjection, String)> {
    let (_, _, scene) = house_scene();
    Sweep { parameter, from, to, steps, volumes: false }.view_projections(&scene).expect("views")
}

fn house_view() -> (Scene, ViewProjection, Point<World>) {
    let (_, _, scene) = house_scene();
    let middle = Bounds::from_points(scene.world_points()).expect("points").center();
    let view_projection = scene.view_projection;
    (scene, view_projection, middle)
}

/// Returns x and y in the picture.
fn project_to_ndc(view_projection: &ViewProjection, point: Point<World>) -> [f64; 2] {
    let point = view_projection
        .world_to_clip()
        .transform_point(point)
        .divide()
        .expect("a point in front of the eye");
    [point.x(), point.y()]
}

#[track_caller]
fn assert_near(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-9 * a.abs().max(b.abs()).max(1.0), "{a} {b}");
}

/// Returns a point off the line of sight, at the depth of the center.
fn point_beside(view_projection: &ViewProjection, middle: Point<World>) -> Point<World> {
    middle + view_projection.camera.u() * 1.5 + view_projection.camera.v()
}

#[test]
fn values_are_evenly_spaced_and_include_the_end() {
    let sweep = |steps| Sweep {
        parameter: SweepParameter::Fov,
        from: 20.0,
        to: 50.1,
        steps,
        volumes: false,
    };
    assert_eq!(sweep(1).parameter_values(), [20.0]);
    assert_eq!(sweep(2).parameter_values(), [20.0, 50.1]);
    let values = sweep(4).parameter_values();
    assert_eq!((values.len(), values[0], values[3]), (4, 20.0, 50.1));
    assert_near(values[1] - values[0], values[3] - values[2]);
}

/// C62: sizes in the picture are proportional to 1/tan(θ/2).
#[test]
fn a_smaller_angle_enlarges() {
    let (_, _, middle) = house_view();
    let views = sweep_house(SweepParameter::Fov, 20.0, 60.0, 2);
    let [narrow, wide] =
        [0, 1].map(|n| project_to_ndc(&views[n].0, point_beside(&views[n].0, middle)));
    let tan = |degrees: f64| libm::tan((0.5 * degrees).to_radians());
    let ratio = tan(60.0) / tan(20.0);
    assert_near(narrow[0] / wide[0], ratio);
    assert_near(narrow[1] / wide[1], ratio);
    assert!(views[0].1.starts_with("20° high"), "{}", views[0].1);
}

/// C62.
#[test]
fn a_wrong_aspect_ratio_distorts_only_horizontally() {
    let (_, base, middle) = house_view();
    let view_projection = sweep_house(SweepParameter::Aspect, 2.0, 2.0, 1)[0].0;
    let [before, after] = [base, view_projection].map(|view_projection| {
        project_to_ndc(&view_projection, point_beside(&view_projection, middle))
    });
    assert_near(after[0] / before[0], (4.0 / 3.0) / 2.0);
    assert_near(after[1], before[1]);
}

/// C62, C64.
#[test]
fn near_and_far_planes_do_not_move_the_picture() {
    let (scene, base, _) = house_view();
    for (parameter, value) in [(SweepParameter::Near, 1.0), (SweepParameter::Far, 1e4)] {
        let view_projection = sweep_house(parameter, value, value, 1)[0].0;
        for point in scene.world_points() {
            let [a, b] = [project_to_ndc(&base, point), project_to_ndc(&view_projection, point)];
            assert_near(a[0], b[0]);
            assert_near(a[1], b[1]);
        }
        let depth = |view_projection: &ViewProjection, distance: f64| {
            let point = view_projection.camera.eye() + view_projection.camera.gaze() * distance;
            view_projection.world_to_clip().transform_point(point).divide().expect("ahead").z()
        };
        // The canonical volume has the near plane at 1 and the far plane at −1.
        assert_near(
            depth(&view_projection, value),
            if parameter == SweepParameter::Near { 1.0 } else { -1.0 },
        );
    }
}

/// C64: with the same window, half the distance gives twice the tangent.
#[test]
fn the_distance_of_a_fixed_window_acts_as_a_lens() {
    let (_, base, middle) = house_view();
    let near = |view_projection: &ViewProjection| {
        let clip_to_view = view_projection.view_to_clip.inverse().expect("an inverse");
        let corner = clip_to_view.transform_hpoint(HPoint::new(1.0, 1.0, 1.0, 1.0)).divide();
        corner.expect("finite")
    };
    let half = -near(&base).z() * 0.5;
    let view_projection = sweep_house(SweepParameter::Lens, half, half, 1)[0].0;
    assert_near(near(&view_projection).x(), near(&base).x());
    assert_near(near(&view_projection).y(), near(&base).y());
    let [before, after] = [base, view_projection].map(|view_projection| {
        project_to_ndc(&view_projection, point_beside(&view_projection, middle))
    });
    assert_near(after[0] / before[0], 0.5);
}

/// C64.
#[test]
fn a_shift_moves_the_picture_without_distortion() {
    let (scene, base, _) = house_view();
    let view_projection = sweep_house(SweepParameter::Shift, 0.25, 0.25, 1)[0].0;
    for point in scene.world_points() {
        let [before, after] =
            [project_to_ndc(&base, point), project_to_ndc(&view_projection, point)];
        assert_near(after[0], before[0] - 0.25);
        assert_near(after[1], before[1]);
    }
}

/// C94: objects at the depth of the center keep their size, but objects in front of it do not.
#[test]
fn a_dolly_zoom_keeps_the_size_of_the_center() {
    let (_, base, middle) = house_view();
    let views = sweep_house(SweepParameter::Dolly, 20.0, 80.0, 3);
    let distances = [20.0, 50.0, 80.0];
    for ((view_projection, note), distance) in views.iter().zip(distances) {
        assert_near(
            (view_projection.camera.eye() - middle).dot(view_projection.camera.w()),
            distance,
        );
        let [before, after] = [
            project_to_ndc(&base, point_beside(&base, middle)),
            project_to_ndc(view_projection, point_beside(view_projection, middle)),
        ];
        assert_near(before[0], after[0]);
        assert_near(before[1], after[1]);
        assert!(note.contains(&format!("center at {distance}")), "{note}");
    }
    let before = |n: usize| {
        let view_projection: &ViewProjection = &views[n].0;
        project_to_ndc(
            view_projection,
            point_beside(view_projection, middle) + view_projection.camera.w(),
        )
    };
    assert!(before(0)[0] > before(1)[0] && before(1)[0] > before(2)[0]);
}

#[test]
fn the_camera_turns_about_the_center() {
    let (_, base, middle) = house_view();
    let view_projection = sweep_house(SweepParameter::Angle, 90.0, 90.0, 1)[0].0;
    let [before, after] =
        [base, view_projection].map(|view_projection| view_projection.camera.eye() - middle);
    assert_near(before.length(), after.length());
    // Turned from the front (+z) to the right (+x), at the same height.
    assert_near(after.x(), before.z());
    assert_near(after.z(), -before.x());
    assert_near(after.y(), before.y());
}

#[test]
fn invalid_sweeps_are_rejected() {
    let (_, _, mut scene) = house_scene();
    let message = |parameter, value: f64, scene: &Scene| {
        let sweep = Sweep { parameter, from: value, to: value, steps: 1, volumes: false };
        sweep.view_projections(scene).map(|_| ()).expect_err("an error").to_string()
    };
    assert!(
        message(SweepParameter::Fov, 180.0, &scene)
            .contains("`fov` cannot be 180: it must be between")
    );
    assert!(message(SweepParameter::Near, -1.0, &scene).contains("greater than 0"));
    assert!(message(SweepParameter::Near, 1e6, &scene).starts_with("`near` cannot be 1e6: "));
    assert!(message(SweepParameter::Height, 4.0, &scene).contains("a perspective"));
    let volume = Orthographic::new(-1.0, 1.0, -1.0, 1.0, 1.0, 9.0).expect("a volume");
    scene.view_projection.view_to_clip = volume.view_to_clip(Convention::CHAPTER);
    assert!(message(SweepParameter::Fov, 40.0, &scene).contains("use a perspective"));
}

/// C94: the borders and planes of a parallel view volume, one at a time.
#[test]
fn parallel_windows_can_be_varied() {
    let (_, _, mut scene) = house_scene();
    let volume = Orthographic::new(-6.0, 6.0, -4.5, 4.5, 1.0, 30.0).expect("a volume");
    scene.view_projection.view_to_clip = volume.view_to_clip(Convention::CHAPTER);
    let at = |parameter, value| {
        let sweep = Sweep { parameter, from: value, to: value, steps: 1, volumes: false };
        let (view_projection, note) = sweep.view_projections(&scene).expect("a shot").remove(0);
        let point =
            view_projection.camera.view_to_world().transform_point(Point::new(1.5, 0.9, -10.0));
        let image =
            view_projection.world_to_clip().transform_point(point).divide().expect("an image");
        ([image.x(), image.y(), image.z()], note)
    };
    // The near plane of the canonical volume is at 1 and the far plane at −1.
    let depth = |near: f64, far: f64| 1.0 - 2.0 * (10.0 - near) / (far - near);
    for (parameter, value, expected) in [
        (SweepParameter::Height, 4.5, [0.5, 0.4, depth(1.0, 30.0)]),
        (SweepParameter::Aspect, 2.0 / 3.0, [0.5, 0.2, depth(1.0, 30.0)]),
        (SweepParameter::Shift, 0.25, [0.0, 0.2, depth(1.0, 30.0)]),
        (SweepParameter::Near, -5.0, [0.25, 0.2, depth(-5.0, 30.0)]),
        (SweepParameter::Far, 20.0, [0.25, 0.2, depth(1.0, 20.0)]),
    ] {
        let (image, note) = at(parameter, value);
        image.iter().zip(expected).for_each(|(actual, expected)| assert_near(*actual, expected));
        assert!(note.contains(" high · near "), "{note}");
    }
}
