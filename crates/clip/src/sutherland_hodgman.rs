//! One step of Sutherland and Hodgman (1974): a ring of vertices against one plane (CL-3).
//!
//! ```text
//!        inside │ outside         walked a → b → c → a:
//!     a ────────┼──► b              a        keep
//!      ▲        │    │              a b      cross
//!       ╲       │    ▼              b c      nothing
//!        ╲──────┼─── c              c a      cross
//! ```
//!
//! A crossing is always computed from the end nearer to the plane, where the blend is most
//! accurate. Two polygons that share an edge walk it in opposite directions, so this gives
//! bit-identical results.

use glam::DVec4;

/// A vertex of the ring after clipping to a plane.
pub(crate) enum RingStep {
    /// The vertex with this number is kept.
    Keep(usize),
    /// The plane crosses an edge at fraction `t` of the way between two vertices, t ≤ ½.
    Cross { from: usize, to: usize, t: f64 },
}

/// Walks a ring, given the distances of its vertices from the plane, and emits the clipped ring.
pub(crate) fn clip_ring(distances: &[f64], mut emit: impl FnMut(RingStep)) {
    let count = distances.len();
    for start in 0..count {
        let end = if start + 1 == count { 0 } else { start + 1 };
        let (a, b) = (distances[start], distances[end]);
        if a >= 0.0 {
            emit(RingStep::Keep(start));
        }
        // An inner end on the plane is the crossing itself and is kept anyway.
        if a > 0.0 && b < 0.0 {
            emit(ring_crossing((start, a), (end, b)));
        } else if a < 0.0 && b > 0.0 {
            emit(ring_crossing((end, b), (start, a)));
        }
    }
}

fn ring_crossing(inner: (usize, f64), outer: (usize, f64)) -> RingStep {
    match crossing_fraction(inner.1, outer.1) {
        EdgeFraction::FromInner(t) => RingStep::Cross { from: inner.0, to: outer.0, t },
        EdgeFraction::FromOuter(t) => RingStep::Cross { from: outer.0, to: inner.0, t },
    }
}

/// The crossing of a plane with an edge, as the fraction from the nearer end.
#[derive(Clone, Copy)]
pub(crate) enum EdgeFraction {
    FromInner(f64),
    FromOuter(f64),
}

/// Returns the crossing of an edge whose ends are at these distances, `inner` ≥ 0 and `outer` < 0.
pub(crate) fn crossing_fraction(inner: f64, outer: f64) -> EdgeFraction {
    if inner <= -outer {
        EdgeFraction::FromInner(inner / (inner - outer))
    } else {
        EdgeFraction::FromOuter(outer / (outer - inner))
    }
}

/// Returns a power of two that keeps sums and differences of these coordinates from overflowing: 1
/// unless they are huge.
pub(crate) fn safe_scale<'a>(points: impl IntoIterator<Item = &'a DVec4>) -> f64 {
    const HUGE: f64 = 1e290;
    let is_huge = points.into_iter().any(|p| p.abs().max_element() > HUGE);
    if is_huge { SCALE_DOWN } else { 1.0 }
}

/// Undoes the scale; coordinates beyond the largest finite number are clamped to it.
pub(crate) fn unscaled(point: DVec4, scale: f64) -> DVec4 {
    (point / scale).clamp(DVec4::MIN, DVec4::MAX)
}

/// 2⁻⁶⁴: enough for a guard band of 2²⁰ and four terms, and exact.
const SCALE_DOWN: f64 = f64::from_bits((1023 - 64) << 52);
