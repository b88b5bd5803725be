//! All faces of a scene, ready to be asked what they hide.

use super::super::projector::Projector;
use super::bvh::{Aabb, Bvh, NodeContents};
use super::occluder::{Occluder, Occlusion};
use super::occlusion_intervals::OcclusionIntervals;
use super::projected_edge::ProjectedEdge;
use clip::{Outcode, Volume, clip_triangle};
use glam::{DVec2, DVec3};
use homog::{Clip, HPoint, Point, World};

/// How near is touching. What touches does not hide.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Tolerance {
    /// An edge this near to the border of a face, in pixels, as long as it passes by it, runs along it.
    pub screen: f64,
    /// An edge that nowhere gets farther than this behind the plane of a face, in lengths of the world, lies in it.
    pub world: f64,
    /// Parts of an edge shorter than this, in pixels, are no parts.
    pub min_part: f64,
}

impl Tolerance {
    /// For a scene of some size: a few times what the single precision of its coordinates makes uncertain.
    #[must_use]
    pub fn for_scene(diagonal: f64) -> Self {
        Self { screen: 1.0 / 4096.0, world: diagonal / 2_097_152.0, min_part: 1.0 / 1024.0 }
    }
}

/// The visible and the hidden parts of an edge, as fractions of the way from its start to its end in the world.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct EdgeParts {
    /// The parts that nothing is in front of.
    pub visible: Vec<[f64; 2]>,
    /// The parts behind a face. What is outside of the view volume is in neither list.
    pub hidden: Vec<[f64; 2]>,
}

/// The faces of a scene as one viewer sees them.
#[derive(Clone, Debug)]
pub struct Occluders {
    projector: Projector,
    tolerance: Tolerance,
    /// In the order of the tree's leaves.
    occluders: Vec<Occluder>,
    bvh: Bvh,
}

/// Memory that is used again for each edge.
#[derive(Clone, Debug, Default)]
pub(crate) struct OcclusionScratch {
    hidden: OcclusionIntervals,
    face_left: OcclusionIntervals,
    face_right: OcclusionIntervals,
    node_stack: Vec<u32>,
}

impl Occluders {
    /// Prepares triangles. Both of their sides hide; those without an area on the screen hide nothing.
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

    /// What is visible and what is hidden of an edge.
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

    /// The hidden parts of an edge, in s.
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

/// Where an edge passes over a box and not in front of it.
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

/// The pieces that the view volume leaves of a face, each with its box on the screen.
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

/// The corners in the order that makes their area positive; `None` if the triangle is a line.
fn with_positive_area([a, b, c]: [DVec2; 3], thinnest: f64) -> Option<[DVec2; 3]> {
    let area = (b - a).perp_dot(c - a);
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    if area.abs() <= thinnest * longest {
        return None;
    }
    Some(if area > 0.0 { [a, b, c] } else { [a, c, b] })
}
