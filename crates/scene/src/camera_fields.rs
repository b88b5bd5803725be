//! The paths of camera fields, for errors that point at them.

use scene_file::PathStep::{self, Field};

/// The path of the camera's position and direction.
pub(super) const VIEW_PATH: [PathStep<'static>; 2] = [Field("camera"), Field("view")];
/// The path of the projection.
pub(super) const PROJECTION_PATH: [PathStep<'static>; 2] = [Field("camera"), Field("projection")];
