//! Section cuts: cutting a solid open with a plane, and the outline of the cut face.
//!
//! ```text
//!          ╱╲                   plane ──────────────      remaining           the cap
//!         ╱  ╲                          ╱──────╲          sides             ┌──────────┐
//!        ╱    ╲        ──►             ╱        ╲                           │  ┌────┐  │   outline
//!       ╱──────╲                      ╱──────────╲                          │  └────┘  │ and hole
//!                                                                           └──────────┘
//! ```
//!
//! Cutting the triangles of a closed surface leaves it open. Every triangle that the plane crosses
//! contributes one directed edge to the outline of the opening. Neighbors are cut at bit-identical
//! points along a shared edge, so the edges join end to start without a tolerance, and the outline
//! of a closed surface always closes.
//!
//! A corner on the plane counts as inside. A face in the plane is therefore kept whole, and a solid
//! that only touches the plane from inside gets no cap.

use crate::SectionPlane;
use crate::sutherland_hodgman::{EdgeFraction, RingStep, clip_ring, crossing_fraction};
use homog::{Point, Space};

/// A vertex of a triangle cut by a plane.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct SectionVertex<S: Space> {
    /// The position.
    pub point: Point<S>,
    /// The weights of the triangle's corners; they sum to 1.
    pub weights: [f64; 3],
}

/// The part of a triangle on the positive side of a plane and its edge on the plane.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CutTriangle<S: Space> {
    vertices: [SectionVertex<S>; 4],
    count: usize,
    edge: Option<[Point<S>; 2]>,
}

impl<S: Space> CutTriangle<S> {
    /// Returns the vertices of the remaining part, in the order of the triangle. There are zero,
    /// three or four.
    #[must_use]
    pub fn vertices(&self) -> &[SectionVertex<S>] {
        &self.vertices[..self.count]
    }

    /// Returns the remaining part as a fan of triangles.
    pub fn triangles(&self) -> impl Iterator<Item = [SectionVertex<S>; 3]> {
        let vertices = self.vertices();
        vertices.windows(2).skip(1).map(|edge| [vertices[0], edge[0], edge[1]])
    }

    /// Returns the edge that the plane cuts into the triangle, directed to continue the boundary of
    /// the remaining part, or `None` if the plane does not cut the triangle.
    #[must_use]
    pub const fn edge(&self) -> Option<[Point<S>; 2]> {
        self.edge
    }
}

/// Cuts a triangle with a plane and keeps the positive side, toward which the plane's normal
/// points.
///
/// A [`SectionPlane`] has a tolerance: a corner within it is on the plane, and the cut passes
/// through that corner. A plain [`Plane`](homog::Plane) has none.
///
/// The result is empty if a corner is not finite or is too far away for its distance from the plane
/// to be finite.
///
/// ```
/// use clip::cut_triangle;
/// use homog::{Normal, Plane, Point, World};
/// let floor = Plane::<World>::through(Point::ORIGIN, Normal::new(0.0, 1.0, 0.0));
/// let corners = [(0.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| Point::new(x, y, 0.0));
/// let left = cut_triangle(corners, floor);
/// assert_eq!(left.vertices().len(), 4);
/// assert_eq!(left.edge(), Some([Point::new(-0.5, 0.0, 0.0), Point::new(0.5, 0.0, 0.0)]));
/// ```
#[must_use]
pub fn cut_triangle<S: Space>(
    triangle: [Point<S>; 3],
    plane: impl Into<SectionPlane<S>>,
) -> CutTriangle<S> {
    let section = plane.into();
    let corner = |i: usize| {
        let mut weights = [0.0; 3];
        weights[i] = 1.0;
        SectionVertex { point: triangle[i], weights }
    };
    let corners = [corner(0), corner(1), corner(2)];
    let distances = triangle.map(|point| section.height(point));
    let mut left = CutTriangle { vertices: [corners[0]; 4], count: 0, edge: None };
    if !distances.iter().all(|distance| distance.is_finite()) {
        return left;
    }
    clip_ring(&distances, |step| {
        left.vertices[left.count] = match step {
            RingStep::Keep(i) => corners[i],
            RingStep::Cross { from, to, t } => lerp_vertices(&corners[from], &corners[to], t),
        };
        left.count += 1;
    });
    // For points near the largest numbers, even a blend can overflow.
    let finite = left.vertices().iter().all(|vertex| vertex.point.is_finite());
    if !finite || left.count < 3 {
        left.count = 0;
    }
    left.edge = if finite { cut_edge(triangle, distances) } else { None };
    left
}

fn lerp_vertices<S: Space>(a: &SectionVertex<S>, b: &SectionVertex<S>, t: f64) -> SectionVertex<S> {
    let weights = core::array::from_fn(|i| a.weights[i] + (b.weights[i] - a.weights[i]) * t);
    SectionVertex { point: a.point.lerp(b.point, t), weights }
}

/// Returns the edge from the point where the boundary of the triangle leaves the inside to the
/// point where it returns.
fn cut_edge<S: Space>(corners: [Point<S>; 3], distances: [f64; 3]) -> Option<[Point<S>; 2]> {
    let (mut leaves, mut returns) = (None, None);
    for i in 0..3 {
        let j = (i + 1) % 3;
        let (start, end) = ((corners[i], distances[i]), (corners[j], distances[j]));
        match (start.1 >= 0.0, end.1 >= 0.0) {
            (true, false) => leaves = Some(edge_crossing(start, end)),
            (false, true) => returns = Some(edge_crossing(end, start)),
            _ => {}
        }
    }
    let edge = leaves.zip(returns).map(|(from, to)| [from, to]);
    edge.filter(|[from, to]| from != to && from.is_finite() && to.is_finite())
}

/// Returns the crossing of an edge with the plane, bit-identical to the clipped vertex. An inner
/// end on the plane is the crossing itself.
fn edge_crossing<S: Space>(inner: (Point<S>, f64), outer: (Point<S>, f64)) -> Point<S> {
    if inner.1 == 0.0 {
        return inner.0; // The vector to the outer end may overflow.
    }
    match crossing_fraction(inner.1, outer.1) {
        EdgeFraction::FromInner(t) => inner.0.lerp(outer.0, t),
        EdgeFraction::FromOuter(t) => outer.0.lerp(inner.0, t),
    }
}
