//! Screen hierarchy: a world-space hierarchy as seen by one viewer.
//!
//! ```text
//!   world      nodes ──────────────────► the same nodes, with boxes on the screen
//!   vertices   projected once each ────► leaves: triangles that are neither edge-on nor outside
//!                                        the view volume, clipped where they cross its border
//! ```
//!
//! The tree is built once for all views of a sheet; each view only computes the new boxes, from the
//! leaves up. Points close in space are close on the screen, so the tree is as good as a tree built
//! on the screen, and boxes at different depths remain separate.
//!
//! A triangle is stored here as an index and a box; its vertices are in the mesh. When an edge
//! meets a leaf, most of the leaf's triangles are beside or behind the edge. The boxes, which are
//! consecutive in memory, show this without access to the vertices.

use super::bounds::{greatest, least, round_down, round_up};
use super::bvh::{Bvh, NodeContents};
use super::projected_edge::ProjectedEdge;
use crate::projector::Projector;
use clip::{ClipVertex, Outcode, Volume, clip_triangle};
use glam::{DVec2, DVec3};

/// A mesh of triangles that share vertices.
pub(crate) trait TriangleMesh: Sync {
    /// Returns the number of triangles.
    fn triangle_count(&self) -> u32;
    /// Returns the number of vertices.
    fn vertex_count(&self) -> u32;
    /// Returns the vertices of a triangle.
    fn vertex_indices(&self, triangle: u32) -> [u32; 3];
    /// Returns the position of a vertex in the world.
    fn position(&self, vertex: u32) -> DVec3;
    /// Returns the object that a triangle is part of.
    fn object(&self, triangle: u32) -> u32;

    /// Returns the positions of the vertices of a triangle.
    fn positions(&self, triangle: u32) -> [DVec3; 3] {
        self.vertex_indices(triangle).map(|vertex| self.position(vertex))
    }
}

/// A reference to a triangle on the screen, or to a piece that remains after clipping to the view
/// volume.
#[derive(Clone, Copy, Debug)]
enum ScreenTriangle {
    /// A whole triangle of the mesh.
    Whole {
        /// The index of the triangle.
        triangle: u32,
        /// Whether its last two vertices are swapped.
        is_reversed: bool,
    },
    /// A piece that remains after clipping, by its index.
    Clipped(u32),
}

impl ScreenTriangle {
    /// Packs the variant, in two bits, and an index into one number.
    fn pack(self) -> u32 {
        match self {
            Self::Whole { triangle, is_reversed } => triangle << 2 | u32::from(is_reversed) << 1,
            Self::Clipped(piece) => piece << 2 | 1,
        }
    }

    fn unpack(bits: u32) -> Self {
        match bits & 1 {
            0 => Self::Whole { triangle: bits >> 2, is_reversed: bits & 2 != 0 },
            _ => Self::Clipped(bits >> 2),
        }
    }
}

/// A piece of a triangle that remains after clipping to the view volume.
#[derive(Clone, Copy, Debug)]
struct ClippedPiece {
    triangle: u32,
    vertices: [DVec2; 3],
    /// The barycentric weights of each of these vertices in the triangle.
    weights: [[f64; 3]; 3],
}

/// A box on the screen, with its nearest depth.
#[derive(Clone, Copy, Debug)]
struct DepthBox {
    min: [f32; 2],
    max: [f32; 2],
    /// The largest depth, where 1 is nearest.
    nearest: f32,
}

impl DepthBox {
    const EMPTY: Self =
        Self { min: [f32::INFINITY; 2], max: [f32::NEG_INFINITY; 2], nearest: f32::NEG_INFINITY };

    /// Returns the box around two boxes.
    fn union(&self, other: &Self) -> Self {
        Self {
            min: [0, 1].map(|k| least(self.min[k], other.min[k])),
            max: [0, 1].map(|k| greatest(self.max[k], other.max[k])),
            nearest: greatest(self.nearest, other.nearest),
        }
    }
}

/// A triangle of a leaf.
#[derive(Clone, Copy, Debug)]
pub(super) struct LeafTriangle {
    bounds: DepthBox,
    /// The packed [`ScreenTriangle`].
    packed: u32,
}

/// A node of the screen hierarchy.
#[derive(Clone, Copy, Debug)]
struct ScreenNode {
    bounds: DepthBox,
    /// As in [`Bvh`]: the second child, or the first triangle of a leaf.
    first: u32,
    /// The number of triangles of a leaf, or [`INNER_NODE`].
    count: u32,
}

/// The count that marks inner nodes.
const INNER_NODE: u32 = u32::MAX;

/// The boxes and the triangles of a mesh on the screen of one viewer.
#[derive(Clone, Debug)]
pub(super) struct ScreenBvh {
    nodes: Vec<ScreenNode>,
    /// The triangles in the order of the leaves.
    triangles: Vec<LeafTriangle>,
    pieces: Vec<ClippedPiece>,
    /// The vertices on the screen in pixels, or NaN for vertices without an image.
    vertices: Vec<DVec2>,
}

/// The projected vertices of a mesh, with their outcodes.
struct ProjectedVertices {
    screen: Vec<DVec2>,
    /// The depths, rounded toward the viewer.
    depths: Vec<f32>,
    outcodes: Vec<Outcode>,
}

impl ProjectedVertices {
    fn new(mesh: &impl TriangleMesh, projector: &Projector) -> Self {
        let count = mesh.vertex_count() as usize;
        let (mut screen, mut depths, mut outcodes) =
            (Vec::with_capacity(count), Vec::with_capacity(count), Vec::with_capacity(count));
        for vertex in 0..mesh.vertex_count() {
            let clip = projector.world_to_clip_point(mesh.position(vertex));
            let at = projector.project_to_screen(clip).unwrap_or(DVec3::NAN);
            screen.push(at.truncate());
            depths.push(round_up(at.z));
            outcodes.push(Volume::CHAPTER.outcode(clip));
        }
        Self { screen, depths, outcodes }
    }
}

/// The inputs needed to add triangles to leaves.
struct LeafView<'a> {
    projector: &'a Projector,
    projected: &'a ProjectedVertices,
    /// The height in pixels up to which a triangle hides nothing.
    thinnest: f64,
    /// The margin of boxes in pixels.
    margin: f64,
}

impl ScreenBvh {
    /// Projects a mesh and computes the boxes of its hierarchy on the screen, in O(n).
    ///
    /// `thinnest` is the height in pixels up to which a triangle hides nothing; `margin` is the
    /// margin of the boxes.
    pub(super) fn new(
        mesh: &impl TriangleMesh,
        bvh: &Bvh,
        projector: &Projector,
        [thinnest, margin]: [f64; 2],
    ) -> Self {
        let projected = ProjectedVertices::new(mesh, projector);
        let view = LeafView { projector, projected: &projected, thinnest, margin };
        let empty = ScreenNode { bounds: DepthBox::EMPTY, first: 0, count: 0 };
        let mut tree = Self {
            nodes: vec![empty; bvh.node_count()],
            triangles: Vec::with_capacity(bvh.order.len()),
            pieces: Vec::new(),
            vertices: Vec::new(),
        };
        // Children follow their parents, so in reverse order they are computed first.
        for index in (0..bvh.node_count()).rev() {
            tree.nodes[index] = match bvh.contents(index as u32) {
                NodeContents::Nodes(children) => tree.join_nodes(children),
                NodeContents::Items(range) => {
                    let first = tree.triangles.len() as u32;
                    for &triangle in &bvh.order[range] {
                        tree.push_triangle(triangle, mesh, &view);
                    }
                    let boxes = tree.triangles[first as usize..].iter().map(|leaf| &leaf.bounds);
                    let bounds = boxes.fold(DepthBox::EMPTY, |all, next| all.union(next));
                    let count = tree.triangles.len() as u32 - first;
                    ScreenNode { bounds, first, count }
                }
            };
        }
        tree.vertices = projected.screen;
        tree
    }

    /// Creates the parent of two nodes; the first child directly follows it.
    fn join_nodes(&self, [first, second]: [u32; 2]) -> ScreenNode {
        let [a, b] = [first, second].map(|node| &self.nodes[node as usize].bounds);
        ScreenNode { bounds: a.union(b), first: second, count: INNER_NODE }
    }

    /// Adds a triangle, or its pieces inside the view volume, to the current leaf.
    fn push_triangle(&mut self, triangle: u32, mesh: &impl TriangleMesh, view: &LeafView<'_>) {
        let LeafView { projector, projected, thinnest, margin } = *view;
        let indices = mesh.vertex_indices(triangle).map(|vertex| vertex as usize);
        let outcodes = indices.map(|vertex| projected.outcodes[vertex]);
        if Outcode::trivially_accepts(&outcodes) {
            let corners = indices.map(|vertex| projected.screen[vertex]);
            if let Some(is_reversed) = orientation(corners, thinnest) {
                let depths = indices.map(|vertex| projected.depths[vertex]);
                let bounds = box_around(corners, depths, margin);
                let packed = ScreenTriangle::Whole { triangle, is_reversed }.pack();
                self.triangles.push(LeafTriangle { bounds, packed });
            }
        } else if Outcode::trivially_rejects(&outcodes).is_inside() {
            let clip = mesh.positions(triangle).map(|at| projector.world_to_clip_point(at));
            for piece in clip_triangle(clip, &Volume::CHAPTER).triangles() {
                self.push_piece(triangle, piece, view);
            }
        }
    }

    /// Adds a piece of a triangle to the current leaf.
    fn push_piece(
        &mut self,
        triangle: u32,
        corners: [ClipVertex; 3],
        &LeafView { projector, thinnest, margin, .. }: &LeafView<'_>,
    ) {
        let to_screen = |corner: ClipVertex| projector.project_to_screen(corner.point);
        let [Some(a), Some(b), Some(c)] = corners.map(to_screen) else { return };
        let [p, q, r] = [a, b, c].map(DVec3::truncate);
        let Some(is_reversed) = orientation([p, q, r], thinnest) else { return };
        let bounds = box_around([p, q, r], [a, b, c].map(|corner| round_up(corner.z)), margin);
        let vertices = reverse_if(is_reversed, [p, q, r]);
        let weights = reverse_if(is_reversed, corners.map(|corner| corner.weights));
        let packed = ScreenTriangle::Clipped(self.pieces.len() as u32).pack();
        self.triangles.push(LeafTriangle { bounds, packed });
        self.pieces.push(ClippedPiece { triangle, vertices, weights });
    }

    /// Returns the vertices of a leaf triangle in pixels, ordered so that `(b − a) × (c − a)` is
    /// positive, and the index of the triangle in the mesh.
    pub(super) fn triangle(
        &self,
        leaf: &LeafTriangle,
        mesh: &impl TriangleMesh,
    ) -> ([DVec2; 3], u32) {
        match ScreenTriangle::unpack(leaf.packed) {
            ScreenTriangle::Whole { triangle, is_reversed } => {
                let corners = mesh.vertex_indices(triangle);
                let vertices = corners.map(|vertex| self.vertices[vertex as usize]);
                (reverse_if(is_reversed, vertices), triangle)
            }
            ScreenTriangle::Clipped(piece) => {
                let piece = &self.pieces[piece as usize];
                (piece.vertices, piece.triangle)
            }
        }
    }

    /// Returns the world-space vertices of a leaf triangle, in the same order as
    /// [`Self::triangle`].
    pub(super) fn world_vertices(
        &self,
        leaf: &LeafTriangle,
        mesh: &impl TriangleMesh,
    ) -> [DVec3; 3] {
        match ScreenTriangle::unpack(leaf.packed) {
            ScreenTriangle::Whole { triangle, is_reversed } => {
                reverse_if(is_reversed, mesh.positions(triangle))
            }
            ScreenTriangle::Clipped(piece) => {
                let ClippedPiece { triangle, weights, .. } = self.pieces[piece as usize];
                let [a, b, c] = mesh.positions(triangle);
                weights.map(|[u, v, w]| a * u + b * v + c * w)
            }
        }
    }

    /// Returns the interval of s where an edge passes over the box of a node and is not completely
    /// in front of it.
    pub(super) fn interval_behind(&self, node: u32, edge: &ScreenEdge<'_>) -> Option<[f64; 2]> {
        edge.interval_behind(&self.nodes[node as usize].bounds)
    }

    /// Returns the root, or `None` if the hierarchy is empty.
    pub(super) fn root_node(&self) -> Option<u32> {
        (!self.nodes.is_empty()).then_some(0)
    }

    /// Returns the two children of a node, with the nearer child last, or the triangles of a leaf.
    pub(super) fn contents(&self, index: u32) -> Result<[u32; 2], &[LeafTriangle]> {
        let node = &self.nodes[index as usize];
        if node.count != INNER_NODE {
            return Err(&self.triangles[node.first as usize..(node.first + node.count) as usize]);
        }
        let [a, b] = [index + 1, node.first];
        let nearest = |node: u32| self.nodes[node as usize].bounds.nearest;
        Ok(if nearest(a) > nearest(b) { [b, a] } else { [a, b] })
    }
}

/// Creates the box around the corners of a triangle, with a margin in pixels on the screen.
fn box_around([a, b, c]: [DVec2; 3], depths: [f32; 3], margin: f64) -> DepthBox {
    let (min, max) = (a.min(b).min(c) - margin, a.max(b).max(c) + margin);
    DepthBox {
        min: min.to_array().map(round_down),
        max: max.to_array().map(round_up),
        nearest: greatest(greatest(depths[0], depths[1]), depths[2]),
    }
}

/// Swaps the last two vertices if `is_reversed` is true.
fn reverse_if<T>(is_reversed: bool, [a, b, c]: [T; 3]) -> [T; 3] {
    if is_reversed { [a, c, b] } else { [a, b, c] }
}

/// Returns whether two vertices must be swapped so that the signed area of a triangle is positive.
/// Returns `None` if the triangle is thinner than `thinnest` pixels or has no image.
fn orientation([a, b, c]: [DVec2; 3], thinnest: f64) -> Option<bool> {
    let area = (b - a).perp_dot(c - a);
    let sides = [b - a, c - b, a - c];
    // The sum of both components is at least the length, so most triangles need no square root.
    let longest = sides.iter().fold(0.0_f64, |most, side| most.max(side.x.abs() + side.y.abs()));
    if area.abs() > thinnest * longest {
        return Some(area < 0.0);
    }
    let longest = sides.iter().fold(0.0_f64, |most, side| most.max(side.length()));
    (area.abs() > thinnest * longest).then_some(area < 0.0)
}

/// An edge, prepared for comparison with boxes.
pub(super) struct ScreenEdge<'a> {
    edge: &'a ProjectedEdge,
    /// The lower corner of the box around the edge; `high` is the opposite corner.
    low: DVec2,
    high: DVec2,
    /// The change of s per pixel along x and y; 0 along an axis perpendicular to the edge.
    slope: DVec2,
    /// Whether a box hides only parts behind it.
    respects_depth: bool,
}

/// The extent in pixels below which an edge counts as perpendicular to an axis.
const LEAST_CHANGE: f64 = 1e-9;

impl<'a> ScreenEdge<'a> {
    pub(super) fn new(edge: &'a ProjectedEdge, respects_depth: bool) -> Self {
        let [a, b] = edge.screen;
        let inverse = |step: f64| if step.abs() < LEAST_CHANGE { 0.0 } else { 1.0 / step };
        let slope = DVec2::new(inverse(b.x - a.x), inverse(b.y - a.y));
        Self { edge, low: a.min(b), high: a.max(b), slope, respects_depth }
    }

    /// Whether a triangle is outside the box around the edge by more than `margin` pixels.
    pub(super) fn is_beside(&self, [a, b, c]: [DVec2; 3], margin: f64) -> bool {
        let (low, high) = (self.low - margin, self.high + margin);
        (a.x < low.x && b.x < low.x && c.x < low.x)
            || (a.x > high.x && b.x > high.x && c.x > high.x)
            || (a.y < low.y && b.y < low.y && c.y < low.y)
            || (a.y > high.y && b.y > high.y && c.y > high.y)
    }

    /// Returns the interval of s where the edge passes over a box on the screen and is not
    /// completely in front of it.
    ///
    /// ```text
    ///         ┌──────┐
    ///   a ────┼──────┼──── b      s at the sides along x and along y: the last entry and the
    ///         └──────┘            first exit bound the interval
    ///          s₀    s₁
    /// ```
    ///
    /// This is a slab test in x and y (Kay and Kajiya 1986), followed by one comparison of depth.
    /// If even the farthest point of the edge is nearer than the nearest point of the box, nothing
    /// in the box can hide it. Depth is linear in s, so its extremes are at the ends. The margin of
    /// the boxes is far larger than the rounding errors here.
    fn interval_behind(&self, bounds: &DepthBox) -> Option<[f64; 2]> {
        let (min, max) = (bounds.min.map(f64::from), bounds.max.map(f64::from));
        let is_apart = self.high.x < min[0]
            || self.low.x > max[0]
            || self.high.y < min[1]
            || self.low.y > max[1];
        if is_apart {
            return None;
        }
        let [enter, leave] = self.interval_over_box(min, max)?;
        if !self.respects_depth {
            return Some([enter, leave]);
        }
        let [a, b] = self.edge.depths;
        let [first, last] = [enter, leave].map(|s| a + (b - a) * s);
        let farthest = if first < last { first } else { last };
        (farthest <= f64::from(bounds.nearest)).then_some([enter, leave])
    }

    /// Returns the interval of s where the edge passes over the box around a triangle.
    pub(super) fn interval_over_triangle(&self, leaf: &LeafTriangle) -> Option<[f64; 2]> {
        self.interval_over_box(leaf.bounds.min.map(f64::from), leaf.bounds.max.map(f64::from))
    }

    /// Returns the interval of s where the edge passes over a box (slab test). Along an axis
    /// perpendicular to the edge, the box must overlap the edge.
    fn interval_over_box(&self, min: [f64; 2], max: [f64; 2]) -> Option<[f64; 2]> {
        let from = self.edge.screen[0];
        let (mut enter, mut leave) = (0.0, 1.0);
        for k in 0..2 {
            if self.slope[k] != 0.0 {
                let [s, t] = [min[k], max[k]].map(|side| (side - from[k]) * self.slope[k]);
                let (first, last) = if s < t { (s, t) } else { (t, s) };
                enter = if first > enter { first } else { enter };
                leave = if last < leave { last } else { leave };
            }
        }
        (enter <= leave).then_some([enter, leave])
    }
}
