//! Errors of projection parameters.

use homog::ClipRangeError;
use thiserror::Error;

/// A parameter was refused. Every message names the parameter, its value and what is allowed.
#[derive(Clone, Copy, PartialEq, Debug, Error)]
#[non_exhaustive]
pub enum ProjectionError {
    /// NaN or an infinity where a number is due.
    #[error("`{parameter}` is {value}; it must be a finite number")]
    NotFinite {
        /// The parameter at fault.
        parameter: &'static str,
        /// The value given.
        value: f64,
    },
    /// A number outside its range.
    #[error("`{parameter}` is {value}; allowed: {allowed}")]
    OutOfRange {
        /// The parameter at fault.
        parameter: &'static str,
        /// The value given.
        value: f64,
        /// The allowed values, in words.
        allowed: &'static str,
    },
    /// Two opposite edges of the window coincide, so that the picture has no width or no height.
    #[error("the window is empty: `{low}` and `{high}` are both {value}")]
    EmptyWindow {
        /// The name of the left or bottom edge.
        low: &'static str,
        /// The name of the right or top edge.
        high: &'static str,
        /// Where both edges are.
        value: f64,
    },
    /// The near and the far plane coincide.
    #[error("the depth range is empty: `near` and `far` are both {value}")]
    EmptyDepth {
        /// Where both planes are.
        value: f64,
    },
    /// The far plane does not lie beyond the near one.
    #[error("`far` ({far}) must lie beyond `near` ({near}) along the line of sight")]
    FarNotBeyondNear {
        /// The near plane as given.
        near: f64,
        /// The far plane as given.
        far: f64,
    },
    /// A direction of length zero.
    #[error("`{parameter}` is the zero vector; it must have a direction")]
    ZeroVector {
        /// The parameter at fault.
        parameter: &'static str,
    },
    /// Projectors that never meet the plane they should meet in one point.
    #[error("the projectors are parallel to the projection plane and never meet it")]
    ParallelToPlane,
    /// The center of projection lies on the projection plane.
    #[error("the center of projection lies on the projection plane")]
    CenterOnPlane,
    /// No vanishing point was asked for (p = q = r = 0), which is no perspective.
    #[error("p, q and r are all 0: that is a parallel projection, it has no vanishing point")]
    NoVanishingPoint,
    /// Three or two vanishing points to which no eye belongs.
    #[error("no eye sees these vanishing points at right angles: {reason}")]
    ImpossibleVanishingPoints {
        /// The reason.
        reason: &'static str,
    },
    /// Three foreshortening ratios that no axonometric projection has.
    #[error("no axonometric projection shortens the axes as {x} : {y} : {z}; {reason}")]
    ImpossibleForeshortening {
        /// The ratio of the x axis.
        x: f64,
        /// The ratio of the y axis.
        y: f64,
        /// The ratio of the z axis.
        z: f64,
        /// The law it breaks.
        reason: &'static str,
    },
    /// The frustum's window is not centered on the line of sight, so that no field of view describes
    /// it.
    #[error("the window is off center; a perspective by field of view cannot show it")]
    OffCenter,
    /// All parameters are fine by themselves, but the matrix would overflow or underflow.
    #[error("the {what} is too large, too small or too extreme to compute with")]
    Unrepresentable {
        /// The part of the projection at fault.
        what: &'static str,
    },
}

/// Passes a finite number on and refuses any other.
pub(crate) fn check_finite(parameter: &'static str, value: f64) -> Result<f64, ProjectionError> {
    if value.is_finite() { Ok(value) } else { Err(ProjectionError::NotFinite { parameter, value }) }
}

/// Passes a finite number above zero on and refuses any other.
pub(crate) fn check_positive(parameter: &'static str, value: f64) -> Result<f64, ProjectionError> {
    if check_finite(parameter, value)? > 0.0 {
        Ok(value)
    } else {
        Err(ProjectionError::OutOfRange { parameter, value, allowed: "greater than 0" })
    }
}

/// Passes an angle between 0 and π, both excluded, on and refuses any other.
pub(crate) fn check_opening_angle(
    parameter: &'static str,
    value: f64,
) -> Result<f64, ProjectionError> {
    let allowed = "between 0 and π radians, both excluded";
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
