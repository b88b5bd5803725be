//! Viewport parameter errors.

use thiserror::Error;

/// An invalid parameter. Every variant names it, and the message states the requirement.
#[derive(Clone, Copy, PartialEq, Debug, Error)]
#[non_exhaustive]
pub enum ViewportError {
    /// A number is infinite or NaN.
    #[error("{name} = {value} is not a finite number")]
    NotFinite {
        /// The name of the parameter.
        name: &'static str,
        /// The rejected value.
        value: f64,
    },
    /// A size, resolution or scale is zero or negative.
    #[error("{name} = {value} is not allowed: it must be greater than 0")]
    NotPositive {
        /// The name of the parameter.
        name: &'static str,
        /// The rejected value.
        value: f64,
    },
    /// The two ends of an interval coincide, so it cannot be mapped.
    #[error("{name} is empty: both ends are {value}")]
    Empty {
        /// The name of the interval.
        name: &'static str,
        /// The value of both ends.
        value: f64,
    },
    /// A count is too small.
    #[error("{name} = {count} is not allowed: it must be at least {least}")]
    TooFew {
        /// The name of the parameter.
        name: &'static str,
        /// The rejected value.
        count: usize,
        /// The minimum allowed value.
        least: usize,
    },
    /// A parameter is too large or too small, or the parameters differ too much in size, so the map
    /// or its inverse would not be finite.
    #[error("{name} is too large or too small to compute with")]
    OutOfRange {
        /// The name of the parameter, or of the result computed from it.
        name: &'static str,
    },
}

pub(crate) fn check_finite(name: &'static str, value: f64) -> Result<f64, ViewportError> {
    if value.is_finite() { Ok(value) } else { Err(ViewportError::NotFinite { name, value }) }
}

pub(crate) fn check_positive(name: &'static str, value: f64) -> Result<f64, ViewportError> {
    check_finite(name, value)?;
    if value > 0.0 { Ok(value) } else { Err(ViewportError::NotPositive { name, value }) }
}

/// Checks that both ends of an interval are finite and that they differ.
pub(crate) fn check_interval(
    name: &'static str,
    ends: [f64; 2],
) -> Result<[f64; 2], ViewportError> {
    let [start, end] = ends;
    check_finite(name, start)?;
    check_finite(name, end)?;
    if start == end { Err(ViewportError::Empty { name, value: start }) } else { Ok(ends) }
}
