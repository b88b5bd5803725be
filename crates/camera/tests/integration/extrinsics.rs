//! Conversion of extrinsic parameters to cameras and back, in all axes.

use camera::{Camera, CameraAxes, CameraError, Extrinsics};
use homog::{Point, World};
use proptest::prelude::*;

const ALL_AXES: [CameraAxes; 3] = [CameraAxes::OpenCv, CameraAxes::OpenGl, CameraAxes::Pytorch3d];
const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn triple() -> impl Strategy<Value = [f64; 3]> {
    [-10.0..10.0, -10.0..10.0, -10.0..10.0]
}

fn camera() -> impl Strategy<Value = Camera> {
    (triple(), triple(), triple()).prop_filter_map("a valid gaze and view-up", |(eye, gaze, up)| {
        Camera::look_to(eye.into(), gaze.into(), up.into()).ok()
    })
}

fn axes() -> impl Strategy<Value = CameraAxes> {
    prop::sample::select(ALL_AXES.to_vec())
}

/// Returns camera = R · world + t.
fn apply(extrinsics: Extrinsics, point: Point<World>) -> [f64; 3] {
    let [x, y, z] = point.raw().to_array();
    let t = extrinsics.translation();
    [0, 1, 2].map(|row| {
        let [a, b, c] = extrinsics.rotation()[row];
        a * x + b * y + c * z + t[row]
    })
}

fn near<const N: usize>(
    one: [f64; N],
    other: [f64; N],
    tolerance: f64,
) -> Result<(), TestCaseError> {
    for (a, b) in one.into_iter().zip(other) {
        prop_assert!((a - b).abs() <= tolerance, "{one:?} {other:?}");
    }
    Ok(())
}

proptest! {
    #[test]
    fn coordinates_differ_from_view_space_only_in_sign(
        camera in camera(),
        point in triple(),
    ) {
        let view = camera.world_to_view().transform_point(Point::from(point));
        let of = |axes| apply(Extrinsics::from_camera(camera, axes), Point::from(point));
        let (right, up, ahead) = (view.x(), view.y(), -view.z());
        near(of(CameraAxes::OpenCv), [right, -up, ahead], 1e-12)?;
        near(of(CameraAxes::OpenGl), [right, up, -ahead], 1e-12)?;
        near(of(CameraAxes::Pytorch3d), [-right, up, ahead], 1e-12)?;
    }

    #[test]
    fn cameras_round_trip(camera in camera(), axes in axes(), others in axes()) {
        let extrinsics = Extrinsics::from_camera(camera, axes).in_axes(others);
        prop_assert_eq!(extrinsics.axes(), others);
        let (rotation, eye) = extrinsics.to_pose();
        near(eye, camera.eye().raw().to_array(), 1e-12 * 20.0)?;
        let quaternion = extrinsics.to_quaternion();
        let t = extrinsics.translation();
        for made in [
            Extrinsics::new(extrinsics.rotation(), t, others),
            Extrinsics::from_pose(rotation, eye, others),
            Extrinsics::from_quaternion(quaternion, t, others),
            Extrinsics::from_quaternion(quaternion.map(|part| part * -1e200), t, others),
        ] {
            let back = made.and_then(Extrinsics::to_camera).expect("a camera");
            near(back.eye().raw().to_array(), camera.eye().raw().to_array(), 1e-12 * 20.0)?;
            near(back.u().raw().to_array(), camera.u().raw().to_array(), 1e-12)?;
            near(back.v().raw().to_array(), camera.v().raw().to_array(), 1e-12)?;
            near(back.w().raw().to_array(), camera.w().raw().to_array(), 1e-12)?;
        }
    }

    #[test]
    fn pytorch3d_uses_row_vectors(camera in camera(), point in triple()) {
        let extrinsics = Extrinsics::from_camera(camera, CameraAxes::Pytorch3d);
        let rows = extrinsics.rotation();
        let transposed = [0, 1, 2].map(|i| [0, 1, 2].map(|j: usize| rows[j][i]));
        let back = Extrinsics::from_pytorch3d(transposed, extrinsics.translation());
        prop_assert_eq!(back, Ok(extrinsics));
        // x' = Σ x_i R[i][0] + T[0].
        let x: f64 = (0..3).map(|i| point[i] * transposed[i][0]).sum();
        let by_rows = x + extrinsics.translation()[0];
        prop_assert!((by_rows - apply(extrinsics, Point::from(point))[0]).abs() <= 1e-12);
    }
}

#[test]
fn a_quarter_turn_has_the_textbook_quaternion() {
    // About +z by 90°: (cos 45°, 0, 0, sin 45°); x maps to y.
    let half = 0.5_f64.sqrt();
    let made = Extrinsics::from_quaternion([half, 0.0, 0.0, half], [0.0; 3], CameraAxes::OpenCv);
    let seen = apply(made.expect("a camera"), Point::new(1.0, 0.0, 0.0));
    assert!((seen[1] - 1.0).abs() < 1e-15 && seen[0].abs() < 1e-15, "{seen:?}");
}

#[test]
fn half_turns_have_quaternions() {
    for rotation in [
        [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]],
        [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]],
        [[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]],
        IDENTITY,
    ] {
        let made = Extrinsics::new(rotation, [1.0, 2.0, 3.0], CameraAxes::OpenGl).expect("one");
        let [t, q] = [made.translation().to_vec(), made.to_quaternion().to_vec()];
        let back = Extrinsics::from_quaternion(
            [q[0], q[1], q[2], q[3]],
            [t[0], t[1], t[2]],
            CameraAxes::OpenGl,
        );
        assert_eq!(back, Ok(made));
    }
}

#[test]
fn invalid_rotations_are_rejected() {
    let new = |rotation| Extrinsics::new(rotation, [0.0; 3], CameraAxes::OpenCv);
    let scaled = IDENTITY.map(|row| row.map(|entry| entry * 2.0));
    assert_eq!(new(scaled), Err(CameraError::NotRotation { deviation: 3.0 }));
    assert!(new(scaled).expect_err("scaled").to_string().contains("off by 3.00e0"));
    let mirrored = [[-1.0, 0.0, 0.0], IDENTITY[1], IDENTITY[2]];
    assert_eq!(new(mirrored), Err(CameraError::MirroringRotation));
    let huge = [[1e200, 0.0, 0.0], [0.0, 1e200, 0.0], [0.0, 0.0, 1e200]];
    assert!(matches!(new(huge), Err(CameraError::NotRotation { .. })));
    let broken = [[f64::NAN, 0.0, 0.0], IDENTITY[1], IDENTITY[2]];
    assert!(new(broken).expect_err("NaN").to_string().starts_with("the first row"));
    let zero = Extrinsics::from_quaternion([0.0; 4], [0.0; 3], CameraAxes::OpenCv);
    assert_eq!(zero, Err(CameraError::ZeroQuaternion));
    let far = Extrinsics::new(IDENTITY, [f64::MAX, 0.0, 0.0], CameraAxes::OpenCv);
    assert!(matches!(far.and_then(Extrinsics::to_camera), Err(CameraError::EyeTooFar { .. })));
    // Six digits, as in files, are precise enough for a camera.
    let rounded = [[0.866025, -0.5, 0.0], [0.5, 0.866025, 0.0], [0.0, 0.0, 1.0]];
    let camera = new(rounded).and_then(Extrinsics::to_camera).expect("a camera");
    assert!((camera.u().length() - 1.0).abs() < 1e-15);
    assert!(camera.u().dot(camera.v()).abs() < 1e-15);
}
