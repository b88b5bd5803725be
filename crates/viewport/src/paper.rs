//! Paper: millimeters, dots per inch, and drawings to scale 1:n.

use crate::error::check_positive;
use crate::{Rectangle, ViewportError};
use core::fmt;

/// Millimeters per inch, by definition.
pub const MILLIMETERS_PER_INCH: f64 = 25.4;

/// The resolution of a device, in dots per unit of length.
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug)]
pub struct Resolution {
    dots_per_inch: f64,
}

impl Resolution {
    /// Creates a resolution of `dpi` dots per inch.
    ///
    /// # Errors
    /// Returns an error if `dpi` is not finite or not greater than 0.
    pub fn dots_per_inch(dpi: f64) -> Result<Self, ViewportError> {
        Ok(Self { dots_per_inch: check_positive("dots per inch", dpi)? })
    }

    /// Converts millimeters to dots.
    #[must_use]
    pub fn to_dots(self, millimetres: f64) -> f64 {
        millimetres * self.dots_per_inch / MILLIMETERS_PER_INCH
    }

    /// Converts dots to millimeters.
    #[must_use]
    pub fn to_millimeters(self, dots: f64) -> f64 {
        dots * MILLIMETERS_PER_INCH / self.dots_per_inch
    }

    /// Converts a rectangle from millimeters to dots.
    ///
    /// # Errors
    /// Returns an error if the result is not a finite rectangle.
    pub fn to_pixel_rectangle(self, millimetres: Rectangle) -> Result<Rectangle, ViewportError> {
        let [x, y] = [millimetres.x(), millimetres.y()].map(|mm| self.to_dots(mm));
        Rectangle::new(x, y, self.to_dots(millimetres.width()), self.to_dots(millimetres.height()))
    }
}

/// A paper size in millimeters. The constants are in portrait orientation.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Paper {
    width: f64,
    height: f64,
}

impl Paper {
    /// 841 × 1189 mm (ISO 216).
    pub const A0: Self = Self { width: 841.0, height: 1189.0 };
    /// 594 × 841 mm.
    pub const A1: Self = Self { width: 594.0, height: 841.0 };
    /// 420 × 594 mm.
    pub const A2: Self = Self { width: 420.0, height: 594.0 };
    /// 297 × 420 mm.
    pub const A3: Self = Self { width: 297.0, height: 420.0 };
    /// 210 × 297 mm.
    pub const A4: Self = Self { width: 210.0, height: 297.0 };
    /// 148 × 210 mm.
    pub const A5: Self = Self { width: 148.0, height: 210.0 };
    /// 8½ × 11 inches.
    pub const LETTER: Self = Self { width: 215.9, height: 279.4 };
    /// 11 × 17 inches.
    pub const TABLOID: Self = Self { width: 279.4, height: 431.8 };

    /// Creates a paper size from a width and height in millimeters.
    ///
    /// # Errors
    /// Returns an error if a size is not finite or not greater than 0.
    pub fn new(width: f64, height: f64) -> Result<Self, ViewportError> {
        Ok(Self {
            width: check_positive("paper width", width)?,
            height: check_positive("paper height", height)?,
        })
    }

    /// Returns this sheet rotated by a right angle: landscape instead of portrait.
    #[must_use]
    pub const fn rotated(self) -> Self {
        Self { width: self.height, height: self.width }
    }

    /// Returns the width in millimeters.
    #[must_use]
    pub const fn width(self) -> f64 {
        self.width
    }

    /// Returns the height in millimeters.
    #[must_use]
    pub const fn height(self) -> f64 {
        self.height
    }

    /// Returns the sheet as a rectangle in millimeters with its corner at the origin.
    #[must_use]
    pub fn to_rectangle(self) -> Rectangle {
        Rectangle::new_unchecked(0.0, 0.0, self.width, self.height)
    }

    /// Returns the size of the sheet rounded to whole pixels, at least one in each direction, or
    /// `None` if a count does not fit in a `u32`.
    #[must_use]
    pub fn pixel_size(self, resolution: Resolution) -> Option<[u32; 2]> {
        let count = |millimetres: f64| {
            let dots = libm::round(resolution.to_dots(millimetres)).max(1.0);
            (dots <= f64::from(u32::MAX)).then_some(dots as u32)
        };
        Some([count(self.width)?, count(self.height)?])
    }
}

/// The scale of a drawing: the ratio of lengths on paper to real lengths, as in 1:50 or 2:1.
///
/// ```
/// use viewport::DrawingScale;
/// let scale = DrawingScale::new(1, 50)?;
/// // Five meters become ten centimeters on paper; all lengths are in millimeters.
/// assert_eq!(scale.to_paper_length(5000.0), 100.0);
/// assert_eq!(scale.to_string(), "1:50");
/// # Ok::<(), viewport::ViewportError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct DrawingScale {
    paper: u32,
    thing: u32,
}

impl DrawingScale {
    /// The standard scales for technical drawings, largest first (ISO 5455).
    pub const STANDARD: [Self; 18] = [
        Self::from_ratio(50, 1),
        Self::from_ratio(20, 1),
        Self::from_ratio(10, 1),
        Self::from_ratio(5, 1),
        Self::from_ratio(2, 1),
        Self::from_ratio(1, 1),
        Self::from_ratio(1, 2),
        Self::from_ratio(1, 5),
        Self::from_ratio(1, 10),
        Self::from_ratio(1, 20),
        Self::from_ratio(1, 50),
        Self::from_ratio(1, 100),
        Self::from_ratio(1, 200),
        Self::from_ratio(1, 500),
        Self::from_ratio(1, 1000),
        Self::from_ratio(1, 2000),
        Self::from_ratio(1, 5000),
        Self::from_ratio(1, 10_000),
    ];

    const fn from_ratio(paper: u32, thing: u32) -> Self {
        Self { paper, thing }
    }

    /// Creates the scale `paper`:`thing`.
    ///
    /// # Errors
    /// Returns an error if either number is 0.
    pub fn new(paper: u32, thing: u32) -> Result<Self, ViewportError> {
        check_positive("scale on paper", paper.into())?;
        check_positive("scale of the object", thing.into())?;
        Ok(Self { paper, thing })
    }

    /// Returns the largest standard scale at which an object of size `thing` fits into `room`, both
    /// in the same unit. Returns `None` if the object is too large for all scales, or if a size is
    /// not finite.
    #[must_use]
    pub fn largest_standard(thing: [f64; 2], room: [f64; 2]) -> Option<Self> {
        let fits = |scale: &&Self| {
            scale.to_paper_length(thing[0]) <= room[0] && scale.to_paper_length(thing[1]) <= room[1]
        };
        Self::STANDARD.iter().find(fits).copied()
    }

    /// Returns the ratio of lengths on paper to real lengths.
    #[must_use]
    pub fn ratio(self) -> f64 {
        f64::from(self.paper) / f64::from(self.thing)
    }

    /// Converts a real length to its length on paper, in the same unit.
    #[must_use]
    pub fn to_paper_length(self, length: f64) -> f64 {
        length * f64::from(self.paper) / f64::from(self.thing)
    }

    /// Converts a length on paper to the real length, in the same unit. Applied to the size of a
    /// viewport, it returns the size of the window for an orthographic projection drawn to scale.
    #[must_use]
    pub fn to_object_length(self, length: f64) -> f64 {
        length * f64::from(self.thing) / f64::from(self.paper)
    }
}

impl fmt::Display for DrawingScale {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.paper, self.thing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_and_sheets_convert_to_dots() {
        let print = Resolution::dots_per_inch(300.0).expect("positive");
        assert_eq!(print.to_dots(25.4), 300.0);
        assert_eq!(print.to_millimeters(300.0), 25.4);
        assert_eq!(Paper::A4.pixel_size(print), Some([2480, 3508]));
        assert_eq!(Paper::A4.rotated().pixel_size(print), Some([3508, 2480]));
        let absurd = Resolution::dots_per_inch(1e12).expect("positive");
        assert_eq!(Paper::A4.pixel_size(absurd), None);
        for bad in [0.0, -300.0, f64::NAN, f64::INFINITY] {
            assert!(Resolution::dots_per_inch(bad).is_err() && Paper::new(bad, 1.0).is_err());
        }
    }

    #[test]
    fn lengths_convert_to_paper_and_back_at_every_scale() {
        let one = DrawingScale::new(1, 1).expect("not 0");
        assert_eq!(one.to_paper_length(100.0), 100.0);
        for scale in DrawingScale::STANDARD {
            assert!(
                (scale.to_object_length(scale.to_paper_length(0.3)) - 0.3).abs() < 1e-16,
                "{scale}"
            );
        }
        assert!(DrawingScale::STANDARD.windows(2).all(|pair| pair[0].ratio() > pair[1].ratio()));
    }

    #[test]
    fn the_largest_standard_scale_that_fits_is_chosen() {
        let room = [190.0, 277.0];
        let scale = |thing| DrawingScale::largest_standard(thing, room);
        assert_eq!(scale([190.0, 277.0]), Some(DrawingScale::from_ratio(1, 1)));
        assert_eq!(scale([190.1, 277.0]), Some(DrawingScale::from_ratio(1, 2)));
        assert_eq!(scale([30.0, 30.0]), Some(DrawingScale::from_ratio(5, 1)));
        assert_eq!(scale([8000.0, 12_000.0]), Some(DrawingScale::from_ratio(1, 50)));
        assert_eq!(scale([1e9, 1.0]), None);
        assert_eq!(scale([f64::NAN, 1.0]), None);
        assert!(DrawingScale::new(1, 0).is_err() && DrawingScale::new(0, 1).is_err());
    }
}
