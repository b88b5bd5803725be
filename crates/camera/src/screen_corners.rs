//! A camera for a physical screen in the world: a wall, a table, one side of a CAVE.
//!
//! ```text
//!  upper left c ┌──────────┐
//!               │          │               u = b − a, v = c − a, w = u × v (unit vectors)
//!               │          │
//!  lower left a └──────────┘ b             d = w · (e − a): the eye's distance from the plane
//!                    ╲    lower right
//!                     ● eye e              left = u · (a − e), right = u · (b − e)
//!                                          bottom = v · (a − e), top = v · (c − e)
//! ```
//!
//! The picture is correct for any position of the eye: the screen looks like a hole in the wall.
//! The gaze is perpendicular to the screen, not toward its center, and the window is as far
//! off-center as the eye is.
//!
//! Source: R. Kooima, *Generalized Perspective Projection*, 2008.

use crate::{Basis, Camera, CameraError, CameraView, ViewWindow};
use homog::{Point, Vector, World};

/// The largest cosine of the angle between two sides for which they count as perpendicular.
const MAX_SKEW_COSINE: f64 = 1e-6;

/// Three corners of a rectangular screen in the world, as seen by its viewer.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ScreenCorners {
    /// The lower left corner.
    pub lower_left: Point<World>,
    /// The lower right corner.
    pub lower_right: Point<World>,
    /// The upper left corner.
    pub upper_left: Point<World>,
}

impl ScreenCorners {
    /// Returns the camera at `eye`, and the window in the plane of the screen through which it sees
    /// the world correctly.
    ///
    /// [`ViewWindow::at_distance`] moves the window to any near plane.
    ///
    /// # Errors
    /// Returns an error if:
    /// - a corner or the eye is not finite;
    /// - a side has no length;
    /// - the sides are not perpendicular;
    /// - the eye is in the plane of the screen or behind the screen.
    ///
    /// ```
    /// use camera::ScreenCorners;
    /// use homog::Point;
    /// let wall = ScreenCorners {
    ///     lower_left: Point::new(-2.0, 0.0, 0.0),
    ///     lower_right: Point::new(2.0, 0.0, 0.0),
    ///     upper_left: Point::new(-2.0, 3.0, 0.0),
    /// };
    /// let view = wall.view_from(Point::new(1.0, 1.0, 2.0))?;
    /// let window = view.window;
    /// assert_eq!((window.left, window.right, window.bottom, window.top), (-3.0, 1.0, -1.0, 2.0));
    /// assert_eq!(window.distance, 2.0);
    /// # Ok::<(), camera::CameraError>(())
    /// ```
    pub fn view_from(self, eye: Point<World>) -> Result<CameraView, CameraError> {
        let basis = self.basis()?;
        let camera = Camera::new(eye, basis)?;
        let [a, b, c] = [self.lower_left, self.lower_right, self.upper_left]
            .map(|corner| basis.to_view(corner - eye));
        let distance = -a.z();
        if distance <= 0.0 {
            return Err(CameraError::EyeBehindScreen { distance });
        }
        let window = ViewWindow { left: a.x(), right: b.x(), bottom: a.y(), top: c.y(), distance };
        window.check_perspective()?;
        Ok(CameraView { camera, window })
    }

    /// Returns the axes of the screen.
    fn basis(self) -> Result<Basis, CameraError> {
        let right = unit_side(self.lower_left, self.lower_right, "lower right corner")?;
        let up = unit_side(self.lower_left, self.upper_left, "upper left corner")?;
        let cosine = right.dot(up);
        if cosine.abs() > MAX_SKEW_COSINE {
            return Err(CameraError::SkewedScreen { cosine });
        }
        let w = right.cross(up);
        Basis::from_gaze(-w, up)
    }
}

/// Returns the unit vector along a side of the screen.
fn unit_side(
    from: Point<World>,
    to: Point<World>,
    name: &'static str,
) -> Result<Vector<World>, CameraError> {
    for (name, corner) in [("lower left corner", from), (name, to)] {
        if !corner.is_finite() {
            return Err(CameraError::NotFinite { name, value: corner - Point::ORIGIN });
        }
    }
    let half = to.raw() * 0.5 - from.raw() * 0.5;
    Vector::from_raw(half).normalized().ok_or(CameraError::FlatScreen { corner: from })
}
