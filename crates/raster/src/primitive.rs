//! Primitives: screen triangles, and lines and points as triangles.

use crate::ScreenVertex;
use crate::screen_vertex::{GRID_RANGE, SUBPIXELS};

/// How a primitive affects visibility: the glTF alpha modes `OPAQUE`, `MASK` and `BLEND`.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Opacity {
    /// Hides everything behind it: its color and alpha replace the values behind.
    #[default]
    Opaque,
    /// Alpha tested: hides everything behind it where
    /// [`Surface::passes_alpha_test`](crate::Surface::passes_alpha_test) is true, and is absent
    /// elsewhere.
    Masked,
    /// Alpha blended: its fragments are blended over opaque fragments, back to front.
    Translucent,
}

/// The triangles of a mesh to cull, by their winding on the screen (y down).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum CullMode {
    /// No triangles.
    #[default]
    Nothing,
    /// Clockwise triangles: back faces, if front faces are counterclockwise (glTF, OpenGL).
    Clockwise,
    /// Counterclockwise triangles: front faces as glTF and OpenGL wind them.
    CounterClockwise,
}

impl CullMode {
    /// Returns whether a triangle with this [signed area](crate::signed_area) is drawn.
    #[inline(always)]
    #[must_use]
    pub const fn retains(self, area: i64) -> bool {
        match self {
            Self::Nothing => true,
            Self::Clockwise => area < 0,
            Self::CounterClockwise => area > 0,
        }
    }
}

/// The weights of a source primitive's vertices at each vertex of a triangle that is part of it.
///
/// A clipped triangle becomes several triangles, and a line or a point becomes two. Shading needs
/// weights in the submitted primitive; this table converts weights in the part to them.
pub type SourceWeights = [[f32; 3]; 3];

/// A screen triangle with its vertices clockwise (y down), and the primitive to which it belongs.
///
/// It fills one cache line and is aligned to it, because bins refer to triangles all over the
/// buffer.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct ScreenTriangle {
    pub(crate) vertices: [ScreenVertex; 3],
    /// The id with which the primitive was submitted.
    pub(crate) id: u32,
    pub(crate) source: WeightSource,
    pub(crate) opacity: Opacity,
}

const _: () = assert!(size_of::<ScreenTriangle>() == 64, "one cache line");

impl ScreenTriangle {
    /// Returns the depth of the nearest vertex: no sample of the triangle is nearer.
    #[inline(always)]
    pub(crate) fn nearest_depth(&self) -> f32 {
        let [p, q, r] = &self.vertices;
        p.depth.max(q.depth).max(r.depth)
    }
}

/// The conversion from weights of a screen triangle's vertices to weights of its source primitive's
/// vertices.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum WeightSource {
    /// The triangle is the whole primitive.
    Unclipped,
    /// The triangle is the whole primitive, with two vertices swapped to make it clockwise.
    Flipped,
    /// The triangle is part of the primitive: an index into the frame's source weights.
    Clipped(u32),
}

/// The range of 1/w in which no product of the weights and their derivatives overflows or
/// underflows.
const SAFE_INV_W: core::ops::RangeInclusive<f32> = 1.0 / MAX_SAFE_INV_W..=MAX_SAFE_INV_W;
/// The maximum of this range, 2⁴⁰.
const MAX_SAFE_INV_W: f32 = 1_099_511_627_776.0;

/// Returns the vertices, with 1/w scaled if it is extreme: weights depend only on the ratios of
/// 1/w.
#[inline(always)]
pub(crate) fn normalize_inv_w(vertices: [ScreenVertex; 3]) -> [ScreenVertex; 3] {
    let is_safe = |vertex: &ScreenVertex| SAFE_INV_W.contains(&vertex.inv_w());
    if is_safe(&vertices[0]) & is_safe(&vertices[1]) & is_safe(&vertices[2]) {
        return vertices;
    }
    scale_inv_w_to_one(vertices)
}

/// Scales 1/w so that the largest value is 1.
///
/// No value becomes less than 2⁻⁸⁰, so the divisor of the weights is never 0. Kept out of line,
/// because ordinary scenes never need it.
#[cold]
fn scale_inv_w_to_one(vertices: [ScreenVertex; 3]) -> [ScreenVertex; 3] {
    let [p, q, r] = vertices.map(|vertex| f64::from(vertex.inv_w()));
    let largest = p.max(q).max(r);
    let least = 1.0 / (MAX_SAFE_INV_W * MAX_SAFE_INV_W);
    vertices.map(|vertex| {
        let ratio = (f64::from(vertex.inv_w()) / largest) as f32;
        ScreenVertex::new(vertex.x, vertex.y, vertex.depth, ratio.max(least)).unwrap_or(vertex)
    })
}

/// Converts a line to the two triangles of a rectangle around it, or returns no triangle if its
/// ends coincide.
///
/// The ends of the rectangle are flush with the ends of the line. Depth and 1/w are constant across
/// the line.
pub(crate) fn triangulate_line(
    [a, b]: [ScreenVertex; 2],
    width: f64,
) -> [Option<([ScreenVertex; 3], SourceWeights)>; 2] {
    let (dx, dy) = (f64::from(b.x) - f64::from(a.x), f64::from(b.y) - f64::from(a.y));
    let length = (dx * dx + dy * dy).sqrt();
    if length == 0.0 {
        return [None, None];
    }
    // The normal of the line, half a line width long.
    let scale = 0.5 * width * f64::from(SUBPIXELS) / length;
    let (nx, ny) = (-dy * scale, dx * scale);
    // The four vertices of the rectangle, each with the weights of its end.
    let (at_a, at_b) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let [a0, a1] = [offset_vertex(a, nx, ny), offset_vertex(a, -nx, -ny)];
    let [b0, b1] = [offset_vertex(b, nx, ny), offset_vertex(b, -nx, -ny)];
    [Some(([a0, b0, b1], [at_a, at_b, at_b])), Some(([a0, b1, a1], [at_a, at_b, at_a]))]
}

/// Converts a point to the two triangles of a square around it, with constant depth and 1/w.
pub(crate) fn triangulate_point(
    center: ScreenVertex,
    size: f64,
) -> [([ScreenVertex; 3], SourceWeights); 2] {
    // Half the side in grid steps.
    let half = 0.5 * size * f64::from(SUBPIXELS);
    let corner = |x: f64, y: f64| offset_vertex(center, x * half, y * half);
    let [nw, ne] = [corner(-1.0, -1.0), corner(1.0, -1.0)];
    let [sw, se] = [corner(-1.0, 1.0), corner(1.0, 1.0)];
    let weights = [[1.0, 0.0, 0.0]; 3];
    [([nw, ne, se], weights), ([nw, se, sw], weights)]
}

/// Moves a vertex by grid steps, rounded to the nearest step (halves up).
fn offset_vertex(vertex: ScreenVertex, dx: f64, dy: f64) -> ScreenVertex {
    // Keep the vertices within the guard band even for very wide lines.
    let shift = |from: i32, by: f64| {
        let moved = from.saturating_add((by + 0.5).floor() as i32);
        moved.clamp(*GRID_RANGE.start(), *GRID_RANGE.end())
    };
    let mut moved = vertex;
    (moved.x, moved.y) = (shift(vertex.x, dx), shift(vertex.y, dy));
    moved
}
