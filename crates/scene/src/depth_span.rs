//! The depth range of a scene along the line of sight, for automatic near and far planes.

use camera::Camera;
use homog::{Point, World};

/// The smallest and largest depth of the vertices, along the line of sight from the eye.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct DepthSpan {
    /// The smallest depth in world units, negative behind the eye.
    nearest_depth: f64,
    /// The largest depth in world units.
    farthest_depth: f64,
}

impl DepthSpan {
    /// Computes the span of `points` as seen by `camera`; 0 to 1 if there are no points.
    #[must_use]
    pub fn from_points(points: &[Point<World>], camera: Camera) -> Self {
        let world_to_view = camera.world_to_view();
        let distances = points.iter().map(|&point| -world_to_view.transform_point(point).z());
        let none = Self { nearest_depth: f64::INFINITY, farthest_depth: f64::NEG_INFINITY };
        let span = distances.fold(none, |span, distance| Self {
            nearest_depth: span.nearest_depth.min(distance),
            farthest_depth: span.farthest_depth.max(distance),
        });
        if span.nearest_depth <= span.farthest_depth {
            span
        } else {
            Self { nearest_depth: 0.0, farthest_depth: 1.0 }
        }
    }

    /// Returns the near and far planes of a perspective, tight around the vertices with a margin of
    /// 1%.
    ///
    /// The near distance is at least 1e-5 times the far distance, because depth resolution falls as
    /// the far-to-near ratio grows (ZP-1). Planes that the file sets are used unchanged. The result
    /// always has near < far, unless `far` is set.
    #[must_use]
    pub fn perspective_planes(self, near: Option<f64>, far: Option<f64>) -> (f64, f64) {
        let farthest =
            far.unwrap_or(if self.farthest_depth > 0.0 { self.farthest_depth * 1.01 } else { 1.0 });
        let near = near.unwrap_or((self.nearest_depth * 0.99).max(farthest * 1e-5));
        let far = far.unwrap_or(if farthest > near { farthest } else { near * 2.0 });
        (near, far)
    }

    /// Returns the near and far planes of a parallel projection; they may be behind the eye.
    ///
    /// The margin is 1% of the depth range, with a lower bound relative to the distance of flat
    /// scenes, so that the planes stay apart in floating point.
    #[must_use]
    pub fn parallel_planes(self, near: Option<f64>, far: Option<f64>) -> (f64, f64) {
        let size = self.nearest_depth.abs().max(self.farthest_depth.abs());
        let room = (self.farthest_depth - self.nearest_depth).max(size * 1e-6).max(1e-9) * 0.01;
        let near_plane = near.unwrap_or(self.nearest_depth - room);
        (near_plane, far.unwrap_or((self.farthest_depth + room).max(near_plane + room)))
    }
}
