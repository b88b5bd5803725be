//! Pixel conventions: the positions of pixel centers, and whether y points up or down (VP-1 to
//! VP-4).
//!
//! ```text
//!   CHAPTER: integer centers, y up            IMAGE: half-integer centers, y down
//!
//!   y ▲                                            0   1   2   3 ► x
//! 1.5 ┼───┬───┬───┐                              0 ┌───┬───┬───┐
//!   1 │ · │ · │ · │                            0.5 │ · │ · │ · │
//! 0.5 ├───┼───┼───┤                              1 ├───┼───┼───┤
//!   0 │ · │ · │ · │                            1.5 │ · │ · │ · │
//! -.5 └───┴───┴───┘► x                           2 └───┴───┴───┘
//!   -.5 0 .5  1  2 2.5                         y ▼   .5  1.5 2.5
//! ```

use crate::remap::check_finite;
use crate::{Affine, Point, RemapError, Screen, Vector};

/// The direction of the y axis of an image.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum YAxis {
    /// Row 0 is the bottom row, as in the textbook (Shirley and Marschner, ch. 8) and in OpenGL.
    Up,
    /// Row 0 is the top row, as in image files and most other interfaces.
    Down,
}

/// The position of the center of pixel (i, j).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum PixelCenters {
    /// At (i, j): pixel i covers [i − ½, i + ½). Used by the textbook, OpenCV, most of computer
    /// vision and Direct3D 9. The center of a row of 640 pixels is at 319.5.
    #[default]
    Integer,
    /// At (i + ½, j + ½): pixel i covers [i, i + 1). Used by Direct3D 10 and later, OpenGL, Vulkan,
    /// Metal, WebGPU and COLMAP. The center of a row of 640 pixels is at 320.
    Half,
}

impl PixelCenters {
    /// Returns the coordinate of the center of pixel 0.
    #[must_use]
    pub const fn first_center(self) -> f64 {
        match self {
            Self::Integer => 0.0,
            Self::Half => 0.5,
        }
    }

    /// Returns the coordinate of the outer edge of pixel 0.
    #[must_use]
    pub const fn image_border(self) -> f64 {
        self.first_center() - 0.5
    }
}

/// A pixel convention: the direction of y and the position of pixel centers.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct PixelConvention {
    /// The direction of y.
    pub y: YAxis,
    /// The position of centers within their pixels.
    pub centers: PixelCenters,
}

impl PixelConvention {
    /// Integer centers, y up (VP-1; the textbook, §8.1.1).
    pub const CHAPTER: Self = Self { y: YAxis::Up, centers: PixelCenters::Integer };
    /// Integer centers, y down (VP-2): exercise 1 of the textbook, and Direct3D 9.
    pub const CHAPTER_Y_DOWN: Self = Self { y: YAxis::Down, centers: PixelCenters::Integer };
    /// Half-integer centers, y down (VP-3): this project's pipeline, image files, Direct3D, Vulkan,
    /// Metal, WebGPU.
    pub const IMAGE: Self = Self { y: YAxis::Down, centers: PixelCenters::Half };
    /// Half-integer centers, y up (VP-3): OpenGL.
    pub const OPENGL: Self = Self { y: YAxis::Up, centers: PixelCenters::Half };
    /// All four conventions.
    pub const ALL: [Self; 4] = [Self::CHAPTER, Self::CHAPTER_Y_DOWN, Self::IMAGE, Self::OPENGL];

    /// Returns the map from positions in this convention to positions in `other`, in an image of
    /// `height` rows (VP-4).
    ///
    /// ```
    /// use homog::{PixelConvention, Point};
    /// let map = PixelConvention::CHAPTER.convert_to(PixelConvention::IMAGE, 480.0)?;
    /// // The center of the lower left pixel.
    /// assert_eq!(map.transform_point(Point::ORIGIN), Point::new(0.5, 479.5, 0.0));
    /// # Ok::<(), homog::RemapError>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if the height is not finite or not greater than 0.
    pub fn convert_to(
        self,
        other: Self,
        height: f64,
    ) -> Result<Affine<Screen, Screen>, RemapError> {
        check_finite("height", height)?;
        if height <= 0.0 {
            return Err(RemapError::NotPositive { name: "height", value: height });
        }
        let (from, to) = (self.centers.image_border(), other.centers.image_border());
        let (flip, y) =
            if self.y == other.y { (1.0, to - from) } else { (-1.0, height + to + from) };
        let y_axis = Vector::new(0.0, flip, 0.0);
        Ok(Affine::from_frame(Vector::X, y_axis, Vector::Z, Point::new(to - from, y, 0.0)))
    }
}
