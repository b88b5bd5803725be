//! Cameras: projections with validated parameters. Invalid cameras are skipped with a warning.
//!
//! The rules of glTF 2.0 §3.10.3 are checked: 0 < yfov < π and 0 < znear < zfar for perspective
//! cameras, and nonzero magnifications and 0 ≤ znear < zfar for orthographic cameras. A perspective
//! projection without `zfar` is infinite.

use crate::warnings::ImportWarnings;
use gltf::json::Root;
use gltf::json::camera::{Camera, Orthographic, Perspective, Type};
use gltf::json::validation::Checked;
use model::{CameraProjection, Diagnostic, ModelCamera};
use std::f64::consts::PI;

/// Imports every camera of a file, and returns for each whether its parameters are valid.
///
/// Invalid cameras remain in the list with a default projection, because nodes and animations refer
/// to cameras by index.
pub(super) fn import_cameras(
    root: &Root,
    warnings: &mut ImportWarnings,
) -> (Vec<ModelCamera>, Vec<bool>) {
    let mut lenses = Vec::with_capacity(root.cameras.len());
    let mut usable = Vec::with_capacity(root.cameras.len());
    for (at, json) in root.cameras.iter().enumerate() {
        let kind = camera_projection(json, &format!("/cameras/{at}"));
        usable.push(kind.is_ok());
        let kind = kind.unwrap_or_else(|diagnostic| {
            warnings.downgrade(&diagnostic, "the camera is skipped");
            DEFAULT_PROJECTION
        });
        lenses.push(ModelCamera { name: json.name.clone(), projection: kind });
    }
    (lenses, usable)
}

/// A placeholder for the projection of an invalid camera.
///
/// It is never used for drawing, because references to the camera are cleared.
const DEFAULT_PROJECTION: CameraProjection =
    CameraProjection::Perspective { fov_y: PI / 4.0, aspect: None, near: 0.1, far: f64::INFINITY };

/// Reads and checks a camera.
///
/// # Errors
/// Fails if the type is unknown, or the parameters for it are missing or out of range.
fn camera_projection(json: &Camera, pointer: &str) -> Result<CameraProjection, Diagnostic> {
    match (json.type_, &json.perspective, &json.orthographic) {
        (Checked::Valid(Type::Perspective), Some(json), _) => perspective_projection(json, pointer),
        (Checked::Valid(Type::Orthographic), _, Some(json)) => {
            orthographic_projection(json, pointer)
        }
        (Checked::Valid(_), ..) => {
            Err(Diagnostic::invalid(pointer, "the camera lacks the parameters for its type"))
        }
        (Checked::Invalid, ..) => {
            let message = "the type is neither perspective nor orthographic";
            Err(Diagnostic::invalid(&format!("{pointer}/type"), message))
        }
    }
}

/// Checks the parameters of a perspective camera.
///
/// NaN fails every check. `zfar` may be infinite.
fn perspective_projection(
    json: &Perspective,
    pointer: &str,
) -> Result<CameraProjection, Diagnostic> {
    let out_of_range = |member: &str, value: f64, rule: &str| {
        let pointer = format!("{pointer}/perspective/{member}");
        Err(Diagnostic::invalid(&pointer, format!("{member} is {value} but must be {rule}")))
    };
    let (fov_y, near) = (f64::from(json.yfov), f64::from(json.znear));
    let far = json.zfar.map_or(f64::INFINITY, f64::from);
    let aspect = json.aspect_ratio.map(f64::from);
    if !(fov_y > 0.0 && fov_y < PI) {
        return out_of_range("yfov", fov_y, "above 0 and below pi");
    }
    if !(near > 0.0 && near.is_finite()) {
        return out_of_range("znear", near, "above 0");
    }
    if far <= near || far.is_nan() {
        return out_of_range("zfar", far, "above znear");
    }
    match aspect {
        Some(aspect) if !(aspect > 0.0 && aspect.is_finite()) => {
            out_of_range("aspectRatio", aspect, "above 0")
        }
        _ => Ok(CameraProjection::Perspective { fov_y, aspect, near, far }),
    }
}

/// Checks the parameters of an orthographic camera. Negative magnifications are treated as
/// positive.
///
/// `xmag` and `ymag` are half the width and height of the view, in world units. Unlike with a
/// perspective camera, the near plane may contain the camera's position.
fn orthographic_projection(
    json: &Orthographic,
    pointer: &str,
) -> Result<CameraProjection, Diagnostic> {
    let out_of_range = |member: &str, value: f64, rule: &str| {
        let pointer = format!("{pointer}/orthographic/{member}");
        Err(Diagnostic::invalid(&pointer, format!("{member} is {value} but must be {rule}")))
    };
    let (half_width, half_height) = (f64::from(json.xmag).abs(), f64::from(json.ymag).abs());
    let (near, far) = (f64::from(json.znear), f64::from(json.zfar));
    if !(half_width > 0.0 && half_width.is_finite()) {
        return out_of_range("xmag", half_width, "above 0");
    }
    if !(half_height > 0.0 && half_height.is_finite()) {
        return out_of_range("ymag", half_height, "above 0");
    }
    if !(near >= 0.0 && near.is_finite()) {
        return out_of_range("znear", near, "at least 0");
    }
    if !(far > near && far.is_finite()) {
        return out_of_range("zfar", far, "above znear");
    }
    Ok(CameraProjection::Orthographic { half_width, half_height, near, far })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// Returns the resulting projection, or the location and message of the error.
    fn read_camera(camera: serde_json::Value) -> Result<CameraProjection, (String, String)> {
        let camera = serde_json::from_value(camera).unwrap();
        camera_projection(&camera, "/cameras/0")
            .map_err(|diagnostic| (diagnostic.location, diagnostic.message))
    }

    #[test]
    fn valid_parameters_are_accepted() {
        let camera = json!({"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.25}});
        let far = f64::INFINITY;
        let kind = CameraProjection::Perspective { fov_y: 0.5, aspect: None, near: 0.25, far };
        assert_eq!(read_camera(camera), Ok(kind));
        let camera = json!({"type": "orthographic",
            "orthographic": {"xmag": -2, "ymag": 1, "znear": 0, "zfar": 8}});
        let kind = CameraProjection::Orthographic {
            half_width: 2.0,
            half_height: 1.0,
            near: 0.0,
            far: 8.0,
        };
        assert_eq!(read_camera(camera), Ok(kind));
    }

    #[test]
    fn invalid_parameters_are_rejected() {
        for (yfov, znear, zfar, aspect, message) in [
            (0.0, 1.0, 2.0, 1.0, "yfov is 0 but must be above 0 and below pi"),
            (4.0, 1.0, 2.0, 1.0, "yfov is 4 but must be above 0 and below pi"),
            (0.5, 0.0, 2.0, 1.0, "znear is 0 but must be above 0"),
            (0.5, -1.0, 2.0, 1.0, "znear is -1 but must be above 0"),
            (0.5, 2.0, 2.0, 1.0, "zfar is 2 but must be above znear"),
            (0.5, 1.0, 2.0, 0.0, "aspectRatio is 0 but must be above 0"),
        ] {
            let perspective =
                json!({"yfov": yfov, "znear": znear, "zfar": zfar, "aspectRatio": aspect});
            let camera = json!({"type": "perspective", "perspective": perspective});
            let member = message.split(' ').next().unwrap();
            let pointer = format!("/cameras/0/perspective/{member}");
            assert_eq!(read_camera(camera), Err((pointer, message.to_owned())));
        }
        for (xmag, znear, zfar, message) in [
            (0.0, 0.0, 2.0, "xmag is 0 but must be above 0"),
            (1.0, -1.0, 2.0, "znear is -1 but must be at least 0"),
            (1.0, 0.0, 0.0, "zfar is 0 but must be above znear"),
        ] {
            let orthographic = json!({"xmag": xmag, "ymag": 1, "znear": znear, "zfar": zfar});
            let camera = json!({"type": "orthographic", "orthographic": orthographic});
            assert_eq!(read_camera(camera).unwrap_err().1, message);
        }
        assert_eq!(read_camera(json!({"type": "fisheye"})).unwrap_err().0, "/cameras/0/type");
        let lacking = json!({"type": "perspective"});
        assert_eq!(
            read_camera(lacking).unwrap_err().1,
            "the camera lacks the parameters for its type"
        );
    }
}
