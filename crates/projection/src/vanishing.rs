//! Vanishing points: the points where images of parallel lines meet (VN-1; C80, C81).
//!
//! Parallel lines share one point at infinity, (d, 0). Its image is their vanishing point. If the
//! image is also at infinity, the images of the lines stay parallel. The number of axes with a
//! finite vanishing point determines whether the picture is a one-, two- or three-point
//! perspective.

use crate::ProjectionError;
use crate::error::check_finite;
use glam::DVec4;
use homog::{Point, Projective, Space, Vector};

/// The point that the images of all lines in one direction approach.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum VanishingPoint<S: Space> {
    /// The images meet at a point.
    At {
        /// The common point, after the divide.
        point: Point<S>,
        /// Whether the lines approach it in the given direction. If not, they approach it in the
        /// opposite direction (w < 0).
        ahead: bool,
    },
    /// The images stay parallel.
    AtInfinity {
        /// The direction of the images. Its length is not significant.
        direction: Vector<S>,
    },
    /// The lines run along the projectors, so each appears as a single point.
    AlongProjectors,
}

impl<S: Space> VanishingPoint<S> {
    /// Returns the common point of the images, if they meet.
    #[must_use]
    pub const fn point(self) -> Option<Point<S>> {
        match self {
            Self::At { point, .. } => Some(point),
            Self::AtInfinity { .. } | Self::AlongProjectors => None,
        }
    }
}

/// Returns the vanishing point of lines along `direction` under `map`. `direction` and its opposite
/// have the same vanishing point.
///
/// ```
/// use homog::{Point, Vector, View};
/// use projection::{Convention, Frustum, VanishingPoint, vanishing_point};
/// let frustum = Frustum::new(-1.0, 1.0, -1.0, 1.0, 1.0, 10.0)?;
/// let rails = Vector::<View>::new(0.0, 0.0, -1.0);
/// let meet = vanishing_point(frustum.view_to_clip(Convention::OPENGL), rails)?;
/// let beyond_far = 11.0 / 9.0;
/// assert_eq!(meet, VanishingPoint::At { point: Point::new(0.0, 0.0, beyond_far), ahead: true });
/// # Ok::<(), projection::ProjectionError>(())
/// ```
///
/// # Errors
/// Returns an error if the direction is zero or not finite, the map is not finite, or the point is
/// too far away.
pub fn vanishing_point<A: Space, B: Space>(
    map: Projective<A, B>,
    direction: Vector<A>,
) -> Result<VanishingPoint<B::Divided>, ProjectionError> {
    for value in <[f64; 3]>::from(direction) {
        check_finite("direction", value)?;
    }
    let unit =
        direction.normalized().ok_or(ProjectionError::ZeroVector { parameter: "direction" })?;
    let image = map.transform_direction(unit).raw();
    if !image.is_finite() {
        return Err(ProjectionError::Unrepresentable { what: "image of the direction" });
    }
    classify_point(image, direction_rounding(map, unit))
}

/// Returns the magnitude up to which each image coordinate may be only a rounding error.
fn direction_rounding<A: Space, B: Space>(map: Projective<A, B>, direction: Vector<A>) -> DVec4 {
    let m = map.raw();
    let d = direction.raw().abs();
    (m.x_axis.abs() * d.x + m.y_axis.abs() * d.y + m.z_axis.abs() * d.z) * (4.0 * f64::EPSILON)
}

fn classify_point<S: Space>(
    image: DVec4,
    rounding: DVec4,
) -> Result<VanishingPoint<S>, ProjectionError> {
    let significant = image.abs().cmpgt(rounding);
    if significant.w {
        let point = Point::from_raw(image.truncate() / image.w);
        let too_far = ProjectionError::Unrepresentable { what: "vanishing point" };
        let at = VanishingPoint::At { point, ahead: image.w > 0.0 };
        return point.is_finite().then_some(at).ok_or(too_far);
    }
    if significant.x || significant.y || significant.z {
        return Ok(VanishingPoint::AtInfinity { direction: Vector::from_raw(image.truncate()) });
    }
    Ok(VanishingPoint::AlongProjectors)
}

/// The number of axes with a finite vanishing point.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum PointPerspective {
    /// None: a parallel projection.
    NoPoint,
    /// One: the plane is parallel to two axes.
    OnePoint,
    /// Two: the plane is parallel to one axis.
    TwoPoint,
    /// Three: the plane meets all axes.
    ThreePoint,
}

/// The vanishing points of the three axes (C81, C83).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PrincipalVanishingPoints<S: Space> {
    /// The vanishing points of the x, y and z axes.
    pub axes: [VanishingPoint<S>; 3],
}

impl<S: Space> PrincipalVanishingPoints<S> {
    /// Returns the number of axes with a finite vanishing point.
    #[must_use]
    pub fn count(&self) -> usize {
        self.axes.iter().filter(|axis| axis.point().is_some()).count()
    }

    /// Returns the kind of perspective with that number of vanishing points.
    #[must_use]
    pub fn class(&self) -> PointPerspective {
        match self.count() {
            0 => PointPerspective::NoPoint,
            1 => PointPerspective::OnePoint,
            2 => PointPerspective::TwoPoint,
            _ => PointPerspective::ThreePoint,
        }
    }
}

/// Returns the vanishing points of the three axes of space `A` under `map`.
///
/// For a map without rotation (bottom row p, q, r, s) this counts the nonzero values among p, q and
/// r.
///
/// # Errors
/// Returns an error if the map is not finite.
pub fn principal_vanishing_points<A: Space, B: Space>(
    map: Projective<A, B>,
) -> Result<PrincipalVanishingPoints<B::Divided>, ProjectionError> {
    let of = |axis| vanishing_point(map, axis);
    Ok(PrincipalVanishingPoints { axes: [of(Vector::X)?, of(Vector::Y)?, of(Vector::Z)?] })
}
