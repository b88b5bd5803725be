//! The view transform: the maps from world space to pixels, and the viewer, in one value (PL-1).
//!
//! ```text
//!  World ──world_to_clip──► Clip ──perspective divide──► Ndc ──ndc_to_screen──► Screen
//!          camera, then            ÷ w                         viewport transform
//!          projection
//! ```
//!
//! Renderers, hidden-line removal and explanations share it, so they all compute bit-identical
//! pixel positions. All numbers are f64.

use crate::ViewProjection;
use homog::{Affine, Clip, HPoint, Ndc, Point, Projective, Screen, Vector, World};

/// World → clip → NDC → screen, and the point from which the picture is viewed.
///
/// This crate has no viewport type: [`new`](Self::new) accepts the complete map from NDC to pixels.
///
/// ```
/// use camera::{Camera, ViewProjection, ViewTransform};
/// use homog::{Affine, Clip, Ndc, Point, Screen, Vector, View};
///
/// // A parallel view along −z; the projection preserves x, y and the depth.
/// let camera = Camera::look_to(Point::ORIGIN, -Vector::Z, Vector::Y)?;
/// let view_to_clip = Affine::<View, Clip>::scale(1.0, 1.0, 1.0).into();
/// // 200 × 100 pixels, y down.
/// let ndc_to_screen = Affine::<Ndc, Screen>::scale(100.0, -50.0, 1.0)
///     .then(Affine::translation(Vector::new(100.0, 50.0, 0.0)));
/// let transform = ViewTransform::new(&ViewProjection { camera, view_to_clip }, ndc_to_screen);
/// let clip = transform.project_to_clip(Point::new(0.5, 0.5, -1.0));
/// let pixel = transform.project_to_screen(clip).expect("a point with w = 1");
/// assert_eq!((pixel.x(), pixel.y()), (150.0, 25.0));
/// # Ok::<(), camera::CameraError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ViewTransform {
    world_to_clip: Projective<World, Clip>,
    ndc_to_screen: Affine<Ndc, Screen>,
    viewer: HPoint<World>,
}

impl ViewTransform {
    /// Creates the transform of a camera and projection, followed by a viewport transform.
    #[must_use]
    pub fn new(view_projection: &ViewProjection, ndc_to_screen: Affine<Ndc, Screen>) -> Self {
        let viewer = view_projection.viewer();
        Self::with_world_to_clip(view_projection.world_to_clip(), ndc_to_screen, viewer)
    }

    /// Returns the transform with a custom clip space, for another graphics API or for one tile of
    /// a larger image. `viewer` is the eye, or the point at infinity of a parallel view, which is
    /// scaled to length 1.
    #[must_use]
    pub fn with_world_to_clip(
        world_to_clip: Projective<World, Clip>,
        ndc_to_screen: Affine<Ndc, Screen>,
        viewer: HPoint<World>,
    ) -> Self {
        let raw = viewer.raw();
        let length = raw.truncate().length();
        let is_parallel = raw.w == 0.0 && length > 0.0;
        let viewer = HPoint::from_raw(if is_parallel { raw / length } else { raw });
        Self { world_to_clip, ndc_to_screen, viewer }
    }

    /// Returns the product of the camera and projection matrices.
    #[must_use]
    pub const fn world_to_clip(&self) -> Projective<World, Clip> {
        self.world_to_clip
    }

    /// Returns the viewport transform: NDC to pixels, and NDC z to depth.
    #[must_use]
    pub const fn ndc_to_screen(&self) -> Affine<Ndc, Screen> {
        self.ndc_to_screen
    }

    /// Returns the map from the world to pixels and depth in homogeneous coordinates: one matrix,
    /// before the divide.
    #[must_use]
    pub fn world_to_screen(&self) -> Projective<World, Screen> {
        Projective::from_raw(self.ndc_to_screen.raw() * self.world_to_clip.raw())
    }

    /// Returns the eye with w = 1, or in a parallel view the unit direction toward it with w = 0.
    /// In reverse perspective, w is −1 (see [`ViewProjection::viewer`]).
    #[must_use]
    pub const fn viewer(&self) -> HPoint<World> {
        self.viewer
    }

    /// Returns the vector from a point to the eye. It has length 1 in a parallel view, and points
    /// away from the center of a reverse perspective.
    #[must_use]
    #[inline]
    pub fn vector_to_viewer(&self, from: Point<World>) -> Vector<World> {
        let viewer = self.viewer.raw();
        Vector::from_raw(viewer.truncate() - from.raw() * viewer.w)
    }

    /// Returns a world point in clip space, for clipping before the divide.
    #[must_use]
    #[inline]
    pub fn project_to_clip(&self, point: Point<World>) -> HPoint<Clip> {
        self.world_to_clip.transform_point(point)
    }

    /// Performs the perspective divide and the viewport transform: returns the pixel position and
    /// depth of a clip-space point, or `None` if w is 0.
    #[must_use]
    #[inline]
    pub fn project_to_screen(&self, point: HPoint<Clip>) -> Option<Point<Screen>> {
        Some(self.ndc_to_screen.transform_point(point.divide()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Camera;
    use projection::{Convention, Frustum, Orthographic};

    fn transform(view_to_clip: Projective<homog::View, Clip>) -> ViewTransform {
        let eye = Point::new(4.0, 3.0, 6.0);
        let camera = Camera::look_at(eye, Point::ORIGIN, Vector::Y).expect("a valid camera");
        let half = Affine::<Ndc, Screen>::scale(320.0, -240.0, 0.5);
        let ndc_to_screen = half.then(Affine::translation(Vector::new(320.0, 240.0, 0.5)));
        ViewTransform::new(&ViewProjection { camera, view_to_clip }, ndc_to_screen)
    }

    #[test]
    fn one_matrix_and_two_steps_give_the_same_pixel() {
        let frustum = Frustum::new(-0.5, 0.5, -0.4, 0.4, 1.0, 50.0).expect("a valid frustum");
        let transform = transform(frustum.view_to_clip(Convention::CHAPTER));
        let point = Point::new(0.3, -0.2, 0.5);
        let expected = transform.project_to_screen(transform.project_to_clip(point));
        let actual = transform.world_to_screen().transform_point(point).divide();
        let difference = expected.expect("a pixel") - actual.expect("a pixel");
        assert!(difference.length() < 1e-9, "{difference:?}");
    }

    #[test]
    fn the_viewer_is_the_eye_or_a_unit_direction() {
        let frustum = Frustum::new(-0.5, 0.5, -0.4, 0.4, 1.0, 50.0).expect("a valid frustum");
        let perspective = transform(frustum.view_to_clip(Convention::CHAPTER));
        let to_eye = perspective.vector_to_viewer(Point::ORIGIN);
        assert!((to_eye - Vector::new(4.0, 3.0, 6.0)).length() < 1e-12, "{to_eye:?}");
        let volume = Orthographic::new(-7.0, 7.0, -7.0, 7.0, 1.0, 50.0).expect("a valid box");
        let parallel = transform(volume.view_to_clip(Convention::CHAPTER));
        assert_eq!(parallel.viewer().w(), 0.0);
        assert!((parallel.vector_to_viewer(Point::ORIGIN).length() - 1.0).abs() < 1e-15);
    }
}
