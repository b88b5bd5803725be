//! The apex-moved frustum of the WebGL lesson. It has the same parameters as glFrustum, but it is a
//! different map.
//!
//! ```text
//!   Frustum                    ApexMovedFrustum
//!              window                     window
//!               ┐                          ┐
//!   eye ●───────┤ seen at            ●─────┤  the apex is directly behind the
//!               ┘ an angle                 ┘  window's center, beside the eye
//! ```
//!
//! The two agree only on the near plane, or if the window is centered (LW-1, M12). For stereo
//! pairs, tiles and lens shift, use [`Frustum`].

use crate::error::check_finite;
use crate::{Convention, Frustum, ProjectionError, Window};
use homog::{Affine, Clip, Point, Projective, View};

/// The perspective projection of createFrustum (LW-1; C63): symmetric, with the apex moved opposite
/// the center of the window.
///
/// # Guarantees
/// See [`Frustum`].
///
/// ```
/// use homog::{HPoint, Point};
/// use projection::{ApexMovedFrustum, Convention};
/// let lesson = ApexMovedFrustum::new(-1.0, 3.0, -2.0, 1.0, 2.0, 6.0)?;
/// assert_eq!(lesson.apex(), Point::new(1.0, -0.5, 0.0));
/// // The window's center line stays in the middle of the picture at every depth.
/// let deep = lesson.view_to_clip(Convention::OPENGL).transform_point(Point::new(1.0, -0.5, -5.0));
/// assert_eq!((deep.x(), deep.y()), (0.0, 0.0));
/// # Ok::<(), projection::ProjectionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ApexMovedFrustum {
    window: Window,
    about_apex: Frustum,
}

/// The four steps of the lesson, in the order in which a point passes through them. Their product
/// is the matrix (C66).
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct ApexMovedSteps {
    /// Eq2: moves the apex to the origin.
    pub move_apex: Affine<View, View>,
    /// Eq7, with the 0 that the lesson omits at the end of the last row (M14): maps the depth and
    /// sets w to the distance.
    pub map_depth: Projective<View, View>,
    /// Eq3: projects x and y onto the near plane by multiplying them by near.
    pub project: Affine<View, View>,
    /// Eq6: scales the window to 2 × 2.
    pub scale_window: Affine<View, Clip>,
}

impl ApexMovedFrustum {
    /// Creates the frustum from the apex ((left + right)/2, (bottom + top)/2, 0) through the window
    /// on the near plane.
    ///
    /// # Errors
    /// Returns the same errors as [`Frustum::new`], and an error if `far` is infinite, which the
    /// lesson does not support.
    pub fn new(
        left: f64,
        right: f64,
        bottom: f64,
        top: f64,
        near: f64,
        far: f64,
    ) -> Result<Self, ProjectionError> {
        let window = Window::new(left, right, bottom, top)?;
        check_finite("far", far)?;
        let centered = Window::centered(window.width(), window.height())?;
        Frustum::from_window(window, near, far)?;
        // In the lesson, scaling the window is a separate step from multiplying by near.
        centered.window_fit(1.0)?;
        Ok(Self { window, about_apex: Frustum::from_window(centered, near, far)? })
    }

    /// Returns the window on the near plane.
    #[must_use]
    pub const fn window(self) -> Window {
        self.window
    }

    /// Returns the distance to the near plane.
    #[must_use]
    pub const fn near(self) -> f64 {
        self.about_apex.near()
    }

    /// Returns the distance to the far plane.
    #[must_use]
    pub const fn far(self) -> f64 {
        self.about_apex.far()
    }

    /// Returns the position from which the picture looks correct.
    #[must_use]
    pub fn apex(self) -> Point<View> {
        let (x, y) = self.window.center();
        Point::new(x, y, 0.0)
    }

    /// Returns the centered frustum as seen from the apex.
    #[must_use]
    pub const fn about_apex(self) -> Frustum {
        self.about_apex
    }

    /// Returns the projection matrix, which moves the apex to the origin and then applies the
    /// centered frustum.
    #[must_use]
    pub fn view_to_clip(self, convention: Convention) -> Projective<View, Clip> {
        let to_apex = Affine::<View, View>::translation(Point::ORIGIN - self.apex());
        to_apex.then_project(self.about_apex.view_to_clip(convention))
    }

    /// Returns the inverse of [`view_to_clip`](Self::view_to_clip) in closed form.
    #[must_use]
    pub fn clip_to_view(self, convention: Convention) -> Projective<Clip, View> {
        let from_apex = Affine::<View, View>::translation(self.apex() - Point::ORIGIN);
        self.about_apex.clip_to_view(convention).then(from_apex)
    }

    /// Returns the lesson's equations 2, 7, 3 and 6 as factors of the matrix, in the given
    /// convention.
    #[must_use]
    pub fn steps(self, convention: Convention) -> ApexMovedSteps {
        let near = self.near();
        let mut map_depth = glam::DMat4::IDENTITY;
        let matrix = self.about_apex.view_to_clip(convention).raw();
        map_depth.z_axis.z = matrix.z_axis.z;
        map_depth.z_axis.w = matrix.z_axis.w;
        map_depth.w_axis.z = matrix.w_axis.z;
        map_depth.w_axis.w = 0.0;
        ApexMovedSteps {
            move_apex: Affine::translation(Point::ORIGIN - self.apex()),
            map_depth: Projective::from_raw(map_depth),
            project: Affine::scale(near, near, 1.0),
            scale_window: Affine::scale(
                2.0 / self.window.width(),
                2.0 * convention.top() / self.window.height(),
                1.0,
            ),
        }
    }
}
