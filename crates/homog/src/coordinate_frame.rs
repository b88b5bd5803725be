//! Frames: an origin and three axes that give points their coordinates (HO-1, C50).
//!
//! ```text
//!        z b                    point  = origin + x·p₁ + y·p₂ + z·p₃      w = 1
//!        │╱                     vector =          x·v₁ + y·v₂ + z·v₃      w = 0
//!  origin●── a
//! ```
//!
//! The 4×4 matrix whose columns are the axes (w = 0) and the origin (w = 1) converts coordinates in
//! the frame to coordinates in the parent space. Its inverse converts them back. The matrix of one
//! frame followed by the inverse matrix of another converts coordinates between the two frames.

use crate::{Affine, Point, Space, Vector};

/// An origin and three independent axes in space `S`.
///
/// ```
/// use homog::{CoordinateFrame, Model, Point, Vector, World};
/// let origin = Point::<World>::new(2.0, 0.75, 0.0);
/// let desk = CoordinateFrame::new(origin, [Vector::Z, Vector::Y, -Vector::X])?;
/// let cup = desk.parent_to_local::<Model>().transform_point(Point::new(2.0, 0.75, 0.5));
/// assert_eq!(cup, Point::new(0.5, 0.0, 0.0)); // half a unit along the desk
/// # Ok::<(), homog::FrameError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CoordinateFrame<S: Space> {
    origin: Point<S>,
    axes: [Vector<S>; 3],
}

/// The reason why an origin and three vectors do not form a frame.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FrameError {
    /// A coordinate is infinite or NaN.
    #[error("a frame needs an origin and axes with finite coordinates")]
    NotFinite,
    /// The axes lie in one plane, or one of them is zero. Most points would have no coordinates.
    #[error("the axes of a frame must not lie in one plane")]
    Dependent,
}

impl<S: Space> CoordinateFrame<S> {
    /// Creates a frame from its origin and axes, which need not be perpendicular or of unit length.
    ///
    /// # Errors
    /// Returns an error if the axes lie in one plane (up to rounding) or a coordinate is not
    /// finite.
    pub fn new(origin: Point<S>, axes: [Vector<S>; 3]) -> Result<Self, FrameError> {
        if !(origin.is_finite() && axes.iter().all(|axis| axis.is_finite())) {
            return Err(FrameError::NotFinite);
        }
        let frame = Self { origin, axes };
        let independent = crate::Projective::from(frame.local_to_parent::<S>()).rank() == 4;
        let invertible = frame.local_to_parent::<S>().inverse().is_some();
        if independent && invertible { Ok(frame) } else { Err(FrameError::Dependent) }
    }

    /// Returns the origin.
    #[must_use]
    pub const fn origin(self) -> Point<S> {
        self.origin
    }

    /// Returns the three axes.
    #[must_use]
    pub const fn axes(self) -> [Vector<S>; 3] {
        self.axes
    }

    /// Returns the map from coordinates in this frame (space `L`) to points in `S`.
    #[must_use]
    pub fn local_to_parent<L: Space>(self) -> Affine<L, S> {
        let [x, y, z] = self.axes;
        Affine::from_frame(x, y, z, self.origin)
    }

    /// Returns the map from points in `S` to coordinates in this frame (space `L`).
    #[must_use]
    pub fn parent_to_local<L: Space>(self) -> Affine<S, L> {
        // `new` accepts a frame only if this inverse exists.
        self.local_to_parent::<L>().inverse().unwrap_or(Affine::IDENTITY)
    }

    /// Returns the change of frame: the map from coordinates in this frame to coordinates of the
    /// same point in `other`.
    #[must_use]
    pub fn change_to<L: Space, M: Space>(self, other: Self) -> Affine<L, M> {
        self.local_to_parent::<L>().then(other.parent_to_local::<M>())
    }

    /// Returns whether the axes are right-handed.
    #[must_use]
    pub fn is_right_handed(self) -> bool {
        self.local_to_parent::<S>().determinant() > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Model, View, World};

    #[test]
    fn c50_the_origin_of_a_frame_moves_points_but_not_vectors() {
        let axes =
            [Vector::new(2.0, 0.0, 0.0), Vector::new(1.0, 1.0, 0.0), Vector::new(0.0, 0.0, -3.0)];
        let frame =
            CoordinateFrame::new(Point::<World>::new(5.0, 6.0, 7.0), axes).expect("independent");
        let place = frame.local_to_parent::<Model>();
        assert_eq!(place.transform_point(Point::new(1.0, 1.0, 1.0)), Point::new(8.0, 7.0, 4.0));
        assert_eq!(place.transform_vector(Vector::new(1.0, 1.0, 1.0)), Vector::new(3.0, 1.0, -3.0));
        assert!(!frame.is_right_handed());
    }

    #[test]
    fn c71_changing_frames_and_back_gives_the_same_point() {
        let o = Point::<World>::new(1.0, 2.0, 3.0);
        let a = CoordinateFrame::new(o, [Vector::Y, Vector::Z, Vector::X]).expect("independent");
        let b = CoordinateFrame::new(Point::ORIGIN, [Vector::X * 2.0, Vector::Y, Vector::Z])
            .expect("independent");
        let p = Point::<Model>::new(0.5, 0.25, 0.125);
        let there = a.change_to::<Model, View>(b).transform_point(p);
        assert_eq!(there, Point::new((1.0 + 0.125) / 2.0, 2.5, 3.25));
        assert_eq!(b.change_to::<View, Model>(a).transform_point(there), p);
    }

    #[test]
    fn flat_frames_are_rejected() {
        let o = Point::<World>::ORIGIN;
        let flat = [Vector::X, Vector::Y, Vector::X + Vector::Y];
        assert_eq!(CoordinateFrame::new(o, flat), Err(FrameError::Dependent));
        assert_eq!(
            CoordinateFrame::new(o, [Vector::X, Vector::ZERO, Vector::Z]),
            Err(FrameError::Dependent)
        );
        assert_eq!(CoordinateFrame::new(o, [Vector::X * f64::NAN; 3]), Err(FrameError::NotFinite));
    }
}
