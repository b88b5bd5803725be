//! Projector: a [`ViewTransform`] for [`DVec3`] points, with clipping of edges.
//!
//! ```text
//!   world ──world_to_clip──► clip space ──divide──► NDC ──ndc_to_screen──► pixels, y down; depth
//! ```
//!
//! Hidden-line removal does linear algebra on plain vectors; this type keeps the steps between
//! spaces in one place. The viewer v is a homogeneous point: the eye in perspective projection, and
//! a point at infinity in parallel projection, so facing tests are the same. The vector from p to
//! the viewer is v.xyz − p · v.w.

use camera::{ViewProjection, ViewTransform};
use clip::{ClippedSegment, Volume, clip_segment};
use glam::{DMat4, DVec3};
use homog::{Clip, HPoint, Point};
use viewport::Viewport;

/// The transforms from world to clip space and screen, and the viewer, for [`DVec3`] points.
#[derive(Clone, Copy, Debug)]
pub struct Projector(ViewTransform);

impl Projector {
    /// Creates the transform for a camera on a viewport, whose depths must run from 0 at the far
    /// plane to 1 at the near plane.
    #[must_use]
    pub fn new(view_projection: &ViewProjection, viewport: &Viewport) -> Self {
        Self(ViewTransform::new(view_projection, viewport.ndc_to_screen()))
    }

    /// Transforms a point from world space to clip space.
    pub(super) fn world_to_clip_point(&self, point: DVec3) -> HPoint<Clip> {
        self.0.project_to_clip(Point::from_raw(point))
    }

    /// Applies the perspective divide and the viewport transform, or returns `None` if the result
    /// is not finite.
    pub(super) fn project_to_screen(&self, point: HPoint<Clip>) -> Option<DVec3> {
        let screen = self.0.project_to_screen(point)?.raw();
        screen.is_finite().then_some(screen)
    }

    /// Returns the matrix from world space to pixels and depth, before the divide.
    pub(super) fn world_to_screen(&self) -> DMat4 {
        self.0.world_to_screen().raw()
    }

    /// Returns the vector from a point to the eye, or a unit vector in a parallel view.
    #[must_use]
    #[inline]
    pub fn towards_viewer(&self, from: DVec3) -> DVec3 {
        self.0.vector_to_viewer(Point::from_raw(from)).raw()
    }

    /// Returns the part of a segment inside the view volume, clipped before the divide.
    pub(super) fn clip_edge(&self, ends: [DVec3; 2]) -> Option<ClippedSegment> {
        let [a, b] = ends.map(|end| self.world_to_clip_point(end));
        clip_segment(a, b, &Volume::CHAPTER)
    }
}
