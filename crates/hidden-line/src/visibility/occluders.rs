//! The occluders of a scene in a bounding-volume hierarchy, and the query for the hidden parts of
//! an edge.
//!
//! [`MeshOccluders::hidden_intervals`] finds the hidden parts of an edge. It descends the hierarchy
//! of screen boxes, nearest boxes first. It skips boxes that the edge does not pass behind, and
//! boxes over a part of the edge that is already hidden. With n faces and evenly distributed edges,
//! a query visits O(log n + k) faces, where k is the number of faces that the edge crosses on the
//! screen.

use super::bvh::{Aabb, Bvh};
use super::crack_intervals::{CrackIntervals, SideIntervals};
use super::occluder::{Occluder, OccluderInWorld, Occlusion, SideInterval, SideOverlap};
use super::occlusion_intervals::OcclusionIntervals;
use super::projected_edge::ProjectedEdge;
use super::screen_bvh::{LeafTriangle, ScreenBvh, ScreenEdge, TriangleMesh};
use crate::projector::Projector;
use glam::DVec3;
use homog::{Point, World};

/// The tolerances of hidden-line removal. A face that an edge only touches does not hide it (HL-1).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Tolerance {
    /// The distance from a side of a face, in pixels. An edge that stays closer than this runs
    /// along the side.
    pub screen: f64,
    /// The distance behind the plane of a face, in world units. An edge that is nowhere farther
    /// behind than this is in the plane.
    pub world: f64,
    /// The minimum length of a visible or hidden part, in pixels. Shorter parts are merged with
    /// their neighbors.
    pub min_part: f64,
    /// The maximum width of a crack between objects through which nothing is visible, in pixels. An
    /// edge behind a crack has a face of one object on the left and a face of another on the right,
    /// no farther away than this.
    pub crack: f64,
}

impl Tolerance {
    /// Returns tolerances for a scene whose bounding box has the given diagonal.
    ///
    /// `world` is diagonal / 2²¹: a few units in the last place of coordinates stored in single
    /// precision. `screen` is 1/4096 pixel and `min_part` is 1/1024 pixel, far below the resolution
    /// of any output. `crack` is 3/16 pixel, or 0.05 mm on paper. This is narrower than any pen, so
    /// lines behind a crack could not be distinguished from its sides.
    #[must_use]
    pub fn for_scene(diagonal: f64) -> Self {
        Self {
            screen: 1.0 / 4096.0,
            world: diagonal / 2_097_152.0,
            min_part: 1.0 / 1024.0,
            crack: 3.0 / 16.0,
        }
    }
}

/// The visible and hidden parts of an edge, as fractions of its length in the world.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct EdgeParts {
    /// The parts with no face in front of them, in ascending order.
    pub visible: Vec<[f64; 2]>,
    /// The parts behind a face, in ascending order. Parts outside the view volume are in neither
    /// list.
    pub hidden: Vec<[f64; 2]>,
}

/// The faces of a scene as one viewer sees them: clipped, projected, and sorted into a hierarchy of
/// boxes.
///
/// ```
/// use hidden_line::{Occluders, Projector, Tolerance};
/// use camera::{Camera, ViewProjection};
/// use homog::{Point, Vector};
/// use projection::{Convention, Orthographic};
/// use viewport::Viewport;
///
/// // A triangle at z = 0 in front of a line at z = −1, seen along −z in a window from −2 to 2.
/// let camera = Camera::look_to(Point::new(0.0, 0.0, 5.0), -Vector::Z, Vector::Y)?;
/// let window = Orthographic::new(-2.0, 2.0, -2.0, 2.0, 1.0, 10.0)?;
/// let view_to_clip = window.view_to_clip(Convention::CHAPTER);
/// let view_projection = ViewProjection { camera, view_to_clip };
/// let projector = Projector::new(&view_projection, &Viewport::image_for(400, 400, Convention::CHAPTER)?);
/// let face = [Point::new(-1.0, -1.0, 0.0), Point::new(1.0, -1.0, 0.0), Point::new(0.0, 1.0, 0.0)];
/// let occluders = Occluders::new([face], projector, Tolerance::for_scene(4.0));
///
/// let parts = occluders.edge_parts([Point::new(-2.0, 0.0, -1.0), Point::new(2.0, 0.0, -1.0)]);
/// // At y = 0, the triangle extends from x = −½ to ½, so the middle quarter of the line is hidden.
/// assert_eq!(parts.hidden, [[0.375, 0.625]]);
/// assert_eq!(parts.visible, [[0.0, 0.375], [0.625, 1.0]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Occluders(MeshOccluders<TriangleList>);

/// Triangles that share no vertices.
#[derive(Clone, Debug)]
struct TriangleList(Vec<[DVec3; 3]>);

impl TriangleMesh for TriangleList {
    fn triangle_count(&self) -> u32 {
        self.0.len() as u32
    }

    fn vertex_count(&self) -> u32 {
        3 * self.triangle_count()
    }

    fn vertex_indices(&self, triangle: u32) -> [u32; 3] {
        [0, 1, 2].map(|k| 3 * triangle + k)
    }

    fn position(&self, vertex: u32) -> DVec3 {
        self.0[vertex as usize / 3][vertex as usize % 3]
    }

    fn object(&self, _: u32) -> u32 {
        0
    }
}

impl Occluders {
    /// Projects triangles and builds the hierarchy in O(n log n).
    ///
    /// Both sides of a face hide lines. A face that is seen edge-on, or is thinner than the
    /// tolerance on the screen, hides nothing.
    pub fn new(
        triangles: impl IntoIterator<Item = [Point<World>; 3]>,
        projector: Projector,
        tolerance: Tolerance,
    ) -> Self {
        let mesh =
            TriangleList(triangles.into_iter().map(|corners| corners.map(Point::raw)).collect());
        let bvh = mesh_bvh(&mesh);
        Self(MeshOccluders::new(mesh, &bvh, projector, tolerance))
    }

    /// Returns the occluders as if each face hid everything that it covers on the screen, at any
    /// depth: only the outline stays visible.
    #[must_use]
    pub fn at_any_depth(self) -> Self {
        Self(self.0.at_any_depth())
    }

    /// Returns the visible and hidden parts of a world-space segment.
    #[must_use]
    pub fn edge_parts(&self, ends: [Point<World>; 2]) -> EdgeParts {
        let mut parts = EdgeParts::default();
        let Some(edge) = ProjectedEdge::clip_and_project(ends.map(Point::raw), &self.0.projector)
        else {
            return parts;
        };
        let mut scratch = OcclusionScratch::default();
        let hidden = self.0.hidden_intervals(&edge, &mut scratch);
        for (interval, hidden) in hidden.divide_unit_interval() {
            let list = if hidden { &mut parts.hidden } else { &mut parts.visible };
            list.push(interval.map(|s| edge.edge_fraction(s)));
        }
        parts
    }
}

/// Returns the hierarchy of the boxes around the triangles of a mesh in the world.
pub(crate) fn mesh_bvh(mesh: &impl TriangleMesh) -> Bvh {
    Bvh::new((0..mesh.triangle_count()).map(|index| Aabb::around_triangle(mesh.positions(index))))
}

/// The triangles of a mesh as one viewer sees them, in a hierarchy of boxes on the screen.
#[derive(Clone, Debug)]
pub(crate) struct MeshOccluders<M> {
    mesh: M,
    /// The projector of the faces, which must also project the edges.
    projector: Projector,
    pub(super) tolerance: Tolerance,
    pub(super) screen: ScreenBvh,
    /// Whether a face hides only parts behind it, not everything that it covers on the screen.
    pub(super) respects_depth: bool,
}

/// Memory of one query, reused for the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct OcclusionScratch {
    /// The result.
    hidden: OcclusionIntervals,
    /// The parts that run exactly behind a side.
    along: SideIntervals,
    /// The parts that run behind a side or beside it.
    cracks: CrackIntervals,
    /// Hierarchy nodes still to visit.
    node_stack: Vec<u32>,
    /// The remaining number of boxes and triangles to compare with edges, or `None` for no limit.
    pub(crate) work_left: Option<u64>,
}

impl OcclusionScratch {
    /// Deducts `count` from the remaining work, and returns `false` if not enough is left.
    pub(super) fn take_work(&mut self, count: usize) -> bool {
        let Some(left) = &mut self.work_left else { return true };
        let is_left = *left >= count as u64;
        *left = left.saturating_sub(count as u64);
        is_left
    }

    /// Starts a query at a node.
    fn restart(&mut self, root: Option<u32>) {
        self.hidden.clear();
        self.along.clear();
        self.cracks.clear();
        self.node_stack.clear();
        self.node_stack.extend(root);
    }

    /// Returns the result of the last query.
    pub(crate) const fn last_result(&self) -> &OcclusionIntervals {
        &self.hidden
    }

    /// Returns the result of a query without faces.
    pub(crate) fn nothing_hidden(&mut self) -> &OcclusionIntervals {
        self.restart(None);
        &self.hidden
    }

    /// Adds the occlusion by one face to the set for its kind.
    fn insert(&mut self, occlusion: Occlusion) {
        match occlusion {
            Occlusion::Interior(interval) => self.hidden.insert_interval(interval),
            Occlusion::Along(side) => {
                self.along.insert(side);
                if side.is_wide {
                    self.cracks.insert(side);
                }
            }
            Occlusion::Beside(side) => self.cracks.insert(side),
        }
    }

    /// Adds the parts that several faces hide together: faces that meet at a side in front of the
    /// edge, and faces of two objects with a crack between them.
    fn join_sides(&mut self) {
        self.hidden.insert_intersection(&self.along.left, &self.along.right);
        self.cracks.insert_into(&mut self.hidden);
    }
}

impl<M: TriangleMesh> MeshOccluders<M> {
    /// Projects a mesh whose world-space hierarchy is `bvh`.
    pub(crate) fn new(mesh: M, bvh: &Bvh, projector: Projector, tolerance: Tolerance) -> Self {
        let margins = [tolerance.screen, tolerance.screen.max(tolerance.crack)];
        let screen = ScreenBvh::new(&mesh, bvh, &projector, margins);
        Self { mesh, projector, tolerance, screen, respects_depth: true }
    }

    /// Returns the occluders as if each face hid everything that it covers on the screen, at any
    /// depth.
    pub(crate) fn at_any_depth(self) -> Self {
        Self { respects_depth: false, ..self }
    }

    /// Returns the intervals of s where an edge is hidden: the union over all faces in front of it.
    ///
    /// This is the inner loop of hidden-line removal. Children are visited front to back, because a
    /// near face is more likely to hide the whole interval and thus end the descent. The result is
    /// borrowed from `scratch` and is incomplete if no work is left there.
    pub(crate) fn hidden_intervals<'a>(
        &self,
        edge: &ProjectedEdge,
        scratch: &'a mut OcclusionScratch,
    ) -> &'a OcclusionIntervals {
        self.hidden_intervals_but(edge, &[], scratch)
    }

    /// Like [`hidden_intervals`](Self::hidden_intervals), but for an edge with parts that are known
    /// to be hidden and need no comparison.
    pub(crate) fn hidden_intervals_but<'a>(
        &self,
        edge: &ProjectedEdge,
        known: &[[f64; 2]],
        scratch: &'a mut OcclusionScratch,
    ) -> &'a OcclusionIntervals {
        scratch.restart(self.screen.root_node());
        known.iter().for_each(|part| scratch.hidden.insert_interval(*part));
        let on_screen = ScreenEdge::new(edge, self.respects_depth);
        while let Some(node) = scratch.node_stack.pop() {
            if !scratch.take_work(1) {
                break;
            }
            let Some(interval) = self.screen.interval_behind(node, &on_screen) else { continue };
            if scratch.hidden.contains_interval(interval) {
                continue;
            }
            match self.screen.contents(node) {
                Ok(children) => scratch.node_stack.extend(children),
                Err(triangles) => {
                    if !scratch.take_work(triangles.len()) {
                        break;
                    }
                    for triangle in triangles {
                        let interval = on_screen.interval_over_triangle(triangle);
                        if interval.is_none_or(|part| scratch.hidden.contains_interval(part)) {
                            continue;
                        }
                        let (tolerance, found) = (&self.tolerance, |part| scratch.insert(part));
                        self.occlude_edge(triangle, edge, &on_screen, tolerance, found);
                    }
                    if scratch.hidden.contains_interval([0.0, 1.0]) {
                        break;
                    }
                }
            }
        }
        scratch.join_sides();
        if !scratch.hidden.is_empty() {
            scratch.hidden.remove_slivers(self.tolerance.min_part / edge.screen_length());
        }
        &scratch.hidden
    }

    /// Finds the parts of an edge hidden by a triangle of the hierarchy.
    pub(super) fn occlude_edge(
        &self,
        leaf: &LeafTriangle,
        edge: &ProjectedEdge,
        on_screen: &ScreenEdge<'_>,
        tolerance: &Tolerance,
        mut found: impl FnMut(Occlusion),
    ) {
        let (vertices, triangle) = self.screen.triangle(leaf, &self.mesh);
        if on_screen.is_beside(vertices, tolerance.crack.max(tolerance.screen)) {
            return;
        }
        let Some(overlap) = (Occluder { vertices }).overlap(edge, tolerance) else { return };
        let object = self.mesh.object(triangle);
        let in_world = |vertices| OccluderInWorld { vertices, projector: &self.projector };
        // The plane is computed from the unclipped triangle, because clipping must not tilt it.
        let whole = || in_world(self.mesh.positions(triangle));
        let clipped = || in_world(self.screen.world_vertices(leaf, &self.mesh));
        let interior = overlap.interior.and_then(|interval| match self.respects_depth {
            true => whole().interval_behind(edge, interval, tolerance),
            false => Some(interval),
        });
        interior.into_iter().for_each(|interval| found(Occlusion::Interior(interval)));
        let Some(overlap) = overlap.side else { return };
        let SideOverlap { side, interval, is_along, is_left, is_wide } = overlap;
        let interval = match (self.respects_depth, is_along) {
            (false, _) => Some(interval),
            (true, true) => whole().interval_behind(edge, interval, tolerance),
            (true, false) => clipped().interval_behind_side(side, edge, interval, tolerance),
        };
        if let Some(interval) = interval {
            let part = SideInterval { interval, is_left, is_wide, object };
            found(if is_along { Occlusion::Along(part) } else { Occlusion::Beside(part) });
        }
    }
}
