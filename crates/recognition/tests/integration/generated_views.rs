//! Generated views of OpenGL, Direct3D and OpenCV, as printed for column vectors and row vectors.

use super::formulas::{Rows, cross, m_cam, opencv, rounded, single, transposed, unit};
use super::random_matrices::Random;
use recognition::{CameraReading, MatrixMeaning, Misprint, ViewAxes, recognize};

/// XMMatrixLookToLH for column vectors, with the rows x = up × z, y = z × x, and z.
pub(crate) fn look_at_lh(eye: [f64; 3], gaze: [f64; 3], up: [f64; 3]) -> Rows {
    let z = unit(gaze);
    let x = unit(cross(up, z));
    let row = |v: [f64; 3]| [v[0], v[1], v[2], -(0..3).map(|i| v[i] * eye[i]).sum::<f64>()];
    [row(x), row(cross(z, x)), row(z), [0.0, 0.0, 0.0, 1.0]]
}

fn view(axes: ViewAxes, eye: [f64; 3], target: [f64; 3]) -> Rows {
    let (gaze, up) = ([0, 1, 2].map(|i| target[i] - eye[i]), [0.0, 1.0, 0.0]);
    match axes {
        ViewAxes::Direct3d => look_at_lh(eye, gaze, up),
        ViewAxes::OpenCv => opencv(m_cam(eye, gaze, up)),
        _ => m_cam(eye, gaze, up),
    }
}

fn is_view(camera: &CameraReading, axes: ViewAxes, eye: [f64; 3], target: [f64; 3]) -> bool {
    let close = |a: [f64; 3], b: [f64; 3]| a.into_iter().zip(b).all(|(a, b)| (a - b).abs() < 5e-3);
    let gaze = unit([0, 1, 2].map(|i| target[i] - eye[i]));
    camera.axes == axes && close(camera.eye, eye) && close(camera.gaze, gaze) && camera.up[1] > 0.0
}

/// Returns the camera readings of a matrix, most likely first, after the transposition that the
/// report suggests.
fn cameras(rows: Rows) -> Vec<(CameraReading, u32)> {
    let found = recognize(rows);
    let slip = found.misprint().filter(|slip| slip.misprint == Misprint::Transposed);
    let found = slip.and_then(|slip| slip.remedied).map_or(found, recognize);
    let camera = |meaning: &MatrixMeaning, cost: u32| match meaning {
        MatrixMeaning::Camera(camera) => Some((*camera, cost)),
        _ => None,
    };
    found.readings.iter().filter_map(|reading| camera(&reading.meaning, reading.cost)).collect()
}

/// A camera that looks at the origin is read with its gaze. The numbers of a camera that looks at
/// another target do not tell −z from +z, so both readings are equally likely.
#[test]
fn views_of_three_interfaces_are_read_with_their_gaze() {
    let mut random = Random(23);
    let mut count = 0;
    for at in 0..240 {
        let whole = |random: &mut Random| (random.bits() % 17) as f64 - 8.0;
        let eye = [whole(&mut random), whole(&mut random), 1.0 + whole(&mut random).abs()];
        let axes = [ViewAxes::OpenGl, ViewAxes::Direct3d, ViewAxes::OpenCv][at % 3];
        let target = if at % 2 == 0 { [0.0; 3] } else { [1.0, 0.5, -2.0] };
        let exact = view(axes, eye, target);
        let printed = [exact, single(exact), rounded(exact, 4)][at / 3 % 3];
        if eye[0] == 0.0 && eye[1] == 0.0 {
            continue;
        }
        for rows in [printed, transposed(printed)] {
            let found = cameras(rows);
            let is_right = |found: &(CameraReading, u32)| is_view(&found.0, axes, eye, target);
            let (_, least) = *found.first().expect("a camera");
            let place = found.iter().position(is_right).expect("the view");
            let is_listed = if target == [0.0; 3] || axes == ViewAxes::OpenCv {
                place == 0
            } else {
                found[place].1 <= least + 3
            };
            assert!(is_listed, "{axes:?}, {eye:?}, {target:?}: {found:?}");
            count += 1;
        }
    }
    assert!(count > 400, "{count}");
}

/// FReversedZPerspectiveMatrix as Unreal prints it, for row vectors and an infinite far plane.
#[test]
fn the_matrix_of_unreal_is_reversed_and_infinite() {
    for (x, y, near) in [(1.0, 16.0 / 9.0, 10.0), (0.5625, 1.0, 5.0), (1.3, 2.3111111, 10.0)] {
        let rows =
            [[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0], [0.0, 0.0, near, 0.0]];
        let found = recognize(rows);
        let slip = found.misprint().map(|slip| slip.misprint);
        assert_eq!(slip, Some(Misprint::Transposed), "{near}: {:?}", found.first());
        let MatrixMeaning::Perspective { frustum, convention, .. } =
            recognize(transposed(rows)).first().meaning
        else {
            panic!("{near}: {:?}", recognize(transposed(rows)).first())
        };
        assert_eq!((frustum.near(), frustum.far()), (near, f64::INFINITY));
        assert_eq!(convention, projection::Convention::DIRECT3D.reversed());
    }
}
