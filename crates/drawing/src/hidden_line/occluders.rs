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
    /// The projection of the faces; edges must be projected by the same one.
    projector: Projector,
    pub(super) tolerance: Tolerance,
    /// In the order of the leaves of the hierarchy, so that a leaf is a range.
    pub(super) occluders: Vec<Occluder>,
    /// Over the boxes of the occluders: x and y in pixels, z the depth, with 1 nearest.
    pub(super) bvh: Bvh,
    /// Whether a face hides what is behind it only.
    pub(super) respects_depth: bool,
}

/// Memory of one query, reused for the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct OcclusionScratch {
    /// The result.
    hidden: OcclusionIntervals,
    /// Where the edge runs exactly behind a side with its face on the left.
    face_left: OcclusionIntervals,
    /// Where the edge runs exactly behind a side with its face on the right.
    face_right: OcclusionIntervals,
    /// Nodes of the hierarchy that are still to be visited.
    node_stack: Vec<u32>,
}

impl OcclusionScratch {
    /// Starts a query at a node.
    fn restart(&mut self, root: Option<u32>) {
        self.hidden.clear();
        self.face_left.clear();
        self.face_right.clear();
        self.node_stack.clear();
        self.node_stack.extend(root);
    }

    /// Adds what one face hides to the set that its kind belongs to.
    fn insert(&mut self, occlusion: Occlusion) {
        match occlusion {
            Occlusion::Interior(interval) => self.hidden.insert_interval(interval),
            Occlusion::FaceLeft(interval) => self.face_left.insert_interval(interval),
            Occlusion::FaceRight(interval) => self.face_right.insert_interval(interval),
        }
    }
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
        let (mut unsorted, mut boxes) = (Vec::new(), Vec::new());
        for triangle in triangles {
            let vertices = triangle.map(Point::raw);
            push_occluders(vertices, &projector, &tolerance, |occluder, bounds| {
                unsorted.push(occluder);
                boxes.push(bounds);
            });
        }
        // Long edges meet a box on the screen in proportion to half its perimeter.
        let bvh = Bvh::new(&boxes, |size| size.x + size.y);
        let occluders = bvh.order.iter().map(|&index| unsorted[index as usize]).collect();
        Self { projector, tolerance, occluders, bvh, respects_depth: true }
    }

    /// The occluders as if each face hid all of the screen that it covers, at any depth: what they
    /// do not hide is the outline.
    #[must_use]
    pub fn at_any_depth(self) -> Self {
        Self { respects_depth: false, ..self }
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
        for (interval, hidden) in self.hidden_intervals(&edge, &mut scratch).divide_unit_interval()
        {
            let list = if hidden { &mut parts.hidden } else { &mut parts.visible };
            list.push(interval.map(|s| edge.edge_fraction(s)));
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
        scratch.restart(self.bvh.root_node());
        while let Some(node) = scratch.node_stack.pop() {
            let bounds = self.bvh.bounds(node);
            let Some(interval) = interval_behind_box(edge, bounds, self.respects_depth) else {
                continue;
            };
            if scratch.hidden.contains_interval(interval) {
                continue;
            }
            match self.bvh.contents(node) {
                NodeContents::Nodes(children) => {
                    scratch.node_stack.extend(self.far_to_near(children));
                }
                NodeContents::Items(range) => {
                    for occluder in &self.occluders[range] {
                        let occlusion =
                            occluder.occlude_edge(edge, &self.tolerance, self.respects_depth);
                        occlusion.into_iter().for_each(|occlusion| scratch.insert(occlusion));
                    }
                }
            }
        }
        let OcclusionScratch { hidden, face_left, face_right, .. } = scratch;
        // Where faces meet at a side that the edge runs behind, they hide it together.
        hidden.insert_intersection(face_left, face_right);
        if !hidden.is_empty() {
            hidden.remove_slivers(self.tolerance.min_part / edge.screen_length());
        }
        hidden
    }

    /// Two nodes in the order for a stack: the nearer one is popped first.
    fn far_to_near(&self, [a, b]: [u32; 2]) -> [u32; 2] {
        let nearest_depth = |node| self.bvh.bounds(node).max.z;
        if nearest_depth(a) > nearest_depth(b) { [b, a] } else { [a, b] }
    }
}

/// The interval of s in which an edge passes over a box on the screen and is not wholly in front of
/// it.
///
/// ```text
///         ┌──────┐
///   a ────┼──────┼──── b      s of the sides along x and along y: the greatest entry and the
///         └──────┘            least exit bound the interval
///          s₀    s₁
/// ```
///
/// A slab test in x and y (Kay and Kajiya 1986), then one comparison of depth: where even the
/// farthest point of the edge is nearer than the nearest point of the box, nothing in the box can
/// hide it. Depth is linear in s, so its extremes are at the ends.
pub(super) fn interval_behind_box(
    edge: &ProjectedEdge,
    bounds: &Aabb,
    respects_depth: bool,
) -> Option<[f64; 2]> {
    let [a, b] = edge.screen;
    let mut interval = [0.0_f64, 1.0];
    for axis in 0..2 {
        let (from, step) = (a[axis], b[axis] - a[axis]);
        if step == 0.0 {
            if from < bounds.min[axis] || from > bounds.max[axis] {
                return None;
            }
            continue;
        }
        let (s, t) = ((bounds.min[axis] - from) / step, (bounds.max[axis] - from) / step);
        interval = [interval[0].max(s.min(t)), interval[1].min(s.max(t))];
    }
    if interval[0] > interval[1] {
        return None;
    }
    let farthest = edge.depth_at(interval[0]).min(edge.depth_at(interval[1]));
    (!respects_depth || farthest <= bounds.max.z).then_some(interval)
}

/// Clips a face to the view volume and hands on each triangle that is left, with its box on the
/// screen.
///
/// All triangles of a face keep its plane in the world, computed before clipping: clipping must not
/// tilt it.
fn push_occluders(
    vertices: [DVec3; 3],
    projector: &Projector,
    tolerance: &Tolerance,
    mut push: impl FnMut(Occluder, Aabb),
) {
    let clip = vertices.map(|vertex| projector.world_to_clip_point(vertex));
    let outcodes = clip.map(|point| Volume::CHAPTER.outcode(point));
    if !Outcode::trivially_rejects(&outcodes).is_inside() {
        return;
    }
    let [a, b, c] = vertices;
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let towards = normal.dot(projector.towards_viewer(a));
    if towards == 0.0 {
        return;
    }
    let normal = normal * towards.signum();
    let offset = normal.dot(a);
    let mut push_clipped = |points: [HPoint<Clip>; 3]| {
        let [Some(a), Some(b), Some(c)] = points.map(|point| projector.project_to_screen(point))
        else {
            return;
        };
        let bounds = Aabb::from_points([a, b, c]);
        if let Some(vertices) = with_positive_area([a, b, c].map(DVec3::truncate), tolerance.screen)
        {
            let margin = DVec3::new(tolerance.screen, tolerance.screen, 0.0);
            push(Occluder { vertices, normal, offset }, bounds.expanded_by(margin));
        }
    };
    if Outcode::trivially_accepts(&outcodes) {
        push_clipped(clip);
    } else {
        clip_triangle(clip, &Volume::CHAPTER)
            .triangles()
            .for_each(|triangle| push_clipped(triangle.map(|vertex| vertex.point)));
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
