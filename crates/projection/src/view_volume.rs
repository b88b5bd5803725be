//! The view volume as geometry: the corners, edges and planes of the visible region.
//!
//! ```text
//!        7────────6     corners 0..3 on the near plane, 4..7 on the far plane,
//!       /│  far  /│     each counterclockwise from the lower left, as seen by the viewer:
//!      4────────5 │         3 2      7 6
//!      │ 3──────│-2         0 1      4 5
//!      │/ near  │/
//!      0────────1       planes: left, right, bottom, top, near, far
//! ```

use crate::Convention;
use glam::DVec4;
use homog::{Clip, HPoint, Ndc, Plane, Point, Projective, View};

/// The view volume of any projection: corners, planes and eye (C4, C7, C85).
///
/// ```
/// use homog::Point;
/// use projection::{Convention, Orthographic, ViewVolume};
/// let sheet = Orthographic::new(-2.0, 2.0, -1.0, 1.0, 0.0, 10.0)?;
/// let volume = ViewVolume::new(sheet.view_to_clip(Convention::CHAPTER), Convention::CHAPTER);
/// assert!(volume.contains(Point::new(1.0, 1.0, -10.0)));
/// assert!(!volume.contains(Point::new(1.0, 1.0, 0.5)));
/// # Ok::<(), projection::ProjectionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ViewVolume {
    view_to_clip: Projective<View, Clip>,
    convention: Convention,
}

/// The largest w, relative to the other coordinates, that counts as 0 for an eye at infinity.
const ROUNDING: f64 = 1e-13;

impl ViewVolume {
    /// The pairs of corners joined by an edge: four near, four far, four from near to far.
    pub const EDGES: [[usize; 2]; 12] = [
        [0, 1],
        [1, 2],
        [2, 3],
        [3, 0],
        [4, 5],
        [5, 6],
        [6, 7],
        [7, 4],
        [0, 4],
        [1, 5],
        [2, 6],
        [3, 7],
    ];

    /// Creates the volume that `view_to_clip` maps to the canonical volume of `convention`.
    #[must_use]
    pub const fn new(view_to_clip: Projective<View, Clip>, convention: Convention) -> Self {
        Self { view_to_clip, convention }
    }

    /// Returns the six half-spaces whose intersection is the volume: left, right, bottom, top,
    /// near, far (CL-1).
    ///
    /// The value of each plane is nonnegative inside. The normals are not scaled to length 1.
    #[must_use]
    pub fn planes(self) -> [Plane<View>; 6] {
        let rows = self.view_to_clip.raw().transpose();
        let (x, y, z, w) =
            (rows.x_axis, rows.y_axis * self.convention.top(), rows.z_axis, rows.w_axis);
        let (near, far) = (self.convention.near_depth(), self.convention.far_depth());
        let inwards = if far > near { 1.0 } else { -1.0 };
        [w + x, w - x, w + y, w - y, (z - w * near) * inwards, (w * far - z) * inwards]
            .map(Plane::from_raw)
    }

    /// Returns the eight corners, with w = 0 for corners at infinity, or `None` if the projection
    /// is singular or a coordinate is not finite.
    #[must_use]
    pub fn corners(self) -> Option<[HPoint<View>; 8]> {
        let clip_to_view = self.view_to_clip.inverse()?;
        let up = self.convention.top();
        let (near, far) = (self.convention.near_depth(), self.convention.far_depth());
        let face =
            |z: f64| [(-1.0, -up), (1.0, -up), (1.0, up), (-1.0, up)].map(|(x, y)| [x, y, z, 1.0]);
        let [a, b, c, d] = face(near);
        let [e, f, g, h] = face(far);
        let corners = [a, b, c, d, e, f, g, h]
            .map(|corner| clip_to_view.transform_hpoint(HPoint::from(corner)));
        corners.iter().all(|corner| corner.is_finite()).then_some(corners)
    }

    /// Returns whether the point is visible. The boundary is part of the volume (CL-1).
    #[must_use]
    pub fn contains(self, point: Point<View>) -> bool {
        let inside = |plane: Plane<View>| plane.evaluate(point) >= 0.0;
        self.planes().into_iter().all(inside) && self.view_to_clip.transform_point(point).w() > 0.0
    }

    /// Returns the position from which the volume is seen: a point, or with w = 0 the direction
    /// toward an eye at infinity.
    ///
    /// Returns `None` if the projection is singular or a coordinate is not finite.
    #[must_use]
    pub fn eye(self) -> Option<HPoint<View>> {
        let clip_to_view = self.view_to_clip.inverse()?;
        let towards = self.convention.near_depth() - self.convention.far_depth();
        let eye =
            clip_to_view.transform_hpoint(HPoint::from_raw(DVec4::new(0.0, 0.0, towards, 0.0)));
        let direction = eye.raw().truncate();
        // The inverse of a parallel projection may have a w that is only a rounding error.
        let is_infinite = eye.w().abs() <= ROUNDING * direction.abs().max_element();
        let eye = if is_infinite { HPoint::from_raw(direction.extend(0.0)) } else { eye };
        eye.is_finite().then_some(eye)
    }
}

impl Convention {
    /// Returns whether a point after the divide is in the canonical view volume, including the
    /// boundary (C4).
    #[must_use]
    pub fn contains(self, point: Point<Ndc>) -> bool {
        let (near, far) = (self.near_depth(), self.far_depth());
        let depth = near.min(far)..=near.max(far);
        point.x().abs() <= 1.0 && point.y().abs() <= 1.0 && depth.contains(&point.z())
    }
}
