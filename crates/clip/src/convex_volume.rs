//! Convex volumes with any planes in any space, for clipping to a room, a light cone or a camera
//! view.
//!
//! [`Volume`](crate::Volume) is the plane table of the pipeline: it is in clip space, has at most
//! sixteen planes and never allocates. A [`ConvexVolume`] starts without planes, accepts any number
//! of them, and carries attributes along.

use crate::VolumeError;
use crate::sutherland_hodgman::{RingStep, clip_ring};
use alloc::vec::Vec;
use homog::{Bounds, Clip, ClipRange, HPoint, Interpolate, Plane, Point, Projective, Space};

/// An intersection of half-spaces in space `S`: the points where no plane is negative. The boundary
/// is included.
///
/// ```
/// use clip::ConvexVolume;
/// use homog::{Plane, Point, World};
///
/// // A quarter of the world: x ≥ 0 and y ≥ 0.
/// let quarter = ConvexVolume::<World>::new()
///     .with_plane(Plane::new(1.0, 0.0, 0.0, 0.0))?
///     .with_plane(Plane::new(0.0, 1.0, 0.0, 0.0))?;
///
/// // A triangle with a color at each corner.
/// let corner = |x: f64, y: f64, red: f32| (Point::<World>::new(x, y, 0.0), [red, 0.0, 0.0]);
/// let triangle = [corner(-1.0, 1.0, 0.0), corner(3.0, 1.0, 1.0), corner(1.0, 5.0, 0.5)];
/// let inside = quarter.clip_polygon(&triangle);
/// assert_eq!(inside.len(), 4);
/// assert_eq!(inside[0], corner(0.0, 1.0, 0.25));
/// # Ok::<(), clip::VolumeError>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct ConvexVolume<S: Space> {
    planes: Vec<Plane<S>>,
}

/// All of space.
impl<S: Space> Default for ConvexVolume<S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<S: Space> ConvexVolume<S> {
    /// Creates a volume without planes, which is all of space.
    #[must_use]
    pub const fn new() -> Self {
        Self { planes: Vec::new() }
    }

    /// Returns the part of this volume on the positive side of another plane.
    ///
    /// # Errors
    /// Returns [`VolumeError::NoPlane`] if the coefficients are not finite or all zero.
    pub fn with_plane(mut self, plane: Plane<S>) -> Result<Self, VolumeError> {
        let coefficients = plane.coefficients();
        let largest = coefficients.iter().fold(0.0_f64, |largest, c| largest.max(c.abs()));
        if !coefficients.iter().all(|c| c.is_finite()) || largest == 0.0 {
            return Err(VolumeError::NoPlane { coefficients });
        }
        let [a, b, c, d] = coefficients.map(|coefficient| coefficient / largest);
        self.planes.push(Plane::new(a, b, c, d));
        Ok(self)
    }

    /// Creates the volume of a box.
    #[must_use]
    pub fn from_bounds(bounds: Bounds<S>) -> Self {
        let ([x0, y0, z0], [x1, y1, z1]) =
            (<[f64; 3]>::from(bounds.min()), <[f64; 3]>::from(bounds.max()));
        let planes = [
            Plane::new(1.0, 0.0, 0.0, -x0),
            Plane::new(-1.0, 0.0, 0.0, x1),
            Plane::new(0.0, 1.0, 0.0, -y0),
            Plane::new(0.0, -1.0, 0.0, y1),
            Plane::new(0.0, 0.0, 1.0, -z0),
            Plane::new(0.0, 0.0, -1.0, z1),
        ];
        Self { planes: planes.to_vec() }
    }

    /// Creates the volume that a projection shows, from the six planes of its frustum in clip-space
    /// order (left, right, bottom, top, near, far; Gribb and Hartmann, 2001).
    ///
    /// A far plane at infinity is omitted, and so is a far plane that only rounding keeps finite.
    ///
    /// ```
    /// use clip::ConvexVolume;
    /// use homog::{Point, View};
    /// use projection::{Convention, Fov, Perspective};
    ///
    /// let lens = Perspective::new(Fov::vertical_degrees(90.0), 1.0, 1.0, 9.0)?;
    /// let convention = Convention::WEBGPU;
    /// let view = ConvexVolume::from_projection(lens.view_to_clip(convention), convention)?;
    /// assert_eq!(view.planes().len(), 6);
    /// assert!(view.contains(Point::<View>::new(0.0, 4.9, -5.0)));
    /// assert!(!view.contains(Point::<View>::new(0.0, 5.1, -5.0)));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns [`VolumeError::NoPlane`] if the map is not finite, or if a plane degenerates.
    pub fn from_projection(
        source_to_clip: Projective<S, Clip>,
        range: impl Into<ClipRange>,
    ) -> Result<Self, VolumeError> {
        let range = range.into();
        let (near, far) = (range.near_depth(), range.far_depth());
        let side = if far < near { -1.0 } else { 1.0 };
        let [x, y, z, w] = source_to_clip.rows();
        let sum = |row: [f64; 4], factor: f64, other: f64| -> [f64; 4] {
            core::array::from_fn(|i| factor * row[i] + other * w[i])
        };
        let rows = [
            sum(x, 1.0, 1.0),
            sum(x, -1.0, 1.0),
            sum(y, 1.0, 1.0),
            sum(y, -1.0, 1.0),
            sum(z, side, -side * near),
            sum(z, -side, side * far),
        ];
        let mut volume = Self::new();
        for (index, [a, b, c, d]) in rows.into_iter().enumerate() {
            // A plane at infinity has no direction: its value is a positive constant everywhere.
            let is_at_infinity = a.abs().max(b.abs()).max(c.abs()) <= 1e-15 * d.abs();
            if index == 5 && is_at_infinity && d > 0.0 {
                continue;
            }
            volume = volume.with_plane(Plane::new(a, b, c, d))?;
        }
        Ok(volume)
    }

    /// Returns the planes in the order in which they were added, scaled to make the largest
    /// coefficient of each ±1.
    #[must_use]
    pub fn planes(&self) -> &[Plane<S>] {
        &self.planes
    }

    /// Returns whether a point is inside or on the boundary. A point that is not finite is outside.
    #[must_use]
    pub fn contains(&self, point: impl Into<HPoint<S>>) -> bool {
        let point = point.into();
        point.is_finite() && self.planes.iter().all(|plane| plane.evaluate(point) >= 0.0)
    }

    /// Returns false if a box is certainly outside, that is, completely on the negative side of one
    /// plane. This is the test for frustum culling.
    #[must_use]
    pub fn may_touch(&self, bounds: Bounds<S>) -> bool {
        let corners = bounds.corners();
        self.planes.iter().all(|plane| corners.iter().any(|corner| plane.evaluate(*corner) >= 0.0))
    }

    /// Returns the part of a convex polygon that is inside: its corners with their attributes, in
    /// the same order (CL-3; Sutherland and Hodgman, 1974). Corners may be points or homogeneous
    /// points.
    ///
    /// The result is empty if nothing is left, or if a corner is not finite. Corners that are
    /// inside are unchanged, and an edge shared by two polygons is cut at bit-identical points.
    #[must_use]
    pub fn clip_polygon<P, A>(&self, polygon: &[(P, A)]) -> Vec<(P, A)>
    where
        P: Interpolate + Into<HPoint<S>>,
        A: Interpolate,
    {
        let is_finite = |corner: &(P, A)| corner.0.into().is_finite();
        if polygon.len() < 3 || !polygon.iter().all(is_finite) {
            return Vec::new();
        }
        let mut ring = polygon.to_vec();
        for plane in &self.planes {
            let distances: Vec<f64> =
                ring.iter().map(|(place, _)| plane.evaluate((*place).into())).collect();
            if distances.iter().all(|&distance| distance >= 0.0) {
                continue;
            }
            let mut rest = Vec::with_capacity(ring.len() + 1);
            clip_ring(&distances, |step| {
                rest.push(match step {
                    RingStep::Keep(i) => ring[i],
                    RingStep::Cross { from, to, t } => {
                        (ring[from].0.lerp(ring[to].0, t), ring[from].1.lerp(ring[to].1, t))
                    }
                });
            });
            if rest.len() < 3 {
                return Vec::new();
            }
            ring = rest;
        }
        ring
    }

    /// Returns the part of a segment that is inside, as the fractions at which it enters and
    /// leaves, or 0 and 1 where its endpoints are inside (Cyrus and Beck, 1978). Returns `None` if
    /// nothing is inside.
    #[must_use]
    pub fn clip_segment(&self, ends: [impl Into<HPoint<S>>; 2]) -> Option<[f64; 2]> {
        let [p, q] = ends.map(Into::into);
        if !p.is_finite() || !q.is_finite() {
            return None;
        }
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for plane in &self.planes {
            let (a, b) = (plane.evaluate(p), plane.evaluate(q));
            match (a >= 0.0, b >= 0.0) {
                (false, false) => return None,
                (false, true) => enter = enter.max(a / (a - b)),
                (true, false) => leave = leave.min(a / (a - b)),
                (true, true) => {}
            }
        }
        (enter <= leave).then_some([enter, leave])
    }
}

/// Clipping of points without attributes.
impl<S: Space> ConvexVolume<S> {
    /// Returns the part of a triangle that is inside, as a polygon. This is
    /// [`clip_polygon`](Self::clip_polygon) with the weights of the triangle's corners as
    /// attributes.
    #[must_use]
    pub fn clip_triangle(&self, [a, b, c]: [Point<S>; 3]) -> Vec<(Point<S>, [f64; 3])> {
        self.clip_polygon(&[(a, [1.0, 0.0, 0.0]), (b, [0.0, 1.0, 0.0]), (c, [0.0, 0.0, 1.0])])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Volume, clip_triangle};
    use homog::{Vector, World};

    type Room = ConvexVolume<World>;

    #[test]
    fn volumes_without_planes_keep_everything_and_bad_planes_are_rejected() {
        let triangle = [[0.0; 3], [9.0, 0.0, 0.0], [0.0, 1e30, 0.0]].map(Point::<World>::from);
        let whole = Room::new().clip_triangle(triangle);
        assert_eq!(whole.iter().map(|(p, _)| *p).collect::<Vec<_>>(), triangle);
        for [a, b, c, d] in [[0.0; 4], [f64::NAN, 1.0, 0.0, 0.0], [f64::INFINITY; 4]] {
            assert!(Room::new().with_plane(Plane::new(a, b, c, d)).is_err());
        }
    }

    #[test]
    fn a_hundred_planes_around_a_circle_cut_a_square_into_a_disc() {
        let mut ball = Room::new();
        for step in 0..100 {
            let (s, c) = libm::sincos(f64::from(step) * core::f64::consts::TAU / 100.0);
            ball = ball.with_plane(Plane::new(-c, -s, 0.0, 1.0)).expect("a plane");
        }
        let square = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]];
        let square = square.map(|[x, y]| (Point::<World>::new(x, y, 0.0), [x, y]));
        let disc = ball.clip_polygon(&square);
        assert_eq!(disc.len(), 100);
        for (point, attribute) in disc {
            let radius = (point - Point::ORIGIN).length();
            assert!((1.0 - 1e-12..1.0005).contains(&radius), "{radius}");
            assert!((point.x() - attribute[0]).abs() < 1e-12);
        }
    }

    #[test]
    fn segments_are_cut_where_they_enter_and_leave() {
        let corners = [[0.0; 3], [1.0, 1.0, 1.0]].map(Point::<World>::from);
        let cube = Room::from_bounds(Bounds::from_points(corners).expect("a box"));
        let cut =
            |p: [f64; 3], q: [f64; 3]| cube.clip_segment([Point::<World>::from(p), Point::from(q)]);
        assert_eq!(cut([-1.0, 0.5, 0.5], [3.0, 0.5, 0.5]), Some([0.25, 0.5]));
        assert_eq!(cut([0.5; 3], [0.5, 0.5, 1.5]), Some([0.0, 0.5]));
        assert_eq!(cut([-1.0, 2.0, 0.5], [3.0, 2.0, 0.5]), None);
        assert_eq!(cut([-1.0, 0.9, 0.5], [0.2, 2.1, 0.5]), None, "past an edge");
        assert_eq!(cut([f64::NAN; 3], [0.5; 3]), None);
        let far = Bounds::from_points([Point::new(2.0, 0.0, 0.0)]).expect("a point");
        assert!(!cube.may_touch(far));
        assert!(cube.may_touch(Bounds::from_points(corners).expect("a box")));
    }

    /// With homogeneous coordinates, the result matches the pipeline's volume.
    #[test]
    fn convex_volumes_in_clip_space_match_the_clip_volume() {
        let mut volume = ConvexVolume::<Clip>::new();
        for index in crate::PlaneIndex::BOX {
            volume = volume.with_plane(Volume::CHAPTER.plane(index).expect("six")).expect("one");
        }
        let corners = [[-2.0, -1.5, 0.3, 1.0], [3.0, 0.0, -4.0, 1.5], [0.5, 2.0, 0.2, -0.5]]
            .map(HPoint::<Clip>::from);
        let units = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0_f64]];
        let polygon: Vec<_> = corners.into_iter().zip(units).collect();
        let ours = volume.clip_polygon(&polygon);
        let theirs = clip_triangle(corners, &Volume::CHAPTER);
        assert_eq!(ours.len(), theirs.vertices().len());
        for ((point, weights), vertex) in ours.iter().zip(theirs.vertices()) {
            let apart: f64 = (0..3).map(|k| (weights[k] - vertex.weights[k]).abs()).sum();
            assert!(apart < 1e-12);
            let (a, b) =
                (point.divide().expect("visible"), vertex.point.divide().expect("visible"));
            assert!((a - b).length() < 1e-12 * Vector::length(a - Point::ORIGIN).max(1.0));
        }
    }
}
