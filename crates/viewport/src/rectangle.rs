//! Rectangles for pixels, paper and windows.

use crate::ViewportError;
use crate::error::{check_finite, check_positive};

/// An axis-aligned rectangle, defined by its corner of minimum coordinates and its size.
///
/// # Guarantees
/// The width and height are greater than 0. The magnitudes of all four numbers are at most 10¹⁰⁰,
/// and the sizes are at least 10⁻¹⁰⁰, which keeps maps and their inverses finite.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Rectangle {
    x: f64,
    y: f64,
    width: f64,
    height: f64,
}

const MAX_EXTENT: f64 = 1e100;
const MIN_EXTENT: f64 = 1e-100;

impl Rectangle {
    /// Creates the rectangle [x, x + width] × [y, y + height].
    ///
    /// # Errors
    /// Returns an error if a number is not finite or too large, or if a size is not greater than 0
    /// or too small.
    pub fn new(x: f64, y: f64, width: f64, height: f64) -> Result<Self, ViewportError> {
        for (name, value) in [("x", x), ("y", y)] {
            if check_finite(name, value)?.abs() > MAX_EXTENT {
                return Err(ViewportError::OutOfRange { name });
            }
        }
        for (name, value) in [("width", width), ("height", height)] {
            if !(MIN_EXTENT..=MAX_EXTENT).contains(&check_positive(name, value)?) {
                return Err(ViewportError::OutOfRange { name });
            }
        }
        Ok(Self { x, y, width, height })
    }

    /// Creates a rectangle of this size with its corner at the origin.
    ///
    /// # Errors
    /// Returns an error if a size is not finite or not greater than 0.
    pub fn from_size(width: f64, height: f64) -> Result<Self, ViewportError> {
        Self::new(0.0, 0.0, width, height)
    }

    /// Creates a rectangle from numbers that are known to be valid.
    pub(crate) const fn new_unchecked(x: f64, y: f64, width: f64, height: f64) -> Self {
        Self { x, y, width, height }
    }

    /// Returns the minimum x.
    #[must_use]
    pub const fn x(&self) -> f64 {
        self.x
    }

    /// Returns the minimum y.
    #[must_use]
    pub const fn y(&self) -> f64 {
        self.y
    }

    /// Returns the extent along x, which is greater than 0.
    #[must_use]
    pub const fn width(&self) -> f64 {
        self.width
    }

    /// Returns the extent along y, which is greater than 0.
    #[must_use]
    pub const fn height(&self) -> f64 {
        self.height
    }

    /// Returns the width divided by the height.
    #[must_use]
    pub fn aspect(&self) -> f64 {
        self.width / self.height
    }

    /// Returns the center.
    #[must_use]
    pub fn center(&self) -> [f64; 2] {
        [self.x + self.width / 2.0, self.y + self.height / 2.0]
    }

    /// Returns whether the point is inside or on the border.
    #[must_use]
    pub fn contains(&self, [x, y]: [f64; 2]) -> bool {
        (self.x..=self.x + self.width).contains(&x) && (self.y..=self.y + self.height).contains(&y)
    }
}
