//! Cameras of a file: perspective and orthographic projections (glTF 2.0 §3.10).

/// A camera, which consists only of a projection; the node it is attached to provides the view.
///
/// A camera looks along its node's −z with +y up. If the file has no aspect ratio, or one that
/// differs from the picture's, the renderer decides how to fit the view to the picture.
#[derive(Clone, Debug)]
pub struct ModelCamera {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// The projection with its validated parameters.
    pub projection: CameraProjection,
}

/// The two camera types of glTF.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum CameraProjection {
    /// Perspective projection.
    Perspective {
        /// Vertical field of view in radians, in (0, π).
        fov_y: f64,
        /// Aspect ratio (width over height), if the file specifies it.
        aspect: Option<f64>,
        /// Distance of the near plane, > 0.
        near: f64,
        /// Distance of the far plane, > `near`; infinite if the file does not specify it.
        far: f64,
    },
    /// Orthographic projection.
    Orthographic {
        /// Half the width of the view volume (`xmag`), > 0.
        half_width: f64,
        /// Half the height of the view volume (`ymag`), > 0.
        half_height: f64,
        /// Distance of the near plane, ≥ 0.
        near: f64,
        /// Distance of the far plane, > `near`.
        far: f64,
    },
}
