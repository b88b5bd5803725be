//! What a frame is made of: triangles, and lines and points turned into triangles.

use crate::ScreenVertex;
use crate::screen_vertex::{GRID_RANGE, SUBPIXELS};

/// How a primitive takes part in visibility.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Opacity {
    /// It hides what is behind it.
    #[default]
    Opaque,
    /// It hides what is behind it where [`Surface::passes_alpha_test`](crate::Surface::passes_alpha_test) says so, and is absent elsewhere.
    Masked,
    /// It lets through what is behind it: its fragments are blended over the solid ones, the farthest first.
    Translucent,
}

/// Which triangles of a mesh are left out, by the way their corners run on the screen (y down).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum CullMode {
    /// None.
    #[default]
    Nothing,
    /// Those that run clockwise, the backs of closed bodies as glTF and OpenGL wind them.
    Clockwise,
    /// Those that run counter-clockwise.
    CounterClockwise,
}

impl CullMode {
    /// Whether a triangle with this signed area is kept.
    #[inline(always)]
    pub(crate) const fn retains(self, area: i64) -> bool {
        match self {
            Self::Nothing => true,
            Self::Clockwise => area < 0,
            Self::CounterClockwise => area > 0,
        }
    }
}

/// For each corner of a piece, the weights of the source primitive's corners there.
///
/// A triangle that was clipped arrives in pieces; a line and a point arrive as rectangles. Whoever shades wants the
/// weights in the primitive he gave, and these lead back to it.
pub type SourceWeights = [[f32; 3]; 3];

/// A triangle of the screen, corners clockwise (y down), with the name of what it is a piece of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScreenTriangle {
    pub(crate) corners: [ScreenVertex; 3],
    pub(crate) id: u32,
    pub(crate) source: WeightSource,
    pub(crate) opacity: Opacity,
}

impl ScreenTriangle {
    /// The depth of its nearest corner.
    #[inline(always)]
    pub(crate) fn nearest_depth(&self) -> f32 {
        let [p, q, r] = &self.corners;
        p.depth.max(q.depth).max(r.depth)
    }
}

/// How the corners of a piece lead back to those of the primitive it is a piece of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum WeightSource {
    /// The piece is the primitive.
    Unclipped,
    /// The piece is the primitive with its second and third corner exchanged, so that they run clockwise.
    Flipped,
    /// By an entry of the frame's source weights.
    Clipped(u32),
}

/// The sizes of 1/w with which no product on the way to weights and their derivatives over- or underflows.
const SAFE_INV_W: core::ops::RangeInclusive<f32> = 1.0 / MAX_SAFE_INV_W..=MAX_SAFE_INV_W;
/// 2⁴⁰.
const MAX_SAFE_INV_W: f32 = 1_099_511_627_776.0;

/// The corners, with 1/w near 1 if it was very large or very small: weights depend on its ratios alone.
#[inline(always)]
pub(crate) fn normalize_inv_w(corners: [ScreenVertex; 3]) -> [ScreenVertex; 3] {
    let is_usual = |corner: &ScreenVertex| SAFE_INV_W.contains(&corner.inv_w());
    if is_usual(&corners[0]) & is_usual(&corners[1]) & is_usual(&corners[2]) {
        return corners;
    }
    scale_inv_w_to_one(corners)
}

/// The corners with 1 as the largest 1/w. None becomes so small that a weight between the others has nothing to be divided by.
#[cold]
fn scale_inv_w_to_one(corners: [ScreenVertex; 3]) -> [ScreenVertex; 3] {
    let [p, q, r] = corners.map(|corner| f64::from(corner.inv_w()));
    let largest = p.max(q).max(r);
    let least = 1.0 / (MAX_SAFE_INV_W * MAX_SAFE_INV_W);
    corners.map(|corner| {
        let share = (f64::from(corner.inv_w()) / largest) as f32;
        ScreenVertex::new(corner.x, corner.y, corner.depth, share.max(least)).unwrap_or(corner)
    })
}

/// A rectangle of the screen around a line, as two triangles; none if the ends coincide or cannot be drawn.
///
/// The ends are square and flush with the line's ends. Depth and 1/w are constant across the line.
pub(crate) fn triangulate_line(
    [a, b]: [ScreenVertex; 2],
    width: f64,
) -> [Option<([ScreenVertex; 3], SourceWeights)>; 2] {
    let (dx, dy) = (f64::from(b.x) - f64::from(a.x), f64::from(b.y) - f64::from(a.y));
    let length = (dx * dx + dy * dy).sqrt();
    if length == 0.0 {
        return [None, None];
    }
    let reach = 0.5 * width * f64::from(SUBPIXELS) / length;
    let (nx, ny) = (-dy * reach, dx * reach);
    let (at_a, at_b) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let [a0, a1] = [offset_vertex(a, nx, ny), offset_vertex(a, -nx, -ny)];
    let [b0, b1] = [offset_vertex(b, nx, ny), offset_vertex(b, -nx, -ny)];
    [Some(([a0, b0, b1], [at_a, at_b, at_b])), Some(([a0, b1, a1], [at_a, at_b, at_a]))]
}

/// A square of the screen around a point, as two triangles.
pub(crate) fn triangulate_point(
    center: ScreenVertex,
    size: f64,
) -> [([ScreenVertex; 3], SourceWeights); 2] {
    let reach = 0.5 * size * f64::from(SUBPIXELS);
    let corner = |x: f64, y: f64| offset_vertex(center, x * reach, y * reach);
    let [nw, ne] = [corner(-1.0, -1.0), corner(1.0, -1.0)];
    let [sw, se] = [corner(-1.0, 1.0), corner(1.0, 1.0)];
    let there = [[1.0, 0.0, 0.0]; 3];
    [([nw, ne, se], there), ([nw, se, sw], there)]
}

fn offset_vertex(vertex: ScreenVertex, dx: f64, dy: f64) -> ScreenVertex {
    // However wide a line, its corners stay on the grid.
    let shift = |from: i32, by: f64| {
        from.saturating_add((by + 0.5).floor() as i32).clamp(*GRID_RANGE.start(), *GRID_RANGE.end())
    };
    let mut moved = vertex;
    (moved.x, moved.y) = (shift(vertex.x, dx), shift(vertex.y, dy));
    moved
}
