//! The plane of a section, with the distance within which a vertex counts as lying on it.
//!
//! ```text
//!     exact:  ●────●────●   one vertex is 2e-15 above the plane, so the plane cuts a needle off
//!            ─────────────  a flat wall; the normal of the needle is rounding noise
//!     here:   ●────●────●   all three vertices are on the plane, and the wall is cut at them
//! ```

use homog::{Plane, Point, Space};

/// The tolerance of [`SectionPlane::for_size`] as a fraction of the model's size.
///
/// It is far above the rounding of world coordinates in `f64` (about 1e-16 of the size), and far
/// below the step of coordinates stored as `f32` (6e-8 of the size), so distinct vertices of a file
/// are not merged. A needle wider than this fraction has a normal that is accurate to 1e-7.
const ON_PLANE: f64 = 1e-9;

/// A section plane. Vertices within a tolerance of the plane are *on* it.
///
/// This is the only test for the side of a vertex. Both sides of a cut, the outline and the cap
/// follow from its result, so they agree.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SectionPlane<S: Space> {
    plane: Plane<S>,
    /// The largest value of [`Plane::evaluate`] on the plane.
    tolerance: f64,
}

impl<S: Space> From<Plane<S>> for SectionPlane<S> {
    /// Creates a section plane without a tolerance.
    fn from(plane: Plane<S>) -> Self {
        Self { plane, tolerance: 0.0 }
    }
}

impl<S: Space> SectionPlane<S> {
    /// Creates a section plane for models of this size, usually the diagonal of their bounding box.
    /// Vertices within 1e-9 of the size are on the plane.
    ///
    /// ```
    /// use clip::SectionPlane;
    /// use homog::{Normal, Plane, Point, World};
    /// let floor = Plane::<World>::through(Point::ORIGIN, Normal::new(0.0, 2.0, 0.0));
    /// let section = SectionPlane::for_size(floor, 100.0);
    /// assert_eq!(section.height(Point::new(5.0, -2.2e-15, 0.0)), 0.0);
    /// assert_eq!(section.height(Point::new(5.0, -0.001, 0.0)), -0.002);
    /// ```
    #[must_use]
    pub fn for_size(plane: Plane<S>, size: f64) -> Self {
        let tolerance = ON_PLANE * size * plane.normal().raw().length();
        // A size that is not finite gives no tolerance rather than a plane that everything is on.
        Self { plane, tolerance: if tolerance.is_finite() { tolerance.max(0.0) } else { 0.0 } }
    }

    /// Returns the plane.
    #[must_use]
    pub const fn plane(self) -> Plane<S> {
        self.plane
    }

    /// Evaluates the plane at a point: positive on the side of the normal, negative on the other
    /// side, and exactly 0 within the tolerance.
    #[must_use]
    pub fn height(self, point: Point<S>) -> f64 {
        let height = self.plane.evaluate(point);
        if height.abs() <= self.tolerance { 0.0 } else { height }
    }
}
