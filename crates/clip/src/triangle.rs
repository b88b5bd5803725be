//! Triangles (CL-3): what is left is a convex polygon, as a fan of triangles.
//!
//! ```text
//!            ╱╲                        each plane takes a corner and leaves two:
//!       ┌───╱──╲───┐                   at most one vertex more per plane,
//!       │  ╱    ╲  │                   nine for the six planes of the box
//!       │ ╱      ╲ │
//!       └╱────────╲┘  ► 4 vertices
//! ```

use crate::walk::{Step, safe_scale, unscaled, walk};
use crate::{Fates, MAX_PLANES, Outcode, PlaneIndex, Volume};
use core::fmt;
use homog::{Clip, HPoint};

/// A triangle has 3 vertices and each plane adds at most one.
const MAX_VERTICES: usize = 3 + MAX_PLANES;

/// A vertex of what is left of a triangle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ClipVertex {
    /// Where it is, not divided. Its w is greater than 0.
    pub point: HPoint<Clip>,
    /// How much of each vertex of the source triangle is in it; they sum to 1. Blending any attribute of the
    /// vertices by them is right without a further correction, for the blend is made before the divide (CL-2).
    pub weights: [f64; 3],
}

impl ClipVertex {
    const NOTHING: Self = Self { point: HPoint::new(0.0, 0.0, 0.0, 0.0), weights: [0.0; 3] };

    fn lerp(&self, end: &Self, t: f64) -> Self {
        let ([a, b, c], [p, q, r]) = (self.weights, end.weights);
        Self {
            point: self.point.lerp(end.point, t),
            weights: [a + (p - a) * t, b + (q - b) * t, c + (r - c) * t],
        }
    }
}

/// What is left of a triangle: a convex polygon with the turning direction of the triangle, or nothing.
///
/// # Guarantees
/// - It has no vertices or at least three.
/// - Every vertex is finite, inside the volume's box or on its border, and has w > 0.
/// - Vertices of the triangle that are inside are here with their very bits, and an edge shared by two triangles is cut
///   at the same bits in both, whichever way it runs.
#[derive(Clone, Copy, Debug)]
pub struct ClippedPolygon {
    ring: Ring,
    /// What each plane did.
    pub fates: Fates,
}

/// Most triangles are kept whole; a copy of those need not carry room for the cut ones.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::large_enum_variant, reason = "on the stack, and no allocation is the point")]
enum Ring {
    Nothing,
    Whole([ClipVertex; 3]),
    Cut(Room),
}

impl ClippedPolygon {
    /// The vertices in the triangle's order; none if nothing is left.
    #[must_use]
    pub fn vertices(&self) -> &[ClipVertex] {
        match &self.ring {
            Ring::Nothing => &[],
            Ring::Whole(vertices) => vertices,
            Ring::Cut(room) => room.vertices(),
        }
    }

    /// True if nothing is left.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        matches!(self.ring, Ring::Nothing)
    }

    /// True if the triangle is left as it was.
    #[must_use]
    pub const fn is_whole(&self) -> bool {
        matches!(self.ring, Ring::Whole(_))
    }

    /// The polygon as a fan of triangles around its first vertex.
    pub fn triangles(&self) -> impl Iterator<Item = [ClipVertex; 3]> {
        let vertices = self.vertices();
        vertices.windows(2).skip(1).map(|edge| [vertices[0], edge[0], edge[1]])
    }

    fn nothing(rejected: Outcode) -> Self {
        Self { ring: Ring::Nothing, fates: Fates::rejected(rejected) }
    }
}

/// The part of a triangle inside a volume (CL-3; Sutherland and Hodgman, 1974).
///
/// It is cut in homogeneous space, before the divide, so that triangles that pass behind the eye or have vertices at
/// infinity come out right. Nothing is allocated. A triangle with a vertex that is not finite gives nothing, and so
/// does one of which only a vertex or an edge touches the volume from outside, or that is seen edge-on from the eye
/// itself (w = 0).
///
/// ```
/// use clip::{Volume, clip_triangle};
/// use homog::HPoint;
/// let corners = [HPoint::new(-0.5, 0.0, 0.0, 1.0), HPoint::new(2.0, 0.0, 0.0, 1.0), HPoint::new(-0.5, 1.0, 0.0, 1.0)];
/// let left = clip_triangle(corners, &Volume::CHAPTER);
/// assert_eq!(left.vertices().len(), 4);
/// assert_eq!(left.vertices()[1].point, HPoint::new(1.0, 0.0, 0.0, 1.0));
/// assert_eq!(left.vertices()[1].weights, [0.4, 0.6, 0.0]);
/// assert_eq!(left.triangles().count(), 2);
/// ```
#[must_use]
pub fn clip_triangle(triangle: [HPoint<Clip>; 3], volume: &Volume) -> ClippedPolygon {
    let codes = triangle.map(|point| volume.outcode(point));
    let rejected = Outcode::rejects(&codes);
    if !rejected.is_inside() || !triangle.iter().all(|point| point.is_finite()) {
        return ClippedPolygon::nothing(rejected);
    }
    if Outcode::accepts(&codes) {
        return keep(triangle);
    }
    cut(triangle, volume)
}

fn keep(triangle: [HPoint<Clip>; 3]) -> ClippedPolygon {
    if triangle.iter().any(|point| point.w() <= 0.0) {
        return ClippedPolygon::nothing(Outcode::INSIDE);
    }
    ClippedPolygon { ring: Ring::Whole(corners(triangle)), fates: Fates::default() }
}

fn corners([a, b, c]: [HPoint<Clip>; 3]) -> [ClipVertex; 3] {
    [
        ClipVertex { point: a, weights: [1.0, 0.0, 0.0] },
        ClipVertex { point: b, weights: [0.0, 1.0, 0.0] },
        ClipVertex { point: c, weights: [0.0, 0.0, 1.0] },
    ]
}

/// Every plane looks at every vertex, also where the outcodes of this triangle would allow to leave it out: so the
/// fate of an edge depends on the edge alone, and a neighbour decides alike.
fn cut(triangle: [HPoint<Clip>; 3], volume: &Volume) -> ClippedPolygon {
    let (mut one, mut other) = (Room::default(), Room::default());
    let (mut ring, mut rest) = (&mut one, &mut other);
    let scale = safe_scale(&triangle.map(HPoint::raw));
    let scaled = triangle.map(|point| HPoint::from_raw(point.raw() * scale));
    corners(scaled).into_iter().for_each(|corner| ring.push(corner));
    let mut fates = Fates::default();
    for index in volume.present().planes() {
        if !cut_by(volume, index, ring.vertices(), rest) {
            continue;
        }
        if rest.count < 3 {
            fates.rejected = fates.rejected.with(index);
            return ClippedPolygon { ring: Ring::Nothing, fates };
        }
        fates.cut = fates.cut.with(index);
        core::mem::swap(&mut ring, &mut rest);
    }
    for vertex in ring.vertices_mut() {
        vertex.point = HPoint::from_raw(volume.settle(unscaled(vertex.point.raw(), scale)));
    }
    // The zero vector is in every closed volume but is no point. Only triangles without an area in the image reach it.
    let is_point = |vertex: &ClipVertex| vertex.point.w() > 0.0;
    let ring = if ring.vertices().iter().all(is_point) { Ring::Cut(*ring) } else { Ring::Nothing };
    ClippedPolygon { ring, fates }
}

/// Puts the ring behind a plane into `rest`; false if it is the same.
fn cut_by(volume: &Volume, index: PlaneIndex, ring: &[ClipVertex], rest: &mut Room) -> bool {
    let mut distances = [0.0; MAX_VERTICES];
    let distances = &mut distances[..ring.len()];
    for (distance, vertex) in distances.iter_mut().zip(ring) {
        *distance = volume.distance(index, vertex.point.raw());
    }
    if distances.iter().all(|&distance| distance >= 0.0) {
        return false;
    }
    rest.count = 0;
    walk(distances, |step| {
        rest.push(match step {
            Step::Keep(i) => ring[i],
            Step::Cross { from, to, t } => {
                let mut crossing = ring[from].lerp(&ring[to], t);
                crossing.point = HPoint::from_raw(volume.land(index, crossing.point.raw()));
                crossing
            }
        });
    });
    true
}

/// Room for the vertices, on the stack.
#[derive(Clone, Copy)]
struct Room {
    vertices: [ClipVertex; MAX_VERTICES],
    count: usize,
}

impl Default for Room {
    fn default() -> Self {
        Self { vertices: [ClipVertex::NOTHING; MAX_VERTICES], count: 0 }
    }
}

impl fmt::Debug for Room {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.vertices()).finish()
    }
}

impl Room {
    fn vertices(&self) -> &[ClipVertex] {
        &self.vertices[..self.count]
    }

    fn vertices_mut(&mut self) -> &mut [ClipVertex] {
        &mut self.vertices[..self.count]
    }

    /// Rounding may make a ring a hair concave; only then could it outgrow its room, and loses a vertex on a line.
    fn push(&mut self, vertex: ClipVertex) {
        if let Some(place) = self.vertices.get_mut(self.count) {
            *place = vertex;
            self.count += 1;
        }
    }
}
