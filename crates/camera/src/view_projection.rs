//! A shot: camera and projection together, as the stages want them.

use crate::Camera;
use glam::{DVec3, DVec4, Vec4Swizzles};
use homog::{Clip, HPoint, Projective, View, World};

/// Where the picture is taken from, and by which projection.
#[derive(Clone, Copy, Debug)]
pub struct ViewProjection {
    /// The camera.
    pub camera: Camera,
    /// The projection in the pipeline's convention: the chapter's canonical volume with w > 0 in
    /// front (PE-3).
    pub view_to_clip: Projective<View, Clip>,
}

impl ViewProjection {
    /// From the world to clip space.
    #[must_use]
    pub fn world_to_clip(&self) -> Projective<World, Clip> {
        self.camera.world_to_view().then_project(self.view_to_clip)
    }

    /// Where the viewer is: the eye, or in a parallel projection the direction towards it, a point
    /// at infinity.
    ///
    /// It is the one point that has no image: the rows of x, y and w of the matrix all give 0 for
    /// it.
    #[must_use]
    pub fn viewer(&self) -> HPoint<World> {
        let viewer = self.blind_point();
        let towards = self.camera.w().raw();
        let backwards =
            if viewer.w == 0.0 { viewer.truncate().dot(towards) < 0.0 } else { viewer.w < 0.0 };
        let viewer = if backwards { -viewer } else { viewer };
        HPoint::from_raw(if viewer.w == 0.0 { viewer } else { viewer / viewer.w })
    }

    /// Whether the picture shows the world as in a mirror: a window with left and right (or bottom
    /// and top) exchanged.
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        self.blind_point().dot(self.viewer().raw()) > 0.0
    }

    /// The point without an image, as the product of the rows of x, y and w in four dimensions: the
    /// determinant of three points and this one is that of (x, y, w) of their images. View space
    /// looks along −z while w grows ahead, so the product points away from the viewer unless the
    /// picture is mirrored.
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
    use projection::{Convention, Frustum, Orthographic};

    fn camera() -> Camera {
        Camera::look_at(Point::new(4.0, 3.0, 6.0), Point::new(0.0, 1.0, 0.0), Vector::Y)
            .expect("a good camera")
    }

    fn perspective(left: f64, right: f64) -> ViewProjection {
        let frustum = Frustum::new(left, right, -1.0, 1.0, 1.0, 50.0).expect("a good frustum");
        ViewProjection { camera: camera(), view_to_clip: frustum.view_to_clip(Convention::CHAPTER) }
    }

    #[test]
    fn the_viewer_of_a_perspective_is_the_eye() {
        let viewer = perspective(-0.5, 3.0).viewer().divide().expect("a place");
        assert!((viewer - Point::new(4.0, 3.0, 6.0)).length() < 1e-12, "{viewer:?}");
    }

    #[test]
    fn the_viewer_of_a_parallel_projection_is_the_direction_against_the_gaze() {
        let view_to_clip = Orthographic::new(-1.0, 1.0, -1.0, 1.0, 1.0, 50.0)
            .expect("a good box")
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
    fn only_a_window_with_exchanged_sides_mirrors() {
        assert!(!perspective(-0.5, 3.0).is_mirrored());
        assert!(perspective(3.0, -0.5).is_mirrored());
    }
}
