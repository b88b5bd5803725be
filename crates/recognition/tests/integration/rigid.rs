//! Rigid matrices as cameras, poses and model transforms, and rigid matrices with a wrong sign.

use super::formulas::*;
use glam::DMat4;
use recognition::{MatrixMeaning, Misprint, Recognition, recognize};

fn recognized(rows: Rows) -> Recognition {
    recognize(rows)
}

fn rotation_z(degrees: f64) -> Rows {
    let (s, c) = libm::sincos(degrees.to_radians());
    let mut rows = scale([1.0; 3]);
    (rows[0][0], rows[0][1], rows[1][0], rows[1][1]) = (c, -s, s, c);
    rows
}

#[test]
fn a_rotation_about_z_with_a_translation_is_first_read_as_a_model_transform() {
    for (degrees, by) in [(30.0, [5.0, 2.0, 0.0]), (90.0, [5.0, 2.0, 0.0]), (45.0, [1.0, 0.0, 3.0])]
    {
        let exact = product(translation(by), rotation_z(degrees));
        for rows in [exact, rounded(exact, 3)] {
            let found = recognized(rows);
            let MatrixMeaning::ModelTransform { translation, axis, angle_degrees, scale } =
                found.first().meaning
            else {
                panic!("{degrees}: {:?}", found.first())
            };
            assert_eq!((translation, axis, scale), (by, [0.0, 0.0, 1.0], [1.0; 3]));
            assert!((angle_degrees - degrees).abs() < 0.06, "{angle_degrees}");
            let camera = |meaning: &MatrixMeaning| matches!(meaning, MatrixMeaning::Camera(_));
            assert!(found.readings.iter().any(|reading| camera(&reading.meaning)));
        }
    }
}

/// The matrix is the inverse of a camera transform, so its last column is the eye.
#[test]
fn a_pose_is_read_as_the_camera_in_the_world() {
    let (eye, gaze) = ([3.0, 4.0, 5.0], [-3.0, -4.0, -5.0]);
    let view = DMat4::from_cols_array_2d(&m_cam(eye, gaze, [0.0, 1.0, 0.0])).transpose();
    let exact = view.inverse().transpose().to_cols_array_2d();
    for rows in [exact, rounded(exact, 4)] {
        let MatrixMeaning::CameraPose(camera) = recognized(rows).first().meaning else {
            panic!("{:?}", recognized(rows).first())
        };
        assert!(camera.eye.iter().zip(eye).all(|(a, b)| (a - b).abs() < 1e-3), "{camera:?}");
        assert!(camera.gaze.iter().zip(unit(gaze)).all(|(a, b)| (a - b).abs() < 1e-3));
        assert!(camera.up[1] > 0.0);
    }
    assert!(matches!(
        recognized(m_cam(eye, gaze, [0.0, 1.0, 0.0])).first().meaning,
        MatrixMeaning::Camera(_)
    ));
}

/// The matrix is glm::perspective with +1 in its last row.
#[test]
fn a_negated_last_row_is_reported() {
    for (degrees, n, f) in [(60.0, 0.1, 100.0), (45.0, 1.0, 50.0)] {
        let mut rows = gl(degrees, 16.0 / 9.0, n, f);
        rows[3][2] = 1.0;
        for rows in [rows, rounded(rows, 4)] {
            let found = recognized(rows);
            let slip = found.misprint().map(|slip| slip.misprint);
            assert_eq!(slip, Some(Misprint::LastRowNegated), "{:?}", found.first());
        }
    }
}

/// The matrix is a look-at transform with the sign of one rotation entry flipped.
#[test]
fn a_single_wrong_sign_in_a_camera_is_found() {
    let exact = m_cam([4.0, 3.0, 6.0], [-4.0, -2.0, -6.0], [0.1, 1.0, 0.0]);
    for right in [exact, rounded(exact, 5)] {
        for at in 0..9 {
            let mut rows = right;
            rows[at / 3][at % 3] = -rows[at / 3][at % 3];
            let found = recognized(rows);
            let slip = found.misprint().expect("a misprint");
            assert_eq!(slip.misprint, Misprint::WrongSign, "{at}");
            assert_eq!(slip.remedied, Some(right), "{at}");
        }
    }
}
