//! Segment clipping (CL-2; Liang and Barsky, 1984, in homogeneous space).
//!
//! ```text
//!            ┌─────────┐
//!   p ───────●─────────●───► q        t0 is the last entry, t1 the first exit;
//!        t0  │         │ t1           if t0 > t1, the segment misses the box
//!            └─────────┘
//! ```

use crate::sutherland_hodgman::{EdgeFraction, crossing_fraction, safe_scale, unscaled};
use crate::{Outcode, PlaneIndex, PlaneOutcomes, Volume};
use core::cmp::Ordering;
use glam::DVec4;
use homog::{Clip, HPoint};

/// The visible part of a segment from p to q.
///
/// # Guarantees
/// - 0 ≤ `t0` ≤ `t1` ≤ 1; both endpoints are finite, have w > 0 and are inside the volume's box or
///   on its boundary.
/// - An endpoint that is inside is unchanged. The segment from q to p gives the same two points,
///   bit for bit.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct ClippedSegment {
    /// The first point that is inside.
    pub start: HPoint<Clip>,
    /// The last point that is inside. It equals `start` if only one point is left.
    pub end: HPoint<Clip>,
    /// The fraction at `start` of the way from p to q. Use it to interpolate attributes of the
    /// endpoints; no further correction is needed.
    pub t0: f64,
    /// The fraction at `end`.
    pub t1: f64,
    /// The plane through which the segment enters, or `None` if it starts inside.
    pub enter: Option<PlaneIndex>,
    /// The plane through which the segment leaves, or `None` if it ends inside.
    pub exit: Option<PlaneIndex>,
}

impl ClippedSegment {
    /// Returns whether only one point is left: the segment only touches the volume or has no
    /// length.
    #[must_use]
    pub fn is_point(&self) -> bool {
        self.start == self.end
    }

    fn reversed(self) -> Self {
        Self {
            start: self.end,
            end: self.start,
            t0: 1.0 - self.t1,
            t1: 1.0 - self.t0,
            enter: self.exit,
            exit: self.enter,
        }
    }
}

/// Returns the part of the segment from `p` to `q` inside a volume, or `None` if nothing is inside
/// or an endpoint is not finite.
///
/// Clipping comes before the divide, so segments that cross w = 0, start behind the eye or end at
/// infinity are handled correctly.
///
/// ```
/// use clip::{PlaneIndex, Volume, clip_segment};
/// use homog::HPoint;
/// // From a point in front of the eye to one behind it.
/// let (p, q) = (HPoint::new(0.0, 0.0, 0.0, 1.0), HPoint::new(0.0, 0.0, 3.0, -1.0));
/// let visible = clip_segment(p, q, &Volume::CHAPTER).expect("it starts inside");
/// assert_eq!((visible.t0, visible.t1), (0.0, 0.2));
/// assert_eq!(visible.exit, Some(PlaneIndex::NEAR));
/// assert_eq!(visible.end.divide().map(|end| end.z()), Some(1.0));
/// ```
#[must_use]
pub fn clip_segment(p: HPoint<Clip>, q: HPoint<Clip>, volume: &Volume) -> Option<ClippedSegment> {
    // Only one of the two directions is ever computed, so both give bit-identical results.
    if compare_points(p.raw(), q.raw()) == Ordering::Greater {
        return Some(VisibleSpan::new(q, p, volume).ok()?.end_points(q, p, volume)?.reversed());
    }
    VisibleSpan::new(p, q, volume).ok()?.end_points(p, q, volume)
}

/// Returns the effect of each plane on the segment from `p` to `q`: why it is clipped or rejected.
///
/// A segment that passes outside a corner of the volume is rejected by two planes: it leaves
/// through one before it enters through the other.
#[must_use]
pub fn segment_outcomes(p: HPoint<Clip>, q: HPoint<Clip>, volume: &Volume) -> PlaneOutcomes {
    match VisibleSpan::new(p, q, volume) {
        Ok(span) => PlaneOutcomes { clipped: span.planes(), rejected: Outcode::INSIDE },
        Err(rejected) => PlaneOutcomes::from_rejected(rejected),
    }
}

/// Compares finite points in a total order.
fn compare_points(p: DVec4, q: DVec4) -> Ordering {
    let mut pairs = p.to_array().into_iter().zip(q.to_array());
    pairs.find_map(|(a, b)| Some(a.total_cmp(&b)).filter(|o| o.is_ne())).unwrap_or(Ordering::Equal)
}

/// A crossing with a plane at the fraction `t` of the way from p to q.
#[derive(Clone, Copy)]
struct PlaneCrossing {
    t: f64,
    blend: EdgeFraction,
    plane: PlaneIndex,
}

impl PlaneCrossing {
    /// Returns the crossing point, given the endpoint inside the plane and the endpoint outside.
    fn crossing_point(
        self,
        inner: HPoint<Clip>,
        outer: HPoint<Clip>,
        volume: &Volume,
    ) -> HPoint<Clip> {
        let scale = safe_scale(&[inner.raw(), outer.raw()]);
        let (inner, outer) = (inner.raw() * scale, outer.raw() * scale);
        let point = match self.blend {
            EdgeFraction::FromInner(t) => inner + (outer - inner) * t,
            EdgeFraction::FromOuter(t) => outer + (inner - outer) * t,
        };
        HPoint::from_raw(
            volume.clamp_to_box(unscaled(volume.snap_to_plane(self.plane, point), scale)),
        )
    }
}

/// The span between the last entry and the first exit.
#[derive(Clone, Copy, Default)]
struct VisibleSpan {
    enter: Option<PlaneCrossing>,
    exit: Option<PlaneCrossing>,
}

impl VisibleSpan {
    /// Returns the span inside the volume, or the planes that reject the segment.
    fn new(p: HPoint<Clip>, q: HPoint<Clip>, volume: &Volume) -> Result<Self, Outcode> {
        let (p_outside, q_outside) = (volume.outcode(p), volume.outcode(q));
        let rejected = p_outside & q_outside;
        if !rejected.is_inside() || !p.is_finite() || !q.is_finite() {
            return Err(rejected);
        }
        let scale = safe_scale(&[p.raw(), q.raw()]);
        let (p, q) = (p.raw() * scale, q.raw() * scale);
        let mut span = Self::default();
        for plane in (p_outside | q_outside).planes() {
            let (a, b) = (volume.plane_distance(plane, p), volume.plane_distance(plane, q));
            // A point slightly outside may end up at distance 0 when huge points are scaled down.
            if p_outside.contains(plane) {
                let (a, b) = (a.min(-f64::MIN_POSITIVE), b.max(0.0));
                span.enter_by(PlaneCrossing {
                    t: a / (a - b),
                    blend: crossing_fraction(b, a),
                    plane,
                });
            } else {
                let (a, b) = (a.max(0.0), b.min(-f64::MIN_POSITIVE));
                span.exit_by(PlaneCrossing {
                    t: a / (a - b),
                    blend: crossing_fraction(a, b),
                    plane,
                });
            }
        }
        if span.t0() > span.t1() { Err(span.planes()) } else { Ok(span) }
    }

    fn enter_by(&mut self, crossing: PlaneCrossing) {
        if self.enter.is_none_or(|enter| enter.t < crossing.t) {
            self.enter = Some(crossing);
        }
    }

    fn exit_by(&mut self, crossing: PlaneCrossing) {
        if self.exit.is_none_or(|exit| exit.t > crossing.t) {
            self.exit = Some(crossing);
        }
    }

    fn t0(self) -> f64 {
        self.enter.map_or(0.0, |crossing| crossing.t)
    }

    fn t1(self) -> f64 {
        self.exit.map_or(1.0, |crossing| crossing.t)
    }

    fn planes(self) -> Outcode {
        let crossings = [self.enter, self.exit].into_iter().flatten();
        crossings.fold(Outcode::INSIDE, |planes, crossing| planes.with_plane(crossing.plane))
    }

    fn end_points(
        self,
        p: HPoint<Clip>,
        q: HPoint<Clip>,
        volume: &Volume,
    ) -> Option<ClippedSegment> {
        let start = self.enter.map_or(p, |enter| enter.crossing_point(q, p, volume));
        let end = self.exit.map_or(q, |exit| exit.crossing_point(p, q, volume));
        // The zero vector is in every closed volume but is not a point. A segment that ends there
        // runs straight toward the eye: all of it has the same image as its other end.
        let (start, end) = match (start.w() > 0.0, end.w() > 0.0) {
            (true, true) => (start, end),
            (true, false) => (start, start),
            (false, true) => (end, end),
            (false, false) => return None,
        };
        let (enter, exit) = (self.enter.map(|c| c.plane), self.exit.map(|c| c.plane));
        Some(ClippedSegment { start, end, t0: self.t0(), t1: self.t1(), enter, exit })
    }
}
