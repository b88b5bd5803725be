//! A near plane of any inclination, for clipping at the surface of a mirror or portal (Lengyel
//! 2005).
//!
//! Only the depth row changes, so the picture stays the same. Ordinary near clipping then removes
//! everything between the eye and the plane. The far plane tilts with the near plane and passes
//! through the opposite corner of the volume.

use crate::{Convention, ProjectionError, ViewVolume};
use glam::DVec4;
use homog::{Clip, HPoint, Plane, Projective, View};

/// Replaces the near plane of any projection matrix with `plane`: oblique near-plane clipping.
///
/// The normal of the plane points to the visible side, and the eye must be on the other side. The
/// plane gets the near depth of the convention. The corner of the old volume that is farthest in
/// front of the plane gets the far depth.
///
/// Source: Lengyel, "Oblique View Frustum Depth Projection and Clipping", Journal of Game
/// Development 1(2), 2005.
///
/// # Errors
/// Returns an error if a number is not finite, the projection is singular, the normal is zero, the
/// eye is not behind the plane, or no part of the volume is in front of the plane.
///
/// ```
/// use homog::{Normal, Plane, Point};
/// use projection::{Convention, Fov, Perspective, oblique_near_plane};
/// let lens = Perspective::new(Fov::Vertical(1.0), 1.0, 0.1, 100.0)?;
/// let mirror = Plane::through(Point::new(0.0, 0.0, -5.0), Normal::new(0.0, 0.6, -0.8));
/// let c = Convention::CHAPTER;
/// let cut = oblique_near_plane(lens.view_to_clip(c), c, mirror)?;
/// let on_mirror = cut.transform_point(Point::new(0.3, 0.8, -4.4)).divide().expect("in front");
/// assert!((on_mirror.z() - c.near_depth()).abs() < 1e-12);
/// # Ok::<(), projection::ProjectionError>(())
/// ```
pub fn oblique_near_plane(
    view_to_clip: Projective<View, Clip>,
    convention: Convention,
    plane: Plane<View>,
) -> Result<Projective<View, Clip>, ProjectionError> {
    let unusable = ProjectionError::Unrepresentable { what: "projection" };
    let clip_to_view = view_to_clip.inverse().ok_or(unusable)?;
    let eye = ViewVolume::new(view_to_clip, convention).eye().ok_or(unusable)?;
    let plane = normalized_plane(plane)?;
    let side = plane.evaluate(eye);
    if side.is_nan() || side >= 0.0 {
        return Err(out_of_range(
            "plane at the eye",
            side,
            "below 0, so that the eye is behind the plane",
        ));
    }
    // The corner farthest in front of the plane keeps the far depth.
    let seen = clip_to_view.raw().transpose() * plane.raw();
    let corner = DVec4::new(seen.x.signum(), seen.y.signum(), convention.far_depth(), 1.0);
    let farthest = plane.evaluate(clip_to_view.transform_hpoint(HPoint::from_raw(corner)));
    if farthest.is_nan() || farthest <= 0.0 {
        let allowed = "above 0, so that part of the volume is in front of the plane";
        return Err(out_of_range("plane at the far corner", farthest, allowed));
    }
    let depths = convention.far_depth() - convention.near_depth();
    let mut rows = view_to_clip.raw().transpose();
    rows.z_axis = rows.w_axis * convention.near_depth() + plane.raw() * (depths / farthest);
    let result = rows.transpose();
    result.is_finite().then_some(Projective::from_raw(result)).ok_or(unusable)
}

fn out_of_range(parameter: &'static str, value: f64, allowed: &'static str) -> ProjectionError {
    ProjectionError::OutOfRange { parameter, value, allowed }
}

/// Returns the plane, with its normal scaled to length 1.
fn normalized_plane(plane: Plane<View>) -> Result<Plane<View>, ProjectionError> {
    for value in plane.raw().to_array() {
        crate::error::check_finite("plane", value)?;
    }
    let length = homog::Vector::<View>::from_raw(plane.raw().truncate()).length();
    let unit = plane.raw() / length;
    if length == 0.0 {
        return Err(ProjectionError::ZeroVector { parameter: "plane normal" });
    }
    unit.is_finite()
        .then_some(Plane::from_raw(unit))
        .ok_or(ProjectionError::Unrepresentable { what: "plane" })
}
