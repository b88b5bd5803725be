//! The camera path of a scene file, for `alberti animate` and for stills.

use crate::number::{FieldOfView, Finite, Triple};
use crate::schema::{named_enum, scene_struct};

scene_struct! {
    /// The motion of the camera in frame sequences. The projection comes from the scene's `camera`.
    pub struct CameraPathFile as "CameraPath" {
        /// From 2 to 10,000 keyframes, with increasing times. If the last one repeats the first,
        /// the path is closed and smooth at that point too.
        pub keys: Vec<CameraKeyFile>,
        /// The interpolation between keyframes. Default: `Smooth`.
        pub curve: CurveFile = CurveFile::Smooth,
    }
}

scene_struct! {
    /// A keyframe: the position and direction of the camera at a given time.
    #[derive(Copy)]
    pub struct CameraKeyFile as "CameraKey" {
        /// The time in seconds.
        pub time: Finite,
        /// The position of the eye.
        pub eye: Triple,
        /// The point the camera looks at.
        pub target: Triple,
        /// The view-up vector. Default: y.
        pub up: Triple = Triple::Y_AXIS,
        /// The vertical field of view of a perspective projection, in degrees. Default: from the
        /// scene's projection.
        pub fov_y_degrees: Option<FieldOfView>,
    }
}

named_enum! {
    /// The interpolation between keyframes.
    pub enum CurveFile as "Curve" {
        Linear = "Straight lines, with an abrupt change of velocity at each keyframe.",
        Smooth = "A smooth Catmull-Rom curve through all keyframes. With 8 evenly spaced keyframes and the first one repeated, it approximates a circle to within 1%; with 12, to within 0.2%.",
    }
}
