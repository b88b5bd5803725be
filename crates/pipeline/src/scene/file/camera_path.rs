//! The way of a camera in a scene file, for `alberti animate`.

use crate::scene::number::{FieldOfView, Finite, Triple};
use serde::Deserialize;

/// Where the camera is at which time, in films. Its projection is that of the scene's `camera`.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "CameraPath", deny_unknown_fields)]
pub struct CameraPathFile {
    /// From 2 to 10,000 places and times, each later than the one before.
    pub keys: Vec<CameraKeyFile>,
    /// How the camera moves between them. Default: `Smooth`.
    #[serde(default)]
    pub curve: CurveFile,
}

/// A place of the camera at a time.
#[derive(Clone, Copy, PartialEq, Debug, Deserialize)]
#[serde(rename = "CameraKey", deny_unknown_fields)]
pub struct CameraKeyFile {
    /// The time in seconds.
    pub time: Finite,
    /// The place of the eye.
    pub eye: Triple,
    /// The place looked at.
    pub target: Triple,
    /// The view-up vector. Default: y.
    #[serde(default = "Triple::y_axis")]
    pub up: Triple,
    /// The vertical opening angle of a perspective in degrees. Default: that of the scene's projection.
    pub fov_y_degrees: Option<FieldOfView>,
}

/// How something moves between its keys.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(rename = "Curve")]
pub enum CurveFile {
    /// On straight lines, with a jerk at each key.
    Linear,
    /// On a smooth curve through all keys (Catmull and Rom).
    #[default]
    Smooth,
}
