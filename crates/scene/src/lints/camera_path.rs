//! Lint for camera paths on which the picture flips between keyframes.

use super::Lint;
use crate::{CameraPath, Origin};
use glam::DVec3;
use scene_file::PathStep::{Field, Index};
use scene_file::SceneFile;
use scene_file::file::ViewFile;

/// The number of steps at which the path between two keyframes is examined.
const STEPS: u32 = 64;
/// If the gaze is at most this fraction as long as one step earlier, the eye is at its target. Two
/// directions are parallel if the sine of the angle between them is at most this.
const DEGENERATE: f64 = 1e-6;

/// Warns about a path whose eye meets its target, or whose gaze becomes parallel to the view-up
/// vector. The picture is undefined at that time, or it flips from one frame to the next.
///
/// The right-hand direction gaze × up vanishes at that time and is reversed afterward, so the time
/// is between two samples with opposite right-hand directions.
pub(super) fn lint_camera_path(origin: &Origin, file: &SceneFile) -> Option<Lint> {
    let path = CameraPath::from_scene_file(origin, file).ok()??;
    let keys = &file.camera_path.as_ref()?.keys;
    let mut before: Option<(DVec3, DVec3)> = None;
    for (number, pair) in keys.windows(2).enumerate() {
        let [start, end] = [pair[0].time.value(), pair[1].time.value()];
        for step in 0..=STEPS {
            let time = start + (end - start) * f64::from(step) / f64::from(STEPS);
            let ViewFile::LookAt { eye, target, up } = path.camera_at(time).view else { continue };
            let [eye, target, up] = [eye.0, target.0, up.0].map(DVec3::from_array);
            let gaze = target - eye;
            let right = gaze.cross(up);
            let last = before.replace((gaze, right));
            let (last_gaze, last_right) = last.unwrap_or((gaze, right));
            // The gaze reverses if the eye passes its target between two samples.
            let is_at_target = gaze.length() <= DEGENERATE * last_gaze.length()
                || gaze.length() == 0.0
                || gaze.dot(last_gaze) < 0.0;
            let is_parallel = right.length() <= DEGENERATE * gaze.length() * up.length();
            if !is_at_target && !is_parallel && right.dot(last_right) >= 0.0 {
                continue;
            }
            let (what, help) = if is_at_target {
                ("passes through its target", "add a key that leads it around the target")
            } else {
                (
                    "looks along its view-up vector, so the picture flips",
                    "add a key that leads it past that direction, or give the keys a different `up`",
                )
            };
            let message = format!("at {time:.3} s the camera {what}");
            let place = [Field("camera_path"), Field("keys"), Index(number)];
            let error = origin.error_at(&place, message, Some(help.to_owned()));
            return Some(Lint { code: "camera-path-turns-over", error });
        }
    }
    None
}
