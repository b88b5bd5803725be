//! Perspective as drafters construct it: the eye follows from vanishing points in the picture.
//!
//! ```text
//!   three points:  the principal point is the orthocenter of their triangle,
//!                  the eye's distance from it is the height of the box corner above the triangle
//!   two points:    the principal point is on the horizon between them,
//!                  and the eye is on the semicircle whose diameter joins them
//!   one point:     the principal point is the vanishing point
//!
//!   VP x ●──────────────┼──────● VP z     horizon
//!         ╲      principal   ╱
//!            ╲             ╱              d² = −(VPx − P)·(VPz − P)
//!               ╲___●___╱  eye, rotated into the picture plane
//! ```

use crate::error::{check_finite, check_positive};
use crate::{Frustum, ProjectionError, Window};
use glam::DVec2;
use homog::{Affine, Point, Vector, View, World};

/// The eye and the world orientation for which the axes have the chosen vanishing points.
///
/// The picture plane is `distance` in front of the eye; positions on it are (x, y) in any unit and
/// from any origin.
///
/// ```
/// use homog::{Point, Vector};
/// use projection::{ConstructedPerspective, Convention, Window, vanishing_point};
/// let drawing = ConstructedPerspective::two_point((-3.0, 0.0), (2.0, 0.0), 0.6)?;
/// let frustum = drawing.frustum(Window::new(-1.0, 1.0, -1.0, 1.0)?, 0.1, 100.0)?;
/// let view_to_clip = frustum.view_to_clip(Convention::OPENGL);
/// let world_to_clip = drawing.world_to_view().then_project(view_to_clip);
/// let right = vanishing_point(world_to_clip, Vector::Z)?.point().expect("finite");
/// assert!((right.x() - 2.0).abs() < 1e-12 && right.y().abs() < 1e-12);
/// # Ok::<(), projection::ProjectionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ConstructedPerspective {
    principal: DVec2,
    distance: f64,
    axes: [Vector<View>; 3],
}

impl ConstructedPerspective {
    /// Constructs a one-point perspective: lines along z meet at `z`, and the eye is `distance` in
    /// front of it.
    ///
    /// # Errors
    /// Returns an error if a number is not finite or the distance is not positive.
    pub fn one_point(z: (f64, f64), distance: f64) -> Result<Self, ProjectionError> {
        let principal = check_picture_point("vanishing point of z", z)?;
        check_positive("distance", distance)?;
        Ok(Self { principal, distance, axes: [Vector::X, Vector::Y, Vector::Z] })
    }

    /// Constructs a two-point perspective: lines along x meet at `x`, lines along z meet at `z`,
    /// and y is parallel to the picture plane.
    ///
    /// `fraction` is the position of the principal point between them: 0 at `x`, 1 at `z`.
    ///
    /// # Errors
    /// Returns an error if a number is not finite, the points coincide, or the fraction is not
    /// between 0 and 1.
    pub fn two_point(x: (f64, f64), z: (f64, f64), fraction: f64) -> Result<Self, ProjectionError> {
        let (x, z) = (
            check_picture_point("vanishing point of x", x)?,
            check_picture_point("vanishing point of z", z)?,
        );
        if check_finite("fraction", fraction)? <= 0.0 || fraction >= 1.0 {
            let allowed = "between 0 and 1, exclusive";
            return Err(ProjectionError::OutOfRange {
                parameter: "fraction",
                value: fraction,
                allowed,
            });
        }
        let principal = x + (z - x) * fraction;
        let horizon = z - x;
        let length = libm::hypot(horizon.x, horizon.y);
        let distance = length * libm::sqrt(fraction * (1.0 - fraction));
        if !is_usable_distance(distance) {
            let reason = "the points coincide or are too far apart";
            return Err(ProjectionError::ImpossibleVanishingPoints { reason });
        }
        let across = DVec2::new(-horizon.y, horizon.x) / length;
        let up = if across.y < 0.0 { -across } else { across };
        let up = Vector::new(up.x, up.y, 0.0);
        Self::oriented(principal, distance, up, gaze_into_picture(z - principal, distance)?)
    }

    /// Constructs a three-point perspective: lines along x, y and z meet at the three given points.
    ///
    /// # Errors
    /// Returns an error if a number is not finite or the points do not form an acute triangle.
    pub fn three_point(
        x: (f64, f64),
        y: (f64, f64),
        z: (f64, f64),
    ) -> Result<Self, ProjectionError> {
        let (x, y) = (
            check_picture_point("vanishing point of x", x)?,
            check_picture_point("vanishing point of y", y)?,
        );
        let z = check_picture_point("vanishing point of z", z)?;
        let impossible = |reason| ProjectionError::ImpossibleVanishingPoints { reason };
        let principal = orthocenter(x, y, z).ok_or(impossible("they are collinear"))?;
        let [square_1, square_2, square_3] =
            [(x, y), (y, z), (z, x)].map(|(a, b)| -(a - principal).dot(b - principal));
        let square = (square_1 + square_2 + square_3) / 3.0;
        let distance = libm::sqrt(square);
        if square_1.min(square_2).min(square_3) <= 0.0 || !is_usable_distance(distance) {
            return Err(impossible("their triangle has an angle of 90° or more"));
        }
        let vertical = gaze_into_picture(y - principal, distance)?;
        let up = if vertical.y() < 0.0 { -vertical } else { vertical };
        Self::oriented(principal, distance, up, gaze_into_picture(z - principal, distance)?)
    }

    /// Creates the perspective with z pointing out of the picture and x chosen to make the world
    /// right-handed.
    fn oriented(
        principal: DVec2,
        distance: f64,
        up: Vector<View>,
        into: Vector<View>,
    ) -> Result<Self, ProjectionError> {
        let out = -into;
        let flat = ProjectionError::ImpossibleVanishingPoints {
            reason: "the axes are not at right angles",
        };
        let right = up.cross(out).normalized().ok_or(flat)?;
        Ok(Self { principal, distance, axes: [right, up, out] })
    }

    /// Returns the foot of the perpendicular from the eye to the picture plane.
    #[must_use]
    pub fn principal_point(self) -> (f64, f64) {
        self.principal.into()
    }

    /// Returns the distance of the eye from the picture plane.
    #[must_use]
    pub const fn distance(self) -> f64 {
        self.distance
    }

    /// Returns the rotation from world space to view space. The eye is at the world's origin.
    #[must_use]
    pub fn world_to_view(self) -> Affine<World, View> {
        let [x, y, z] = self.axes;
        Affine::from_frame(x, y, z, Point::ORIGIN)
    }

    /// Returns the frustum through `window`, a part of the picture in the coordinates of the
    /// vanishing points.
    ///
    /// # Errors
    /// Returns an error unless 0 < near < far.
    pub fn frustum(self, window: Window, near: f64, far: f64) -> Result<Frustum, ProjectionError> {
        let slope = |edge: f64, principal: f64| (edge - principal) / self.distance;
        let slopes = Window::new(
            slope(window.left(), self.principal.x),
            slope(window.right(), self.principal.x),
            slope(window.bottom(), self.principal.y),
            slope(window.top(), self.principal.y),
        )?;
        Frustum::from_slopes(slopes, near, far)
    }
}

fn check_picture_point(
    parameter: &'static str,
    point: (f64, f64),
) -> Result<DVec2, ProjectionError> {
    let (x, y) = point;
    Ok(DVec2::new(check_finite(parameter, x)?, check_finite(parameter, y)?))
}

fn is_usable_distance(distance: f64) -> bool {
    (1e-140..1e140).contains(&distance)
}

/// Returns the unit direction from the eye to a point of the picture plane.
fn gaze_into_picture(
    from_principal: DVec2,
    distance: f64,
) -> Result<Vector<View>, ProjectionError> {
    let direction = Vector::new(from_principal.x, from_principal.y, -distance);
    direction.normalized().ok_or(ProjectionError::Unrepresentable { what: "vanishing point" })
}

/// Returns the orthocenter of the triangle, or `None` if the corners are collinear.
fn orthocenter(a: DVec2, b: DVec2, c: DVec2) -> Option<DVec2> {
    // (h − a)·(c − b) = 0 and (h − b)·(a − c) = 0
    let (u, v) = (c - b, a - c);
    let area = u.perp_dot(v);
    let (left, right) = (a.dot(u), b.dot(v));
    let h = DVec2::new(left * v.y - right * u.y, right * u.x - left * v.x) / area;
    let flat = area.abs() <= 1e-12 * (u.length() * v.length());
    (!flat && h.is_finite()).then_some(h)
}
