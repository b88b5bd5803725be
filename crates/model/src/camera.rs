//! Cameras of a file.

/// A camera of the file: its projection only, the node that carries it gives the view.
#[derive(Clone, Debug)]
pub struct ModelCamera {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// What kind of projection, with its parameters, already checked for sense.
    pub projection: CameraProjection,
}

/// The two kinds of camera that glTF has.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum CameraProjection {
    /// Perspective projection.
    Perspective {
        /// The vertical opening angle in radians, in (0, π).
        fov_y: f64,
        /// Width over height, if the file fixes it.
        aspect: Option<f64>,
        /// The distance of the near plane, > 0.
        near: f64,
        /// The distance of the far plane, > near; infinite if the file gives none.
        far: f64,
    },
    /// Orthographic projection.
    Orthographic {
        /// Half the width of the view volume, > 0.
        half_width: f64,
        /// Half the height of the view volume, > 0.
        half_height: f64,
        /// The distance of the near plane, ≥ 0.
        near: f64,
        /// The distance of the far plane, > near.
        far: f64,
    },
}
