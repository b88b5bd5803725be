//! Edge functions and the top-left rule (RA-1; Pineda 1988).
//!
//! ```text
//!        v2                  E(p) > 0 inside, for each of the three edges.
//!       /  \                 A sample on an edge, E(p) = 0, is inside if the edge is
//!      / +  \                a left edge (the inside is to its right) or a top edge
//!     v0────v1               (horizontal, the inside below it on the screen).
//! ```
//! Two triangles that share an edge see it from opposite sides, so exactly one of them owns the samples on it.

use crate::ScreenVertex;

/// The function E(x, y) = a x + b y + c of an edge in grid steps, exact in 64 bits.
///
/// The top-left rule is folded into c: a sample is on the inside if and only if E ≥ 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeFunction {
    pub(crate) a: i64,
    pub(crate) b: i64,
    c: i64,
}

impl EdgeFunction {
    /// The edge from `start` to `end` of a triangle of positive area (clockwise on a screen with y down).
    pub(crate) fn new(start: ScreenVertex, end: ScreenVertex) -> Self {
        let (x, y) = (i64::from(start.x), i64::from(start.y));
        let a = y - i64::from(end.y);
        let b = i64::from(end.x) - x;
        // (a, b) is the normal to the inside: it points right on a left edge, and down (larger y) on a top edge.
        let owns_border = a > 0 || (a == 0 && b > 0);
        Self { a, b, c: -(a * x + b * y) - i64::from(!owns_border) }
    }

    /// E at a grid position, ≥ 0 if the edge does not exclude it.
    pub(crate) fn evaluate(&self, x: i64, y: i64) -> i64 {
        self.a * x + self.b * y + self.c
    }
}

/// Twice the signed area of a triangle in square grid steps: positive if its corners run clockwise on the screen
/// (y down), that is counter-clockwise in a space with y up seen from behind; 0 if it covers nothing.
///
/// A surface whose front is counter-clockwise (glTF, OpenGL) has a **negative** area here when it faces the viewer.
#[must_use]
pub fn signed_area([p, q, r]: [ScreenVertex; 3]) -> i64 {
    let (qx, qy) = (i64::from(q.x) - i64::from(p.x), i64::from(q.y) - i64::from(p.y));
    let (rx, ry) = (i64::from(r.x) - i64::from(p.x), i64::from(r.y) - i64::from(p.y));
    qx * ry - qy * rx
}

#[cfg(test)]
mod tests {
    use super::*;

    fn v(x: i32, y: i32) -> ScreenVertex {
        ScreenVertex::new(x, y, 0.5, 1.0).expect("on the grid")
    }

    #[test]
    fn counter_clockwise_with_y_up_is_negative_area_on_the_screen() {
        // y up: (0,0) (1,0) (0,1) is counter-clockwise; with y down its corners are (0,1) (1,1) (0,0).
        assert!(signed_area([v(0, 256), v(256, 256), v(0, 0)]) < 0);
    }
}
