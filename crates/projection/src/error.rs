//! Projection parameter errors.

use homog::ClipRangeError;
use thiserror::Error;

/// An error in the parameters of a projection; the message states the violated condition.
#[derive(Clone, Copy, PartialEq, Debug, Error)]
#[non_exhaustive]
pub enum ProjectionError {
    /// The parameter is NaN or infinite.
    #[error("`{parameter}` is {value}; it must be a finite number")]
    NotFinite {
        /// The name of the parameter.
        parameter: &'static str,
        /// The rejected value.
        value: f64,
    },
    /// The parameter is out of range.
    #[error("`{parameter}` is {value}; it must be {allowed}")]
    OutOfRange {
        /// The name of the parameter.
        parameter: &'static str,
        /// The rejected value.
        value: f64,
        /// The allowed values, worded to follow "it must be".
        allowed: &'static str,
    },
    /// Two opposite edges of the window coincide, so the picture has no width or no height.
    #[error("the window is empty: `{low}` and `{high}` are both {value}")]
    EmptyWindow {
        /// The name of the left or bottom edge.
        low: &'static str,
        /// The name of the right or top edge.
        high: &'static str,
        /// The position of both edges.
        value: f64,
    },
    /// The near and far planes coincide.
    #[error("the depth range is empty: `near` and `far` are both {value}")]
    EmptyDepth {
        /// The distance of both planes.
        value: f64,
    },
    /// The far plane is not beyond the near plane.
    #[error("`far` ({far}) must be beyond `near` ({near}) along the line of sight")]
    FarNotBeyondNear {
        /// The rejected near plane.
        near: f64,
        /// The rejected far plane.
        far: f64,
    },
    /// A direction has length zero.
    #[error("`{parameter}` is the zero vector; it must have a direction")]
    ZeroVector {
        /// The name of the parameter.
        parameter: &'static str,
    },
    /// The projectors are parallel to the plane, so they do not meet it in a single point.
    #[error("the projectors are parallel to the projection plane and never meet it")]
    ParallelToPlane,
    /// The center of projection is in the projection plane.
    #[error("the center of projection is in the projection plane")]
    CenterOnPlane,
    /// There is no vanishing point (p = q = r = 0), so this is not a perspective projection.
    #[error("p, q and r are all 0: this is a parallel projection, without vanishing points")]
    NoVanishingPoint,
    /// No eye sees these two or three vanishing points in perpendicular directions.
    #[error("no eye sees these vanishing points in perpendicular directions: {reason}")]
    ImpossibleVanishingPoints {
        /// The reason why no eye exists.
        reason: &'static str,
    },
    /// No axonometric projection has these three foreshortening ratios.
    #[error("no axonometric projection has the foreshortening ratios {x} : {y} : {z}; {reason}")]
    ImpossibleForeshortening {
        /// The foreshortening ratio of the x axis.
        x: f64,
        /// The foreshortening ratio of the y axis.
        y: f64,
        /// The foreshortening ratio of the z axis.
        z: f64,
        /// The violated condition.
        reason: &'static str,
    },
    /// The frustum's window is not centered on the line of sight, so no field of view describes it.
    #[error("the window is off-center; a field of view cannot describe it")]
    OffCenter,
    /// The matrix is not a perspective projection through a pinhole, or is not invertible.
    #[error("the matrix is not an invertible pinhole projection; it has no intrinsics")]
    NotPinhole,
    /// Each parameter is valid, but the matrix would overflow or underflow.
    #[error("the {what} is too large, too small or too extreme to compute with")]
    Unrepresentable {
        /// The affected part of the projection.
        what: &'static str,
    },
}

/// Returns the value if it is finite, and an error otherwise.
pub(crate) fn check_finite(parameter: &'static str, value: f64) -> Result<f64, ProjectionError> {
    if value.is_finite() { Ok(value) } else { Err(ProjectionError::NotFinite { parameter, value }) }
}

/// Returns the value if it is finite and positive, and an error otherwise.
pub(crate) fn check_positive(parameter: &'static str, value: f64) -> Result<f64, ProjectionError> {
    if check_finite(parameter, value)? > 0.0 {
        Ok(value)
    } else {
        Err(ProjectionError::OutOfRange { parameter, value, allowed: "greater than 0" })
    }
}

/// Returns the angle if it is strictly between 0 and π, and an error otherwise.
pub(crate) fn check_opening_angle(
    parameter: &'static str,
    value: f64,
) -> Result<f64, ProjectionError> {
    let allowed = "between 0 and π radians, exclusive";
    if check_finite(parameter, value)? > 0.0 && value < core::f64::consts::PI {
        Ok(value)
    } else {
        Err(ProjectionError::OutOfRange { parameter, value, allowed })
    }
}

impl From<ClipRangeError> for ProjectionError {
    fn from(error: ClipRangeError) -> Self {
        match error {
            ClipRangeError::Depth { name: parameter, value } if !value.is_finite() => {
                Self::NotFinite { parameter, value }
            }
            ClipRangeError::Depth { name: parameter, value } => {
                Self::OutOfRange { parameter, value, allowed: "between −1 and 1" }
            }
            ClipRangeError::TooClose { far: value } => Self::OutOfRange {
                parameter: "far_depth",
                value,
                allowed: "at least 0.000001 away from `near_depth`",
            },
        }
    }
}
