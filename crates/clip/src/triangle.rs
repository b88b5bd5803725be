//! Triangle clipping (CL-3): the result is a convex polygon, available as a fan of triangles.
//!
//! ```text
//!            ╱╲                        a plane that cuts off a corner leaves two:
//!       ┌───╱──╲───┐                   at most one more vertex per plane,
//!       │  ╱    ╲  │                   nine for the six planes of the box
//!       │ ╱      ╲ │
//!       └╱────────╲┘  ► 4 vertices
//! ```

use crate::sutherland_hodgman::{RingStep, clip_ring, safe_scale, unscaled};
use crate::{MAX_PLANES, Outcode, PlaneIndex, PlaneOutcomes, Volume};
use core::fmt;
use homog::{Clip, HPoint};

/// The maximum number of vertices: the triangle has 3, and each plane adds at most one.
const MAX_VERTICES: usize = 3 + MAX_PLANES;

/// A vertex of a clipped triangle.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct ClipVertex {
    /// The position before the divide. Its w is greater than 0.
    pub point: HPoint<Clip>,
    /// The weights of the source vertices; they sum to 1. Use them to interpolate any attribute; no
    /// further correction is needed, because the blend happens before the divide (CL-2).
    pub weights: [f64; 3],
}

impl ClipVertex {
    const ZERO: Self = Self { point: HPoint::new(0.0, 0.0, 0.0, 0.0), weights: [0.0; 3] };

    fn lerp(&self, end: &Self, t: f64) -> Self {
        let ([a, b, c], [p, q, r]) = (self.weights, end.weights);
        Self {
            point: self.point.lerp(end.point, t),
            weights: [a + (p - a) * t, b + (q - b) * t, c + (r - c) * t],
        }
    }
}

/// The visible part of a triangle: a convex polygon with the winding of the triangle, or nothing.
///
/// # Guarantees
/// - It has no vertices or at least three.
/// - Every vertex is finite, inside the volume's box or on its boundary, and has w > 0.
/// - Vertices of the triangle that are inside are unchanged, and an edge shared by two triangles is
///   cut at bit-identical points, in either direction.
#[derive(Clone, Copy, Debug)]
pub struct ClippedPolygon {
    ring: PolygonVertices,
    /// The effect of each plane.
    pub outcomes: PlaneOutcomes,
}

/// The vertices. Most triangles are unclipped, so copying them need not copy the large buffer.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::large_enum_variant, reason = "stays on the stack to avoid allocation")]
enum PolygonVertices {
    Empty,
    Unclipped([ClipVertex; 3]),
    Clipped(VertexBuffer),
}

impl ClippedPolygon {
    /// Returns the vertices in the order of the triangle, or an empty slice if nothing is left.
    #[must_use]
    pub fn vertices(&self) -> &[ClipVertex] {
        match &self.ring {
            PolygonVertices::Empty => &[],
            PolygonVertices::Unclipped(vertices) => vertices,
            PolygonVertices::Clipped(room) => room.vertices(),
        }
    }

    /// Returns whether nothing is left.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        matches!(self.ring, PolygonVertices::Empty)
    }

    /// Returns whether the triangle is unchanged.
    #[must_use]
    pub const fn is_unclipped(&self) -> bool {
        matches!(self.ring, PolygonVertices::Unclipped(_))
    }

    /// Returns the polygon as a fan of triangles around its first vertex.
    pub fn triangles(&self) -> impl Iterator<Item = [ClipVertex; 3]> {
        let vertices = self.vertices();
        vertices.windows(2).skip(1).map(|edge| [vertices[0], edge[0], edge[1]])
    }

    fn rejected(rejected: Outcode) -> Self {
        Self { ring: PolygonVertices::Empty, outcomes: PlaneOutcomes::from_rejected(rejected) }
    }
}

/// Returns the part of a triangle inside a volume (CL-3; Sutherland and Hodgman, 1974).
///
/// Clipping happens in homogeneous space, before the divide, so triangles that pass behind the eye
/// or have vertices at infinity are handled correctly. Nothing is allocated. The result is empty if
/// a vertex is not finite, if only a vertex or an edge touches the volume from outside, or if the
/// plane of the triangle contains the eye (w = 0).
///
/// ```
/// use clip::{Volume, clip_triangle};
/// use homog::HPoint;
/// let corners = [(-0.5, 0.0), (2.0, 0.0), (-0.5, 1.0)].map(|(x, y)| HPoint::new(x, y, 0.0, 1.0));
/// let left = clip_triangle(corners, &Volume::CHAPTER);
/// assert_eq!(left.vertices().len(), 4);
/// assert_eq!(left.vertices()[1].point, HPoint::new(1.0, 0.0, 0.0, 1.0));
/// assert_eq!(left.vertices()[1].weights, [0.4, 0.6, 0.0]);
/// assert_eq!(left.triangles().count(), 2);
/// ```
#[must_use]
pub fn clip_triangle(triangle: [HPoint<Clip>; 3], volume: &Volume) -> ClippedPolygon {
    let codes = triangle.map(|point| volume.outcode(point));
    let rejected = Outcode::trivially_rejects(&codes);
    if !rejected.is_inside() || !triangle.iter().all(|point| point.is_finite()) {
        return ClippedPolygon::rejected(rejected);
    }
    if Outcode::trivially_accepts(&codes) {
        return accept_triangle(triangle);
    }
    clip_by_planes(triangle, volume)
}

fn accept_triangle(triangle: [HPoint<Clip>; 3]) -> ClippedPolygon {
    if triangle.iter().any(|point| point.w() <= 0.0) {
        return ClippedPolygon::rejected(Outcode::INSIDE);
    }
    ClippedPolygon {
        ring: PolygonVertices::Unclipped(source_vertices(triangle)),
        outcomes: PlaneOutcomes::default(),
    }
}

fn source_vertices([a, b, c]: [HPoint<Clip>; 3]) -> [ClipVertex; 3] {
    [
        ClipVertex { point: a, weights: [1.0, 0.0, 0.0] },
        ClipVertex { point: b, weights: [0.0, 1.0, 0.0] },
        ClipVertex { point: c, weights: [0.0, 0.0, 1.0] },
    ]
}

/// Clips a triangle to all planes. Every plane is tested against every vertex, even if the outcodes
/// of this triangle would allow skipping it. The result for an edge then depends only on the edge
/// and is the same for a neighbor.
fn clip_by_planes(triangle: [HPoint<Clip>; 3], volume: &Volume) -> ClippedPolygon {
    let (mut one, mut other) = (VertexBuffer::default(), VertexBuffer::default());
    let (mut ring, mut rest) = (&mut one, &mut other);
    let scale = safe_scale(&triangle.map(HPoint::raw));
    let scaled = triangle.map(|point| HPoint::from_raw(point.raw() * scale));
    source_vertices(scaled).into_iter().for_each(|corner| ring.push(corner));
    let mut fates = PlaneOutcomes::default();
    for index in volume.active_planes().planes() {
        if !clip_by_plane(volume, index, ring.vertices(), rest) {
            continue;
        }
        if rest.count < 3 {
            fates.rejected = fates.rejected.with_plane(index);
            return ClippedPolygon { ring: PolygonVertices::Empty, outcomes: fates };
        }
        fates.clipped = fates.clipped.with_plane(index);
        core::mem::swap(&mut ring, &mut rest);
    }
    for vertex in ring.vertices_mut() {
        vertex.point = HPoint::from_raw(volume.clamp_to_box(unscaled(vertex.point.raw(), scale)));
    }
    // The zero vector is in every closed volume but is not a point. Only triangles without area in
    // the image reach it.
    let is_point = |vertex: &ClipVertex| vertex.point.w() > 0.0;
    let ring = if ring.vertices().iter().all(is_point) {
        PolygonVertices::Clipped(*ring)
    } else {
        PolygonVertices::Empty
    };
    ClippedPolygon { ring, outcomes: fates }
}

/// Writes the ring clipped to a plane into `rest`; returns false if the ring is unchanged.
fn clip_by_plane(
    volume: &Volume,
    index: PlaneIndex,
    ring: &[ClipVertex],
    rest: &mut VertexBuffer,
) -> bool {
    let mut distances = [0.0; MAX_VERTICES];
    let distances = &mut distances[..ring.len()];
    for (distance, vertex) in distances.iter_mut().zip(ring) {
        *distance = volume.plane_distance(index, vertex.point.raw());
    }
    if distances.iter().all(|&distance| distance >= 0.0) {
        return false;
    }
    rest.count = 0;
    clip_ring(distances, |step| {
        rest.push(match step {
            RingStep::Keep(i) => ring[i],
            RingStep::Cross { from, to, t } => {
                let mut crossing = ring[from].lerp(&ring[to], t);
                crossing.point =
                    HPoint::from_raw(volume.snap_to_plane(index, crossing.point.raw()));
                crossing
            }
        });
    });
    true
}

/// Storage for the vertices, on the stack.
#[derive(Clone, Copy)]
struct VertexBuffer {
    vertices: [ClipVertex; MAX_VERTICES],
    count: usize,
}

impl Default for VertexBuffer {
    fn default() -> Self {
        Self { vertices: [ClipVertex::ZERO; MAX_VERTICES], count: 0 }
    }
}

impl fmt::Debug for VertexBuffer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.vertices()).finish()
    }
}

impl VertexBuffer {
    fn vertices(&self) -> &[ClipVertex] {
        &self.vertices[..self.count]
    }

    fn vertices_mut(&mut self) -> &mut [ClipVertex] {
        &mut self.vertices[..self.count]
    }

    /// Appends a vertex if there is space. Rounding may make a ring slightly concave. Only such a
    /// ring could exceed the storage; a vertex on a straight line is then dropped.
    fn push(&mut self, vertex: ClipVertex) {
        if let Some(place) = self.vertices.get_mut(self.count) {
            *place = vertex;
            self.count += 1;
        }
    }
}
