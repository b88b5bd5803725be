//! A camera together with its projection, as used by the later stages.

use crate::Camera;
use glam::{DVec3, DVec4, Vec4Swizzles};
use homog::{Clip, HPoint, Projective, View, World};

/// A camera and its projection.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ViewProjection {
    /// The camera.
    pub camera: Camera,
    /// The projection in the pipeline's convention: the canonical volume of the textbook (Shirley
    /// and Marschner, ch. 8) with w > 0 in front (PE-3).
    pub view_to_clip: Projective<View, Clip>,
}

impl ViewProjection {
    /// Returns the map from world space to clip space.
    #[must_use]
    pub fn world_to_clip(&self) -> Projective<World, Clip> {
        self.camera.world_to_view().then_project(self.view_to_clip)
    }

    /// Returns the viewer: the eye, or in a parallel projection a point at infinity, opposite to
    /// the gaze.
    ///
    /// The viewer is the only point without an image: the x, y and w rows of the matrix all give 0
    /// for it. Its sign is chosen so that depth grows toward the viewer: `viewer.xyz − p·viewer.w`
    /// is the vector from a visible point p to the viewer.
    ///
    /// w is 1 for an eye and 0 for a direction. It is −1 in reverse perspective, for example with
    /// the bottom row (p, q, r, 1) and r > 0: the lines of sight meet *behind* the scene, and
    /// points farther from that center hide nearer points.
    #[must_use]
    pub fn viewer(&self) -> HPoint<World> {
        let viewer = self.blind_point();
        let viewer = if self.is_mirrored() { viewer } else { -viewer };
        HPoint::from_raw(if viewer.w == 0.0 { viewer } else { viewer / viewer.w.abs() })
    }

    /// Returns whether the picture is mirrored, as by a window with left and right (or bottom and
    /// top) swapped.
    ///
    /// The result follows from the sign of the matrix's determinant, which equals the z row times
    /// the point without an image. It is unambiguous because depth grows toward the viewer.
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        self.world_to_clip().raw().row(2).dot(self.blind_point()) > 0.0
    }

    /// Returns the point without an image, as the four-dimensional cross product of the x, y and w
    /// rows. The determinant of three points and this point equals the determinant of (x, y, w) of
    /// their images. The product points away from the viewer unless the picture is mirrored.
    fn blind_point(&self) -> DVec4 {
        let m = self.world_to_clip().raw();
        let rows = [m.row(0), m.row(1), m.row(3)];
        let minor = |kept: fn(DVec4) -> DVec3| {
            let [x, y, w] = rows.map(kept);
            x.dot(y.cross(w))
        };
        DVec4::new(
            -minor(Vec4Swizzles::yzw),
            minor(Vec4Swizzles::xzw),
            -minor(Vec4Swizzles::xyw),
            minor(Vec4Swizzles::xyz),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homog::{Point, Vector};
    use projection::{Convention, Frustum, NPoint, Orthographic};

    fn camera() -> Camera {
        Camera::look_at(Point::new(4.0, 3.0, 6.0), Point::new(0.0, 1.0, 0.0), Vector::Y)
            .expect("a valid camera")
    }

    fn perspective(left: f64, right: f64) -> ViewProjection {
        let frustum = Frustum::new(left, right, -1.0, 1.0, 1.0, 50.0).expect("a valid frustum");
        ViewProjection { camera: camera(), view_to_clip: frustum.view_to_clip(Convention::CHAPTER) }
    }

    #[test]
    fn the_viewer_of_a_perspective_projection_is_the_eye() {
        let viewer = perspective(-0.5, 3.0).viewer().divide().expect("a place");
        assert!((viewer - Point::new(4.0, 3.0, 6.0)).length() < 1e-12, "{viewer:?}");
    }

    #[test]
    fn the_viewer_of_a_parallel_projection_is_opposite_to_the_gaze() {
        let view_to_clip = Orthographic::new(-1.0, 1.0, -1.0, 1.0, 1.0, 50.0)
            .expect("a valid box")
            .view_to_clip(Convention::CHAPTER);
        let view_projection = ViewProjection { camera: camera(), view_to_clip };
        let viewer = view_projection.viewer();
        assert_eq!(viewer.w(), 0.0);
        let towards = Vector::<World>::from_raw(viewer.raw().truncate());
        let unit = towards.normalized().expect("a direction");
        assert!((unit - camera().w()).length() < 1e-12);
        assert!(!view_projection.is_mirrored());
    }

    #[test]
    fn the_viewer_of_a_reverse_perspective_has_negative_w() {
        for r in [-0.2, 0.2] {
            let perspective = NPoint::new(0.1, -0.05, r).expect("a perspective");
            let volume = Orthographic::new(-2.0, 2.0, -2.0, 2.0, -1.0, 1.0).expect("a valid box");
            let view_to_clip =
                perspective.depth_preserving().then(volume.view_to_clip(Convention::CHAPTER));
            let camera =
                Camera::look_to(Point::ORIGIN, -Vector::Z, Vector::Y).expect("a valid camera");
            let view_projection = ViewProjection { camera, view_to_clip };
            let viewer = view_projection.viewer();
            // ONE-1: the lines of sight meet at (0, 0, −1/r).
            assert_eq!(viewer.w(), -r.signum());
            let center = viewer.divide().expect("a place");
            assert!((center - Point::new(0.0, 0.0, -1.0 / r)).length() < 1e-12, "{center:?}");
            // In both cases, depth grows toward +z.
            assert!(viewer.z() > 0.0);
            assert!(!view_projection.is_mirrored());
        }
    }

    #[test]
    fn only_swapped_sides_mirror_the_picture() {
        assert!(!perspective(-0.5, 3.0).is_mirrored());
        assert!(perspective(3.0, -0.5).is_mirrored());
    }
}
