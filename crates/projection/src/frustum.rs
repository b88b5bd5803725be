//! Perspective through any window: the off-center frustum.

use crate::error::{check_finite, check_positive};
use crate::matrix::{self, DepthRow, WindowFit};
use crate::{Convention, ProjectionError, Window};
use homog::{Clip, Projective, View};

/// The perspective projection through a window on the near plane (PE-2 and GL-1; C91).
///
/// ```text
///               top ┐            The eye is the apex; the window need not be centered on
///  eye ●────────────┤ D = near   the line of sight, as in stereo pairs, tiles, lens shift
///               bot ┘            and pictures on walls.
/// ```
///
/// # Guarantees
/// - 0 < near < far, where far may be infinite.
/// - The window is finite and not empty.
/// - The matrix and its inverse are finite in every [`Convention`].
///
/// ```
/// use homog::Point;
/// use projection::{Convention, Frustum};
/// let frustum = Frustum::new(-1.0, 3.0, -2.0, 1.0, 2.0, 6.0)?;
/// let view_to_clip = frustum.view_to_clip(Convention::CHAPTER);
/// let clip = view_to_clip.transform_point(Point::new(3.0, 1.0, -2.0));
/// assert_eq!(clip.divide(), Some(Point::new(1.0, 1.0, 1.0))); // right, top, near
/// # Ok::<(), projection::ProjectionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Frustum {
    window: Window,
    near: f64,
    far: f64,
}

impl Frustum {
    /// Creates the frustum from the eye through the window [left, right] × [bottom, top] on the
    /// near plane.
    ///
    /// `near` and `far` are distances in front of the eye; `far` may be infinite.
    ///
    /// # Errors
    /// Returns an error if a number other than `far` is not finite, the window is empty, or 0 <
    /// near < far does not hold.
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

    /// Returns the frustum through `window` on the near plane.
    ///
    /// # Errors
    /// See [`new`](Self::new).
    pub fn from_window(window: Window, near: f64, far: f64) -> Result<Self, ProjectionError> {
        check_planes(near, far)?;
        window.window_fit(near)?;
        let frustum = Self { window, near, far };
        frustum.slopes().check_edges()?;
        Ok(frustum)
    }

    /// Returns the frustum whose window at distance 1 in front of the eye has the edges `slopes`:
    /// the tangents of the four angles.
    ///
    /// # Errors
    /// See [`new`](Self::new).
    pub fn from_slopes(slopes: Window, near: f64, far: f64) -> Result<Self, ProjectionError> {
        check_planes(near, far)?;
        let on_near = slopes.scaled(near);
        let window = Window::new(on_near.left(), on_near.right(), on_near.bottom(), on_near.top())?;
        Self::from_window(window, near, far)
    }

    /// Creates a frustum from parts that have already been checked.
    pub(crate) const fn new_unchecked(window: Window, near: f64, far: f64) -> Self {
        Self { window, near, far }
    }

    /// Returns the window on the near plane.
    #[must_use]
    pub const fn window(self) -> Window {
        self.window
    }

    /// Returns the window at distance 1 in front of the eye: left/near, right/near, bottom/near,
    /// top/near.
    #[must_use]
    pub fn slopes(self) -> Window {
        self.window.scaled(1.0 / self.near)
    }

    /// Returns the distance of the near plane.
    #[must_use]
    pub const fn near(self) -> f64 {
        self.near
    }

    /// Returns the distance of the far plane, possibly infinite.
    #[must_use]
    pub const fn far(self) -> f64 {
        self.far
    }

    /// Returns the projection matrix.
    #[must_use]
    pub fn view_to_clip(self, convention: Convention) -> Projective<View, Clip> {
        matrix::central_matrix(self.window_fit(), self.depth_row(convention), convention)
    }

    /// Returns the inverse of [`view_to_clip`](Self::view_to_clip) in closed form (IV-1).
    #[must_use]
    pub fn clip_to_view(self, convention: Convention) -> Projective<Clip, View> {
        matrix::central_inverse(self.window_fit(), self.depth_row(convention), convention)
    }

    fn window_fit(self) -> WindowFit {
        self.window.window_fit_unchecked(self.near)
    }

    fn depth_row(self, convention: Convention) -> DepthRow {
        DepthRow::central(self.near, self.far, convention)
    }
}

/// Checks that 0 < near < far and that the matrix can represent the planes.
pub(crate) fn check_planes(near: f64, far: f64) -> Result<(), ProjectionError> {
    check_positive("near", near)?;
    if far != f64::INFINITY {
        check_finite("far", far)?;
    }
    if near == far {
        return Err(ProjectionError::EmptyDepth { value: near });
    }
    if near > far {
        return Err(ProjectionError::FarNotBeyondNear { near, far });
    }
    DepthRow::check_central(near, far)
}
