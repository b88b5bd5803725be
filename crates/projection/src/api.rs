//! Builders under the names used by graphics APIs.
//!
//! All functions take `near` and `far` as distances and return only the matrix. They reject an
//! infinite `far` if the formula needs a finite value. Each is a one-line wrapper around
//! [`Frustum`], [`Perspective`] or [`Orthographic`] with its [`Convention`]. `fovy` is in radians
//! (M19), and `aspect` is width / height. In the names:
//! - `lh` means that the camera looks along +z;
//! - `zo` means that depth ranges from zero to one;
//! - `rev` means that near is at 1;
//! - `inf` means that there is no far plane.
//!
//! ```
//! use projection::{Convention, Frustum, api};
//! let by_name = api::frustum_gl(-1.0, 3.0, -2.0, 1.0, 2.0, 6.0)?;
//! let frustum = Frustum::new(-1.0, 3.0, -2.0, 1.0, 2.0, 6.0)?;
//! assert_eq!(by_name, frustum.view_to_clip(Convention::OPENGL));
//! # Ok::<(), projection::ProjectionError>(())
//! ```

use crate::error::check_finite;
use crate::{Convention, Fov, Frustum, Orthographic, Perspective, ProjectionError};
use homog::{Clip, Projective, View};

type Matrix = Result<Projective<View, Clip>, ProjectionError>;

const ZERO_ONE_RH: Convention = Convention::WEBGPU;
const ZERO_ONE_LH: Convention = Convention::DIRECT3D;

fn frustum_matrix(window: [f64; 4], near: f64, far: f64, convention: Convention) -> Matrix {
    let [left, right, bottom, top] = window;
    let frustum = Frustum::new(left, right, bottom, top, near, check_finite("far", far)?)?;
    Ok(frustum.view_to_clip(convention))
}

fn perspective_matrix(
    fovy: f64,
    aspect: f64,
    near: f64,
    far: f64,
    convention: Convention,
) -> Matrix {
    infinite_perspective_matrix(fovy, aspect, near, check_finite("far", far)?, convention)
}

fn infinite_perspective_matrix(
    fovy: f64,
    aspect: f64,
    near: f64,
    far: f64,
    convention: Convention,
) -> Matrix {
    Ok(Perspective::new(Fov::Vertical(fovy), aspect, near, far)?.view_to_clip(convention))
}

macro_rules! by_window {
    ($(#[$doc:meta])* $name:ident, $convention:expr) => {
        $(#[$doc])*
        ///
        /// # Errors
        /// Returns an error if a number is not finite, if the window is empty, or if 0 < near < far
        /// does not hold.
        pub fn $name(left: f64, right: f64, bottom: f64, top: f64, near: f64, far: f64) -> Matrix {
            frustum_matrix([left, right, bottom, top], near, far, $convention)
        }
    };
}

macro_rules! by_box {
    ($(#[$doc:meta])* $name:ident, $convention:expr) => {
        $(#[$doc])*
        /// `near` and `far` may be any two different distances.
        ///
        /// # Errors
        /// Returns an error if a number is not finite or two opposite sides coincide.
        pub fn $name(left: f64, right: f64, bottom: f64, top: f64, near: f64, far: f64) -> Matrix {
            Ok(Orthographic::new(left, right, bottom, top, near, far)?.view_to_clip($convention))
        }
    };
}

macro_rules! by_angle {
    ($(#[$doc:meta])* $name:ident, $convention:expr) => {
        $(#[$doc])*
        ///
        /// # Errors
        /// Returns an error if a number is not finite, if fovy is not between 0 and π, if aspect is
        /// not positive, or if 0 < near < far does not hold.
        pub fn $name(fovy: f64, aspect: f64, near: f64, far: f64) -> Matrix {
            perspective_matrix(fovy, aspect, near, far, $convention)
        }
    };
    ($(#[$doc:meta])* $name:ident, $convention:expr, infinite) => {
        $(#[$doc])*
        ///
        /// # Errors
        /// Returns an error if a number is not finite, if fovy is not between 0 and π, or if aspect
        /// or near is not positive.
        pub fn $name(fovy: f64, aspect: f64, near: f64) -> Matrix {
            infinite_perspective_matrix(fovy, aspect, near, f64::INFINITY, $convention)
        }
    };
}

by_window! {
    /// Builds glFrustum (GL-1, C91): right-handed, near at −1, far at +1.
    frustum_gl, Convention::OPENGL
}
by_window! {
    /// Builds D3D-4: right-handed, near at 0, far at 1.
    frustum_rh_zo, ZERO_ONE_RH
}
by_window! {
    /// Builds D3D-3: left-handed, near at 0, far at 1.
    frustum_lh_zo, ZERO_ONE_LH
}
by_box! {
    /// Builds glOrtho and the `ortho` of `MV.js` (GL-3, C90): right-handed, near at −1, far at +1.
    ortho_gl, Convention::OPENGL
}
by_box! {
    /// Builds D3D-6: right-handed, near at 0, far at 1.
    ortho_rh_zo, ZERO_ONE_RH
}
by_box! {
    /// Builds D3D-5: left-handed, near at 0, far at 1.
    ortho_lh_zo, ZERO_ONE_LH
}
by_angle! {
    /// Builds gluPerspective, the `perspective` of `MV.js`, and createPerspective
    /// (GL-2, LW-2, C92).
    perspective_gl, Convention::OPENGL
}
by_angle! {
    /// Builds D3D-2: right-handed, near at 0, far at 1.
    perspective_rh_zo, ZERO_ONE_RH
}
by_angle! {
    /// Builds D3DXMatrixPerspectiveFovLH (D3D-1, C60), for column vectors.
    perspective_lh_zo, ZERO_ONE_LH
}
by_angle! {
    /// Builds RV-1: right-handed, near at 1, far at 0.
    perspective_rh_zo_rev, ZERO_ONE_RH.reversed()
}
by_angle! {
    /// Builds IF-1: right-handed, near at −1, infinity at +1.
    perspective_gl_inf, Convention::OPENGL, infinite
}
by_angle! {
    /// Builds IF-2: right-handed, near at 0, infinity at 1.
    perspective_rh_zo_inf, ZERO_ONE_RH, infinite
}
by_angle! {
    /// Builds IF-3: right-handed, near at 1 and infinity at 0, so depth = near/distance.
    perspective_rh_zo_rev_inf, ZERO_ONE_RH.reversed(), infinite
}
