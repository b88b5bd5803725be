//! Orthographic projection: a box in view space becomes the picture.

use crate::error::check_finite;
use crate::matrix::{self, DepthRow, WindowFit};
use crate::{Convention, ProjectionError, Window};
use homog::{Clip, Projective, View};

/// The orthographic projection of a box (OR-1, GL-3; C7, C34, C90).
///
/// `near` and `far` are distances in front of the eye. They may be any two different numbers;
/// negative distances are behind the eye.
///
/// # Guarantees
/// The box is finite and not empty; the matrix and its inverse are finite in every [`Convention`].
///
/// ```
/// use homog::Point;
/// use projection::{Convention, Orthographic};
/// let sheet = Orthographic::new(-2.0, 2.0, -1.0, 1.0, 0.0, 10.0)?;
/// let clip = sheet.view_to_clip(Convention::CHAPTER).transform_point(Point::new(2.0, 1.0, 0.0));
/// assert_eq!(clip.divide(), Some(Point::new(1.0, 1.0, 1.0))); // right, top, near
/// # Ok::<(), projection::ProjectionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Orthographic {
    window: Window,
    near: f64,
    far: f64,
}

impl Orthographic {
    /// Creates the projection of the box [left, right] × [bottom, top] × [near, far].
    ///
    /// # Errors
    /// Returns an error if a number is not finite or two opposite sides coincide.
    pub fn new(
        left: f64,
        right: f64,
        bottom: f64,
        top: f64,
        near: f64,
        far: f64,
    ) -> Result<Self, ProjectionError> {
        Self::from_window(Window::new(left, right, bottom, top)?, near, far)
    }

    /// Returns the projection of the box with cross section `window`, from `near` to `far`.
    ///
    /// # Errors
    /// See [`new`](Self::new).
    pub fn from_window(window: Window, near: f64, far: f64) -> Result<Self, ProjectionError> {
        check_finite("near", near)?;
        check_finite("far", far)?;
        if near == far {
            return Err(ProjectionError::EmptyDepth { value: near });
        }
        DepthRow::check_parallel(near, far)?;
        window.window_fit(1.0)?;
        Ok(Self { window, near, far })
    }

    /// Returns the window, which is the same at every depth.
    #[must_use]
    pub const fn window(self) -> Window {
        self.window
    }

    /// Returns the distance of the near plane.
    #[must_use]
    pub const fn near(self) -> f64 {
        self.near
    }

    /// Returns the distance of the far plane.
    #[must_use]
    pub const fn far(self) -> f64 {
        self.far
    }

    /// Returns the projection matrix. It is affine: w stays 1.
    #[must_use]
    pub fn view_to_clip(self, convention: Convention) -> Projective<View, Clip> {
        matrix::parallel_matrix(self.window_fit(), self.depth_row(convention), convention)
    }

    /// Returns the inverse of [`view_to_clip`](Self::view_to_clip) in closed form.
    #[must_use]
    pub fn clip_to_view(self, convention: Convention) -> Projective<Clip, View> {
        matrix::parallel_inverse(self.window_fit(), self.depth_row(convention), convention)
    }

    fn window_fit(self) -> WindowFit {
        self.window.window_fit_unchecked(1.0)
    }

    fn depth_row(self, convention: Convention) -> DepthRow {
        DepthRow::parallel(self.near, self.far, convention)
    }
}
