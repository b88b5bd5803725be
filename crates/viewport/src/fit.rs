//! Fit policies, which place a picture in a rectangle with a different aspect ratio.
//!
//! ```text
//!   wide picture, tall place:
//!
//!    Stretch      Contain       Cover
//!   ┌───────┐    ┌───────┐   ┌─┬───────┬─┐
//!   │╭─────╮│    │       │   │ │       │ │
//!   ││     ││    ├───────┤   │╭┼───────┼╮│
//!   ││     ││    │  (o)  │   │││  (o)  │││
//!   ││     ││    ├───────┤   │╰┼───────┼╯│
//!   │╰─────╯│    │       │   │ │       │ │
//!   └───────┘    └───────┘   └─┴───────┴─┘
//!    distorts     leaves       cuts off
//!                 margins      the sides
//! ```

use crate::error::{check_finite, check_positive};
use crate::{Rectangle, ViewportError};

/// A policy for fitting a picture into a rectangle with a different aspect ratio.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub enum FitPolicy {
    /// Fills the rectangle; circles may become ellipses.
    Stretch,
    /// As large as possible without cropping, with margins (letterbox). This is the default.
    #[default]
    Contain,
    /// As small as possible without margins; the overhang is cropped.
    Cover,
    /// As wide as the rectangle, with any height.
    FixedWidth,
    /// As high as the rectangle, with any width.
    FixedHeight,
}

impl FitPolicy {
    /// Returns the rectangle in which to draw a picture of this size so that it fits `place`. Only
    /// the aspect ratio of the picture matters.
    ///
    /// `align` is the fraction of the spare space in x and y that precedes the picture: `[0.5,
    /// 0.5]` centers it, and `[0.0, 0.0]` puts it in the corner of minimum coordinates. The
    /// overhang that [`FitPolicy::Cover`] crops is distributed in the same way.
    ///
    /// ```
    /// use viewport::{FitPolicy, Rectangle};
    /// let place = Rectangle::from_size(1920.0, 1080.0)?;
    /// let film = FitPolicy::Contain.place_picture([4.0, 3.0], place, [0.5, 0.5])?;
    /// assert_eq!(film, Rectangle::new(240.0, 0.0, 1440.0, 1080.0)?);
    /// # Ok::<(), viewport::ViewportError>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if a number is not finite or if a size is not greater than 0.
    pub fn place_picture(
        self,
        picture: [f64; 2],
        place: Rectangle,
        align: [f64; 2],
    ) -> Result<Rectangle, ViewportError> {
        check_finite("horizontal alignment", align[0])?;
        check_finite("vertical alignment", align[1])?;
        let (sx, sy) = scale_factors(picture, place)?;
        let [sx, sy] = match self {
            Self::Stretch => [sx, sy],
            Self::Contain => [sx.min(sy); 2],
            Self::Cover => [sx.max(sy); 2],
            Self::FixedWidth => [sx; 2],
            Self::FixedHeight => [sy; 2],
        };
        let (width, height) = (picture[0] * sx, picture[1] * sy);
        let x = place.x() + (place.width() - width) * align[0];
        let y = place.y() + (place.height() - height) * align[1];
        Rectangle::new(x, y, width, height)
    }

    /// Returns the size of a window whose picture fills `place` without distortion. Give the camera
    /// this size instead of `window` to change the window rather than the place.
    ///
    /// Instead of leaving margins, [`FitPolicy::Contain`] shows more of the scene; instead of
    /// cropping, [`FitPolicy::Cover`] shows less.
    ///
    /// ```
    /// use viewport::{FitPolicy, Rectangle};
    /// let place = Rectangle::from_size(200.0, 100.0)?;
    /// assert_eq!(FitPolicy::Contain.fit_window([1.0, 1.0], place)?, [2.0, 1.0]);
    /// assert_eq!(FitPolicy::Cover.fit_window([1.0, 1.0], place)?, [1.0, 0.5]);
    /// # Ok::<(), viewport::ViewportError>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if a size is not finite or not greater than 0.
    pub fn fit_window(self, window: [f64; 2], place: Rectangle) -> Result<[f64; 2], ViewportError> {
        let (sx, sy) = scale_factors(window, place)?;
        let factor = match self {
            Self::Stretch => return Ok(window),
            Self::Contain => sx.min(sy),
            Self::Cover => sx.max(sy),
            Self::FixedWidth => sx,
            Self::FixedHeight => sy,
        };
        let size = [place.width() / factor, place.height() / factor];
        Ok([check_positive("window width", size[0])?, check_positive("window height", size[1])?])
    }
}

/// Returns the factors from the picture's width and height to the rectangle's.
fn scale_factors(picture: [f64; 2], place: Rectangle) -> Result<(f64, f64), ViewportError> {
    let sx = place.width() / check_positive("picture width", picture[0])?;
    let sy = place.height() / check_positive("picture height", picture[1])?;
    Ok((check_positive("horizontal factor", sx)?, check_positive("vertical factor", sy)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_policy_fits_pictures_and_windows() {
        let tall = Rectangle::new(10.0, 20.0, 100.0, 200.0).expect("a place");
        // (policy, the placed 4:2 picture, the 4 × 2 window after it is made to fill the place)
        let table = [
            (FitPolicy::Stretch, [10.0, 20.0, 100.0, 200.0], [4.0, 2.0]),
            (FitPolicy::Contain, [10.0, 95.0, 100.0, 50.0], [4.0, 8.0]),
            (FitPolicy::Cover, [-140.0, 20.0, 400.0, 200.0], [1.0, 2.0]),
            (FitPolicy::FixedWidth, [10.0, 95.0, 100.0, 50.0], [4.0, 8.0]),
            (FitPolicy::FixedHeight, [-140.0, 20.0, 400.0, 200.0], [1.0, 2.0]),
        ];
        for (fit, [x, y, width, height], window) in table {
            let expected = Rectangle::new(x, y, width, height);
            assert_eq!(fit.place_picture([4.0, 2.0], tall, [0.5, 0.5]), expected, "{fit:?}");
            assert_eq!(fit.fit_window([4.0, 2.0], tall), Ok(window), "{fit:?}");
        }
    }

    #[test]
    fn extra_space_goes_to_the_requested_side() {
        let wide = Rectangle::from_size(300.0, 100.0).expect("a place");
        for (align, x) in [(0.0, 0.0), (0.5, 100.0), (1.0, 200.0)] {
            let square =
                FitPolicy::Contain.place_picture([1.0, 1.0], wide, [align, 0.5]).expect("fits");
            assert_eq!((square.x(), square.width(), square.height()), (x, 100.0, 100.0));
        }
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(FitPolicy::Contain.place_picture([bad, 1.0], wide, [0.5, 0.5]).is_err());
            assert!(FitPolicy::Cover.fit_window([1.0, bad], wide).is_err());
        }
        assert!(FitPolicy::Contain.place_picture([1.0, 1.0], wide, [f64::NAN, 0.5]).is_err());
    }
}
