//! From pixels back to the world: points (UN-1), rays (UN-2) and the narrow view around a pixel.
//!
//! ```text
//!                     near          far
//!                      │             │         The points with all depths of a pixel form a line.
//!   center ●───────────┼─────────────┼──►      Between the near and far planes, it is the pixel's
//!                    pixel           │         ray. Extended, it passes through the center of
//!                      │             │         projection, if the center is not at infinity.
//! ```

use crate::error::check_finite;
use crate::{Rectangle, Viewport, ViewportError};
use glam::{DMat4, DVec4};
use homog::{Clip, HPoint, Point, Projective, Ray, Screen, Space, Vector};

/// The inverse map from pixels and depth to a space `S`: world, model or camera space.
///
/// ```
/// use homog::{Clip, ClipRange, Projective, View};
/// use viewport::Viewport;
/// // −1 times P of the textbook (PE-3), for n = −1 and f = −3.
/// let [x, y, z] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 4.0, 3.0]];
/// let view_to_clip = Projective::<View, Clip>::from_rows([x, y, z, [0.0, 0.0, -1.0, 0.0]]);
/// let clip_to_view = view_to_clip.inverse().expect("regular");
/// let back = Viewport::image_for(200, 100, ClipRange::CHAPTER)?.unprojector(clip_to_view);
/// let pick = back.pick_ray([100.0, 50.0]).expect("the middle of the picture");
/// assert_eq!(pick.ray.direction.z(), -1.0);
/// # Ok::<(), viewport::ViewportError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Unprojector<S: Space> {
    viewport: Viewport,
    screen_to_source: Projective<Screen, S>,
}

/// The ray through a position in the image, with its points on the near and far planes.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct PickRay<S: Space> {
    /// The ray away from the viewer, with a direction of length 1. It starts at the center of
    /// projection or, in a parallel projection, on the near plane.
    pub ray: Ray<S>,
    /// The point on the near plane.
    pub near: Point<S>,
    /// The point on the far plane, before the divide; it is at infinity if w = 0.
    pub far: HPoint<S>,
}

impl Viewport {
    /// Returns the complete map from a space to the screen, M_vp · M, before the divide (PL-1).
    #[must_use]
    pub fn source_to_screen<S: Space>(
        &self,
        source_to_clip: Projective<S, Clip>,
    ) -> Projective<S, Screen> {
        Projective::from_raw(self.ndc_to_screen().raw() * source_to_clip.raw())
    }

    /// Creates the inverse map from the inverse of the chain up to clip space. The closed-form
    /// inverses of camera and projection lose the fewest digits.
    #[must_use]
    pub fn unprojector<S: Space>(&self, clip_to_source: Projective<Clip, S>) -> Unprojector<S> {
        let raw = clip_to_source.raw() * self.screen_to_ndc().raw();
        Unprojector { viewport: *self, screen_to_source: Projective::from_raw(raw) }
    }

    /// Returns the map to apply after the projection so that `area`, in pixels of this viewport's
    /// convention, fills the whole view. It serves as a pick matrix, like `gluPickMatrix`, or as
    /// the sub-view of a tile. Everything outside the area is then outside the view volume.
    ///
    /// # Errors
    /// Returns an error if the area is so small compared with the viewport that the factors are not
    /// finite.
    pub fn pick_matrix(&self, area: Rectangle) -> Result<Projective<Clip, Clip>, ViewportError> {
        let to_ndc = self.screen_to_ndc();
        let [a, b] = [
            Point::new(area.x(), area.y(), 0.0),
            Point::new(area.x() + area.width(), area.y() + area.height(), 0.0),
        ]
        .map(|corner| to_ndc.transform_point(corner));
        let (width, height) = ((b.x() - a.x()).abs(), (b.y() - a.y()).abs());
        let sx = check_finite("horizontal factor", 2.0 / width)?;
        let sy = check_finite("vertical factor", 2.0 / height)?;
        let dx = check_finite("horizontal offset", -(a.x() + b.x()) / width)?;
        let dy = check_finite("vertical offset", -(a.y() + b.y()) / height)?;
        Ok(Projective::from_raw(DMat4::from_cols(
            DVec4::new(sx, 0.0, 0.0, 0.0),
            DVec4::new(0.0, sy, 0.0, 0.0),
            DVec4::Z,
            DVec4::new(dx, dy, 0.0, 1.0),
        )))
    }
}

impl<S: Space> Unprojector<S> {
    /// Returns the map M⁻¹, before the divide (UN-1).
    #[must_use]
    pub const fn screen_to_source(&self) -> Projective<Screen, S> {
        self.screen_to_source
    }

    /// Returns the point whose image is at this position and depth (UN-1), or `None` if it is at
    /// infinity.
    #[must_use]
    pub fn unproject_point(&self, screen: Point<Screen>) -> Option<Point<S>> {
        divide_point(self.screen_to_source.transform_point(screen))
    }

    /// Returns the center of projection. If w = 0, it is at infinity, and the projection is
    /// parallel to this direction.
    #[must_use]
    pub fn center_of_projection(&self) -> HPoint<S> {
        self.screen_to_source.transform_direction(Vector::Z)
    }

    /// Returns the ray through a position in the picture (UN-2), from the near to the far plane of
    /// the viewport's clip range.
    ///
    /// Returns `None` if the map is singular or if a number is not finite.
    #[must_use]
    pub fn pick_ray(&self, [x, y]: [f64; 2]) -> Option<PickRay<S>> {
        let at = |z: f64| {
            let depth = self.viewport.depth().ndc_to_depth(z);
            self.screen_to_source.transform_point(Point::new(x, y, depth))
        };
        let range = self.viewport.range();
        let (near_z, far_z) = (range.near_depth(), range.far_depth());
        let (near, far) = (divide_point(at(near_z))?, at(far_z));
        // The far plane may be at infinity, but the point at half the depth is always finite.
        let beyond = match divide_point(far) {
            Some(far) => far,
            None => divide_point(at(near_z * 0.5 + far_z * 0.5))?,
        };
        let direction = (beyond - near).normalized()?;
        let origin =
            if self.is_parallel() { near } else { divide_point(self.center_of_projection())? };
        far.is_finite().then_some(PickRay { ray: Ray { origin, direction }, near, far })
    }

    /// Returns whether the projection is parallel up to rounding, so that rounding cannot turn it
    /// into a perspective projection with a very distant center.
    fn is_parallel(&self) -> bool {
        let raw = self.screen_to_source.raw();
        raw.z_axis.w.abs() <= 1e-14 * raw.z_axis.abs().max_element()
    }
}

fn divide_point<S: Space>(point: HPoint<S>) -> Option<Point<S>> {
    point.divide().map(|place| Point::from_raw(place.raw()))
}
