//! The paths of the fields of a camera, for errors that point at them.

use scene_file::PathStep::{self, Field};

/// The path of the position and direction of the camera.
pub(super) const VIEW_PATH: [PathStep<'static>; 2] = [Field("camera"), Field("view")];
/// The path of the projection.
pub(super) const PROJECTION_PATH: [PathStep<'static>; 2] = [Field("camera"), Field("projection")];
