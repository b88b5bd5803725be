//! Edge functions and the top-left rule (RA-1; Pineda, *A Parallel Algorithm for Polygon
//! Rasterization*, 1988).
//!
//! ```text
//!        v2                  E(p) > 0 inside, for each of the three edges.
//!       /  \                 A sample on an edge, E(p) = 0, is inside if the edge is
//!      / +  \                a left edge (the inside is to its right) or a top edge
//!     v0────v1               (horizontal, with the inside below it on the screen).
//! ```
//! Two triangles that share an edge see it from opposite sides, so exactly one of them owns the
//! samples on it. There is no gap, and no sample is drawn twice. All of this is integer arithmetic
//! on snapped vertices; a tolerance would only move the gaps.

use crate::ScreenVertex;

/// The edge function E(x, y) = a x + b y + c in grid steps, exact in 64 bits.
///
/// The top-left rule is part of c: if an edge does not own its samples, c is reduced by one, so E ≥
/// 0 if and only if the sample is inside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeFunction {
    pub(crate) a: i64,
    pub(crate) b: i64,
    c: i64,
}

impl EdgeFunction {
    /// Creates the edge function from `start` to `end` for a triangle with positive area (clockwise
    /// on a screen with y down).
    pub(crate) fn new(start: ScreenVertex, end: ScreenVertex) -> Self {
        let (x, y) = (i64::from(start.x), i64::from(start.y));
        let a = y - i64::from(end.y);
        let b = i64::from(end.x) - x;
        // Top-left rule. (a, b) is the inward normal: it points right on a left edge, and down
        // (larger y) on a top edge.
        let is_top_left = a > 0 || (a == 0 && b > 0);
        // E is 0 on the edge; a bias of one step makes it negative if the edge does not own its
        // samples.
        Self { a, b, c: -(a * x + b * y) - i64::from(!is_top_left) }
    }

    /// Evaluates E at a grid position: the result is ≥ 0 if the edge does not exclude the position.
    pub(crate) fn evaluate(&self, x: i64, y: i64) -> i64 {
        self.a * x + self.b * y + self.c
    }
}

/// Returns twice the signed area of a triangle in square grid steps: positive if its vertices are
/// clockwise on the screen (y down), and 0 if it is degenerate.
///
/// A surface whose front faces are counterclockwise (glTF, OpenGL) has a **negative** area here
/// when it faces the viewer. The result is exact: coordinates have 23 bits within the guard band.
#[must_use]
pub fn signed_area([p, q, r]: [ScreenVertex; 3]) -> i64 {
    let (qx, qy) = (i64::from(q.x) - i64::from(p.x), i64::from(q.y) - i64::from(p.y));
    let (rx, ry) = (i64::from(r.x) - i64::from(p.x), i64::from(r.y) - i64::from(p.y));
    qx * ry - qy * rx
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertex(x: i32, y: i32) -> ScreenVertex {
        ScreenVertex::new(x, y, 0.5, 1.0).expect("on the grid")
    }

    #[test]
    fn counterclockwise_triangles_with_y_up_have_negative_screen_area() {
        // y up: (0,0) (1,0) (0,1) is counterclockwise; with y down its corners are (0,1) (1,1)
        // (0,0).
        assert!(signed_area([vertex(0, 256), vertex(256, 256), vertex(0, 0)]) < 0);
    }
}
