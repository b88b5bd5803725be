//! Cameras and projections in one matrix, in left-handed (Direct3D) and right-handed worlds, and
//! boxes measured in pixels from the upper left corner.

use super::formulas::*;
use projection::Convention;
use recognition::{MatrixMeaning, Misprint, Recognition, recognize};

fn recognized(rows: Rows) -> Recognition {
    recognize(rows)
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

/// XMMatrixLookToLH for column vectors, with the rows x = up × z, y = z × x, and z.
fn look_to_lh(eye: [f64; 3], gaze: [f64; 3]) -> Rows {
    let z = unit(gaze);
    let x = unit(cross([0.0, 1.0, 0.0], z));
    let row = |v: [f64; 3]| [v[0], v[1], v[2], -(0..3).map(|i| v[i] * eye[i]).sum::<f64>()];
    [row(x), row(cross(z, x)), row(z), [0.0, 0.0, 0.0, 1.0]]
}

/// XMMatrixPerspectiveFovLH for column vectors.
fn perspective_lh(degrees: f64, aspect: f64, n: f64, f: f64) -> Rows {
    let scale = 1.0 / libm::tan(0.5 * degrees.to_radians());
    [
        [scale / aspect, 0.0, 0.0, 0.0],
        [0.0, scale, 0.0, 0.0],
        [0.0, 0.0, f / (f - n), -n * f / (f - n)],
        [0.0, 0.0, 1.0, 0.0],
    ]
}

fn check_camera(found: &MatrixMeaning, eye: [f64; 3], gaze: [f64; 3], context: &str) {
    let MatrixMeaning::CameraPerspective { camera, frustum, lens, convention } = *found else {
        assert!(matches!(found, MatrixMeaning::CameraPerspective { .. }), "{context}: {found:?}");
        return;
    };
    let close = |a: [f64; 3], b: [f64; 3]| a.into_iter().zip(b).all(|(a, b)| (a - b).abs() < 2e-3);
    assert_eq!(convention, Convention::DIRECT3D, "{context}");
    assert!(close(camera.eye, eye) && close(camera.gaze, unit(gaze)), "{context}: {camera:?}");
    assert!(camera.up[1] > 0.0, "{context}: {camera:?}");
    assert!(close(camera.right, cross(camera.up, camera.gaze)), "{context}: {camera:?}");
    assert!((lens.fov_y_degrees - 60.0).abs() < 0.01, "{context}: {lens:?}");
    assert!((frustum.near() - 1.0).abs() < 1e-3 && (frustum.far() / 50.0 - 1.0).abs() < 1e-2);
}

/// Tests cameras with yaw and pitch. Each matrix is tried as it is, rounded, and for row vectors.
#[test]
fn a_direct3d_camera_is_upright_in_a_left_handed_world() {
    for (eye, gaze) in [
        ([0.0, 0.0, -5.0], [0.0, 0.0, 1.0]),
        ([3.0, 0.0, -4.0], [-3.0, 0.0, 4.0]),
        ([0.0, 2.0, -5.0], [0.0, -2.0, 5.0]),
        ([2.0, 3.0, -6.0], [-2.0, -3.0, 6.0]),
        ([2.0, -3.0, 6.0], [-2.0, 3.0, -5.0]),
    ] {
        let whole = product(perspective_lh(60.0, 4.0 / 3.0, 1.0, 50.0), look_to_lh(eye, gaze));
        for rows in [whole, rounded(whole, 6)] {
            let found = recognized(rows);
            check_camera(&found.first().meaning, eye, gaze, &format!("{eye:?}"));
            assert_eq!(found.misprint(), None, "{eye:?}");
            let turned = recognized(transposed(rows));
            let slip = turned.misprint().expect("a misprint");
            assert_eq!(slip.misprint, Misprint::Transposed);
            let remedied = recognize(slip.remedied.expect("a matrix"));
            check_camera(&remedied.first().meaning, eye, gaze, "row vectors");
        }
    }
}

/// Tests Vulkan cameras in a right-handed world where y or z is up.
#[test]
fn a_vulkan_camera_is_upright_in_a_right_handed_world() {
    let vulkan = |degrees: f64| -> Rows {
        let scale = 1.0 / libm::tan(0.5 * degrees.to_radians());
        let (n, f) = (0.5, 100.0);
        [
            [scale / 1.5, 0.0, 0.0, 0.0],
            [0.0, -scale, 0.0, 0.0],
            [0.0, 0.0, f / (n - f), n * f / (n - f)],
            [0.0, 0.0, -1.0, 0.0],
        ]
    };
    for (eye, gaze, up) in [
        ([0.0, 0.0, 5.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]),
        ([4.0, 3.0, 6.0], [-4.0, -3.0, -6.0], [0.0, 1.0, 0.0]),
        ([4.0, 8.0, 1.0], [-4.0, -8.0, -1.0], [0.0, 1.0, 0.0]),
        ([4.0, 3.0, 6.0], [-4.0, -3.0, -6.0], [0.0, 0.0, 1.0]),
        ([-4.0, -3.0, 6.0], [4.0, 3.0, -6.0], [0.0, 0.0, 1.0]),
    ] {
        let found = recognized(product(vulkan(50.0), m_cam(eye, gaze, up))).first().meaning;
        let MatrixMeaning::CameraPerspective { camera, convention, .. } = found else {
            panic!("{eye:?}: {found:?}")
        };
        assert_eq!(convention, Convention::VULKAN, "{eye:?}, {up:?}");
        let cosine: f64 = (0..3).map(|i| camera.up[i] * up[i]).sum();
        assert!(cosine > 0.0, "{camera:?}");
    }
}

/// glOrtho(0, w, h, 0, −1, 1), the common matrix for two-dimensional pictures.
#[test]
fn a_box_of_pixels_from_the_upper_left_is_read_as_glortho() {
    for [width, height] in [[800.0, 600.0], [1920.0, 1080.0], [640.0, 480.0]] {
        let exact = gl_ortho([0.0, width, height, 0.0], -1.0, 1.0);
        for rows in [exact, rounded(exact, 9), single(exact)] {
            let found = recognized(rows).first().meaning;
            let MatrixMeaning::Orthographic { volume, convention } = found else {
                panic!("{width}: {found:?}")
            };
            let w = volume.window();
            assert_eq!(convention, Convention::OPENGL, "{volume:?}");
            assert_eq!([w.left(), w.right(), w.bottom(), w.top()], [0.0, width, height, 0.0]);
            assert_eq!((volume.near(), volume.far()), (-1.0, 1.0));
        }
    }
}

/// A box determines less of its camera than a frustum does, so the camera is read as upright in
/// every convention.
#[test]
fn a_camera_with_a_box_is_upright() {
    let (eye, gaze) = ([4.0, 3.0, 6.0], [-4.0, -3.0, -6.0]);
    let view = m_cam(eye, gaze, [0.0, 1.0, 0.0]);
    let opengl = gl_ortho([-1.0, 3.0, -2.0, 1.0], 4.0, 6.0);
    let mut vulkan = opengl;
    vulkan[1] = vulkan[1].map(|entry| -entry);
    (vulkan[2][2], vulkan[2][3]) = (-0.5, -2.0);
    for (projection, convention) in [(opengl, Convention::OPENGL), (vulkan, Convention::VULKAN)] {
        let found = recognized(product(projection, view));
        let MatrixMeaning::CameraOrthographic { camera, convention: read, .. } =
            found.first().meaning
        else {
            panic!("{:?}", found.first())
        };
        assert_eq!(read, convention);
        assert!(camera.up[1] > 0.0 && camera.gaze[2] < 0.0, "{camera:?}");
    }
}
