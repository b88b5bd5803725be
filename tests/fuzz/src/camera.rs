//! Calibrated cameras: arbitrary K, R and t, as matrices and as the camera of a scene.

use crate::numbers::Numbers;
use crate::scene::resolve_and_draw;
use camera::{CameraAxes, Extrinsics};
use homog::{PixelCenters, Point};
use pipeline::Origin;
use projection::{Convention, Intrinsics};
use scene_file::parse_scene;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/models");

/// Tests a camera made of arbitrary numbers.
pub fn calibrated(bytes: &[u8]) {
    let mut numbers = Numbers(bytes);
    let kind = numbers.byte();
    let size = [numbers.byte(), numbers.byte()].map(|side| u32::from(side) * 8);
    lens(&mut numbers, size);
    let rotation = [(); 3].map(|()| triple(&mut numbers));
    let translation = triple(&mut numbers);
    let axes = [CameraAxes::OpenCv, CameraAxes::OpenGl, CameraAxes::Pytorch3d];
    let axes = axes[usize::from(kind % 3)];
    let quaternion = [(); 4].map(|()| number(&mut numbers));
    for camera in [
        Extrinsics::new(rotation, translation, axes),
        Extrinsics::from_pose(rotation, translation, axes),
        Extrinsics::from_quaternion(quaternion, translation, axes),
        Extrinsics::from_pytorch3d(rotation, translation),
    ] {
        check_place(camera);
    }
    drawn(kind, quaternion, translation, &mut numbers);
}

/// Checks that the rows of a lens are valid again, that its projection matrix is finite, and that
/// the inverse contains no NaN.
fn lens(numbers: &mut Numbers<'_>, size: [u32; 2]) {
    let [fx, fy, cx] = triple(numbers);
    let [cy, skew, near] = triple(numbers);
    let Ok(lens) = Intrinsics::new([fx, fy], [cx, cy], size) else { return };
    let Ok(lens) = lens.with_skew(skew) else { return };
    assert!(Intrinsics::from_rows(lens.to_rows(), size).is_ok(), "{lens:?} is not valid as rows");
    let lens = lens.in_pixel_centers(PixelCenters::Half);
    for convention in [Convention::CHAPTER, Convention::OPENGL] {
        let planes = [near.abs(), f64::INFINITY];
        let Ok(matrix) = lens.view_to_clip(planes, convention) else { continue };
        let entries = matrix.raw().to_cols_array();
        assert!(entries.iter().all(|entry| entry.is_finite()), "{lens:?}: {matrix:?}");
        if let Ok(inverse) = lens.clip_to_view(planes, convention) {
            let entries = inverse.raw().to_cols_array();
            assert!(entries.iter().all(|entry| !entry.is_nan()), "{lens:?}: {inverse:?}");
        }
    }
}

/// Checks that a valid camera has an eye and a rotation, and the same numbers after a round trip
/// through its matrix.
fn check_place(place: Result<Extrinsics, camera::CameraError>) {
    let place = match place {
        Ok(place) => place,
        Err(error) => return assert!(!error.to_string().is_empty(), "empty error message"),
    };
    let Ok(camera) = place.to_camera() else { return };
    let eye = <[f64; 3]>::from(camera.eye());
    assert!(eye.iter().all(|c| c.is_finite()), "{place:?}: the eye is {eye:?}");
    for axis in [camera.u(), camera.v(), camera.w()] {
        let length = axis.dot(axis);
        assert!((length - 1.0).abs() < 1e-9, "{place:?}: an axis of length {length}");
    }
    let again = Extrinsics::from_camera(camera, place.axes());
    for (row, other) in again.rotation().iter().zip(place.rotation()) {
        let far = row.iter().zip(other).any(|(a, b)| (a - b).abs() > 1e-3);
        assert!(!far, "{place:?} became {again:?}");
    }
    let origin = camera.world_to_view().transform_point(Point::from(eye));
    let limit = 1e-9 * eye.iter().fold(1.0, |most: f64, c| most.max(c.abs()));
    let origin = <[f64; 3]>::from(origin);
    assert!(origin.iter().all(|c| c.abs() <= limit), "{place:?}: the eye is seen at {origin:?}");
}

/// Draws a scene with this camera.
fn drawn(kind: u8, [w, x, y, z]: [f64; 4], [a, b, c]: [f64; 3], numbers: &mut Numbers<'_>) {
    let lens = [number(numbers), number(numbers), number(numbers), number(numbers)];
    let [fx, fy, cx, cy] = lens;
    let (view, place) = if kind & 4 == 0 { ("Extrinsics", "translation") } else { ("Pose", "eye") };
    let axes = ["OpenCv", "OpenGl", "Pytorch3d"][usize::from(kind % 3)];
    let text = format!(
        "Scene(models: [Model(path: \"crate.glb\")], image: Image(size: (32, 24)), camera: Camera(\
         view: {view}(rotation: Quaternion(({w:?}, {x:?}, {y:?}, {z:?})), {place}: ({a:?}, {b:?}, {c:?}), axes: {axes}), \
         projection: Intrinsics(fx: {fx:?}, fy: {fy:?}, cx: {cx:?}, cy: {cy:?}, skew: {:?})))",
        number(numbers)
    );
    match parse_scene("scene.ron", &text) {
        Ok(file) => resolve_and_draw(&Origin::from_text("scene.ron", text, FOLDER.into()), &file),
        Err(error) => assert!(!error.to_string().is_empty(), "empty error message"),
    }
}

fn triple(numbers: &mut Numbers<'_>) -> [f64; 3] {
    [(); 3].map(|()| number(numbers))
}

/// Returns a number with arbitrary bits, or a number of ordinary size.
fn number(numbers: &mut Numbers<'_>) -> f64 {
    match numbers.byte() % 8 {
        0 => f64::from_le_bytes(numbers.take()),
        1 => f64::from(f32::from_le_bytes(numbers.take())),
        2 => f64::from(i8::from_le_bytes(numbers.take())),
        3 => f64::from(numbers.byte() % 3) - 1.0,
        _ => f64::from(i16::from_le_bytes(numbers.take())) / 64.0,
    }
}
