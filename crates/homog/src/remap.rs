//! Linear remapping of intervals and boxes: LI-1, WI-2, WI-3.
//!
//! ```text
//!   a ────────── x ──── b            (x − a)/(b − a) = (y − c)/(d − c)
//!   │            │      │
//!   c ────────── y ──── d            y = c + (x − a)(d − c)/(b − a)
//! ```
//!
//! Nothing is clamped: if x is outside [a, b], y is outside [c, d]. If c > d the interval is
//! reversed, and x > b gives y < d. (In one source, the comparison signs of "x < a or x > b gives y
//! < c or y > d" were lost in print. The statement is true only for c < d; misprint M27.)
//!
//! Sources: LI-1; WI-2 and WI-3, the windowing transformations of the textbook (Shirley and
//! Marschner, ch. 8).

use crate::{Affine, Homography, Point, Space, Vector};

/// The reason why an interval or a box cannot be remapped.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RemapError {
    /// A number is infinite or NaN.
    #[error("{name} is {value}, which is not finite")]
    NotFinite {
        /// The name of the number.
        name: &'static str,
        /// The rejected value.
        value: f64,
    },
    /// A size is zero or negative.
    #[error("{name} = {value} is not allowed: it must be greater than 0")]
    NotPositive {
        /// The name of the size.
        name: &'static str,
        /// The rejected value.
        value: f64,
    },
    /// The source interval is empty.
    #[error("the source {interval} is empty: it starts and ends at {at}")]
    Empty {
        /// The name of the interval: "interval", or for a box "x interval", "y interval" or "z
        /// interval".
        interval: &'static str,
        /// The number at which it starts and ends.
        at: f64,
    },
    /// The result is too large.
    #[error(
        "mapping [{}, {}] to [{}, {}] exceeds the range of f64", from[0], from[1], to[0], to[1]
    )]
    OutOfRange {
        /// The source interval.
        from: [f64; 2],
        /// The target interval.
        to: [f64; 2],
    },
}

/// Returns the number whose position in `to` matches the position of `x` in `from` (LI-1). Values
/// outside `from` are extrapolated. Either interval may be reversed.
///
/// # Errors
/// Returns an error if a number is not finite, `from` is empty or the result is out of range.
///
/// ```
/// use homog::remap_interval;
/// assert_eq!(remap_interval(0.25, [0.0, 1.0], [5.0, 9.0]), Ok(6.0));
/// assert_eq!(remap_interval(-3.0, [-1.0, 1.0], [0.0, 10.0]), Ok(-10.0));
/// assert!(remap_interval(1.0, [2.0, 2.0], [0.0, 1.0]).is_err());
/// ```
pub fn remap_interval(x: f64, from: [f64; 2], to: [f64; 2]) -> Result<f64, RemapError> {
    check_finite("the number to map", x)?;
    check_intervals("interval", from, to)?;
    let y = to[0] + (x - from[0]) * ((to[1] - to[0]) / (from[1] - from[0]));
    if y.is_finite() { Ok(y) } else { Err(RemapError::OutOfRange { from, to }) }
}

/// Returns the factor and the offset of the map y = factor · x + offset.
fn scale_and_offset(
    interval: &'static str,
    from: [f64; 2],
    to: [f64; 2],
) -> Result<(f64, f64), RemapError> {
    check_intervals(interval, from, to)?;
    let length = from[1] - from[0];
    let scale = (to[1] - to[0]) / length;
    let offset = (to[0] * from[1] - to[1] * from[0]) / length;
    if scale.is_finite() && offset.is_finite() {
        Ok((scale, offset))
    } else {
        Err(RemapError::OutOfRange { from, to })
    }
}

fn check_intervals(interval: &'static str, from: [f64; 2], to: [f64; 2]) -> Result<(), RemapError> {
    check_finite("the start of the source interval", from[0])?;
    check_finite("the end of the source interval", from[1])?;
    check_finite("the start of the target interval", to[0])?;
    check_finite("the end of the target interval", to[1])?;
    if from[0] == from[1] {
        return Err(RemapError::Empty { interval, at: from[0] });
    }
    Ok(())
}

pub(crate) fn check_finite(name: &'static str, value: f64) -> Result<(), RemapError> {
    if value.is_finite() { Ok(()) } else { Err(RemapError::NotFinite { name, value }) }
}

impl Homography {
    /// Returns the map that takes the rectangle with opposite corners `from` to the rectangle with
    /// opposite corners `to` (WI-2).
    ///
    /// # Errors
    /// Returns the same errors as [`remap_interval`], for either axis.
    pub fn windowing(from: [[f64; 2]; 2], to: [[f64; 2]; 2]) -> Result<Self, RemapError> {
        let axis =
            |name, i: usize| scale_and_offset(name, [from[0][i], from[1][i]], [to[0][i], to[1][i]]);
        let ((sx, dx), (sy, dy)) = (axis("x interval", 0)?, axis("y interval", 1)?);
        Ok(Self::from_rows([[sx, 0.0, dx], [0.0, sy, dy], [0.0, 0.0, 1.0]]))
    }
}

impl<A: Space, B: Space> Affine<A, B> {
    /// Returns the map that takes the box with opposite corners `from` to the box with opposite
    /// corners `to` (WI-3). The target box may be flat or mirrored.
    ///
    /// # Errors
    /// Returns the same errors as [`remap_interval`], for any of the three axes.
    pub fn windowing(from: [Point<A>; 2], to: [Point<B>; 2]) -> Result<Self, RemapError> {
        let (from, to) = (from.map(<[f64; 3]>::from), to.map(<[f64; 3]>::from));
        let axis =
            |name, i: usize| scale_and_offset(name, [from[0][i], from[1][i]], [to[0][i], to[1][i]]);
        let ((sx, dx), (sy, dy), (sz, dz)) =
            (axis("x interval", 0)?, axis("y interval", 1)?, axis("z interval", 2)?);
        let (x, y, z) = (Vector::X * sx, Vector::Y * sy, Vector::Z * sz);
        Ok(Self::from_frame(x, y, z, Point::new(dx, dy, dz)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ndc, View};

    #[test]
    fn c53_misprint_m27_a_reversed_range_swaps_the_sides() {
        let rising = [0.0, 10.0];
        assert_eq!(remap_interval(-3.0, [-1.0, 1.0], rising), Ok(-10.0));
        assert_eq!(
            remap_interval(-3.0, [-1.0, 1.0], [10.0, 0.0]),
            Ok(20.0),
            "x < a, but y is above both ends"
        );
        assert_eq!(
            remap_interval(3.0, [-1.0, 1.0], [10.0, 0.0]),
            Ok(-10.0),
            "x > b, but y is below both ends"
        );
    }

    #[test]
    fn opposite_corners_map_to_opposite_corners() {
        let from = [Point::<View>::new(-2.0, 4.0, -1.0), Point::new(4.0, -1.0, -5.0)];
        let to = [Point::<Ndc>::new(-1.0, 1.0, 1.0), Point::new(1.0, -1.0, -1.0)];
        let map = Affine::windowing(from, to).expect("a box");
        for (p, q) in from.into_iter().zip(to) {
            assert!(
                (map.transform_point(p) - q).length() < 1e-15,
                "{p} maps to {}, not {q}",
                map.transform_point(p)
            );
        }
        let flat = Affine::windowing(to, from).expect("a box").then(
            Affine::windowing(from, [Point::<Ndc>::ORIGIN; 2]).expect("flat, but from a box"),
        );
        assert_eq!(flat.determinant(), 0.0);
    }

    #[test]
    fn empty_infinite_and_overflowing_intervals_are_rejected() {
        let empty = Homography::windowing([[0.0, 1.0], [2.0, 1.0]], [[0.0; 2], [1.0; 2]]);
        assert_eq!(empty, Err(RemapError::Empty { interval: "y interval", at: 1.0 }));
        let unit = [0.0, 1.0];
        assert!(matches!(remap_interval(f64::NAN, unit, unit), Err(RemapError::NotFinite { .. })));
        assert!(matches!(
            remap_interval(0.0, [0.0, f64::INFINITY], unit),
            Err(RemapError::NotFinite { .. })
        ));
        assert!(matches!(
            remap_interval(1e308, [0.0, 1e-9], unit),
            Err(RemapError::OutOfRange { .. })
        ));
    }
}
