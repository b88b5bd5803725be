//! Projected edge: an edge clipped to the view volume, on the screen and in the world.
//!
//! A position on the edge is specified by s, the fraction of its length on the *screen*. The
//! fraction of its length in the *world*, u, follows from the rule for perspective-correct
//! interpolation (IN-1), because a projective map takes lines to lines:
//!
//! ```text
//!            r s                      q u
//!  u = ─────────────        s = ─────────────       r, q: the clip-space w of the two ends
//!       q + s (r − q)            r + u (q − r)
//! ```
//!
//! In a parallel projection, r = q, and both fractions are equal.

use crate::projector::Projector;
use glam::{DVec2, DVec3};

/// The part of an edge inside the view volume, with the map between screen and world fractions.
///
/// Both ends have a positive w: clipping removes points at or behind the eye before the divide.
#[derive(Clone, Debug)]
pub(crate) struct ProjectedEdge {
    /// The ends on the screen, in pixels, with y down.
    pub(crate) screen: [DVec2; 2],
    /// The depths of the ends, 0 at the far plane and 1 at the near plane; linear in s.
    pub(crate) depths: [f64; 2],
    /// The ends in world space, after clipping.
    pub(crate) world: [DVec3; 2],
    /// The clip-space w of the ends: the divisors of the perspective divide.
    w: [f64; 2],
    /// The part of the original edge that remains after clipping, as fractions of its length in the
    /// world.
    clip_range: [f64; 2],
}

impl ProjectedEdge {
    /// Clips an edge in world space to the view volume, divides by w, and maps it to the screen.
    ///
    /// Returns `None` if no part of the edge is inside the volume, or if an end has no finite
    /// image. Ends that are not clipped keep the bits of the vertex, so that edges with a common
    /// vertex meet exactly.
    pub(crate) fn clip_and_project(ends: [DVec3; 2], projector: &Projector) -> Option<Self> {
        let clipped = projector.clip_edge(ends)?;
        let [a, b] = [
            projector.project_to_screen(clipped.start)?,
            projector.project_to_screen(clipped.end)?,
        ];
        let position = |t: f64| match t {
            0.0 => ends[0],
            1.0 => ends[1],
            t => ends[0] + (ends[1] - ends[0]) * t,
        };
        Some(Self {
            screen: [a.truncate(), b.truncate()],
            depths: [a.z, b.z],
            world: [position(clipped.t0), position(clipped.t1)],
            w: [clipped.start.w(), clipped.end.w()],
            clip_range: [clipped.t0, clipped.t1],
        })
    }

    /// Returns the length on the screen in pixels.
    pub(crate) fn screen_length(&self) -> f64 {
        (self.screen[1] - self.screen[0]).length()
    }

    /// Returns the point on the screen at fraction s; at 0 and 1, it has the bits of the ends.
    pub(crate) fn screen_at(&self, s: f64) -> DVec2 {
        let [a, b] = self.screen;
        if s == 1.0 { b } else { a + (b - a) * s }
    }

    /// Returns the depth at fraction s, exact at both ends like [`Self::screen_at`].
    pub(crate) fn depth_at(&self, s: f64) -> f64 {
        let [a, b] = self.depths;
        if s == 1.0 { b } else { a + (b - a) * s }
    }

    /// Returns the world fraction u at the screen fraction s (inverse of IN-1).
    pub(crate) fn world_fraction(&self, s: f64) -> f64 {
        let [r, q] = self.w;
        if r == q { s } else { r * s / (q + s * (r - q)) }
    }

    /// Returns the screen fraction s at the world fraction u (IN-1).
    pub(crate) fn screen_fraction(&self, u: f64) -> f64 {
        let [r, q] = self.w;
        if r == q { u } else { q * u / (r + u * (q - r)) }
    }

    /// Returns the fraction of the original, unclipped edge in the world at the screen fraction s.
    pub(crate) fn edge_fraction(&self, s: f64) -> f64 {
        let [t0, t1] = self.clip_range;
        t0 + (t1 - t0) * self.world_fraction(s)
    }
}
