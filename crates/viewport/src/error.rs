//! Viewport parameter errors.

use thiserror::Error;

/// An invalid parameter. Every variant names it and its allowed values.
#[derive(Clone, Copy, PartialEq, Debug, Error)]
#[non_exhaustive]
pub enum ViewportError {
    /// A number is infinite or NaN.
    #[error("{name} = {value} is not a finite number")]
    NotFinite {
        /// The parameter.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A size, a resolution or a scale is zero or negative.
    #[error("{name} = {value} is not allowed: it must be greater than 0")]
    NotPositive {
        /// The parameter.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// Two limits that must differ coincide, so there is nothing to map.
    #[error("{name} is empty: both its ends are {value}")]
    Empty {
        /// The interval.
        name: &'static str,
        /// The value of both ends.
        value: f64,
    },
    /// A count is too small.
    #[error("{name} = {count} is not allowed: it must be at least {least}")]
    TooFew {
        /// The name of the count.
        name: &'static str,
        /// The count.
        count: usize,
        /// The minimum allowed.
        least: usize,
    },
    /// A parameter is too large or too small, or parameters differ too much in size, for finite
    /// maps in both directions.
    #[error("{name} is too large or too small to compute with")]
    OutOfRange {
        /// The parameter or the result.
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

/// Checks both ends of an interval, which must differ.
pub(crate) fn check_interval(
    name: &'static str,
    ends: [f64; 2],
) -> Result<[f64; 2], ViewportError> {
    let [start, end] = ends;
    check_finite(name, start)?;
    check_finite(name, end)?;
    if start == end { Err(ViewportError::Empty { name, value: start }) } else { Ok(ends) }
}
