//! All occluders of a scene in a bounding-volume hierarchy, and the query for the hidden parts of
//! an edge.
//!
//! [`Occluders::hidden_intervals`] is where hidden lines are cut. It descends the hierarchy of
//! screen boxes, nearest first, and skips each box that the edge does not pass behind and each
//! whose part of the edge is hidden already. With n faces and evenly spread edges a query visits
//! O(log n + k) of them, k being those it crosses on the screen.

use super::super::projector::Projector;
use super::bvh::{Aabb, Bvh, NodeContents};
use super::occluder::{Occluder, Occlusion};
use super::occlusion_intervals::OcclusionIntervals;
use super::projected_edge::ProjectedEdge;
use clip::{Outcode, Volume, clip_triangle};
use glam::{DVec2, DVec3};
use homog::{Clip, HPoint, Point, World};

/// The distances below which an edge touches a face. Touching does not hide (HL-1).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Tolerance {
    /// Distance from a side of a face, in pixels: an edge that stays nearer runs along the side.
    pub screen: f64,
    /// Distance behind the plane of a face, in world units: an edge that nowhere gets farther
    /// behind lies in the plane.
    pub world: f64,
    /// The least length of a visible or hidden part, in pixels; shorter ones are merged with their
    /// neighbors.
    pub min_part: f64,
}

impl Tolerance {
    /// Tolerances for a scene whose bounding box has this diagonal.
    ///
    /// `world` is diagonal / 2²¹: a few units in the last place of coordinates stored in single
    /// precision. `screen` is 1/4096 pixel and `min_part` 1/1024 pixel, far below what any output
    /// resolves.
    #[must_use]
    pub fn for_scene(diagonal: f64) -> Self {
        Self { screen: 1.0 / 4096.0, world: diagonal / 2_097_152.0, min_part: 1.0 / 1024.0 }
    }
}

/// The visible and the hidden parts of an edge, as fractions of its length in the world.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct EdgeParts {
    /// Parts with no face in front of them, in rising order.
    pub visible: Vec<[f64; 2]>,
    /// Parts behind a face, in rising order. Parts outside the view volume are in neither list.
    pub hidden: Vec<[f64; 2]>,
}

/// The faces of a scene as one viewer sees them: clipped, projected, and sorted into a hierarchy of
/// boxes.
///
/// ```
/// use drawing::{Occluders, Projector, Tolerance};
/// use camera::{Camera, ViewProjection};
/// use homog::{Point, Vector};
/// use projection::{Convention, Orthographic};
/// use viewport::Viewport;
///
/// // A triangle at z = 0 before a line at z = −1, seen along −z through a window from −2 to 2.
/// let camera = Camera::look_to(Point::new(0.0, 0.0, 5.0), -Vector::Z, Vector::Y)?;
/// let window = Orthographic::new(-2.0, 2.0, -2.0, 2.0, 1.0, 10.0)?;
/// let view_to_clip = window.view_to_clip(Convention::CHAPTER);
/// let view_projection = ViewProjection { camera, view_to_clip };
/// let projector = Projector::new(&view_projection, &Viewport::image(400, 400)?);
/// let face = [Point::new(-1.0, -1.0, 0.0), Point::new(1.0, -1.0, 0.0), Point::new(0.0, 1.0, 0.0)];
/// let occluders = Occluders::new([face], projector, Tolerance::for_scene(4.0));
///
/// let parts = occluders.edge_parts([Point::new(-2.0, 0.0, -1.0), Point::new(2.0, 0.0, -1.0)]);
/// // At y = 0 the triangle reaches from x = −½ to ½: the middle quarter of the line is hidden.
/// assert_eq!(parts.hidden, [[0.375, 0.625]]);
/// assert_eq!(parts.visible, [[0.0, 0.375], [0.625, 1.0]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Occluders {
    /// From the world to the screen on which the faces were projected; edges must go the same way.
    projector: Projector,
    tolerance: Tolerance,
    /// In the order of the leaves of the hierarchy, so that a leaf is a range.
    occluders: Vec<Occluder>,
    /// Over the boxes of the occluders: x and y in pixels, z the depth, with 1 nearest.
    bvh: Bvh,
}

/// Memory of one query, reused for the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct OcclusionScratch {
    /// The result.
    hidden: OcclusionIntervals,
    /// Where the edge runs exactly behind a side with its face on the left.
    face_left: OcclusionIntervals,
    /// The same parts with the face on the right.
    face_right: OcclusionIntervals,
    /// Nodes of the hierarchy that are still to be visited.
    node_stack: Vec<u32>,
}

impl Occluders {
    /// Projects triangles and builds the hierarchy: O(n log n).
    ///
    /// Both sides of a face hide. A face that is seen edge-on, or is thinner than the tolerance on
    /// the screen, hides nothing.
    pub fn new(
        triangles: impl IntoIterator<Item = [Point<World>; 3]>,
        projector: Projector,
        tolerance: Tolerance,
    ) -> Self {
        let (mut pieces, mut boxes) = (Vec::new(), Vec::new());
        for triangle in triangles {
            let corners = triangle.map(Point::raw);
            push_occluders(
                corners,
                corners.map(|c| projector.world_to_clip_point(c)),
                &projector,
                &tolerance,
                |piece, bounds| {
                    pieces.push(piece);
                    boxes.push(bounds);
                },
            );
        }
        let bvh = Bvh::new(&boxes, |size| size.x + size.y);
        let occluders = bvh.order.iter().map(|&at| pieces[at as usize]).collect();
        Self { projector, tolerance, occluders, bvh }
    }

    /// The visible and the hidden parts of a segment of the world.
    #[must_use]
    pub fn edge_parts(&self, ends: [Point<World>; 2]) -> EdgeParts {
        let mut parts = EdgeParts::default();
        let Some(edge) = ProjectedEdge::clip_and_project(ends.map(Point::raw), &self.projector)
        else {
            return parts;
        };
        let mut scratch = OcclusionScratch::default();
        for (span, hidden) in self.hidden_intervals(&edge, &mut scratch).divide_unit_interval() {
            let list = if hidden { &mut parts.hidden } else { &mut parts.visible };
            list.push(span.map(|s| edge.edge_fraction(s)));
        }
        parts
    }

    /// The intervals of s in which an edge is hidden: the union over all faces in front of it.
    ///
    /// This is the inner loop of hidden-line removal. Children are visited front to back, because a
    /// near face is more likely to hide the whole interval and so end the descent. The result is
    /// borrowed from `scratch`.
    pub(crate) fn hidden_intervals<'a>(
        &self,
        edge: &ProjectedEdge,
        scratch: &'a mut OcclusionScratch,
    ) -> &'a OcclusionIntervals {
        let OcclusionScratch { hidden, face_left: left, face_right: right, node_stack: open } =
            scratch;
        hidden.clear();
        left.clear();
        right.clear();
        open.clear();
        open.extend(self.bvh.root_node());
        while let Some(node) = open.pop() {
            let Some(span) = interval_behind_box(edge, self.bvh.bounds(node)) else { continue };
            if hidden.contains_interval(span) {
                continue;
            }
            match self.bvh.contents(node) {
                NodeContents::Nodes([a, b]) => {
                    let depth = |node| self.bvh.bounds(node).max.z;
                    open.extend(if depth(a) > depth(b) { [b, a] } else { [a, b] });
                }
                NodeContents::Items(places) => {
                    for piece in &self.occluders[places] {
                        match piece.occlude_edge(edge, &self.tolerance) {
                            Some(Occlusion::Interior(span)) => hidden.insert_interval(span),
                            Some(Occlusion::FaceLeft(span)) => left.insert_interval(span),
                            Some(Occlusion::FaceRight(span)) => right.insert_interval(span),
                            None => {}
                        }
                    }
                }
            }
        }
        hidden.insert_intersection(left, right);
        if !hidden.is_empty() {
            hidden.remove_slivers(self.tolerance.min_part / edge.screen_length());
        }
        hidden
    }
}

/// The interval of s in which an edge passes over a box on the screen and is not wholly in front of
/// it.
///
/// A slab test in x and y (Kay and Kajiya 1986), then one comparison of depth: where even the
/// farthest point of the edge is nearer than the nearest point of the box, nothing in the box can
/// hide it.
fn interval_behind_box(edge: &ProjectedEdge, bounds: &Aabb) -> Option<[f64; 2]> {
    let [a, b] = edge.screen;
    let mut span = [0.0_f64, 1.0];
    for axis in 0..2 {
        let (from, by) = (a[axis], b[axis] - a[axis]);
        if by == 0.0 {
            if from < bounds.min[axis] || from > bounds.max[axis] {
                return None;
            }
            continue;
        }
        let (s, t) = ((bounds.min[axis] - from) / by, (bounds.max[axis] - from) / by);
        span = [span[0].max(s.min(t)), span[1].min(s.max(t))];
    }
    if span[0] > span[1] {
        return None;
    }
    let farthest = edge.depth_at(span[0]).min(edge.depth_at(span[1]));
    (farthest <= bounds.max.z).then_some(span)
}

/// Clips a face to the view volume and hands on each triangle that is left, with its box on the
/// screen.
///
/// All triangles of a face keep its plane in the world, computed before clipping: clipping must not
/// tilt it.
fn push_occluders(
    corners: [DVec3; 3],
    clip: [HPoint<Clip>; 3],
    sight: &Projector,
    tolerance: &Tolerance,
    mut push: impl FnMut(Occluder, Aabb),
) {
    let outcodes = clip.map(|point| Volume::CHAPTER.outcode(point));
    if !Outcode::trivially_rejects(&outcodes).is_inside() {
        return;
    }
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let towards = normal.dot(sight.towards_viewer(a));
    if towards == 0.0 {
        return;
    }
    let normal = normal * towards.signum();
    let offset = normal.dot(a);
    let mut push_clipped = |points: [HPoint<Clip>; 3]| {
        let [Some(a), Some(b), Some(c)] = points.map(|point| sight.to_screen(point)) else {
            return;
        };
        let bounds = Aabb::from_points([a, b, c]);
        if let Some(corners) = with_positive_area([a, b, c].map(DVec3::truncate), tolerance.screen)
        {
            let by = DVec3::new(tolerance.screen, tolerance.screen, 0.0);
            push(Occluder { vertices: corners, normal, offset }, bounds.expanded_by(by));
        }
    };
    if Outcode::trivially_accepts(&outcodes) {
        push_clipped(clip);
    } else {
        clip_triangle(clip, &Volume::CHAPTER)
            .triangles()
            .for_each(|t| push_clipped(t.map(|v| v.point)));
    }
}

/// Orders vertices so that their signed area is positive; `None` if the triangle is thinner than
/// `thinnest` pixels.
fn with_positive_area([a, b, c]: [DVec2; 3], thinnest: f64) -> Option<[DVec2; 3]> {
    let area = (b - a).perp_dot(c - a);
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    if area.abs() <= thinnest * longest {
        return None;
    }
    Some(if area > 0.0 { [a, b, c] } else { [a, c, b] })
}
