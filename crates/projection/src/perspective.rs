//! Perspective defined by a field of view: the window is centered on the line of sight.

use crate::frustum::check_planes;
use crate::matrix::{self, DepthRow, WindowFit};
use crate::{Convention, Fov, Frustum, HalfSlopes, ProjectionError, Window};
use homog::{Clip, Projective, View};

/// The symmetric perspective projection (GL-2, FOV-1; C61, C92).
///
/// # Guarantees
/// - 0 < near < far, where far may be infinite.
/// - Both fields of view are between 0 and π.
/// - The matrix and its inverse are finite in every [`Convention`].
///
/// ```
/// use homog::Point;
/// use projection::{Convention, Fov, Perspective};
/// let lens = Perspective::new(Fov::vertical_degrees(90.0), 2.0, 1.0, f64::INFINITY)?;
/// let clip = lens.view_to_clip(Convention::OPENGL).transform_point(Point::new(0.0, 0.0, -1.0));
/// assert_eq!(clip.divide(), Some(Point::new(0.0, 0.0, -1.0)));
/// # Ok::<(), projection::ProjectionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Perspective {
    half: HalfSlopes,
    near: f64,
    far: f64,
}

impl Perspective {
    /// Creates the perspective projection with the given field of view, aspect (width / height of
    /// the picture) and distances of the near and far planes. `far` may be infinite.
    ///
    /// # Errors
    /// Returns an error if a number other than `far` is not finite, the angle is not between 0 and
    /// π, the aspect is not positive, or 0 < near < far does not hold.
    pub fn new(fov: Fov, aspect: f64, near: f64, far: f64) -> Result<Self, ProjectionError> {
        let lens = Self { half: fov.half_slopes(aspect)?, near, far };
        check_planes(near, far)?;
        lens.window_fit().check_fit()?;
        let window = lens.slopes().scaled(near);
        Window::new(window.left(), window.right(), window.bottom(), window.top())?
            .window_fit(near)?;
        Ok(lens)
    }

    /// Returns half the size of the window at distance 1 in front of the eye: the tangents of half
    /// the fields of view.
    #[must_use]
    pub const fn half_slopes(self) -> HalfSlopes {
        self.half
    }

    /// Returns the window at distance 1 in front of the eye: left/near, right/near, bottom/near,
    /// top/near.
    #[must_use]
    pub fn slopes(self) -> Window {
        Window::symmetric(self.half.x, self.half.y)
    }

    /// Returns the aspect of the picture, width / height.
    #[must_use]
    pub fn aspect(self) -> f64 {
        self.half.x / self.half.y
    }

    /// Returns the vertical field of view in radians.
    #[must_use]
    pub fn fov_y(self) -> f64 {
        2.0 * libm::atan(self.half.y)
    }

    /// Returns the horizontal field of view in radians.
    #[must_use]
    pub fn fov_x(self) -> f64 {
        2.0 * libm::atan(self.half.x)
    }

    /// Returns the field of view between opposite corners in radians.
    #[must_use]
    pub fn fov_diagonal(self) -> f64 {
        2.0 * libm::atan(libm::hypot(self.half.x, self.half.y))
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

    /// Returns this projection as a frustum with the window on the near plane: top = near·tan(θ/2),
    /// right = aspect·top.
    #[must_use]
    pub fn to_frustum(self) -> Frustum {
        Frustum::new_unchecked(self.slopes().scaled(self.near), self.near, self.far)
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
        let HalfSlopes { x, y } = self.half;
        WindowFit { scale_x: 1.0 / x, scale_y: 1.0 / y, center_x: 0.0, center_y: 0.0 }
    }

    fn depth_row(self, convention: Convention) -> DepthRow {
        DepthRow::central(self.near, self.far, convention)
    }
}

impl From<Perspective> for Frustum {
    fn from(perspective: Perspective) -> Self {
        perspective.to_frustum()
    }
}

impl TryFrom<Frustum> for Perspective {
    type Error = ProjectionError;

    /// Converts a frustum whose window is centered on the line of sight and not mirrored
    /// (C69, M31).
    ///
    /// # Errors
    /// Returns [`ProjectionError::OffCenter`] for any other window.
    fn try_from(frustum: Frustum) -> Result<Self, ProjectionError> {
        let slopes = frustum.slopes();
        let centered = slopes.left() == -slopes.right() && slopes.bottom() == -slopes.top();
        if !centered || slopes.right() < 0.0 || slopes.top() < 0.0 {
            return Err(ProjectionError::OffCenter);
        }
        let half = HalfSlopes { x: slopes.right(), y: slopes.top() };
        Ok(Self { half, near: frustum.near(), far: frustum.far() })
    }
}
