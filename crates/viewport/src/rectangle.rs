//! Rectangles of pixels, of paper, of windows.

use crate::ViewportError;
use crate::error::{finite, positive};

/// A rectangle with sides along the axes, by its corner of least coordinates and its size.
///
/// # Guarantees
/// All four numbers are finite; width and height are greater than 0.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Rectangle {
    x: f64,
    y: f64,
    width: f64,
    height: f64,
}

impl Rectangle {
    /// The rectangle [x, x + width] × [y, y + height].
    ///
    /// # Errors
    /// If a number is not finite or a size is not greater than 0.
    pub fn new(x: f64, y: f64, width: f64, height: f64) -> Result<Self, ViewportError> {
        let (x, y) = (finite("x", x)?, finite("y", y)?);
        let (width, height) = (positive("width", width)?, positive("height", height)?);
        finite("x + width", x + width)?;
        finite("y + height", y + height)?;
        Ok(Self { x, y, width, height })
    }

    /// The rectangle of this size with its corner at the origin.
    ///
    /// # Errors
    /// If a size is not finite or not greater than 0.
    pub fn of_size(width: f64, height: f64) -> Result<Self, ViewportError> {
        Self::new(0.0, 0.0, width, height)
    }

    /// The least x.
    #[must_use]
    pub const fn x(&self) -> f64 {
        self.x
    }

    /// The least y.
    #[must_use]
    pub const fn y(&self) -> f64 {
        self.y
    }

    /// The extent along x, greater than 0.
    #[must_use]
    pub const fn width(&self) -> f64 {
        self.width
    }

    /// The extent along y, greater than 0.
    #[must_use]
    pub const fn height(&self) -> f64 {
        self.height
    }

    /// Width divided by height.
    #[must_use]
    pub fn aspect(&self) -> f64 {
        self.width / self.height
    }

    /// The point in the middle.
    #[must_use]
    pub fn centre(&self) -> [f64; 2] {
        [self.x + self.width / 2.0, self.y + self.height / 2.0]
    }

    /// True if the point is inside or on the border.
    #[must_use]
    pub fn contains(&self, [x, y]: [f64; 2]) -> bool {
        (self.x..=self.x + self.width).contains(&x) && (self.y..=self.y + self.height).contains(&y)
    }
}
