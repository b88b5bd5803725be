//! Projector: the transform from the world to the screen, and the position of the viewer.
//!
//! ```text
//!   world ──world_to_clip──► clip space ──divide──► NDC ──ndc_to_screen──► pixels, y down; depth
//! ```
//!
//! The viewer is kept in homogeneous coordinates, so facing tests read the same in perspective,
//! where it is the eye, and in parallel projection, where it is a point at infinity: the vector to
//! the viewer from p is v.xyz − p · v.w.

use camera::ViewProjection;
use clip::{ClippedSegment, Volume, clip_segment};
use glam::{DMat4, DVec3, DVec4};
use homog::{Affine, Clip, HPoint, Ndc, Point, Projective, Screen, World};
use viewport::Viewport;

/// The transform from world space to the screen, with the viewer in homogeneous coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Projector {
    world_to_clip: Projective<World, Clip>,
    ndc_to_screen: Affine<Ndc, Screen>,
    /// The eye (w = 1), or the unit direction towards it as a point at infinity (w = 0).
    viewer: DVec4,
}

impl Projector {
    /// A camera on a viewport whose depths run from 0 at the far plane to 1 at the near plane.
    #[must_use]
    pub fn new(view_projection: &ViewProjection, viewport: &Viewport) -> Self {
        let viewer = view_projection.viewer().raw();
        let length = viewer.truncate().length();
        let far = viewer.w == 0.0 && length > 0.0;
        Self {
            world_to_clip: view_projection.world_to_clip(),
            ndc_to_screen: viewport.ndc_to_screen(),
            viewer: if far { viewer / length } else { viewer },
        }
    }

    /// From world space to clip space.
    pub(super) fn world_to_clip_point(&self, point: DVec3) -> HPoint<Clip> {
        self.world_to_clip.transform_point(Point::from_raw(point))
    }

    /// The perspective divide and the viewport transform; `None` where there is no finite image.
    pub(super) fn to_screen(&self, point: HPoint<Clip>) -> Option<DVec3> {
        let screen = self.ndc_to_screen.transform_point(point.divide()?).raw();
        screen.is_finite().then_some(screen)
    }

    /// The matrix from world space to screen and depth, before the divide.
    pub(super) fn world_to_screen(&self) -> DMat4 {
        self.ndc_to_screen.raw() * self.world_to_clip.raw()
    }

    /// The vector from a point towards the viewer; of length 1 in a parallel projection, not
    /// normalized in perspective.
    pub(super) fn towards_viewer(&self, from: DVec3) -> DVec3 {
        self.viewer.truncate() - from * self.viewer.w
    }

    /// The part of an edge within the view volume, in clip space.
    pub(super) fn clip_edge(&self, ends: [DVec3; 2]) -> Option<ClippedSegment> {
        let [a, b] = ends.map(|end| self.world_to_clip_point(end));
        clip_segment(a, b, &Volume::CHAPTER)
    }
}
