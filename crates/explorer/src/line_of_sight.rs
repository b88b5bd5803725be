//! A line of sight: all points of the view volume that map to one position in the picture (UN-2).

use crate::triangle_survey::WorldTriangle;
use camera::ViewProjection;
use homog::{HPoint, Point, World};

/// The part of a line of sight between the near and far planes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct LineOfSight {
    /// The endpoints on the near and far planes.
    pub(crate) ends: [Point<World>; 2],
}

impl LineOfSight {
    /// Returns the line through a picture position, in fractions from the upper left corner, or
    /// `None` if the far plane is at infinity.
    pub(crate) fn through_picture(view: &ViewProjection, [x, y]: [f64; 2]) -> Option<Self> {
        Self::through_ndc(view, [2.0 * x - 1.0, 1.0 - 2.0 * y])
    }

    /// Returns the line through a world-space point, or `None` if the point is not in front of the
    /// eye.
    pub(crate) fn through_point(view: &ViewProjection, point: Point<World>) -> Option<Self> {
        let clip = view.world_to_clip().transform_point(point);
        let ndc = clip.divide().filter(|_| clip.w() > 0.0)?;
        Self::through_ndc(view, [ndc.x(), ndc.y()])
    }

    fn through_ndc(view: &ViewProjection, [x, y]: [f64; 2]) -> Option<Self> {
        let clip_to_world = view.world_to_clip().inverse()?;
        let end = |z: f64| clip_to_world.transform_hpoint(HPoint::new(x, y, z, 1.0)).divide();
        Some(Self { ends: [end(1.0)?, end(-1.0)?] })
    }

    /// Returns the first intersection of the line with a triangle (Möller and Trumbore 1997).
    pub(crate) fn first_hit(&self, triangles: &[WorldTriangle]) -> Option<Point<World>> {
        let [origin, end] = self.ends.map(Point::raw);
        let direction = end - origin;
        let hit = |triangle: &WorldTriangle| {
            let [a, b, c] = triangle.map(Point::raw);
            let (ab, ac) = (b - a, c - a);
            let across = direction.cross(ac);
            let determinant = ab.dot(across);
            if determinant == 0.0 {
                return None;
            }
            let from_a = origin - a;
            let u = from_a.dot(across) / determinant;
            let along = from_a.cross(ab);
            let v = direction.dot(along) / determinant;
            let t = ac.dot(along) / determinant;
            let is_inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && (0.0..=1.0).contains(&t);
            is_inside.then_some(t)
        };
        let nearest = triangles.iter().filter_map(hit).min_by(f64::total_cmp)?;
        Some(Point::from_raw(origin + direction * nearest))
    }
}
