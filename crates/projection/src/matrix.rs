//! The two matrix forms behind every builder, central and parallel, with their closed-form inverses
//! (IV-1).
//!
//! With D the distance in front of the eye, a window [l, r] × [b, t] and depth coefficients (c, e):
//!
//! ```text
//!            central (window on D = near)             parallel
//!  x' =    2N/(r−l) x − (r+l)/(r−l) D        2/(r−l) x − (r+l)/(r−l)
//!  y' = ±( 2N/(t−b) y − (t+b)/(t−b) D )   ±( 2/(t−b) y − (t+b)/(t−b) )
//!  z' =           c D + e                          c D + e
//!  w' =             D                                 1
//! ```

use crate::{Convention, ProjectionError};
use glam::{DMat4, DVec4};
use homog::{Clip, Projective, View};

/// The map of x and y for the window: x' = `scale_x` x − `center_x` (times D if central).
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct WindowFit {
    pub(crate) scale_x: f64,
    pub(crate) scale_y: f64,
    pub(crate) center_x: f64,
    pub(crate) center_y: f64,
}

impl WindowFit {
    /// Rejects values that would overflow in the matrix or in its inverse.
    pub(crate) fn check_fit(self) -> Result<Self, ProjectionError> {
        let usable = is_invertible(self.scale_x)
            && is_invertible(self.scale_y)
            && is_bounded(self.center_x)
            && is_bounded(self.center_y)
            && is_bounded(self.center_x / self.scale_x)
            && is_bounded(self.center_y / self.scale_y);
        usable.then_some(self).ok_or(ProjectionError::Unrepresentable { what: "window" })
    }
}

/// The depth row: z' = `factor` D + `offset`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct DepthRow {
    pub(crate) factor: f64,
    pub(crate) offset: f64,
}

impl DepthRow {
    /// Returns the row for which z'/D is the near depth at D = near and the far depth at D = far,
    /// which may be infinite (IF-1..3).
    pub(crate) fn central(near: f64, far: f64, convention: Convention) -> Self {
        let (at_near, at_far) = (convention.near_depth(), convention.far_depth());
        if far == f64::INFINITY {
            return Self { factor: at_far, offset: near * (at_near - at_far) };
        }
        let far_part = far / (far - near);
        let near_part = near / (far - near);
        Self {
            factor: at_far * far_part - at_near * near_part,
            offset: near * far_part * (at_near - at_far),
        }
    }

    /// Returns the row for which z' is the near depth at D = near and the far depth at D = far.
    pub(crate) fn parallel(near: f64, far: f64, convention: Convention) -> Self {
        let (at_near, at_far) = (convention.near_depth(), convention.far_depth());
        Self {
            factor: (at_far - at_near) / (far - near),
            offset: at_near * (far / (far - near)) - at_far * (near / (far - near)),
        }
    }

    /// Rejects planes whose central depth row or its inverse would overflow.
    pub(crate) fn check_central(near: f64, far: f64) -> Result<(), ProjectionError> {
        let row = Self::central(near, far, Convention::OPENGL);
        let usable = is_invertible(row.offset) && is_bounded(row.factor / row.offset);
        usable.then_some(()).ok_or(ProjectionError::Unrepresentable { what: "depth range" })
    }

    /// Rejects planes whose parallel depth row or its inverse would overflow.
    pub(crate) fn check_parallel(near: f64, far: f64) -> Result<(), ProjectionError> {
        let row = Self::parallel(near, far, Convention::OPENGL);
        let usable = is_invertible(row.factor) && is_bounded(row.offset);
        usable.then_some(()).ok_or(ProjectionError::Unrepresentable { what: "depth range" })
    }
}

/// Returns whether the value is small enough to be multiplied by the factors of a convention.
pub(crate) fn is_bounded(value: f64) -> bool {
    value.abs() < 1e280
}

/// Returns whether both the value and its reciprocal are bounded.
pub(crate) fn is_invertible(value: f64) -> bool {
    is_bounded(value) && value.abs() > 1e-280
}

/// Returns the central form, in which w is the distance in front of the eye.
pub(crate) fn central_matrix(
    fit: WindowFit,
    depth: DepthRow,
    convention: Convention,
) -> Projective<View, Clip> {
    let (ahead, top) = (convention.ahead(), convention.top());
    Projective::from_raw(DMat4::from_cols(
        DVec4::new(fit.scale_x, 0.0, 0.0, 0.0),
        DVec4::new(0.0, top * fit.scale_y, 0.0, 0.0),
        DVec4::new(-fit.center_x, -top * fit.center_y, depth.factor, 1.0) * ahead,
        DVec4::new(0.0, 0.0, depth.offset, 0.0),
    ))
}

/// Returns the inverse of [`central_matrix`], by IV-1.
pub(crate) fn central_inverse(
    fit: WindowFit,
    depth: DepthRow,
    convention: Convention,
) -> Projective<Clip, View> {
    let (ahead, top) = (convention.ahead(), convention.top());
    Projective::from_raw(DMat4::from_cols(
        DVec4::new(1.0 / fit.scale_x, 0.0, 0.0, 0.0),
        DVec4::new(0.0, top / fit.scale_y, 0.0, 0.0),
        DVec4::new(0.0, 0.0, 0.0, 1.0 / depth.offset),
        DVec4::new(
            fit.center_x / fit.scale_x,
            fit.center_y / fit.scale_y,
            ahead,
            -depth.factor / depth.offset,
        ),
    ))
}

/// Returns the parallel form, in which w stays 1.
pub(crate) fn parallel_matrix(
    fit: WindowFit,
    depth: DepthRow,
    convention: Convention,
) -> Projective<View, Clip> {
    let (ahead, top) = (convention.ahead(), convention.top());
    Projective::from_raw(DMat4::from_cols(
        DVec4::new(fit.scale_x, 0.0, 0.0, 0.0),
        DVec4::new(0.0, top * fit.scale_y, 0.0, 0.0),
        DVec4::new(0.0, 0.0, depth.factor * ahead, 0.0),
        DVec4::new(-fit.center_x, -top * fit.center_y, depth.offset, 1.0),
    ))
}

/// Returns the inverse of [`parallel_matrix`].
pub(crate) fn parallel_inverse(
    fit: WindowFit,
    depth: DepthRow,
    convention: Convention,
) -> Projective<Clip, View> {
    let (ahead, top) = (convention.ahead(), convention.top());
    Projective::from_raw(DMat4::from_cols(
        DVec4::new(1.0 / fit.scale_x, 0.0, 0.0, 0.0),
        DVec4::new(0.0, top / fit.scale_y, 0.0, 0.0),
        DVec4::new(0.0, 0.0, ahead / depth.factor, 0.0),
        DVec4::new(
            fit.center_x / fit.scale_x,
            fit.center_y / fit.scale_y,
            -ahead * (depth.offset / depth.factor),
            1.0,
        ),
    ))
}

/// Creates a matrix from its rows.
pub(crate) fn from_rows(rows: [[f64; 4]; 4]) -> DMat4 {
    DMat4::from_cols_array_2d(&rows).transpose()
}

/// Rejects a matrix with an entry too large for further computation.
pub(crate) fn check_representable(
    matrix: DMat4,
    what: &'static str,
) -> Result<DMat4, ProjectionError> {
    let usable = matrix.to_cols_array().into_iter().all(is_bounded);
    usable.then_some(matrix).ok_or(ProjectionError::Unrepresentable { what })
}
