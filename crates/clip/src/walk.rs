//! One step of Sutherland and Hodgman (1974): a ring of vertices against one plane (CL-3).
//!
//! ```text
//!        inside │ outside         walked a → b → c → a:
//!     a ────────┼──► b              a        keep
//!      ▲        │    │              a b      cross, interpolated from a
//!       ╲       │    ▼              b c      nothing
//!        ╲──────┼─── c              c a      cross, interpolated from a
//! ```
//!
//! A crossing is always interpolated from its inner to its outer end. Two polygons that share an edge walk it in
//! opposite directions; this way both get the same bits.

use glam::DVec4;

/// A vertex of the ring behind a plane.
pub(crate) enum Step {
    /// The vertex with this number stays.
    Keep(usize),
    /// The plane crosses the edge between two vertices at fraction `t` of the way from the inner to the outer.
    Cross { inner: usize, outer: usize, t: f64 },
}

/// Walks a ring, given the distances of its vertices from the plane, and emits the ring that is left.
pub(crate) fn walk(distances: &[f64], mut emit: impl FnMut(Step)) {
    let count = distances.len();
    for start in 0..count {
        let end = if start + 1 == count { 0 } else { start + 1 };
        let (a, b) = (distances[start], distances[end]);
        if a >= 0.0 {
            emit(Step::Keep(start));
        }
        // An inner end on the plane is the crossing itself and stays anyway.
        if a > 0.0 && b < 0.0 {
            emit(Step::Cross { inner: start, outer: end, t: a / (a - b) });
        } else if a < 0.0 && b > 0.0 {
            emit(Step::Cross { inner: end, outer: start, t: b / (b - a) });
        }
    }
}

/// A power of two that makes sums and differences of these coordinates safe from overflow: 1 for all but huge ones.
pub(crate) fn safe_scale<'a>(points: impl IntoIterator<Item = &'a DVec4>) -> f64 {
    const HUGE: f64 = 1e270;
    let is_huge = points.into_iter().any(|p| p.abs().max_element() > HUGE);
    if is_huge { DOWN } else { 1.0 }
}

/// 2⁻²⁵⁶.
const DOWN: f64 = f64::from_bits((1023 - 256) << 52);
