//! All faces of a scene, ready to be asked what they hide.

use super::super::sight::Sight;
use super::bvh::{Aabb, Below, Bvh};
use super::piece::{Hiding, Piece};
use super::spans::Spans;
use super::trace::Trace;
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
    pub shortest: f64,
}

impl Tolerance {
    /// For a scene of some size: a few times what the single precision of its coordinates makes uncertain.
    #[must_use]
    pub fn of_scene(diagonal: f64) -> Self {
        Self { screen: 1.0 / 4096.0, world: diagonal / 2_097_152.0, shortest: 1.0 / 1024.0 }
    }
}

/// The visible and the hidden parts of an edge, as fractions of the way from its start to its end in the world.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Parts {
    /// The parts that nothing is in front of.
    pub visible: Vec<[f64; 2]>,
    /// The parts behind a face. What is outside of the view volume is in neither list.
    pub hidden: Vec<[f64; 2]>,
}

/// The faces of a scene as one viewer sees them.
#[derive(Clone, Debug)]
pub struct Obstacles {
    sight: Sight,
    tolerance: Tolerance,
    /// In the order of the tree's leaves.
    pieces: Vec<Piece>,
    tree: Bvh,
}

/// Memory that is used again for each edge.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    hidden: Spans,
    left: Spans,
    right: Spans,
    open: Vec<u32>,
}

impl Obstacles {
    /// Prepares triangles. Both of their sides hide; those without an area on the screen hide nothing.
    pub fn new(
        triangles: impl IntoIterator<Item = [Point<World>; 3]>,
        sight: Sight,
        tolerance: Tolerance,
    ) -> Self {
        let (mut pieces, mut boxes) = (Vec::new(), Vec::new());
        for triangle in triangles {
            let corners = triangle.map(Point::raw);
            add(corners, corners.map(|c| sight.project(c)), &sight, &tolerance, |piece, bounds| {
                pieces.push(piece);
                boxes.push(bounds);
            });
        }
        let tree = Bvh::new(&boxes, |size| size.x + size.y);
        let pieces = tree.order.iter().map(|&at| pieces[at as usize]).collect();
        Self { sight, tolerance, pieces, tree }
    }

    /// What is visible and what is hidden of an edge.
    #[must_use]
    pub fn parts(&self, ends: [Point<World>; 2]) -> Parts {
        let mut parts = Parts::default();
        let Some(edge) = Trace::of(ends.map(Point::raw), &self.sight) else { return parts };
        let mut scratch = Scratch::default();
        for (span, hidden) in self.hidden(&edge, &mut scratch).divide() {
            let list = if hidden { &mut parts.hidden } else { &mut parts.visible };
            list.push(span.map(|s| edge.to_edge(s)));
        }
        parts
    }

    /// The hidden parts of an edge, in s.
    pub(crate) fn hidden<'a>(&self, edge: &Trace, scratch: &'a mut Scratch) -> &'a Spans {
        let Scratch { hidden, left, right, open } = scratch;
        hidden.clear();
        left.clear();
        right.clear();
        open.clear();
        open.extend(self.tree.root());
        while let Some(node) = open.pop() {
            let Some(span) = passing(edge, self.tree.bounds(node)) else { continue };
            if hidden.covers(span) {
                continue;
            }
            match self.tree.below(node) {
                Below::Nodes([a, b]) => {
                    let depth = |node| self.tree.bounds(node).max.z;
                    open.extend(if depth(a) > depth(b) { [b, a] } else { [a, b] });
                }
                Below::Items(places) => {
                    for piece in &self.pieces[places] {
                        match piece.hides(edge, &self.tolerance) {
                            Some(Hiding::Inside(span)) => hidden.add(span),
                            Some(Hiding::Left(span)) => left.add(span),
                            Some(Hiding::Right(span)) => right.add(span),
                            None => {}
                        }
                    }
                }
            }
        }
        hidden.add_common(left, right);
        if !hidden.is_empty() {
            hidden.clean(self.tolerance.shortest / edge.length());
        }
        hidden
    }
}

/// Where an edge passes over a box and not in front of it.
fn passing(edge: &Trace, bounds: &Aabb) -> Option<[f64; 2]> {
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
fn add(
    corners: [DVec3; 3],
    clip: [HPoint<Clip>; 3],
    sight: &Sight,
    tolerance: &Tolerance,
    mut push: impl FnMut(Piece, Aabb),
) {
    let outcodes = clip.map(|point| Volume::CHAPTER.outcode(point));
    if !Outcode::rejects(&outcodes).is_inside() {
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
    let mut add = |points: [HPoint<Clip>; 3]| {
        let [Some(a), Some(b), Some(c)] = points.map(|point| sight.place(point)) else {
            return;
        };
        let bounds = Aabb::around([a, b, c]);
        if let Some(corners) = turned([a, b, c].map(DVec3::truncate), tolerance.screen) {
            let by = DVec3::new(tolerance.screen, tolerance.screen, 0.0);
            push(Piece { corners, normal, offset }, bounds.grown(by));
        }
    };
    if Outcode::accepts(&outcodes) {
        add(clip);
    } else {
        clip_triangle(clip, &Volume::CHAPTER).triangles().for_each(|t| add(t.map(|v| v.point)));
    }
}

/// The corners in the order that makes their area positive; `None` if the triangle is a line.
fn turned([a, b, c]: [DVec2; 3], thinnest: f64) -> Option<[DVec2; 3]> {
    let area = (b - a).perp_dot(c - a);
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    if area.abs() <= thinnest * longest {
        return None;
    }
    Some(if area > 0.0 { [a, b, c] } else { [a, c, b] })
}
